#!/usr/bin/env bash
# Checks that a camera ray and a photon take no more calls and files than scripts/journey
# allows.
. "$(dirname "$0")/common.sh"
[ -n "${LJUS_PYTHON:-}" ] || skip "Python is not installed"
command -v addr2line >/dev/null || skip "addr2line (binutils) is not installed"
case $("$LJUS_CXX" --version) in
    *clang*) skip "clang reports no functions of chosen files alone; g++ does" ;;
esac
CXX=$LJUS_CXX CXXFLAGS=${LJUS_PACKAGE_FLAGS//;/ } \
    "$LJUS_PYTHON" "$LJUS_ROOT/scripts/journey" --check
