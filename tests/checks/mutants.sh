#!/usr/bin/env bash
# Tests the mutants themselves: what is found in a small header, and what becomes of it.
. "$(dirname "$0")/common.sh"
command -v python3 >/dev/null || exit 77
python3 "$LJUS_ROOT/tests/mutants/self_test.py" "${LJUS_CXX:-g++}"
