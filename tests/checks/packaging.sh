#!/usr/bin/env bash
# Checks the recipes of cmake/packaging/ as far as possible without their tools: they can be
# parsed, name existing files and options, and all give the same version.
. "$(dirname "$0")/common.sh"
status=0
problem() { echo "$*"; status=1; }
packaging=$LJUS_ROOT/cmake/packaging

# --- One version.
same() {
    [ "$2" = "$LJUS_VERSION" ] || problem "$1 says version '$2', not $LJUS_VERSION."
}
same cmake/packaging/vcpkg/ljus/vcpkg.json \
    "$(sed -n 's/^ *"version": "\(.*\)",$/\1/p' "$packaging/vcpkg/ljus/vcpkg.json")"
same cmake/packaging/conan/conanfile.py \
    "$(sed -n 's/^    version = "\(.*\)"$/\1/p' "$packaging/conan/conanfile.py")"
same CHANGELOG.md "$(sed -n 's/^## \([0-9.]*\).*/\1/p' "$LJUS_ROOT/CHANGELOG.md" | head -n 1)"
same "README.md, how to cite it," \
    "$(tr '\n' ' ' <"$LJUS_ROOT/README.md" | sed -n 's/.*compiles, version \([0-9.]*\)\*.*/\1/p').${LJUS_VERSION##*.}"

# --- vcpkg: the port, with commands that only record their arguments.
cat >"$scratch/port.cmake" <<END
function(vcpkg_cmake_configure)
    file(WRITE "$scratch/told" "\${ARGN}")
endfunction()
function(vcpkg_cmake_install)
endfunction()
function(vcpkg_cmake_config_fixup)
endfunction()
function(vcpkg_fixup_pkgconfig)
endfunction()
function(vcpkg_install_copyright option file)
    if(NOT EXISTS "\${file}")
        message(FATAL_ERROR "there is no \${file}")
    endif()
endfunction()
set(CURRENT_PACKAGES_DIR "$scratch/packages")
include("$packaging/vcpkg/ljus/portfile.cmake")
if(NOT EXISTS "\${SOURCE_PATH}/include/ljus/ljus.hpp")
    message(FATAL_ERROR "the port takes its sources from \${SOURCE_PATH}")
endif()
END
if "$LJUS_CMAKE" -P "$scratch/port.cmake"; then
    tr ';' '\n' <"$scratch/told" | sed -n 's/^-D\(LJUS_[A-Z_]*\)=.*/\1/p' >"$scratch/options"
    [ -s "$scratch/options" ] || problem "the vcpkg port sets no option."
    while read -r option; do
        grep -qE "^(option|set)\($option " "$LJUS_ROOT/CMakeLists.txt" ||
            problem "the vcpkg port sets $option, which CMakeLists.txt does not have."
    done <"$scratch/options"
else
    problem "portfile.cmake has an error."
fi

# --- JSON, and Python.
if [ -n "${LJUS_PYTHON:-}" ]; then
    "$LJUS_PYTHON" - "$packaging" "$scratch" <<'END' || status=1
import json, pathlib, py_compile, sys
packaging, scratch = map(pathlib.Path, sys.argv[1:])
port = json.loads((packaging / "vcpkg/ljus/vcpkg.json").read_text())
missing = {"name", "version", "description", "license", "dependencies"} - port.keys()
assert not missing, f"vcpkg.json lacks {missing}"
names = [d if isinstance(d, str) else d["name"] for d in port["dependencies"]]
assert {"glm", "stb", "vcpkg-cmake", "vcpkg-cmake-config"} == set(names), names
assert all(d["host"] is True for d in port["dependencies"] if not isinstance(d, str))
py_compile.compile(packaging / "conan/conanfile.py", cfile=scratch / "x", doraise=True)
END
fi
[ $status -ne 0 ] || echo "the recipes can be read, and all say version $LJUS_VERSION"
exit $status
