#!/usr/bin/env bash
# What each header costs to include: user time of -fsyntax-only, the median of three.
# The budget is 0.25 s up to the materials and 0.6 s above; because machines are noisy,
# only twice the budget is an error.
. "$(dirname "$0")/common.sh"
TIMEFORMAT=%U
status=0

# One run, in seconds.
seconds() {
    # shellcheck disable=SC2086
    { time echo "#include \"$1\"" | "$LJUS_CXX" -std=c++20 $LJUS_OPENMP_FLAGS \
        $LJUS_PACKAGE_FLAGS -I "$include" -fsyntax-only -x c++ - >/dev/null; } 2>&1 |
        tail -n 1
}

printf '%-44s %8s %8s\n' header seconds budget
while read -r header; do
    case $header in
        ljus/scene/* | ljus/photons/* | ljus/render/* | ljus/ljus.hpp) budget=0.60 ;;
        *) budget=0.25 ;;
    esac
    median=$( (seconds "$header"; seconds "$header"; seconds "$header") | sort -n | sed -n 2p)
    verdict=$(awk -v t="$median" -v b="$budget" \
        'BEGIN { print t > 2 * b ? "TOO SLOW" : t > b ? "above budget" : "" }')
    if grep -qxF "$header" "$LJUS_OPTIONAL"; then
        verdict="optional${verdict:+, $verdict}"
    elif [ "$verdict" = "TOO SLOW" ]; then
        status=1
    fi
    printf '%-44s %8s %8s  %s\n' "$header" "$median" "$budget" "$verdict"
done <"$LJUS_HEADERS"
exit $status
