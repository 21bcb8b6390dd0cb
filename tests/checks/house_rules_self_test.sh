#!/usr/bin/env bash
# Tests house_rules.sh: it must find each of these faults, and pass a tree without them.
. "$(dirname "$0")/common.sh"
folder=$scratch/house
wrong=0

# header NAME [LINE...]: writes a correct header with these lines added.
header() {
    local name=$1
    shift
    mkdir -p "$folder/$(dirname "$name")"
    {
        printf '#pragma once\n\n/// \\file %s\n/// \\brief A header.\n\n' "$name"
        [ "$name" = ljus/version.hpp ] || echo '#include "ljus/version.hpp"'
        [ $# -eq 0 ] || printf '%s\n' "$@"
    } >"$folder/$name"
}
good_house() {
    rm -rf "$folder"
    header ljus/version.hpp '#define LJUS_VERSION_MAJOR 1'
    header ljus/math/a.hpp '// not virtual, no shared_ptr' 'struct A { int b = 1; };'
    header ljus/parallel.hpp '#pragma omp parallel'
    header ljus/geometry/b.hpp '#include "ljus/math/a.hpp"' '#include "ljus/parallel.hpp"'
    header ljus/scene/load.hpp '#include <nlohmann/json.hpp>'
    header ljus/ljus.hpp '#include "ljus/geometry/b.hpp"'
    mkdir "$folder/examples" "$folder/chapters"
    echo 'int main() { CLI::detail::trim(); }' >"$folder/examples/a.cpp"
}
rules() { bash "$(dirname "$0")/house_rules.sh" "$folder" "$folder" 2>&1; }

# finds SENTENCE: the rules must fail with this sentence.
finds() {
    local output
    if output=$(rules); then
        echo "WRONG: nothing found, although: $1"
        wrong=1
    elif ! echo "$output" | grep -F "$1" >/dev/null; then
        echo "WRONG: should be found: $1; it says: $output"
        wrong=1
    fi
    good_house
}
sin() { header ljus/math/a.hpp "$1"; finds "$2"; }

good_house
rules || { echo "WRONG: a correct tree does not pass."; wrong=1; }
sin '#include <iostream>' "too long to compile"
sin '#include <glm/glm.hpp>' "by part"
sin '    virtual void f();' "no 'virtual'"
sin 'std::shared_ptr<int> p;' "no 'shared_ptr'"
sin 'struct B : public A {};' "no inheritance"
sin 'using namespace std;' "must not open a namespace"
sin '#define MAX 3' "macros are named"
sin 'static int f();' "no 'static'"
sin '#pragma omp parallel for' "only ljus/parallel.hpp"
sin 'inline void f() { printf("x"); }' "neither prints"
sin '#include "ljus/geometry/b.hpp"' "one way only"
sin '#include "ljus/math/gone.hpp"' "which does not exist"
sin "$(printf '%089d' 0)" "longer than 88"
header ljus/image/c.hpp '#include "ljus/parallel.hpp"'
finds "one way only"
header ljus/render/c.hpp '#include "ljus/scene/load.hpp"'
finds "an optional header"
header ljus/attic/c.hpp
finds "not a room"
for line in 'int main() { return ljus::detail::f(); }' 'using namespace ljus::detail;' \
    'namespace detail {' '#include "ljus/math/detail/a.hpp"'; do
    echo "$line" >"$folder/chapters/a.cpp"
    finds "detail is named outside"
done
printf '#pragma once\n/// \\file ljus/math/a.hpp\n/// \\brief A.\n#include "ljus/math/c.hpp"\n' \
    >"$folder/ljus/math/a.hpp"
printf '#pragma once\n/// \\file ljus/math/c.hpp\n/// \\brief C.\n' >"$folder/ljus/math/c.hpp"
finds "does not include ljus/version.hpp"
printf '\n#pragma once\n' >"$folder/ljus/math/a.hpp"
finds "first line"
rm -rf "$folder"
[ $wrong -eq 0 ] && echo "every fault was found"
exit $wrong
