#!/usr/bin/env bash
# Checks the messages about beginners' mistakes, each a file of tests/mistakes: g++ and
# clang++ take at most 20 lines, which name a line of the user's file, and the first error is
# in that file or is a sentence of the library. At the head of the file, "// says: PATTERN"
# gives what must be said, and "// long: REASON" allows clang++ more lines. The page "When it
# does not compile" shows most of these files.
. "$(dirname "$0")/common.sh"
status=0
problem() { echo "$*"; sed 's/^/    /' "$scratch/said"; status=1; }
compilers=$LJUS_CXX
other=$(other_compiler)
[ "$other" = "$LJUS_CXX" ] || compilers="$compilers $other"
head_of() { sed -n "s|^// $1: *||p" "$2"; }

count=0
for file in "$LJUS_ROOT"/tests/mistakes/*.cpp; do
    name=${file##*/}
    count=$((count + 1))
    pattern=$(head_of says "$file")
    [ -n "$pattern" ] || { echo "$name has no line '// says: '"; status=1; continue; }
    flags=$(head_of flags "$file")
    cp "$file" "$scratch/$name"
    for compiler in $compilers; do
        # shellcheck disable=SC2086
        if (cd "$scratch" && "$compiler" ${flags:--std=c++20} $LJUS_PACKAGE_FLAGS \
            -I"$include" -fsyntax-only "$name") >"$scratch/said" 2>&1; then
            problem "$name compiles by $compiler, and must not."
            continue
        fi
        lines=$(wc -l <"$scratch/said")
        most=20
        case $compiler:$(head_of long "$file") in *clang*:?*) most=30 ;; esac
        [ "$lines" -le $most ] || problem "$name by $compiler: $lines lines, not $most:"
        grep -qE "$pattern" "$scratch/said" ||
            problem "$name by $compiler does not say '$pattern':"
        grep -qE "(^|[ /])$name:[0-9]+" "$scratch/said" ||
            problem "$name by $compiler: none of its lines is named:"
        first=$(grep -m 1 'error' "$scratch/said" || true)
        case $first in
            "$name":*) where="in the reader's line" ;;
            "$include"/ljus/*static*assert* | "$include"/ljus/*"Ljus needs"*)
                where="a sentence of ours" ;;
            *) where=no; problem "$name by $compiler: the first error is elsewhere:" ;;
        esac
        printf '%3d lines, %s: %s by %s\n' "$lines" "$where" "$name" "$compiler"
    done
done
[ "$count" -ge 10 ] || { echo "only $count mistakes are there"; status=1; }
exit $status
