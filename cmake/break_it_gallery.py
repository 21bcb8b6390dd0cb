"""Makes the headers in which the mistakes of a program's pictures can be switched on.

    break_it_gallery.py HEADERS FOLDER PROGRAM TESTS

HEADERS is the folder that contains ljus/; PROGRAM is a source file that names rows of
TESTS/break_it/*.cmake, each as `.row = "NAME"`. The headers that these rows change are
written to FOLDER, with ljus_break_it.hpp: the switch, and a description of each row, which
is the line before and after the change and the test case that notices. break_it_patch.py
says how a header can hold several mistakes.
"""

import re
import sys
from pathlib import Path

import break_it_patch as patch

SWITCH = """\
#pragma once

#include <array>
#include <cstring>
#include <type_traits>

namespace ljus_break_it {

/// The description of a row.
struct Told {
    const char* name;   ///< The row's name; empty for "nothing is broken".
    const char* header; ///< The header, as the row gives it.
    const char* from;   ///< The correct text.
    const char* to;     ///< The text with the mistake.
    const char* test;   ///< tests/TEST_test.cpp notices.
    const char* noticed; ///< The first test case that is run.
    int line;            ///< The line where that case begins.
};
inline constexpr std::array told{
    Told{"", "", "", "", "", "", 0},
ROWS};

/// The number of the row that is switched on; 0: none.
inline int row = 0;

/// Whether this row is switched on; never in what the compiler evaluates.
constexpr bool on(int number) noexcept {
    return !std::is_constant_evaluated() && row == number;
}

/// The number of the row with this name; 0 if there is none.
inline int number_of(const char* name) noexcept {
    for (std::size_t i = 0; i < told.size(); ++i)
        if (std::strcmp(told[i].name, name) == 0) return static_cast<int>(i);
    return 0;
}

} // namespace ljus_break_it
"""

# The arguments of a CMake command, in brackets, quoted or bare; and comments.
WORD = re.compile(
    r"""\#[^\n]* | \[(?P<end>=*)\[(?P<bracket>.*?)\](?P=end)\] |
        "(?P<quoted>(?:\\.|[^"\\])*)" | (?P<bare>[^\s()"\#]+) | (?P<close>\))""",
    re.VERBOSE | re.DOTALL,
)
FIELDS = ("NAME", "HEADER", "TEST", "FROM", "TO", "CASES")


def rows_in(text):
    """The rows of a file, each as the arguments of its ljus_break_it()."""
    for call in re.finditer(r"^ljus_break_it\(", text, re.MULTILINE):
        row, field = {"COMPILED": ""}, None
        at = call.end()
        while True:
            word = WORD.search(text, at)
            if word is None:
                raise patch.Problem("a row that is never closed")
            at = word.end()
            if word["close"]:
                break
            if word["bare"] == "COMPILED":
                row["COMPILED"] = "yes"
            elif word["bare"] in FIELDS:
                field = word["bare"]
            elif word["bare"]:
                row[field] = word["bare"]
            elif word["bracket"] is not None:
                row[field] = word["bracket"].removeprefix("\n")
            elif word["quoted"] is not None:
                row[field] = re.sub(r"\\(.)", r"\1", word["quoted"])
        yield row


def noticing_case(row, tests):
    """The first test case that matches the row's CASES, and its line."""
    text = patch.read(tests / f"{row['TEST']}_test.cpp")
    asked = [
        re.escape(p).replace(r"\*", ".*").replace(r"\?", ".")
        for p in row.get("CASES", "*").split(",")
    ]
    for pattern in asked:
        for case in re.finditer(
            r'^TEST_CASE\w*\(\s*((?:"[^"\\\n]*"\s*)+)', text, re.MULTILINE
        ):
            name = "".join(re.findall('"(.*?)"', case[1]))
            if re.fullmatch(pattern, name, re.IGNORECASE):
                return name, text.count("\n", 0, case.start()) + 1
    raise patch.Problem(f"no test case is named '{row.get('CASES', '*')}'")


def literal(text):
    """A C++ string literal."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
    return f'"{escaped}"'


def main():
    headers, folder, program, tests = (Path(argument) for argument in sys.argv[1:5])
    named = list(dict.fromkeys(re.findall(r'\.row = "([^"]+)"', patch.read(program))))
    known = {}
    for file in sorted((tests / "break_it").glob("*.cmake")):
        known |= {row["NAME"]: row for row in rows_in(patch.read(file))}
    rows_of, told, problems = {}, [], 0
    for number, name in enumerate(named, 1):
        try:
            if name not in known:
                raise patch.Problem("no row of tests/break_it has this name")
            fields = known[name]
            if fields["COMPILED"]:
                raise patch.Problem("the row is COMPILED, and cannot be switched")
            patch.write(folder / "rows" / name / "from.txt", fields["FROM"])
            patch.write(folder / "rows" / name / "to.txt", fields.get("TO", ""))
            row = patch.Row(number, name, fields["HEADER"], headers, folder)
            row.find()
            bodies = rows_of.setdefault(row.source, {})
            bodies.setdefault(row.find_body(), []).append(row)
            case, line = noticing_case(fields, tests)
            strings = [name, fields["HEADER"], row.old, row.new, fields["TEST"], case]
            told.append(f"    Told{{{', '.join(map(literal, strings))}, {line}}},\n")
        except patch.Problem as problem:
            print(f"{program}: the row {name}: {problem}.", file=sys.stderr)
            problems += 1
    if problems:
        sys.exit(1)
    for source, bodies in rows_of.items():
        text = patch.switched(patch.read(source), source, bodies)
        patch.write(folder / patch.as_included(source, headers), text)
    patch.write(folder / "ljus_break_it.hpp", SWITCH.replace("ROWS", "".join(told)))


if __name__ == "__main__":
    main()
