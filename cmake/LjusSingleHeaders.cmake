# The target single_headers makes single/NAME.hpp in the build folder for each header that a
# program may include, and single/ljus.hpp; they are installed in PREFIX/share/ljus/single.
# scripts/single-header says what they are.
find_package(Python3 3.9 QUIET COMPONENTS Interpreter)
if(NOT Python3_Interpreter_FOUND)
    message(STATUS "Ljus: Python 3.9 or later is not found: no single headers")
    return()
endif()
set(ljus_single "${CMAKE_BINARY_DIR}/single")
set(ljus_single_stamp "${CMAKE_CURRENT_BINARY_DIR}/single_headers.stamp")
set(ljus_single_script "${PROJECT_SOURCE_DIR}/scripts/single-header")
add_custom_command(OUTPUT "${ljus_single_stamp}"
    COMMAND "${CMAKE_COMMAND}" -E rm -rf "${ljus_single}" # headers may have been renamed
    COMMAND "${Python3_EXECUTABLE}" "${ljus_single_script}" --out "${ljus_single}"
    COMMAND "${CMAKE_COMMAND}" -E touch "${ljus_single_stamp}"
    DEPENDS ${ljus_headers} ${ljus_optional_headers} "${ljus_single_script}"
        "${PROJECT_SOURCE_DIR}/LICENSE"
    COMMENT "Single headers: ${ljus_single}"
    VERBATIM)
add_custom_target(single_headers DEPENDS "${ljus_single_stamp}")
if(LJUS_INSTALL)
    set_target_properties(single_headers PROPERTIES EXCLUDE_FROM_ALL OFF)
    include(GNUInstallDirs)
    install(DIRECTORY "${ljus_single}/" DESTINATION "${CMAKE_INSTALL_DATADIR}/ljus/single"
        OPTIONAL)
endif()
