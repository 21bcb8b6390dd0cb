#!/usr/bin/env bash
# What the README's program and chapter 37's four make the compiler do at -O2: user time
# over that of a yardstick compiled in the same rounds, and bytes of code. The numbers of
# compile_time.csv are the ones to keep to; the limits stand below. Code is exact. Times
# are not, even so: what is above the limit after four rounds is measured for four more.
# With another compiler than the table's it is skipped.
#
#     ctest --test-dir build/dev -C performance -R compile_time
# Usage: compile_time.sh [--write]     writes the table anew
. "$(dirname "$0")/common.sh"
folder=$LJUS_ROOT/tests/checks
table=$folder/compile_time.csv
most_time=1.25 # of the table's: 99 of 100 times, four rounds agree to 0.13
most_code=1.05
programs=(
    "README,examples/01_first_picture.cpp"
    "one ball,tests/checks/footprint/hello_sphere.cpp"
    "matt box,tests/checks/footprint/cornell_diffuse.cpp"
    "box with glass,tests/checks/footprint/cornell_glass.cpp"
    "everything,tests/checks/footprint/everything.cpp"
)
command -v size >/dev/null || skip "size (binutils) is not installed"
conditions="# $("$LJUS_CXX" --version | sed -n '1s/^[^ ]* //p'), -O2, $(uname -m)"
if [ "${1:-}" != --write ] && [ "$(head -n 1 "$table")" != "$conditions" ]; then
    echo "the table: $(head -n 1 "$table")"
    echo "here:      $conditions"
    skip "$table was measured under other conditions."
fi

TIMEFORMAT=%U
measure() { # NAME SOURCE: one compilation
    local seconds
    # shellcheck disable=SC2086
    seconds=$({ time "$LJUS_CXX" -std=c++20 -O2 ${LJUS_OPENMP_FLAGS:-} \
        ${LJUS_PACKAGE_FLAGS//;/ } -I"$include" -c "$LJUS_ROOT/$2" \
        -o "$scratch/object.o"; } 2>&1) ||
        { echo "$seconds"; echo "WRONG: $2 does not compile"; exit 1; }
    size -A "$scratch/object.o" | awk -v name="$1" -v seconds="$(tail -n 1 <<<"$seconds")" \
        '$1 ~ /^\.text/ { sum += $2 } END { print name "," seconds "," sum + 0 }' \
        >>"$scratch/runs"
}
four_rounds() {
    local program
    for _ in 1 2 3 4; do
        measure yardstick tests/checks/compile_time/yardstick.cpp
        for program in "${programs[@]}"; do measure "${program%%,*}" "${program#*,}"; done
    done
}
# The table of all rounds so far.
summary() {
    echo "$conditions"
    echo "program,time over the yardstick's,bytes of code"
    awk -F, '{ if (!($1 in time)) order[++count] = $1
               time[$1] += $2; text[$1] = $3 }
        END { for (i = 1; i <= count; ++i) if (order[i] != "yardstick")
                  printf "%s,%.3f,%d\n", order[i], time[order[i]] / time["yardstick"],
                      text[order[i]] }' "$scratch/runs"
}

four_rounds
if [ "${1:-}" = --write ]; then
    four_rounds
    summary >"$table"
    cat "$table"
    exit 0
fi
# compare: prints a line a program; 2 if only times are above the limit, 1 for the rest.
compare() {
    summary >"$scratch/now"
    awk -F, -v most_time="$most_time" -v most_code="$most_code" 'FNR <= 2 { next }
        NR == FNR { time[$1] = $2; text[$1] = $3; next }
        !($1 in time) { print "WRONG: " $1 " is not in the table"; wrong = 1; next }
        { seen[$1] = 1
          printf "%-16s %6.2f, was %6.2f %9d bytes, was %9d\n", $1, $2, time[$1], $3, text[$1]
          if ($2 > most_time * time[$1]) {
              printf "WRONG: the program \"%s\" takes %.2f times as long to compile as the yardstick, and took %.2f: what does it instantiate that it does not ask for?\n", $1, $2, time[$1]
              slow = 1 }
          if ($3 > most_code * text[$1]) {
              printf "WRONG: the program \"%s\" has %d bytes of code, and had %d: what does it instantiate that it does not ask for?\n", $1, $3, text[$1]
              wrong = 1 } }
        END { for (name in time) if (!(name in seen)) {
                  print "WRONG: " name " was not compiled"; wrong = 1 }
              exit wrong ? 1 : slow ? 2 : 0 }' "$table" "$scratch/now"
}
status=0
compare || status=$?
if [ "$status" -eq 2 ]; then
    echo "Measured again:"
    four_rounds
    status=0
    compare || status=$?
fi
[ "$status" -eq 0 ] || echo "If it must: tests/checks/compile_time.sh --write makes the table again."
exit "$((status != 0))"
