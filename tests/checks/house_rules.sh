#!/usr/bin/env bash
# Checks those rules of CONTRIBUTING.md that a script can check, in every header below
# include/ljus, and in the examples and chapters.
# Usage: house_rules.sh [FOLDER with ljus/ in it [FOLDER with examples/ and chapters/ in it]]
. "$(dirname "$0")/common.sh"
include=${1:-$include}
root=${2:-$LJUS_ROOT}
problems=0
problem() { echo "$*"; problems=$((problems + 1)); }

# Includes point one way only: a header may include its own room and the rooms on lower
# floors. Rooms on the same floor do not include each other.
floor() {
    case $1 in
        ljus/version.hpp | ljus/hook.hpp | ljus/ref.hpp) echo 0 ;;
        ljus/math/*) echo 1 ;;
        ljus/image/* | ljus/parallel.hpp) echo 2 ;;
        ljus/geometry/*) echo 3 ;;
        ljus/accel/* | ljus/optics/*) echo 4 ;;
        ljus/materials/* | ljus/media/* | ljus/lights/*) echo 5 ;;
        ljus/scene/*) echo 6 ;;
        ljus/path/*) echo 7 ;;
        ljus/photons/* | ljus/radiosity/*) echo 8 ;;
        ljus/render/*) echo 9 ;;
        ljus/inspect/* | ljus/scenes/* | ljus/io/*) echo 10 ;;
        ljus/ljus.hpp | ljus/core.hpp) echo 11 ;;
        *) echo none ;;
    esac
}

# The room of a header is its folder; detail/ belongs to the room around it.
room() { local folder=${1%/*}; echo "${folder%/detail}"; }

# The headers without comments, with the same line numbers.
cd "$include"
code=$scratch/code
rm -rf "$code"
names=$(find ljus -type f | sort)
for name in $names; do
    mkdir -p "$code/${name%/*}"
    sed 's://.*$::' "$name" >"$code/$name"
done

# nothing PATTERN SENTENCE [EXCEPT]: no line of any header except EXCEPT may match.
nothing() {
    local line
    while read -r line; do
        [ "${line%%:*}" = "${3-}" ] || problem "${line%%:*}:$(cut -d: -f2 <<<"$line"): $2"
    done < <(cd "$code" && grep -rnE "$1" ljus | sort -t: -k1,1 -u)
}

optional=" $(grep -rlE '#include <(nlohmann/json\.hpp|stb/stb_image\.h|OpenEXR/openexr\.h)>|#include "ljus/io/load_image' \
    ljus | tr '\n' ' ')"

for name in $names; do
    case $name in *.hpp) ;; *) problem "$name: only .hpp files live here." ;; esac
    [ "$(floor "$name")" != none ] || problem "$name: this folder is not a room of the library."
    grep -qF "/// \\file $name" "$name" || problem "$name: it must say '/// \\file $name'."
done
while read -r name; do
    problem "$name:1: the first line must be '#pragma once'."
done < <(awk 'FNR == 1 && $0 != "#pragma once" { print FILENAME }' $names)
while read -r name; do problem "$name: it has no \\brief."; done < <(grep -L '/// \\brief' $names)
while read -r name; do problem "$name: a line is longer than 88 columns."; done < \
    <(awk 'length($0) > 88 { print FILENAME ":" FNR }' $names)
while read -r name; do problem "$name: it has a tab or a CR."; done < \
    <(grep -l "$(printf '[\t\r]')" $names)

nothing '#[ ]*include <(iostream|random|ranges|functional|chrono|filesystem)>' \
    "this header takes too long to compile."
nothing '#[ ]*include <glm/(glm|ext|fwd|gtx/.*|gtc/.*)(\.hpp)?>' \
    "GLM is included by part, its core only."
nothing '(^|[^_a-zA-Z0-9])virtual([^_a-zA-Z0-9]|$)' "there is no 'virtual' here."
nothing 'shared_ptr' "there is no 'shared_ptr' here."
nothing '(struct|class)[^;{]*[^:]:[^:;{]*(public|protected|private)' \
    "there is no inheritance here."
nothing 'using namespace' "a header must not open a namespace for its user."
nothing 'std::(cout|cerr|rand|time)([^_a-zA-Z0-9]|$)' \
    "the library neither prints nor asks the clock."
nothing '(^|[^_a-zA-Z0-9.:])(printf|fprintf|puts|rand|time) *\(' \
    "the library neither prints nor asks the clock."
nothing '#[ ]*define +([^LST]|L[^J]|S[^T]|T[^I])' "macros are named LJUS_... ."
nothing '^static ' "a header has no 'static' function or data: use 'inline'."
nothing '(#[ ]*pragma +omp|omp\.h|omp_)' "only ljus/parallel.hpp knows OpenMP." \
    ljus/parallel.hpp

# Who includes whom: a line "from to" for each of our includes.
grep -rHoE '^ *#[ ]*include *"[^"]*"' ljus | sed 's/: *#[ ]*include *"/ /; s/"$//' \
    >"$scratch/edges"
while read -r name used; do
    if [ ! -f "$used" ]; then
        problem "$name: it includes \"$used\", which does not exist below include/."
        continue
    fi
    here=$(floor "$name")
    there=$(floor "$used")
    if [ "$there" -gt "$here" ] ||
        { [ "$there" -eq "$here" ] && [ "$(room "$used")" != "$(room "$name")" ]; }; then
        problem "$name: it includes \"$used\"; includes point one way only."
    fi
    # Only an optional header may include an optional one.
    case "$optional|$optional" in
        *" $name "*'|'*) ;;
        *" $used "*) problem "$name: it includes \"$used\", an optional header." ;;
    esac
done <"$scratch/edges"

# A header that includes others must include version.hpp, directly or not, which refuses
# C++17; a header without includes, like schlick.hpp, can be copied alone.
for name in $(awk '{ named[$1] = 1; from[NR] = $1; to[NR] = $2 }
    END { reaches["ljus/version.hpp"] = 1
          do { grown = 0
               for (i = 1; i <= NR; ++i)
                   if (reaches[to[i]] && !reaches[from[i]]) grown = reaches[from[i]] = 1
          } while (grown)
          for (name in named) if (!reaches[name]) print name }' "$scratch/edges"); do
    problem "$name: it does not include ljus/version.hpp, not even indirectly, which refuses C++17."
done

# What examples and chapters name is public. (CLI11 has functions in a namespace of that name
# that its own pages document.)
while IFS=: read -r name line _; do
    problem "$name:$line: detail is named outside of include/; make what is needed public."
done < <(cd "$root" && grep -rnE '(^|[^_a-zA-Z0-9:]|ljus::)detail(::|;| \{)|#include.*/detail/' \
    examples chapters --include='*.cpp' --include='*.hpp' --include='*.md')

[ $problems -eq 0 ] || { echo "$problems problems"; exit 1; }
echo "the house rules hold"
