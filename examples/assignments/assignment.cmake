# What the assignments share. A folder of an assignment, copied to anywhere, is a project:
#
#   cmake -S my_copy -B build -DLJUS_FOLDER=where/the/library/is
#   cmake --build build && ctest --test-dir build
#
# ljus_assignment(<number> GIVEN <header>...): the program that makes the picture, and a
# test for each TEST_CASE of tests.cpp, named by its sentence, with the label
# assignment-<number>. GIVEN are the headers that answer.hpp may include.

enable_testing()
if(NOT TARGET ljus::ljus)
    add_subdirectory("${LJUS_FOLDER}" "${CMAKE_BINARY_DIR}/ljus")
endif()
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release)
endif()
include("${LJUS_FOLDER}/cmake/LjusDependencies.cmake")
ljus_dependency(doctest REQUIRED)

function(ljus_assignment number)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "GIVEN")
    foreach(program IN ITEMS picture tests)
        add_executable(assignment_${number}_${program} ${program}.cpp)
        target_include_directories(assignment_${number}_${program} PRIVATE
            "${CMAKE_CURRENT_SOURCE_DIR}" "${LJUS_FOLDER}/examples/assignments")
        target_link_libraries(assignment_${number}_${program} PRIVATE ljus::ljus
            ljus_doctest)
        if(NOT MSVC) # a stub has parameters that it does not use yet
            target_compile_options(assignment_${number}_${program} PRIVATE
                -Wall -Wextra -Wno-unused-parameter)
        endif()
    endforeach()

    string(REPLACE ";" "," given "${arg_GIVEN}")
    set(allowed "assignment-${number}: ${number}.0 the answer includes what is given")
    add_test(NAME "${allowed}" COMMAND "${CMAKE_COMMAND}" -D "GIVEN=${given}"
        -D "ANSWER=${CMAKE_CURRENT_SOURCE_DIR}/answer.hpp"
        -P "${LJUS_FOLDER}/examples/assignments/given.cmake")
    set_tests_properties("${allowed}" PROPERTIES LABELS assignment-${number})
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS tests.cpp)
    file(STRINGS tests.cpp cases REGEX "^TEST_CASE")
    foreach(case IN LISTS cases)
        string(REGEX REPLACE "^TEST_CASE\\(\"(.*)\"\\).*" "\\1" sentence "${case}")
        set(test "assignment-${number}: ${sentence}")
        add_test(NAME "${test}"
            COMMAND assignment_${number}_tests "--test-case=${sentence}")
        set_tests_properties("${test}" PROPERTIES
            LABELS assignment-${number} TIMEOUT 120)
    endforeach()
endfunction()
