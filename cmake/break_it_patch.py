"""Makes the broken headers of one program; LjusBreakIt.cmake calls it.

    break_it_patch.py HEADERS FOLDER TEST CASES switched ROW HEADER [ROW HEADER]...
    break_it_patch.py HEADERS FOLDER TEST CASES alone ROW HEADER

HEADERS is the folder that contains ljus/. HEADER is a path below ljus/, or begins with
examples/, the folder beside HEADERS. In FOLDER/rows/ROW, the row replaces the text of
from.txt by that of to.txt; the changed header is written there as well.

With `alone`, the test is compiled against that header. With `switched`, all rows share one
program and its headers in FOLDER/switched: a function that rows break has one body as it
was and one for each of these rows,

    { if (!on(1) && !on(2)) { as it was } else if (on(1)) { broken } else { broken } }

and the environment variable LJUS_BREAK_IT, the name of a row, chooses among them. #line
gives each copy the name and lines of the file that it comes from, so that the compiler's
messages name the row.

The file TEST is copied beside the headers with only the test cases that match CASES, since
compiling the others would only take time.
"""

import functools
import re
import shutil
import sys
from pathlib import Path

SWITCH = """\
#pragma once

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <type_traits>

namespace ljus_break_it {

inline constexpr const char* names[] = {"nothing is broken", NAMES};

/// The number of the row that LJUS_BREAK_IT names; ends the program if there is none.
inline int chosen() noexcept {
    const char* const name = std::getenv("LJUS_BREAK_IT");
    if (name == nullptr || *name == '\\0') return 0;
    int number = 0;
    for (const char* const of : names) {
        if (std::strcmp(of, name) == 0) return number;
        ++number;
    }
    std::fprintf(stderr, "LJUS_BREAK_IT: there is no row '%s' here.\\n", name);
    std::_Exit(3);
}
inline const int row = chosen();

/// Whether this row is switched on; never in what the compiler evaluates.
constexpr bool on(int number) noexcept {
    return !std::is_constant_evaluated() && row == number;
}

} // namespace ljus_break_it
"""

# Text whose braces are not code. Names and numbers are matched so that the quote of 1'000
# does not begin a character literal.
NOT_CODE = re.compile(
    r"""//[^\n]* | /\*.*?\*/ | ^[ \t]*\#(?:\\\n|[^\n])* |
        R"(?P<end>\w*)\(.*?\)(?P=end)" | "(?:\\.|[^"\\\n])*" | '(?:\\.|[^'\\\n])+' |
        (?P<word>\w(?:\w|'\w)*)""",
    re.VERBOSE | re.DOTALL | re.MULTILINE,
)


class Problem(Exception):
    """One sentence for the author of the row."""


def blanked(text):
    """The text with comments, strings and directives replaced by spaces."""

    def blank(match):
        if match["word"]:
            return match[0]
        return re.sub(r"[^\n]", " ", match[0])

    return NOT_CODE.sub(blank, text)


def closing(code, at):
    """The position of the brace that closes the one at this position."""
    depth = 0
    for brace in re.compile(r"[{}]").finditer(code, at):
        depth += 1 if brace[0] == "{" else -1
        if depth == 0:
            return brace.start()
    raise Problem("its header has a brace that is never closed")


def without_template(head):
    """A declaration without its 'template <...>'."""
    while start := re.search(r"\btemplate\s*<", head):
        depth, end = 1, start.end()
        while depth and end < len(head):
            depth += {"<": 1, ">": -1}.get(head[end], 0)
            end += 1
        head = head[: start.start()] + head[end:]
    return head


def opened_by(head):
    """What a brace after this text opens: a 'scope', a function's 'body', or 'else'."""
    head = re.sub(r"\balignas\s*\([^()]*\)", "", without_template(head))
    if re.search(r"\benum\b", head):
        return "else"
    if re.search(r"\bnamespace\b[\w:\s]*$|\b(struct|class|union)\s[^()=]*$", head):
        return "scope"
    if re.search(r"\brequires\s*(\([^()]*\)\s*)?$", head):
        return "else"  # requires { ... }
    if re.search(r"\)[^:]*[^:]:[^:].*\w\s*$", head, re.DOTALL):
        return "else"  # Constructor() : member{...}
    head = re.sub(r"\boperator\s*(\(\s*\)|[^\s\w(]+)", "operator", head)
    head = re.sub(r"[=<>!]=", "", head)
    if "(" not in head or re.search(r"\bconsteval\b", head):
        return "else"
    while (inner := re.sub(r"\([^()]*\)", "", head)) != head:
        head = inner
    return "else" if "=" in head else "body"  # x = [](...) {...}


@functools.cache  # rows share headers
def function_bodies(text):
    """The beginnings and ends of all function bodies, braces included."""
    code = blanked(text)
    bodies = []
    head = at = parentheses = 0
    while at < len(code):
        if code[at] in "([":
            parentheses += 1
        elif code[at] in ")]":
            parentheses -= 1
        elif code[at] == "}" or (code[at] == ";" and not parentheses):
            head = at + 1
        elif code[at] == "{":
            opened = "else" if parentheses else opened_by(code[head:at])
            if opened == "scope":
                head = at + 1
            else:
                end = closing(code, at)
                if opened == "body":
                    bodies.append((at, end + 1))
                    head = end + 1
                at = end
        at += 1
    return bodies


def as_included(source, headers):
    """How a program names a header: ljus/geometry/sphere.hpp, or flatland/light.hpp for
    examples/flatland/light.hpp."""
    beside = headers.parent / "examples"
    return source.relative_to(beside if beside in source.parents else headers)


class Row:
    def __init__(self, number, name, header, headers, folder):
        self.number = number
        self.name = name
        of_example = header.startswith("examples/")
        self.source = (headers.parent if of_example else headers / "ljus") / header
        self.folder = folder / "rows" / name
        self.broken = self.folder / as_included(self.source, headers)
        self.old = read(self.folder / "from.txt")
        self.new = read(self.folder / "to.txt")

    def find(self):
        """The beginning and end of FROM in the header."""
        text = read(self.source)
        if self.old == self.new:
            raise Problem("FROM and TO are the same text")
        count = text.count(self.old)
        if count != 1:
            raise Problem(
                f"the text '{self.old}' occurs {count} times in {self.source}; it must "
                "occur exactly once"
            )
        self.start = text.index(self.old)
        self.end = self.start + len(self.old)
        for other in self.folder.iterdir():  # another header, before
            if other.is_dir():
                shutil.rmtree(other)
        write(self.broken, text[: self.start] + self.new + text[self.end :])

    def find_body(self):
        """The function body that contains FROM, without its braces."""
        for start, end in function_bodies(read(self.source)):
            if start < self.start and self.end < end:
                return start + 1, end - 1
        raise Problem(
            "its text does not lie in the body of a function, so that it cannot be "
            "switched while the program runs: give the row the word COMPILED"
        )


def without_other_cases(text, cases):
    """The source of a test without the test cases that do not match CASES."""
    patterns = [
        re.escape(pattern).replace(r"\*", ".*").replace(r"\?", ".")
        for pattern in cases.split(",")
    ]
    asked = re.compile("|".join(patterns), re.IGNORECASE)
    code = blanked(text)
    result, done = "", 0
    for case in re.finditer(r'^TEST_CASE\w*\(\s*((?:"[^"\\\n]*"\s*)+)', text, re.MULTILINE):
        name = "".join(re.findall('"(.*?)"', case[1]))
        if not asked.fullmatch(name):
            end = closing(code, code.index("{", case.end())) + 1
            result += text[done : case.start()] + "\n" * text.count("\n", case.start(), end)
            done = end
    return result + text[done:]


def read(file):
    return file.read_text(encoding="utf-8")


def write(file, text):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")


def line_of(text, at, file):
    """A #line directive: the next line has this number in this file."""
    return f'\n#line {text.count(chr(10), 0, at) + 1} "{file.as_posix()}"\n'


def switched(text, source, rows_of):
    """The header with a switch in each body; rows_of is {(start, end) of a body: rows}."""
    result = '#include "ljus_break_it.hpp"' + line_of(text, 0, source)
    done = 0
    for (start, end), rows in sorted(rows_of.items()):
        none = " && ".join(f"!::ljus_break_it::on({row.number})" for row in rows)
        result += text[done:start] + f"\nif ({none}) {{" + line_of(text, start, source)
        result += text[start:end]
        for row in rows:
            result += "\n} else "
            if row is not rows[-1]:
                result += f"if (::ljus_break_it::on({row.number})) "
            result += "{" + line_of(text, start, row.broken)
            result += text[start : row.start] + row.new + text[row.end : end]
        result += "\n}" + line_of(text, end, source)
        done = end
    return result + text[done:]


def main():
    headers, folder, test = (Path(argument) for argument in sys.argv[1:4])
    cases, how = sys.argv[4:6]
    pairs = zip(sys.argv[6::2], sys.argv[7::2])
    rows = [Row(number, *pair, headers, folder) for number, pair in enumerate(pairs, 1)]
    rows_of = {row.source: {} for row in rows}
    problems = 0
    for row in rows:
        try:
            row.find()
            if how == "switched":
                rows_of[row.source].setdefault(row.find_body(), []).append(row)
        except Problem as problem:
            print(f"break it {row.name}: {problem}.", file=sys.stderr)
            problems += 1
    if problems:
        sys.exit(1)
    target = rows[0].folder
    if how == "switched":
        target = folder / "switched"
        shutil.rmtree(target, ignore_errors=True)  # rows may have gone
        names = ", ".join(f'"{row.name}"' for row in rows)
        write(target / "ljus_break_it.hpp", SWITCH.replace("NAMES", names))
        for source, bodies in rows_of.items():
            text = switched(read(source), source, bodies)
            write(target / as_included(source, headers), text)
    text = read(test)
    write(target / test.name, line_of(text, 0, test) + without_other_cases(text, cases))


if __name__ == "__main__":
    main()
