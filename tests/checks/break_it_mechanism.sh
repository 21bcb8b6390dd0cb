#!/usr/bin/env bash
# Tests the break-it mechanism itself: only an assertion that fails counts as noticed.
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

# expect NAME STEP SENTENCE: STEP (build or test) of this row must fail with the sentence;
# "passes" means that both must succeed.
expect() {
    local name=$1 step=$2 sentence=$3 output status=0 seen
    output=$("$LJUS_CMAKE" --build "$folder" --target "break_it_$name" 2>&1) || status=$?
    seen=build
    if [ "$status" -eq 0 ]; then
        output=$("$ctest" --test-dir "$folder" -V -R "^break_it\.$name\$" 2>&1) || status=$?
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

expect noticed passes "1 assertions failed; it was noticed by"
expect awkward passes "noticed by"
expect equivalent test "nobody noticed"
expect crashes test "a crash is not a test that notices"
expect throws test "no assertion failed"
expect no-such-case test "no test case is named 'no such case*'"
expect other-case test "nobody noticed"
expect not-compiled build "forty_two"
expect not-there build "occurs 0 times"
expect there-twice build "occurs 2 times"
expect unchanged build "FROM and TO are the same text"
exit $wrong
