#!/usr/bin/env bash
# Measures the cost of including each header alone: user time of -fsyntax-only.
# The budget is 0.25 s for maths, images, geometry, optics and materials, 0.75 s for files (a
# mesh file brings the decoders of its pictures and the cutting of its polygons), and 0.6 s for
# the trees and all headers that include a scene. Machines are noisy: only twice the budget is
# an error, and only if the fastest of eight runs exceeds it.
# If a machine needs more than 0.21 s for <string> and <vector>, the budgets are scaled by
# that factor. Optional headers are measured once: most of their cost is that of other
# libraries.
. "$(dirname "$0")/common.sh"
TIMEFORMAT=%U
status=0

# One run, in seconds.
seconds() {
    # shellcheck disable=SC2086
    { time printf '#include %s\n' "$@" | "$LJUS_CXX" -std=c++20 $LJUS_OPENMP_FLAGS \
        $LJUS_PACKAGE_FLAGS -I "$include" -fsyntax-only -x c++ - >/dev/null; } 2>&1 |
        tail -n 1
}

# above COST BUDGET [FACTOR]
above() { awk -v t="$1" -v b="$2" -v f="${3:-1}" 'BEGIN { exit !(t > f * b) }'; }

pace=$(for _ in 1 2 3 4 5; do seconds '<string>' '<vector>'; done | sort -n |
    awk 'NR == 1 { print ($1 > 0.21 ? $1 / 0.21 : 1) }')
limit=$(awk -v pace="$pace" 'BEGIN { print 2 * pace }')
echo "Fails above $limit times the budget."

printf '%-44s %8s %8s\n' header seconds budget
while read -r header; do
    case $header in
        ljus/math/* | ljus/image/* | ljus/geometry/* | ljus/optics/* | ljus/materials/*)
            budget=0.25 ;;
        ljus/io/*) budget=0.75 ;;
        *) budget=0.60 ;;
    esac
    if ! cost=$(seconds "<$header>"); then
        echo "$header does not compile alone."
        status=1
        continue
    fi
    verdict=
    if above "$cost" "$budget"; then verdict="above budget"; fi
    if grep -qxF "$header" "$LJUS_OPTIONAL"; then
        verdict="optional${verdict:+, $verdict}"
    elif above "$cost" "$budget" "$limit"; then
        fastest=$( (echo "$cost"; for _ in 2 3 4 5 6 7 8; do seconds "<$header>"; done) |
            sort -n | sed -n 1p)
        if above "$fastest" "$budget" "$limit"; then
            verdict="TOO SLOW"
            status=1
        fi
    fi
    printf '%-44s %8s %8s  %s\n' "$header" "$cost" "$budget" "$verdict"
done <"$LJUS_HEADERS"
exit $status
