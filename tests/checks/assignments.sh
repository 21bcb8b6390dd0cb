#!/usr/bin/env bash
# Checks the assignments: a copied folder compiles as it is, and each of its tests fails; the
# solution passes all of them; and with --wrong, each wrong solution of
# tests/assignments/wrong fails the test that its row names.
# Usage: assignments.sh [--wrong] [NUMBER...]
. "$(dirname "$0")/common.sh"
assignments=$LJUS_ROOT/examples/assignments
solutions=$LJUS_ROOT/tests/assignments
doctest_main=$scratch/doctest_main.o
problems=0
wrong=no
if [ "${1:-}" = --wrong ]; then
    wrong=yes
    shift
fi
problem() { echo "$*"; problems=$((problems + 1)); }

# doctest's main() is compiled once, and left out of the tests.
echo '#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>' >"$scratch/doctest_main.cpp"
# shellcheck disable=SC2086
"$LJUS_CXX" -std=c++20 -O1 $LJUS_PACKAGE_FLAGS -c "$scratch/doctest_main.cpp" -o "$doctest_main"

# compile FOLDER PROGRAM: of a folder with answer.hpp, given.hpp, tests.cpp.
compile() {
    grep -v DOCTEST_CONFIG_IMPLEMENT "$1/$2.cpp" >"$1/$2_only.cpp"
    # shellcheck disable=SC2086
    "$LJUS_CXX" -std=c++20 -O2 $warnings $LJUS_PACKAGE_FLAGS -I"$1" -I"$assignments" \
        -I"$include" "$1/$2_only.cpp" $3 -o "$1/$2"
}
cases() { sed -n 's/^TEST_CASE("\(.*\)").*/\1/p' "$1/tests.cpp"; }
strict="-Wall -Wextra -Wpedantic -Wshadow -Werror"

# Whether an assertion failed; a crash or a filter that matches no test does not count.
fails() {
    local status=0
    timeout 120 "$1/tests" "--test-case=$2" >"$1/output" 2>&1 || status=$?
    [ $status -eq 1 ] && grep -q '1 failed' "$1/output" && ! grep -q 'crashed' "$1/output"
}
passes() {
    timeout 120 "$1/tests" "--test-case=$2" >"$1/output" 2>&1 && grep -q '1 passed' "$1/output"
}

for number in ${*:-1 2 3 4 5 6 7 8}; do
    given=$(echo "$assignments/$number"_*)
    folder=$scratch/$number
    cp -R "$given" "$folder"
    warnings=$strict

    # As it is handed out.
    warnings="$strict -Wno-unused-parameter"
    compile "$folder" tests "$doctest_main"
    while read -r name; do
        fails "$folder" "$name" || problem "$number, the stub: it does not fail '$name'"
    done < <(cases "$folder")

    # The solution.
    warnings=$strict
    cp "$solutions/solutions/$number.hpp" "$folder/answer.hpp"
    "$LJUS_CMAKE" -D "GIVEN=$(tr '\n' ' ' <"$given/CMakeLists.txt" |
        sed 's/.*GIVEN *//; s/).*//' | tr -s ' ' ',')" \
        -D "ANSWER=$folder/answer.hpp" -P "$assignments/given.cmake"
    compile "$folder" tests "$doctest_main"
    while read -r name; do
        passes "$folder" "$name" ||
            { problem "$number, the solution: it does not pass '$name'"; tail -n 30 "$folder/output"; }
    done < <(cases "$folder")
    (cd "$folder" && compile "$folder" picture "" && ./picture picture.png && [ -s picture.png ]) ||
        problem "$number, the solution: there is no picture"

    # The rubric of the page has the points of the tests.
    points=$(cases "$folder" | sed 's/.*(\([0-9]*\) point.*/\1/' | awk '{ sum += $1 } END { print sum }')
    grep -q "^| tests | $points |\$" "$LJUS_ROOT/chapters/assignment_$number.md" ||
        problem "$number: its page gives the tests another sum than $points points"
    echo "assignment $number: $(cases "$folder" | wc -l) tests"
    [ $wrong = yes ] || continue

    # The wrong solutions; their common code is compiled once.
    cat >"$folder/common.hpp" <<'END'
#include <doctest/doctest.h>
#include "course/check.hpp"
#include "course/room.hpp"
#include "ljus/accel/kd_tree.hpp"
END
    warnings="-w"
    # shellcheck disable=SC2086
    "$LJUS_CXX" -std=c++20 -O2 $warnings $LJUS_PACKAGE_FLAGS -I"$folder" -I"$assignments" \
        -I"$include" -x c++-header "$folder/common.hpp" -o "$folder/common.hpp.gch"
    warnings="-w -include $folder/common.hpp"
    while IFS='|' read -r test from to; do
        case $test in '#'*) continue ;; esac
        code=$(<"$solutions/solutions/$number.hpp")
        case $code in *"$from"*) ;; *) problem "$number: the solution has no '$from'"; continue ;; esac
        printf '%s\n' "${code/"$from"/"$to"}" >"$folder/answer.hpp"
        compile "$folder" tests "$doctest_main"
        name=$(cases "$folder" | grep -F "$test(" | head -n 1)
        [ -n "$name" ] || { problem "$number: there is no test '$test'"; continue; }
        fails "$folder" "$name" || problem "$number, '$to' for '$from': '$name' does not notice"
    done <"$solutions/wrong/$number.txt"
    echo "assignment $number: $(grep -vc '^#' "$solutions/wrong/$number.txt") wrong solutions"
done
[ $problems -eq 0 ] || { echo "$problems problems"; exit 1; }
