# A port that lies in the repository itself and takes the sources that it lies in:
#
#   vcpkg install ljus --overlay-ports=FOLDER/cmake/packaging/vcpkg
#
# Not tried: it was checked that this file has no error of syntax and that the options below
# exist. A port in a registry takes a release instead, by vcpkg_from_git() or the like.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../../.." ABSOLUTE)

# Headers only: one configuration serves both.
set(VCPKG_BUILD_TYPE release)
vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        -DLJUS_TESTS=OFF
        -DLJUS_EXAMPLES=OFF
        -DLJUS_FETCH=OFF
        -DLJUS_INSTALL_CORE=OFF
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME ljus CONFIG_PATH share/cmake/ljus)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/lib" "${CURRENT_PACKAGES_DIR}/debug")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
