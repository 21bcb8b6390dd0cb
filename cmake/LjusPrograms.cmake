# The programs of the book: examples/NN_name.cpp are for readers to copy; only the book needs
# chapters/experiments/NN_experiments.cpp and chapters/drawings/NN_drawings.cpp.
#
#   ljus_program(SOURCE [CORE])    adds a program named like its file, and its test
#
# If LJUS_EXAMPLES_QUICK is set, it is compiled for the test run, whose task is small, and not
# for speed; with CORE also against ljus::core and a precompiled header, which an example does
# without as its readers do. Lines at the top of the source say more:
#
#   // figures: fig-1 fig-15      the report's items that it makes (./scripts/figures fig-1)
#   // smoke: --width 16 --rays 1 the test runs it with these arguments and --out
#   // needs: mpi                 it is left out if Open MPI is not installed
#   // headers: broken            it is compiled against headers in which mistakes can be
#                                 switched on (cmake/LjusMistakes.cmake), or against the
#                                 plain ones if Python is not installed
include(LjusMistakes)
include(LjusWriteIfDifferent)

# Precompiles the headers of quick programs once.
function(ljus_quick_headers)
    if(TARGET ljus_example_headers)
        return()
    endif()
    ljus_write_if_different("${PROJECT_BINARY_DIR}/examples/precompiled.cpp" "")
    add_library(ljus_example_headers OBJECT "${PROJECT_BINARY_DIR}/examples/precompiled.cpp")
    target_link_libraries(ljus_example_headers
        PRIVATE ljus_example_common ljus_warnings ljus_core)
    target_compile_options(ljus_example_headers PRIVATE $<$<NOT:$<CXX_COMPILER_ID:MSVC>>:-O1>)
    ljus_use_precompiled_header(ljus_example_headers)
endfunction()

function(ljus_program source)
    cmake_parse_arguments(PARSE_ARGV 1 this "CORE" "" "")
    get_filename_component(name "${source}" NAME_WE)
    # CMake runs again when these lines change.
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${source}")
    file(STRINGS "${source}" needs_mpi LIMIT_COUNT 4 REGEX "^// needs: mpi")
    file(STRINGS "${source}" broken LIMIT_COUNT 4 REGEX "^// headers: broken")
    file(STRINGS "${source}" smoke LIMIT_COUNT 4 REGEX "^// smoke:")
    if(needs_mpi)
        find_package(MPI QUIET COMPONENTS CXX)
        if(NOT MPI_CXX_FOUND)
            message(STATUS "Ljus: Open MPI is not installed (sudo apt-get install "
                           "libopenmpi-dev): ${name} is left out")
            return()
        endif()
    endif()
    if(broken)
        ljus_can_break_headers(broken)
    endif()

    add_executable(${name} "${source}")
    target_link_libraries(${name} PRIVATE ljus_example_common)
    if(needs_mpi)
        target_link_libraries(${name} PRIVATE MPI::MPI_CXX)
    endif()
    if(broken)
        ljus_show_mistakes(${name} "${source}")
    else()
        target_link_libraries(${name} PRIVATE ljus_warnings)
    endif()
    if(LJUS_EXAMPLES_QUICK)
        target_compile_options(${name} PRIVATE $<$<NOT:$<CXX_COMPILER_ID:MSVC>>:-O1>)
        ljus_hide_false_warnings(${name})
        if(this_CORE AND NOT broken)
            ljus_quick_headers()
            target_link_libraries(${name} PRIVATE ljus_core)
            ljus_use_precompiled_header(${name} ljus_example_headers)
        endif()
    endif()

    if(smoke AND LJUS_TESTS)
        set(folder "${PROJECT_BINARY_DIR}/examples/smoke/${name}")
        file(MAKE_DIRECTORY "${folder}")
        string(REGEX REPLACE "^// smoke:" "" arguments "${smoke}")
        separate_arguments(arguments UNIX_COMMAND "${arguments}")
        add_test(NAME example.${name} WORKING_DIRECTORY "${folder}"
            COMMAND ${name} --out "${folder}" ${arguments})
        set_tests_properties(example.${name} PROPERTIES LABELS example TIMEOUT 300)
    endif()
endfunction()
