#!/usr/bin/env bash
# Checks single headers, each in an empty folder and compiled by the command at its head:
# alone, two in one program, and all of them, by the build's compiler and by another if there
# is one. A picture by the single header is byte for byte the one by include/.
# Usage: single_headers.sh [N]: every Nth header alone; without it, all.
. "$(dirname "$0")/common.sh"
[ -n "${LJUS_PYTHON:-}" ] || skip "Python is not installed"
step=${1:-1}
single=$scratch/single
"$LJUS_PYTHON" "$LJUS_ROOT/scripts/single-header" --out "$single"
compilers=$LJUS_CXX
other=$(other_compiler)
[ "$other" = "$LJUS_CXX" ] || compilers="$compilers $other"
status=0
problem() { echo "$*"; status=1; }

# Where it cannot write, it says so in one line.
said=$("$LJUS_PYTHON" "$LJUS_ROOT/scripts/single-header" sphere --out "$single/sphere.hpp" 2>&1) &&
    problem "it wrote into a file instead of a folder"
[[ $said == "single-header: cannot write to $single/sphere.hpp: File exists; "*"another folder." ]] ||
    problem "where it cannot write, it says: $said"

# Those whose packages are installed.
names=()
while read -r header; do
    name=${header##*/}
    case $header in */detail/* | ljus/core.hpp) continue ;; esac
    [ -f "$single/$name" ] || problem "there is no single header of $header"
    names+=("$name")
done <"$LJUS_HEADERS"

# in_empty_folder COMPILER FLAGS NAMES...: compiles a main.cpp read from standard input beside
# copies of these headers.
in_empty_folder() {
    local compiler=$1 flags=$2
    shift 2
    rm -rf "$scratch/empty"
    mkdir "$scratch/empty"
    cat >"$scratch/empty/main.cpp"
    for name in "$@"; do cp "$single/$name" "$scratch/empty/"; done
    # shellcheck disable=SC2086
    (cd "$scratch/empty" && "$compiler" -std=c++20 -Wall -Wextra -Werror $flags \
        $LJUS_PACKAGE_FLAGS main.cpp)
}
includes() { printf '#include "%s"\n' "$@"; }

openmp=
# shellcheck disable=SC2086
echo 'int main() {}' | "$other" $LJUS_OPENMP_FLAGS -x c++ - -o "$scratch/openmp" 2>/dev/null &&
    openmp=$LJUS_OPENMP_FLAGS
for compiler in $compilers; do
    # --- Each alone.
    count=0
    for ((i = step - 1; i < ${#names[@]}; i += step)); do
        { includes "${names[i]}"; echo "int main() {}"; } |
            in_empty_folder "$compiler" "-Wpedantic -fsyntax-only" "${names[i]}" ||
            problem "${names[i]} does not compile alone by $compiler."
        count=$((count + 1))
    done
    # --- Two in one program, which share most of their parts.
    for pair in "sphere.hpp triangle.hpp" "triangle.hpp sphere.hpp"; do
        # shellcheck disable=SC2086
        { includes $pair; cat <<'END'; } | in_empty_folder "$compiler" -O2 $pair
#include <cstdio>
int main() {
    const ljus::Ray ray{.origin = {0, 0, 5}};
    const auto ball = intersect(ray, ljus::Sphere{});
    const auto flat = intersect(
        ray, ljus::Triangle{.v1 = {-1, -1, 0}, .v2 = {1, -1, 0}, .v3 = {0, 1, 0}});
    std::printf("%g %g\n", double(ball.value_or(-1)), double(flat ? flat->t : -1));
}
END
        [ "$("$scratch/empty/a.out")" = "4 5" ] ||
            problem "$pair: the ray meets the ball at 4 and the triangle at 5."
    done
    # --- All in one program, in both orders, so that none hides what another lacks.
    mapfile -t backwards < <(printf '%s\n' "${names[@]}" | tac)
    { includes "${names[@]}" "${backwards[@]}"; echo "int main() {}"; } |
        in_empty_folder "$compiler" -fsyntax-only "${names[@]}" ||
        problem "all single headers do not compile together."
    { includes "${backwards[@]}"; echo "int main() {}"; } |
        in_empty_folder "$compiler" -fsyntax-only "${names[@]}" ||
        problem "all single headers, the last one first, do not compile together."
    # --- The README's program.
    sed 's|<ljus/ljus.hpp>|"ljus.hpp"|' "$LJUS_ROOT/examples/01_first_picture.cpp" |
        in_empty_folder "$compiler" "-O2 $openmp" ljus.hpp
    (cd "$scratch/empty" && ./a.out >/dev/null && mv first_picture.png single.png)
    # shellcheck disable=SC2086
    (cd "$scratch/empty" && "$compiler" -std=c++20 -O2 $openmp $LJUS_PACKAGE_FLAGS \
        -I"$include" "$LJUS_ROOT/examples/01_first_picture.cpp" && ./a.out >/dev/null)
    cmp "$scratch/empty/single.png" "$scratch/empty/first_picture.png" ||
        problem "the picture of the single header is another."
    echo "$compiler: $count single headers alone, all ${#names[@]} together, one picture"
done

# --- What cannot go together is refused by a sentence.
refused() {
    local sentence=$1
    in_empty_folder "$LJUS_CXX" "-fsyntax-only -I$include" sphere.hpp 2>"$scratch/said" &&
        problem "this compiles: '$sentence' should be said."
    grep -m 1 'error' "$scratch/said" | grep -qF "$sentence" ||
        { problem "the first error is not '$sentence':"; head -n 3 "$scratch/said"; }
}
{ echo '#define LJUS_SINGLE 7'; includes sphere.hpp; } | refused "of two versions of Ljus"
includes ljus/geometry/ray.hpp sphere.hpp | refused "beside include/ljus"
exit $status
