# Break it: does a test notice if one term of a header is wrong?
#
#   ljus_break_it(NAME   sphere-discriminant      # unique
#                 HEADER geometry/sphere.hpp      # below include/ljus; or examples/...
#                 TEST   sphere                   # tests/sphere_test.cpp must fail
#                 FROM   "discriminant >= C(0)"   # occurs exactly once in the header
#                 TO     "discriminant <= C(0)"
#                 [CASES "sphere: a hit*"]        # only these test cases are run
#                 [COMPILED])                     # in a program of its own, see below
#   ljus_break_it_programs()                      # after the last row
#
# One program holds all rows of a test. When it runs, the environment variable LJUS_BREAK_IT
# names the row whose FROM is replaced by TO (break_it_patch.py says how). FROM must therefore
# be in the body of a function, and the mistake must have an effect at run time: what the
# compiler evaluates is not broken. A row that cannot meet this, or that does not compile
# beside the others, says COMPILED; it gets a program of its own, which takes longer to
# compile.
#
# The CTest entry break_it.NAME (labels: break_it and the test's name) passes only if the
# program runs to its end and reports at least one failed assertion; break_it.TEST.unbroken
# passes if no assertion fails with the headers as they are. The row's verdict.txt says what
# was changed, and which assertion of which test case noticed. The build stops if FROM does
# not occur exactly once, or if a header does not compile; a crash does not count as noticed.
# Texts with quotes or several lines are written [[like this]].
#
# None of this is part of the target all, and CTest lists the entries only with -C BreakIt:
#
#   cmake --build build --target break_it         # or break_it_TEST
#   ctest --test-dir build -C BreakIt -L '^break_it$'

include("${CMAKE_CURRENT_LIST_DIR}/LjusQuickCompilation.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/LjusWriteIfDifferent.cmake")
set(LJUS_BREAK_IT_FOLDER "${CMAKE_CURRENT_LIST_DIR}")
find_package(Python3 3.9 COMPONENTS Interpreter)
if(NOT Python3_Interpreter_FOUND)
    message(STATUS "Ljus: Python 3.9 or later is not found: the broken headers are left out")
endif()
add_custom_target(break_it)

# Builds a program from the matching test cases of a test and its broken headers; `how` is
# alone (one row) or switched. The rows are given as ROW HEADER ROW HEADER... .
function(ljus_break_it_program target test cases how)
    set(folder "${CMAKE_BINARY_DIR}/break_it/${test}")
    set(include_folder "${folder}/switched")
    set(written)
    set(test_source "${CMAKE_CURRENT_SOURCE_DIR}/${test}_test.cpp")
    set(read "${LJUS_BREAK_IT_FOLDER}/break_it_patch.py" "${test_source}")
    set(rows ${ARGN})
    while(rows)
        list(POP_FRONT rows row header)
        if(how STREQUAL "alone")
            set(include_folder "${folder}/rows/${row}")
        endif()
        set(source "${LJUS_INCLUDE_DIR}/ljus/${header}")
        set(included "ljus/${header}")
        if(header MATCHES "^examples/(.*)")
            get_filename_component(root "${LJUS_INCLUDE_DIR}" DIRECTORY)
            set(source "${root}/${header}")
            set(included "${CMAKE_MATCH_1}")
        endif()
        list(APPEND written "${include_folder}/${included}")
        list(APPEND read "${source}"
            "${folder}/rows/${row}/from.txt" "${folder}/rows/${row}/to.txt")
    endwhile()
    list(APPEND written "${include_folder}/${test}_test.cpp")
    list(REMOVE_DUPLICATES written)
    list(REMOVE_DUPLICATES read)
    add_custom_command(OUTPUT ${written}
        COMMAND "${Python3_EXECUTABLE}" "${LJUS_BREAK_IT_FOLDER}/break_it_patch.py"
            "${LJUS_INCLUDE_DIR}" "${folder}" "${test_source}" "${cases}" ${how} ${ARGN}
        DEPENDS ${read}
        COMMENT "Breaking the headers of ${target}"
        VERBATIM)

    # The broken headers come first on the include path. No warnings: a broken term may leave
    # a variable unused.
    add_executable(${target} EXCLUDE_FROM_ALL ${written} $<TARGET_OBJECTS:ljus_test_main>)
    target_include_directories(${target} BEFORE PRIVATE "${include_folder}")
    target_link_libraries(${target} PRIVATE ljus ljus_test_support)
    target_compile_options(${target} PRIVATE -w)
    if(TARGET ljus_test_compilation)
        target_link_libraries(${target} PRIVATE ljus_test_compilation)
        ljus_include_shown(${target})
    endif()
    ljus_compile_quickly(${target})
    set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${folder}")
    add_dependencies(break_it_${test} ${target})
endfunction()

function(ljus_break_it)
    cmake_parse_arguments(PARSE_ARGV 0 row "COMPILED" "NAME;HEADER;TEST;FROM;TO;CASES" "")
    foreach(field IN ITEMS NAME HEADER TEST FROM)
        if("x${row_${field}}" STREQUAL "x")
            message(FATAL_ERROR "ljus_break_it(${row_NAME}): ${field} is missing.")
        endif()
    endforeach()
    if(NOT "x${row_UNPARSED_ARGUMENTS}" STREQUAL "x")
        message(FATAL_ERROR "ljus_break_it(${row_NAME}): '${row_UNPARSED_ARGUMENTS}' is no "
            "field; a text with quotes or semicolons is written [[like this]].")
    endif()
    if(NOT Python3_Interpreter_FOUND)
        return()
    endif()
    if(row_TEST IN_LIST ljus_tests_left_out) # a package that it needs is missing
        return()
    endif()
    if(TEST break_it.${row_NAME})
        message(FATAL_ERROR "ljus_break_it(${row_NAME}): there are two of this name.")
    endif()
    set(test_source "${CMAKE_CURRENT_SOURCE_DIR}/${row_TEST}_test.cpp")
    if(NOT EXISTS "${test_source}")
        message(FATAL_ERROR "ljus_break_it(${row_NAME}): there is no ${test_source}.")
    endif()

    set(folder "${CMAKE_BINARY_DIR}/break_it/${row_TEST}/rows/${row_NAME}")
    ljus_write_if_different("${folder}/from.txt" "${row_FROM}")
    ljus_write_if_different("${folder}/to.txt" "${row_TO}")
    if(NOT TARGET break_it_${row_TEST})
        add_custom_target(break_it_${row_TEST})
        add_dependencies(break_it break_it_${row_TEST})
    endif()
    set(cases "${row_CASES}")
    if("x${cases}" STREQUAL "x")
        set(cases "*")
    endif()
    if(row_COMPILED)
        set(program break_it_row_${row_NAME})
        ljus_break_it_program(${program} ${row_TEST} "${cases}" alone
            ${row_NAME} "${row_HEADER}")
    else()
        set(program break_it_program_${row_TEST})
        set_property(GLOBAL APPEND PROPERTY ljus_break_it_tests ${row_TEST})
        set_property(GLOBAL APPEND PROPERTY ljus_break_it_rows_${row_TEST}
            ${row_NAME} "${row_HEADER}")
        set_property(GLOBAL APPEND PROPERTY ljus_break_it_cases_${row_TEST} "${cases}")
    endif()
    add_test(NAME break_it.${row_NAME}
        COMMAND "${CMAKE_COMMAND}" -D "NAME=${row_NAME}" -D "HEADER=${row_HEADER}"
            -D "FOLDER=${folder}" -D "CASES=${row_CASES}"
            -D "PROGRAM=$<TARGET_FILE:${program}>"
            -P "${LJUS_BREAK_IT_FOLDER}/break_it_check.cmake"
        CONFIGURATIONS BreakIt)
    set_tests_properties(break_it.${row_NAME} PROPERTIES
        LABELS "break_it;${row_TEST}" TIMEOUT 900)
endfunction()

# Adds the programs, each of which holds the rows of one test.
function(ljus_break_it_programs)
    get_property(tests GLOBAL PROPERTY ljus_break_it_tests)
    list(REMOVE_DUPLICATES tests)
    foreach(test IN LISTS tests)
        set(program break_it_program_${test})
        get_property(rows GLOBAL PROPERTY ljus_break_it_rows_${test})
        get_property(cases GLOBAL PROPERTY ljus_break_it_cases_${test})
        list(REMOVE_DUPLICATES cases)
        list(JOIN cases "," cases)
        ljus_break_it_program(${program} ${test} "${cases}" switched ${rows})

        add_test(NAME break_it.${test}.unbroken
            COMMAND ${program} "--test-case=${cases}" CONFIGURATIONS BreakIt)
        set_tests_properties(break_it.${test}.unbroken PROPERTIES
            LABELS "break_it;${test}" TIMEOUT 900 ENVIRONMENT "LJUS_BREAK_IT=")
    endforeach()
endfunction()
