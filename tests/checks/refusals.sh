#!/usr/bin/env bash
# C++17, -ffast-math and the like are refused by one sentence, whichever header comes
# first. Only a header that includes nothing of ours may compile without a word.
# Usage: refusals.sh [N]: every Nth header; without it, all.
. "$(dirname "$0")/common.sh"
status=0
step=${1:-1}

# refused FLAGS SENTENCE: the first error for each header is the sentence.
refused() {
    local flags=$1 sentence=$2 header first
    while read -r header; do
        # shellcheck disable=SC2086
        first=$(echo "#include \"$header\"" | "$LJUS_CXX" $flags $LJUS_PACKAGE_FLAGS \
            -I "$include" -fsyntax-only -Wfatal-errors -x c++ - 2>&1 |
            grep 'error:' | head -n 1 || true)
        case $first in
            *"$sentence"*) ;;
            '')
                [ -z "$(ours_in "$include/$header")" ] || {
                    echo "$header with $flags compiles; '$sentence' should be said."
                    status=1
                }
                ;;
            *)
                echo "$header with $flags: the first error should be '$sentence'; it is: $first"
                status=1
                ;;
        esac
    done < <(grep -v /detail/ "$LJUS_HEADERS" | awk -v step="$step" 'NR % step == 0')
}
refused "-std=c++17" "Ljus needs C++20: add -std=c++20"
refused "-std=c++20 -ffast-math" "compile without -ffast-math"
step=$((4 * step)) # the same line of the same header says it
refused "-std=c++20 -ffinite-math-only" "compile without -ffast-math"
refused "-std=c++20 -fno-exceptions" "compile without -fno-exceptions"
refused "-std=c++20 -DGLM_FORCE_INTRINSICS" "compile without GLM_FORCE_INTRINSICS"
[ $status -eq 0 ] && echo "C++17, -ffast-math and the like are refused by every header"
exit $status
