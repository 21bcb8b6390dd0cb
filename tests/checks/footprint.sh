#!/usr/bin/env bash
# Measures "model only what a scene requires": the lines compiled, the instructions and the
# memory of programs with one ball, a matt box, a box with glass, and everything at once.
# Without an argument it checks that
#   - the ball's program has not grown by 5 % over chapters/measured/footprint.csv: lines
#     of our headers; and, with the compiler of that file, bytes of code and instructions;
#   - scenes that need no photons have none, and no searches for them;
#   - a matt box has the same picture, byte for byte, whatever else is included and listed.
# Usage: footprint.sh [--write]     rewrites that file, in some minutes
. "$(dirname "$0")/common.sh"
programs=$LJUS_ROOT/tests/checks/footprint
table=$LJUS_ROOT/chapters/measured/footprint.csv
if grep -q clang <<<"$("$LJUS_CXX" --version)"; then
    compiler="clang $("$LJUS_CXX" -dumpversion)"
else
    compiler="g++ $("$LJUS_CXX" -dumpfullversion)"
fi
wrong=0
wrong() { echo "WRONG: $*"; wrong=1; }

# One thread, and no OpenMP: the instruction count of several threads varies.
compile() { # NAME SOURCE FLAGS...
    local name=$1 source=$2
    shift 2
    # shellcheck disable=SC2086
    "$LJUS_CXX" -std=c++20 "$@" -I"$include" $LJUS_PACKAGE_FLAGS "$programs/$source.cpp" \
        -o "$scratch/$name"
}
preprocessed() { # SOURCE: lines of our headers, and of all
    # shellcheck disable=SC2086
    "$LJUS_CXX" -std=c++20 -E -I"$include" $LJUS_PACKAGE_FLAGS "$programs/$1.cpp" |
        awk -v ours="$include/" '/^# [0-9]+ "/ { of = index($3, ours) == 2; next }
            NF { all += 1; if (of) own += 1 } END { print own + 0, all }'
}
text_bytes() { size -A "$scratch/$1" | awk '$1 == ".text" { print $2 }'; }
instructions() {
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$scratch/$1" 2>&1 |
        sed -n 's/.*Collected : \([0-9]*\).*/\1/p'
}
cell() { # PROGRAM COLUMN, of the committed table
    awk -F, -v row="$1" -v name="$2" '/^#/ { next }
        !at { for (i = 1; i <= NF; ++i) if ($i == name) at = i; next }
        $1 == row { print $at }' "$table"
}
# grown NAME NOW: reports a number that is more than 5 % above the table's.
grown() {
    local was
    was=$(cell "one ball" "$1")
    [ -n "$was" ] || { wrong "$table has no '$1' of one ball"; return; }
    echo "one ball: $1 $2, was $was"
    awk -v now="$2" -v was="$was" 'BEGIN { exit !(now > 1.05 * was) }' || return 0
    wrong "the program of one ball has grown by more than 5 %: $1 is $2, and was $was" \
        "(if it must: tests/checks/footprint.sh --write makes the table again)"
}

if [ "${1:-}" = --write ]; then
    command -v valgrind >/dev/null && command -v size >/dev/null ||
        { echo "footprint.sh: --write needs valgrind and size (binutils)." >&2; exit 2; }
    {
        processor=$(sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo 2>/dev/null | sed -n 1p)
        echo "# tests/checks/footprint.sh, -O2, one thread, 64 x 64 pixels;"
        echo "# $compiler; ${processor:-$(uname -m)}. Seconds: the least of five runs."
        echo "program,lines of ours,all lines,seconds to compile,code in bytes,instructions,seconds,rays,searches,photons,bytes per photon"
    } >"$scratch/table"
    TIMEFORMAT=%U
    while IFS=, read -r name source; do
        seconds=$({ time compile "$source" "$source" -O2; } 2>&1)
        least=$(for _ in 1 2 3 4 5; do { time "$scratch/$source" >/dev/null; } 2>&1; done |
            sort -n | sed -n 1p)
        read -r rays searches photons bytes hash < <("$scratch/$source")
        read -r own all < <(preprocessed "$source")
        echo "$name,$own,$all,$seconds,$(text_bytes "$source"),$(instructions "$source"),$least,$rays,$searches,$photons,$bytes" |
            tee -a "$scratch/table"
    done <<'PROGRAMS'
one ball,hello_sphere
matt box,cornell_diffuse
box with glass,cornell_glass
everything,everything
PROGRAMS
    cp "$scratch/table" "$table"
    exit 0
fi

compile hello_sphere hello_sphere -O2
read -r own _ < <(preprocessed hello_sphere)
grown "lines of ours" "$own"
if ! grep -qF "# $compiler;" "$table"; then
    echo "$compiler is not the compiler of $table: code and instructions are not compared"
elif ! command -v size >/dev/null; then
    echo "size (binutils) is not installed: code and instructions are not compared"
else
    grown "code in bytes" "$(text_bytes hello_sphere)"
    if command -v valgrind >/dev/null; then
        grown instructions "$(instructions hello_sphere)"
    else
        echo "valgrind is not installed: instructions are not compared"
    fi
fi

compile narrow cornell_diffuse -O1
compile wide cornell_diffuse -O1 -DALL_HEADERS
for name in hello_sphere narrow wide; do
    read -r rays searches photons _ hash < <("$scratch/$name")
    [ "$rays" -gt 4000 ] || wrong "$name: $rays rays are no picture"
    [ "$searches" -eq 0 ] || wrong "$name: $searches searches for photons that nothing needs"
    [ "$photons" -eq 0 ] || wrong "$name: $photons photons that nothing needs"
    echo "$name: $rays rays, $searches searches, $photons photons, picture $hash"
done
[ "$("$scratch/narrow")" = "$("$scratch/wide")" ] ||
    wrong "a matt box has another picture when glass and mirrors are listed as well"
exit $wrong
