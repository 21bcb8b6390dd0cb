#!/usr/bin/env bash
# Tests the break-it mechanism itself: only a failed assertion counts as noticed.
. "$(dirname "$0")/common.sh"
folder=$scratch/break_it_mechanism
ctest=$(dirname "$LJUS_CMAKE")/ctest
wrong=0
rm -rf "$folder"
mkdir -p "$folder"
"$LJUS_CMAKE" -S "$LJUS_ROOT/tests/checks/break_it_mechanism" -B "$folder" \
    -G "$LJUS_GENERATOR" -DCMAKE_MAKE_PROGRAM="$LJUS_MAKE_PROGRAM" \
    -DCMAKE_CXX_COMPILER="$LJUS_CXX" -DCMAKE_CXX_FLAGS="$LJUS_PACKAGE_FLAGS" \
    -DMAIN="$LJUS_ROOT/tests/doctest_main.cpp" \
    -DMODULE="$LJUS_ROOT/cmake/LjusBreakIt.cmake" >"$folder/configure.log" 2>&1 ||
    { cat "$folder/configure.log"; exit 1; }

# expect TEST ROW STEP SENTENCE: STEP (build, which is that of all rows of the test, or
# test) must fail for this row with the sentence; "passes" means that both must succeed.
expect() {
    local of=$1 name=$2 step=$3 sentence=$4 output status=0 seen
    output=$("$LJUS_CMAKE" --build "$folder" --target "break_it_$of" 2>&1) || status=$?
    seen=build
    if [ "$status" -eq 0 ]; then
        output=$("$ctest" --test-dir "$folder" -C BreakIt -V -R "^break_it\.$name\$" \
            --no-tests=error 2>&1) || status=$?
        seen=test
    fi
    [ "$status" -eq 0 ] && seen=passes
    if [ "$seen" = "$step" ] && echo "$output" | tr -s ' \n' '  ' | grep -F "$sentence" >/dev/null; then
        echo "as it should: $name: $step: $sentence"
    else
        echo "WRONG: $name should be: $step, with '$sentence'; it was: $seen, with"
        echo "$output"
        wrong=1
    fi
}

expect answer noticed passes "noticed by answer: the number"
expect answer awkward passes "noticed by"
expect answer member passes "noticed by"
expect answer lambda passes "noticed by"
expect answer compiled passes "noticed by"
expect answer equivalent test "nobody noticed"
expect answer crashes test "a crash is not a test that notices"
expect answer hangs test "Timeout"
expect answer throws test "no assertion failed"
expect answer no-such-case test "no test case is named 'no such case*'"
expect answer other-case test "nobody noticed"
expect answer constant test "give the row the word COMPILED"
expect answer constant-compiled passes "noticed by"
expect answer answer.unbroken passes "100% tests passed"
expect fails_unbroken fails_unbroken.unbroken test "what no header can mend"
expect not_compiled not-compiled build "rows/not-compiled/ljus/answer.hpp:7"
expect not_switched not-switched build "break it not-switched: its text does not lie in the body"
expect not_there not-there build "break it not-there: the text 'return 41' occurs 0 times"
expect there_twice there-twice build "break it there-twice: the text 'int ' occurs 6 times"
expect unchanged unchanged build "break it unchanged: FROM and TO are the same text"

# The change is shown, and the assertion that noticed it.
verdict=$(cat "$folder/break_it/answer/rows/noticed/verdict.txt")
for words in 'noticed, in answer.hpp:' '    - return 42' '    + return 43' \
    '1 assertions failed; the first:' 'answer_test.cpp:' 'values: CHECK( 43 == 42 )'; do
    if ! grep -qF -e "$words" <<<"$verdict"; then
        echo "WRONG: the verdict of a row has no '$words': $verdict"
        wrong=1
    fi
done

# By default the broken headers are neither built nor run.
if "$ctest" --test-dir "$folder" --show-only | grep 'break_it\.'; then
    echo "WRONG: ctest knows the broken headers without -C BreakIt"
    wrong=1
fi
# An unknown row must not count as "nothing is broken".
if (LJUS_BREAK_IT=no-such-row "$folder/break_it/answer/break_it_program_answer") 2>/dev/null; then
    echo "WRONG: a row that is not there is not refused"
    wrong=1
fi
exit $wrong
