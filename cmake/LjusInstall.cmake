# Install rules: headers, a CMake package and a pkg-config file, and the compiled library
# ljus::core unless LJUS_INSTALL_CORE is OFF. The CMake package goes to share/, because
# without that library it does not depend on the architecture.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(ljus_package_folder "${CMAKE_INSTALL_DATADIR}/cmake/ljus")
if(CMAKE_VERSION VERSION_GREATER_EQUAL 3.23)
    if(ljus_optional_headers)
        set(ljus_optional_set FILE_SET optional_headers)
    endif()
    install(TARGETS ljus EXPORT ljus-targets FILE_SET HEADERS ${ljus_optional_set})
else()
    install(TARGETS ljus EXPORT ljus-targets)
    install(DIRECTORY "${LJUS_INCLUDE_DIR}/ljus"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.hpp")
endif()
if(LJUS_INSTALL_CORE)
    install(TARGETS ljus_core EXPORT ljus-targets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
else()
    set(ljus_any_machine ARCH_INDEPENDENT)
endif()
install(EXPORT ljus-targets NAMESPACE ljus:: DESTINATION "${ljus_package_folder}")

configure_package_config_file(cmake/ljus-config.cmake.in
    "${CMAKE_CURRENT_BINARY_DIR}/ljus-config.cmake"
    INSTALL_DESTINATION "${ljus_package_folder}"
    NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/ljus-config-version.cmake"
    COMPATIBILITY SameMinorVersion ${ljus_any_machine})
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/ljus-config.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/ljus-config-version.cmake"
              cmake/LjusPrecompiledHeader.cmake
    DESTINATION "${ljus_package_folder}")

# ljus.pc is in PREFIX/share/pkgconfig and finds the prefix relative to that folder.
file(RELATIVE_PATH ljus_pc_prefix
    "${CMAKE_INSTALL_FULL_DATADIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
configure_file(cmake/ljus.pc.in "${CMAKE_CURRENT_BINARY_DIR}/ljus.pc" @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/ljus.pc"
    DESTINATION "${CMAKE_INSTALL_DATADIR}/pkgconfig")
# ljus-compare, ljus-inspect and ljus-merge, if the example programs were built.
foreach(program IN ITEMS compare inspect merge)
    if(TARGET ${program})
        install(TARGETS ${program}
            RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" OPTIONAL)
    endif()
endforeach()
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/licenses/ljus")
