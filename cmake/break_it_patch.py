"""Makes the headers of one program of broken headers; LjusBreakIt.cmake calls it.

    break_it_patch.py HEADERS FOLDER TEST CASES switched ROW HEADER [ROW HEADER]...
    break_it_patch.py HEADERS FOLDER TEST CASES alone ROW HEADER

HEADERS is the folder that has ljus/ in it. HEADER is a path below ljus/, or begins with
examples/, the folder beside HEADERS. In FOLDER/rows/ROW, from.txt and to.txt say what the
row replaces by what; the header in which this is done is written there, too.

A row that is alone is compiled against that header. Other rows share one program, and its
headers, in FOLDER/switched, hold all of them: the body of a function that rows break is
there once as it was and once for each of these rows,

    { if (!on(1) && !on(2)) { as it was } else if (on(1)) { broken } else { broken } }

and the environment variable LJUS_BREAK_IT, the name of a row, says which of them runs.
#line gives each copy the name and lines of the file that it comes from, so that the
compiler's messages name the row.

Beside the headers stands a copy of the file TEST that has only the test cases that CASES
lets doctest run: the others would only cost the compiler's time.
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

/// The number of the row that the environment names; a row that is not here ends it all.
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

/// What is computed while the program is compiled is not broken.
constexpr bool on(int number) noexcept {
    return !std::is_constant_evaluated() && row == number;
}

} // namespace ljus_break_it
"""

# What may hold braces that are not code. Names and numbers are there so that the quote of
# 1'000 begins no character.
NOT_CODE = re.compile(
    r"""//[^\n]* | /\*.*?\*/ | ^[ \t]*\#(?:\\\n|[^\n])* |
        R"(?P<end>\w*)\(.*?\)(?P=end)" | "(?:\\.|[^"\\\n])*" | '(?:\\.|[^'\\\n])+' |
        (?P<word>\w(?:\w|'\w)*)""",
    re.VERBOSE | re.DOTALL | re.MULTILINE,
)


class Problem(Exception):
    """One sentence for whoever wrote the row."""


def blanked(text):
    """The text with spaces in place of comments, strings and directives."""

    def blank(match):
        if match["word"]:
            return match[0]
        return re.sub(r"[^\n]", " ", match[0])

    return NOT_CODE.sub(blank, text)


def closing(code, at):
    """Where the brace at this place is closed."""
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
    """What a brace after these words opens: a 'scope', a function's 'body' or 'else'."""
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
    """Where the functions' bodies begin and end, their braces included."""
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
        """Where FROM begins and ends in the header."""
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
        """The function's body that FROM lies in, without its braces."""
        for start, end in function_bodies(read(self.source)):
            if start < self.start and self.end < end:
                return start + 1, end - 1
        raise Problem(
            "its text does not lie in the body of a function, so that it cannot be "
            "switched while the program runs: give the row the word COMPILED"
        )


def without_other_cases(text, cases):
    """The source of a test without the test cases that doctest leaves out."""
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
    """Says that what follows stands at this place of this file."""
    return f'\n#line {text.count(chr(10), 0, at) + 1} "{file.as_posix()}"\n'


def switched(text, source, rows_of):
    """The header with a switch in each body; rows_of: {(start, end) of a body: rows}."""
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
