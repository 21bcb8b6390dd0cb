#!/usr/bin/env bash
# Compares the instructions of benchmarks/guard.cpp, counted by callgrind, with those of
# benchmarks/guard.csv. It fails if a case needs over 5 % more, or if the advantage of a fast
# twin over its plain one, or over nanoflann (libnanoflann-dev), falls by over 5 %. Counts do not depend on the load of the machine,
# but on the compiler: with another compiler than the file names, the check is skipped.
#
#     ctest --test-dir build/dev -C performance -R performance
#     LJUS_GUARD_WRITE=1 ctest ...      rewrites the file
. "$(dirname "$0")/common.sh"
table=$LJUS_ROOT/benchmarks/guard.csv
flags="-O2"

command -v valgrind >/dev/null || skip "valgrind is not installed."
# Without the first word, which is the command.
conditions="# $("$LJUS_CXX" --version | sed -n '1s/^[^ ]* //p'), $flags, $(valgrind --version), $(uname -m)"
if [ -z "${LJUS_GUARD_WRITE:-}" ] && [ "$(head -n 1 "$table")" != "$conditions" ]; then
    echo "the table: $(head -n 1 "$table")"
    echo "here:      $conditions"
    skip "$table was counted under other conditions."
fi

# Each case stays one function: a part split off as unlikely would end its count.
# shellcheck disable=SC2086
"$LJUS_CXX" -std=c++20 $flags -fno-reorder-blocks-and-partition \
    ${LJUS_PACKAGE_FLAGS//;/ } -I"$include" \
    "$LJUS_ROOT/benchmarks/guard.cpp" -o "$scratch/guard"
LC_ALL=C valgrind --quiet --tool=callgrind --callgrind-out-file="$scratch/counted" \
    --toggle-collect='guard_*' "$scratch/guard" >"$scratch/printed"
# "2,813,004 (1.61%)  file:function": inclusive counts for the cases, exclusive ones for
# functions.
count() { callgrind_annotate --threshold=100 "$@" "$scratch/counted" | tr -d ','; }
count --inclusive=yes | awk '$1 ~ /^[0-9]+$/ && match($0, /:guard_[a-z0-9_]+/) {
    name = substr($0, RSTART + 7, RLENGTH - 7)
    if ($1 > most[name]) most[name] = $1 }
    END { for (name in most) print name "," most[name] }' | sort >"$scratch/cases"
# A fast twin by its ratio, plain or nanoflann over fast.
awk -F, '{ count[$1] = $2 }
    END { for (name in count) if (match(name, /_(plain|nanoflann)$/)) {
              fast = substr(name, 1, RSTART - 1)
              printf "%s %s/fast,%.4f\n", fast, substr(name, RSTART + 1),
                  count[name] / count[fast] } }' \
    "$scratch/cases" | sort >"$scratch/ratios"
{ echo "$conditions"; cat "$scratch/cases" "$scratch/ratios"; } >"$scratch/now"
[ "$(wc -l <"$scratch/now")" -gt 20 ] || { cat "$scratch/now"; echo "too few cases"; exit 1; }

if [ -n "${LJUS_GUARD_WRITE:-}" ]; then
    cp "$scratch/now" "$table"
    echo "$table is written"
    exit 0
fi
echo '#include <nanoflann.hpp>' | "$LJUS_CXX" -std=c++20 -fsyntax-only -xc++ - 2>/dev/null &&
    peer=1 || peer=0
awk -F, -v peer="$peer" 'FNR == 1 { next }
    NR == FNR { before[$1] = $2; next }
    !($1 in before) { print "WRONG: " $1 " is not in the table"; wrong = 1; next }
    { seen[$1] = 1
      ratio = $1 ~ / / ? before[$1] / $2 : $2 / before[$1]
      note = ratio > 1.05 ? "WRONG" : ratio < 0.95 ? "better: rewrite the table" : ""
      if (ratio > 1.05) wrong = 1
      printf "%-28s %14s %14s  %+6.1f %%  %s\n", $1, before[$1], $2, 100 * (ratio - 1), note }
    END { for (name in before) if (!(name in seen) && (peer || name !~ /nanoflann/)) {
              print "WRONG: " name " was not counted"; wrong = 1 }
          exit wrong }' "$table" "$scratch/now" || {
    echo "The functions of these cases that take most by themselves:"
    count | awk '$1 ~ /^[0-9]+$/ && ++n <= 12 { print substr($0, 1, 160) }'
    exit 1
}
