# A program that shows mistakes is compiled against headers in which the rows of
# tests/break_it that it names, `.row = "NAME"`, can be switched on at run time.
#
#   ljus_can_break_headers(RESULT)        # is Python installed?
#   ljus_show_mistakes(TARGET SOURCE)     # break_it_gallery.py says how
#
# Such a program uses neither ljus::core nor a precompiled header, because those were
# compiled without the mistakes.

set(LJUS_MISTAKES_FOLDER "${CMAKE_CURRENT_LIST_DIR}")

function(ljus_can_break_headers result)
    find_package(Python3 3.9 QUIET COMPONENTS Interpreter)
    if(NOT Python3_Interpreter_FOUND)
        message(STATUS "Ljus: Python 3.9 or later is not found: "
                       "no program shows mistakes")
    endif()
    set(${result} "${Python3_Interpreter_FOUND}" PARENT_SCOPE)
endfunction()

function(ljus_show_mistakes target source)
    find_package(Python3 3.9 QUIET COMPONENTS Interpreter)
    set(folder "${CMAKE_CURRENT_BINARY_DIR}/${target}_headers")
    set(tests "${PROJECT_SOURCE_DIR}/tests")
    file(GLOB_RECURSE read CONFIGURE_DEPENDS
        "${LJUS_INCLUDE_DIR}/ljus/*.hpp"
        "${tests}/break_it/*.cmake" "${tests}/*_test.cpp")
    add_custom_command(OUTPUT "${folder}/ljus_break_it.hpp"
        COMMAND "${Python3_EXECUTABLE}" -B "${LJUS_MISTAKES_FOLDER}/break_it_gallery.py"
            "${LJUS_INCLUDE_DIR}" "${folder}" "${source}" "${tests}"
        DEPENDS ${read} "${source}" "${LJUS_MISTAKES_FOLDER}/break_it_gallery.py"
            "${LJUS_MISTAKES_FOLDER}/break_it_patch.py"
        COMMENT "Breaking the headers of ${target}"
        VERBATIM)
    target_sources(${target} PRIVATE "${folder}/ljus_break_it.hpp")
    target_include_directories(${target} BEFORE PRIVATE "${folder}")
    # A broken term may leave a variable unused.
    target_compile_options(${target} PRIVATE -w)
    if(NOT MSVC)
        target_compile_options(${target} PRIVATE $<$<CONFIG:Debug>:-O1>)
    endif()
endfunction()
