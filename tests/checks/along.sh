#!/usr/bin/env bash
# The build-along, examples/along: each step compiles alone, by the line that its page gives and
# with all warnings as errors; includes nothing but the standard library; adds or
# changes at most 40 lines of the step before, and the last one has at most 300; and renders a
# picture.
. "$(dirname "$0")/common.sh"
[ -n "${LJUS_PYTHON:-}" ] || skip "Python is not installed"
steps=$LJUS_ROOT/examples/along
page=$LJUS_ROOT/chapters/build_along.md
warnings="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror"
problems=0
problem() { echo "$*"; problems=$((problems + 1)); }

command=$(sed -n 's/^    \(g++ .*01_gradient\.cpp && \.\/a\.out > a\.ppm\)$/\1/p' "$page")
[ -n "$command" ] || problem "$page: no line compiles 01_gradient.cpp"
cd "$scratch"

# render NAME: a file of this folder, by the line of the page; its picture is NAME.ppm.
render() {
    local line=${command/01_gradient.cpp/$warnings $1.cpp}
    eval "${line/g++/\"\$LJUS_CXX\"}" || { problem "$1: it fails"; return; }
    mv a.ppm "$1.ppm"
    "$LJUS_PYTHON" "$LJUS_ROOT/chapters/tools/along" picture "$1.ppm" "$1.png" ||
        problem "$1: its picture is refused"
}

before=
for file in "$steps"/*.cpp; do
    name=$(basename "$file" .cpp)
    grep -q "^## .* {#ch_build_along_$name}" "$page" || problem "$name: it has no section"
    grep -q "^// Step $((10#${name%%_*})), .*[.]\$" "$file" ||
        problem "$name: its first line does not say what is new"
    ! grep -n '# *include' "$file" | grep -v '#include <[a-z]*>$' ||
        problem "$name: it includes more than the standard library"
    if [ -n "$before" ]; then
        new=$(diff "$before" "$file" | grep -c '^>') || true
        [ "$new" -le 40 ] || problem "$name: $new lines are new, more than 40"
    fi
    cp "$file" .
    render "$name"
    before=$file
done
lines=$(wc -l <"$before")
[ "$lines" -le 300 ] || problem "$name: $lines lines, more than 300"
[ "$name" = 12_caustic ] || problem "the last step is $name"

# The same photons in the same disc: whether they stand in a tree makes no difference.
sed "s/trace_photons(100000/trace_photons(1500/; s/hit, 0.06/hit, 0.2/" 10_kd_tree.cpp >tree.cpp
render tree
cmp 09_estimate.ppm tree.ppm || problem "10_kd_tree: the tree changes the picture"

[ $problems -eq 0 ] || { echo "$problems problems"; exit 1; }
echo "$(ls "$steps"/*.cpp | wc -l) steps compile and render; the last has $lines lines"
