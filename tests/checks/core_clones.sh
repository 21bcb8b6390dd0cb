#!/usr/bin/env bash
# ljus::core has some searches for several generations of processors. Checks that each of them
# finds the same, to the last bit, as the headers alone; those that this processor can run.
. "$(dirname "$0")/common.sh"
source=$LJUS_ROOT/tests/checks/core_clones/searches.cpp
[ "$(uname -sm)" = "Linux x86_64" ] || skip "other generations are known on x86-64 only"
"$LJUS_CXX" --version | grep -qE 'g\+\+|GCC|Free Software' || skip "only g++ makes them"

found_by() { # NAME FLAGS...: compiles and runs
    local name=$1
    shift
    # shellcheck disable=SC2086
    "$LJUS_CXX" -std=c++20 "$@" $LJUS_PACKAGE_FLAGS -I"$include" "$source" -o "$scratch/$name"
    "$scratch/$name"
}
headers=$(found_by headers -O2)
echo "headers: $headers"
status=0
for generation in v3:avx2 v4:avx512vl; do
    name=${generation%:*}
    if ! grep -qw "${generation#*:}" /proc/cpuinfo; then
        echo "$name: this processor does not have ${generation#*:}"
        continue
    fi
    clone=$(found_by "$name" -O3 -ffp-contract=off \
        "-DLJUS_CORE_CLONES=[[gnu::target(\"arch=x86-64-$name\"), gnu::flatten]]")
    echo "$name:      $clone"
    [ "$clone" = "$headers" ] || { echo "WRONG: $name finds something else"; status=1; }
done
exit $status
