#!/usr/bin/env bash
# Tests the mutation tool itself on a small header.
. "$(dirname "$0")/common.sh"
command -v python3 >/dev/null || exit 77
python3 "$LJUS_ROOT/tests/mutants/self_test.py" "${LJUS_CXX:-g++}"
