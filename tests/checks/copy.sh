#!/usr/bin/env bash
# Checks that a header and the files that it includes compile when copied into an empty
# folder: alone, first, twice, without OpenMP, with the warnings of a careful user, and by
# another compiler than the build's, if there is one. (project.link compiles all of them with
# the build's own.) Headers in a folder `detail` are copied only with those that include
# them; compile_cost.sh compiles each of them alone.
# Usage: copy.sh [N]: every Nth header; without it, all.
. "$(dirname "$0")/common.sh"
compiler=$(other_compiler)
status=0
count=0
while read -r header; do
    folder=$scratch/copy
    rm -rf "$folder"
    for name in $(reached "$include" "$header"); do
        mkdir -p "$folder/$(dirname "$name")"
        cp "$include/$name" "$folder/$name"
    done
    # shellcheck disable=SC2086
    if ! printf '#include "%s"\n' "$header" "$header" | "$compiler" -std=c++20 -Wall -Wextra -Wpedantic \
        -Wconversion -Wshadow -Werror $LJUS_PACKAGE_FLAGS -I "$folder" -fsyntax-only -x c++ -; then
        files=$(find "$folder" -name '*.hpp' | wc -l | tr -d ' ')
        echo "$header does not compile with only the $files files that it names."
        status=1
    fi
    count=$((count + 1))
done < <(grep -v /detail/ "$LJUS_HEADERS" | awk -v step="${1:-1}" 'NR % step == 0')
echo "$count headers copied, each with what it names, and compiled by $compiler"
exit $status
