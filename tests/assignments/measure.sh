#!/usr/bin/env bash
# What the assignments take: chapters/measured/assignments.csv, on standard output.
# Seconds are those of one processor, user and system: the least of three runs.
# Usage: tests/assignments/measure.sh >chapters/measured/assignments.csv
set -euo pipefail
CDPATH= cd -- "$(dirname -- "$0")/../.."
cxx=${CXX:-g++}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
TIMEFORMAT='%U %S'

seconds() { # the least of three
    for run in 1 2 3; do
        { time "$@" >/dev/null 2>&1; } 2>&1
    done | awk '{ s = $1 + $2; if (NR == 1 || s < least) least = s } END { printf "%.1f", least }'
}

echo "# $("$cxx" --version | head -n 1), -O2; $(sed -n 's/^model name.*: //p' /proc/cpuinfo |
    head -n 1). Seconds of one processor: the least of three runs"
echo "assignment,tests,points,wrong,compile tests,run tests,compile picture,make picture"
for number in 1 2 3 4 5 6 7 8; do
    folder=$scratch/$number
    cp -R examples/assignments/"$number"_* "$folder"
    cp "tests/assignments/solutions/$number.hpp" "$folder/answer.hpp"
    compile() {
        "$cxx" -std=c++20 -O2 -I"$folder" -Iexamples/assignments -Iinclude \
            "$folder/$1.cpp" -o "$folder/$1"
    }
    printf '%s,%s,%s,%s' "$number" "$(grep -c '^TEST_CASE' "$folder/tests.cpp")" \
        "$(sed -n 's/^TEST_CASE("[0-9.]* (\([0-9]*\) point.*/\1/p' "$folder/tests.cpp" | paste -sd+ | bc)" \
        "$(grep -vc '^#' "tests/assignments/wrong/$number.txt")"
    printf ',%s' "$(seconds compile tests)" "$(seconds "$folder/tests")" \
        "$(seconds compile picture)" "$(seconds "$folder/picture" "$folder/picture.png")"
    echo
done
