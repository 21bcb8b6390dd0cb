#!/usr/bin/env bash
# The house rules that a script can check, on every header below include/ljus.
# Usage: house_rules.sh [FOLDER with ljus/ in it]
. "$(dirname "$0")/common.sh"
include=${1:-$include}
problems=0
problem() { echo "$*"; problems=$((problems + 1)); }

# Includes point one way only: a header may name what stands below its own floor, and its
# own room. Rooms on one floor do not know each other.
floor() {
    case $1 in
        ljus/version.hpp | ljus/progress.hpp | ljus/hook.hpp) echo 0 ;;
        ljus/math/*) echo 1 ;;
        ljus/image/* | ljus/parallel.hpp) echo 2 ;;
        ljus/geometry/*) echo 3 ;;
        ljus/accel/* | ljus/optics/*) echo 4 ;;
        ljus/materials/*) echo 5 ;;
        ljus/scene/*) echo 6 ;;
        ljus/path/*) echo 7 ;;
        ljus/photons/* | ljus/radiosity/*) echo 8 ;;
        ljus/render/*) echo 9 ;;
        ljus/inspect/* | ljus/scenes/* | ljus/io/*) echo 10 ;;
        ljus/ljus.hpp | ljus/core.hpp) echo 11 ;;
        *) echo none ;;
    esac
}

# The room of a header: its folder; machinery in detail/ belongs to the room around it.
room() { local folder=${1%/*}; echo "${folder%/detail}"; }

# nothing PATTERN SENTENCE: no line of $code, the header without comments, may match.
nothing() {
    local lines
    lines=$(echo "$code" | grep -nE "$1" || true)
    [ -z "$lines" ] || problem "$name:${lines%%:*}: $2"
}

optional=' '
for name in $(cd "$include" && find ljus -name '*.hpp' | sort); do
    if grep -qE '#include <(nlohmann/json\.hpp|tiny_obj_loader\.h|stb/stb_image\.h)>' \
        "$include/$name"; then
        optional="$optional$name "
    fi
done

for name in $(cd "$include" && find ljus -type f | sort); do
    file=$include/$name
    code=$(sed 's://.*$::' "$file")
    here=$(floor "$name")

    case $name in *.hpp) ;; *) problem "$name: only .hpp files live here."; continue ;; esac
    [ "$here" != none ] || problem "$name: this folder is no floor of the house."
    [ "$(head -n 1 "$file")" = "#pragma once" ] ||
        problem "$name:1: the first line must be '#pragma once'."
    grep -qF "/// \\file $name" "$file" || problem "$name: it must say '/// \\file $name'."
    grep -q '/// \\brief' "$file" || problem "$name: it has no \\brief."
    long=$(awk 'length($0) > 88 { print NR; exit }' "$file")
    [ -z "$long" ] || problem "$name:$long: a line is longer than 88 columns."
    ! grep -q "$(printf '[\t\r]')" "$file" || problem "$name: it has a tab or a CR."

    nothing '#[ ]*include <(iostream|random|ranges|functional|chrono|filesystem)>' \
        "this header is too dear to include: see design rule 11."
    nothing '#[ ]*include <glm/(glm|ext|fwd|gtx/.*|gtc/.*)(\.hpp)?>' \
        "GLM is included by part, its core only."
    nothing '(^|[^_a-zA-Z0-9])virtual([^_a-zA-Z0-9]|$)' "there is no 'virtual' here."
    nothing 'shared_ptr' "there is no 'shared_ptr' here."
    nothing '(struct|class)[^;{]*[^:]:[^:;{]*(public|protected|private)' \
        "there is no inheritance here."
    nothing 'using namespace' "a header opens no namespace for its user."
    nothing 'std::(cout|cerr|rand|time)([^_a-zA-Z0-9]|$)' \
        "the library neither prints nor asks the clock."
    nothing '(^|[^_a-zA-Z0-9.:])(printf|fprintf|puts|rand|time) *\(' \
        "the library neither prints nor asks the clock."
    nothing '#[ ]*define +([^LST]|L[^J]|S[^T]|T[^I])' "macros are named LJUS_... ."
    nothing '^static ' "a header has no 'static' function or data: use 'inline'."
    [ "$name" = ljus/parallel.hpp ] ||
        nothing '(#[ ]*pragma +omp|omp\.h|omp_)' "only ljus/parallel.hpp knows OpenMP."

    for used in $(ours_in "$file"); do
        if [ ! -f "$include/$used" ]; then
            problem "$name: it includes \"$used\", which is not there below include/."
            continue
        fi
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
    done
done

# A header that includes others must reach version.hpp, which refuses C++17; one that
# stands alone, like schlick.hpp, is to be copied alone.
(cd "$include" && grep -rHoE '^ *#[ ]*include *"[^"]*"' ljus) |
    sed 's/: *#[ ]*include *"/ /; s/"$//' >"$scratch/edges"
for name in $(awk '{ named[$1] = 1; from[NR] = $1; to[NR] = $2 }
    END { reaches["ljus/version.hpp"] = 1
          do { grown = 0
               for (i = 1; i <= NR; ++i)
                   if (reaches[to[i]] && !reaches[from[i]]) grown = reaches[from[i]] = 1
          } while (grown)
          for (name in named) if (!reaches[name]) print name }' "$scratch/edges"); do
    problem "$name: it does not reach ljus/version.hpp, which refuses C++17."
done

[ $problems -eq 0 ] || { echo "$problems problems"; exit 1; }
echo "the house rules hold"
