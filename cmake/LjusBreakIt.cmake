# Break it: does a test notice when one term of a header is wrong?
#
#   ljus_break_it(NAME   sphere-discriminant      # unique
#                 HEADER geometry/sphere.hpp      # below include/ljus
#                 TEST   sphere                   # tests/sphere_test.cpp must notice
#                 FROM   "discriminant >= C(0)"   # occurs exactly once in the header
#                 TO     "discriminant <= C(0)"
#                 [CASES "sphere: a hit*"])       # only these test cases are run
#
# The test is compiled against a copy of the header in which FROM is replaced by TO; the
# CTest entry break_it.NAME (labels: break_it and the test's name) passes only if that
# program runs to its end and reports at least one failed assertion. A text that
# is not there exactly once stops the build, and so does a copy that does not compile;
# a crash is not a test that notices. Texts with quotes or several lines are written
# [[like this]].

include("${CMAKE_CURRENT_LIST_DIR}/LjusWriteIfDifferent.cmake")
set(LJUS_BREAK_IT_FOLDER "${CMAKE_CURRENT_LIST_DIR}")

function(ljus_break_it)
    cmake_parse_arguments(PARSE_ARGV 0 row "" "NAME;HEADER;TEST;FROM;TO;CASES" "")
    foreach(field IN ITEMS NAME HEADER TEST FROM)
        if("x${row_${field}}" STREQUAL "x")
            message(FATAL_ERROR "ljus_break_it(${row_NAME}): ${field} is missing.")
        endif()
    endforeach()
    if(NOT "x${row_UNPARSED_ARGUMENTS}" STREQUAL "x")
        message(FATAL_ERROR "ljus_break_it(${row_NAME}): '${row_UNPARSED_ARGUMENTS}' is no "
            "field; a text with quotes or semicolons is written [[like this]].")
    endif()
    if(row_TEST IN_LIST ljus_tests_left_out) # a package that it needs is missing
        return()
    endif()
    # A third of the rows, say: those whose name hashes to the share that is asked for.
    string(MD5 hash "${row_NAME}")
    string(SUBSTRING "${hash}" 0 6 hash)
    set(share "${LJUS_BREAK_IT_SHARE}")
    if(NOT share)
        set(share 1/1)
    endif()
    string(REPLACE "/" ";" share "${share}")
    list(GET share 0 which)
    list(GET share 1 of)
    math(EXPR own "0x${hash} % ${of} + 1")
    if(NOT own EQUAL which)
        return()
    endif()
    if(TARGET break_it_${row_NAME})
        message(FATAL_ERROR "ljus_break_it(${row_NAME}): there are two of this name.")
    endif()
    set(test_source "${CMAKE_CURRENT_SOURCE_DIR}/${row_TEST}_test.cpp")
    if(NOT EXISTS "${test_source}")
        message(FATAL_ERROR "ljus_break_it(${row_NAME}): there is no ${test_source}.")
    endif()

    set(folder "${CMAKE_BINARY_DIR}/break_it/${row_NAME}")
    set(header "${LJUS_INCLUDE_DIR}/ljus/${row_HEADER}")
    set(broken "${folder}/ljus/${row_HEADER}")
    if(NOT EXISTS "${broken}") # another header was broken here before
        file(REMOVE_RECURSE "${folder}/ljus")
    endif()
    ljus_write_if_different("${folder}/from.txt" "${row_FROM}")
    ljus_write_if_different("${folder}/to.txt" "${row_TO}")
    add_custom_command(OUTPUT "${broken}"
        COMMAND "${CMAKE_COMMAND}" -D "NAME=${row_NAME}" -D "HEADER=${header}"
            -D "FOLDER=${folder}" -D "BROKEN=${broken}"
            -P "${LJUS_BREAK_IT_FOLDER}/break_it_patch.cmake"
        DEPENDS "${header}" "${folder}/from.txt" "${folder}/to.txt"
            "${LJUS_BREAK_IT_FOLDER}/break_it_patch.cmake"
        COMMENT "Breaking ${row_HEADER}: ${row_NAME}"
        VERBATIM)

    # The broken copy comes first on the include path; it may leave something unused.
    add_executable(break_it_${row_NAME} "${test_source}" "${broken}"
        $<TARGET_OBJECTS:ljus_test_main>)
    target_include_directories(break_it_${row_NAME} BEFORE PRIVATE "${folder}")
    target_link_libraries(break_it_${row_NAME} PRIVATE ljus ljus_test_support)
    target_compile_options(break_it_${row_NAME} PRIVATE -w)
    if(NOT MSVC) # most of a broken header's time is spent in compiling its test
        target_compile_options(break_it_${row_NAME} PRIVATE -O1)
    endif()
    set_target_properties(break_it_${row_NAME} PROPERTIES
        RUNTIME_OUTPUT_DIRECTORY "${folder}")

    add_test(NAME break_it.${row_NAME}
        COMMAND "${CMAKE_COMMAND}" -D "NAME=${row_NAME}" -D "HEADER=${row_HEADER}"
            -D "FOLDER=${folder}" -D "CASES=${row_CASES}"
            -D "PROGRAM=$<TARGET_FILE:break_it_${row_NAME}>"
            -P "${LJUS_BREAK_IT_FOLDER}/break_it_check.cmake")
    set_tests_properties(break_it.${row_NAME} PROPERTIES
        LABELS "break_it;${row_TEST}" TIMEOUT 900)
    if(TARGET concept_${row_TEST})
        add_dependencies(concept_${row_TEST} break_it_${row_NAME})
    endif()
endfunction()
