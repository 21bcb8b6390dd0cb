# Sourced by the checks of this folder, which CTest runs with LJUS_... in the environment.
set -euo pipefail
: "${LJUS_ROOT:?run this check by ctest, which tells it where everything is}"
include=$LJUS_ROOT/include
# A folder of its own for each running check: CTest runs several at once, and one check runs
# another.
mkdir -p "$LJUS_SCRATCH"
scratch=$(mktemp -d -p "$LJUS_SCRATCH")
trap 'rm -rf "$scratch"' EXIT

skip() { echo "skipped: $*"; exit 77; }

# The other compiler of g++ and clang++ than the build's; itself, if there is no other, or
# one that is too old for the library, and says nothing about it.
other_compiler() {
    local other=clang++
    case $("$LJUS_CXX" --version) in *clang*) other=g++ ;; esac
    if printf '%s\n' '#include <concepts>' \
        '#if defined(__clang__) ? __clang_major__ < 14 : __GNUC__ < 11' \
        '#error' '#endif' | "$other" -std=c++20 -fsyntax-only -x c++ - 2>/dev/null; then
        echo "$other"
    else
        echo "$LJUS_CXX"
    fi
}

# The headers of the library that a header includes directly.
ours_in() { sed -n 's/^ *#[ ]*include *"\([^"]*\)".*/\1/p' "$1"; }

# reached FOLDER NAME: the header and all headers of the library that it includes, directly
# or not.
reached() {
    local folder=$1 todo=$2 seen=" " name
    while :; do
        # shellcheck disable=SC2086
        set -- $todo
        [ $# -gt 0 ] || break
        name=$1
        shift
        todo=$*
        case $seen in *" $name "*) continue ;; esac
        seen="$seen$name "
        [ -f "$folder/$name" ] && todo="$todo $(ours_in "$folder/$name" | tr '\n' ' ')"
    done
    # shellcheck disable=SC2086
    printf '%s\n' $seen
}
