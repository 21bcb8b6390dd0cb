"""Tests mutants.py: what is changed in a small header, that the header with its mutants
compiles, and that one mutant at a time is on. self_test.py [COMPILER]"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import mutants

HEADER = """\
#pragma once
struct Pair { float x, y; }; // a < b in a comment, and "a + b"
template <typename T>
constexpr T difference(T a, T b) noexcept {
    return a - b;
}
inline constexpr int limit = 7;
inline int clipped(int a, const Pair& pair) {
    if (a > limit) return limit; // an early return
    const auto twice = [](int of) { return of * 2; };
    const char* const text = "a * b";
    a += text[0] == 'a' ? 1 : 0;
    return twice(a) + static_cast<int>(pair.x);
}
"""
EXPECTED = {  # operator and the changed line: what main() prints then
    ("arithmetic", "return a + b;"): "3 7 12",
    ("boundary", "if (a >= limit) return limit; "): "-1 7 12",
    ("comparison", "if (a <= limit) return limit; "): "-1 22 7",
    ("never", "false"): "-1 22 12",
    ("always", "true"): "-1 7 7",
    ("constant", "inline constexpr int limit = 8;"): "-1 8 12",
    ("arithmetic", "const auto twice = [](int of) { return of / 2; };"): "-1 7 4",
    ("factor", "const auto twice = [](int of) { return of ; };"): "-1 7 7",
    ("factor", "const auto twice = [](int of) { return 2; };"): "-1 7 4",
    ("statement", ""): "-1 7 10",
    ("arithmetic", "a -= text[0] == 'a' ? 1 : 0;"): "-1 7 8",
    ("negated", "!(text[0] == 'a')"): "-1 7 10",
    ("arithmetic", "return twice(a) - static_cast<int>(pair.x);"): "-1 7 8",
    ("axis", "return twice(a) + static_cast<int>(pair.y);"): "-1 7 15",
}
MAIN = """\
#include "header.hpp"
#include <cstdio>
static_assert(difference(3, 2) == 1);
int main() {
    std::printf("%d %d %d", difference(1, 2), clipped(9, {2, 5}), clipped(4, {2, 5}));
}
"""


def main():
    compiler = sys.argv[1] if len(sys.argv) > 1 else "g++"
    reader, regions = mutants.find(HEADER)
    all_of_them = [mutant for region in regions for mutant in region.mutants]
    for number, mutant in enumerate(all_of_them, 1):
        mutant.number = number
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        writer = mutants.Writer(reader, regions)
        (folder / "header.hpp").write_text(writer.write())
        switch = mutants.SWITCH.replace("COUNT", str(len(all_of_them)))
        (folder / "ljus_mutants.hpp").write_text(switch)
        (folder / "main.cpp").write_text(MAIN)
        program = str(folder / "program")
        command = [compiler, "-std=c++20", "-w", str(folder / "main.cpp"), "-o", program]
        subprocess.run(command, check=True)
        wrong = 0

        def says(number):
            environment = {**os.environ, "LJUS_MUTANT": str(number)}
            return subprocess.run([program], env=environment, capture_output=True).stdout.decode()

        found = {(m.operator, m.after): m for m in all_of_them}
        if says(0) != "-1 7 12":
            print(f"nothing is on, and it prints {says(0)}")
            wrong += 1
        for key, expected in EXPECTED.items():
            key = (key[0], " ".join(key[1].split()))
            match = [m for k, m in found.items() if (k[0], k[1].split(" //")[0]) == key]
            if not match:
                print(f"there is no mutant {key}")
                wrong += 1
            elif says(match[0].number) != expected:
                print(f"{key}: it prints {says(match[0].number)}, not {expected}")
                wrong += 1
        if any("comment" in m.before and m.line == 2 for m in all_of_them):
            print("a comment was changed")
            wrong += 1
        print(f"{len(all_of_them)} mutants, {wrong} problems")
        sys.exit(wrong != 0)


main()
