# Sourced by the scripts of this folder. Works with bash 3.2 (macOS).

# With it, cd may go elsewhere, and prints where.
unset CDPATH
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
me=$(basename "$0")

# Both print one sentence on stderr and exit: with 2 for bad usage, with 1 for other errors.
usage_error() { echo "$me: $*" >&2; exit 2; }
fail() { echo "$me: $*" >&2; exit 1; }

# The comment at the top of the script is its help.
show_help() { sed -n '2,/^$/s/^# \{0,1\}//p' "$root/scripts/$me"; }

jobs=${LJUS_JOBS:-$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)}

# configure FOLDER [cmake options]: uses Ninja if it is installed; prints CMake's output only
# on failure.
configure() {
    local folder=$1 log status=0
    shift
    case $folder in
        *[\"\;\#\\]* | *$'\n'*)
            fail "CMake cannot work in '$folder': a folder's name must not have a \" or ; or # or \\ or a line feed in it; move the project."
            ;;
    esac
    if [ ! -f "$folder/CMakeCache.txt" ] && command -v ninja >/dev/null 2>&1; then
        set -- -G Ninja "$@"
    fi
    mkdir -p "$folder"
    log="$folder/configure.log"
    cmake -S "$root" -B "$folder" "$@" >"$log" 2>&1 || status=$?
    grep -E '^-- Ljus: .*(fetched|not installed|not found|left out)' "$log" || true
    if [ "$status" -ne 0 ]; then
        # Only the error sentence if it is one of ours; otherwise all of CMake's output.
        if grep -q 'Ljus: .* is not installed; install' "$log"; then
            fail "$(sed -n '/Ljus: .* is not installed; install/,/^ *$/p' "$log" |
                sed '/^Call Stack/,$d' | tr -s ' \n' '  ' | sed 's/^ *Ljus: //; s/ *$//')"
        fi
        if grep -qE 'step for (ljus-|.*populate)|Failed to clone|Failed to checkout' "$log"; then
            fail "$(sed -n 's/^-- Ljus: \(.*\) is fetched from \(.*\) (faster: \(.*\))$/\1 is not installed and cannot be fetched from \2: is there a network? Else: \3./p' \
                "$log" | tail -n 1)"
        fi
        cat "$log" >&2
        fail "cmake could not configure $folder; its messages are above."
    fi
}
