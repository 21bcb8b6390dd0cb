# Runs PROGRAM, a test compiled against broken headers, with the row NAME; fails unless the
# program runs to its end and reports at least one failed assertion. Prints the change and the
# assertion that noticed it, and writes them to FOLDER/verdict.txt for ./scripts/test.
cmake_minimum_required(VERSION 3.22)
set(ENV{LJUS_BREAK_IT} "${NAME}")
set(arguments --no-colors=true)
if(NOT "x${CASES}" STREQUAL "x")
    list(APPEND arguments "--test-case=${CASES}")
endif()
execute_process(COMMAND "${PROGRAM}" ${arguments}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)

if(result EQUAL 0 AND output MATCHES "test cases: +0 ")
    message(FATAL_ERROR "break it ${NAME}: no test case is named '${CASES}'.")
endif()
if(result EQUAL 0)
    message(FATAL_ERROR "break it ${NAME}: nobody noticed. With this change in ${HEADER} "
        "every test still passes: test the term, or leave it out; or, if only what the "
        "compiler computes changes, give the row the word COMPILED.\n"
        "The change: ${FOLDER}/from.txt to ${FOLDER}/to.txt")
endif()
if(NOT result EQUAL 1 OR output MATCHES "CRASHED")
    message(FATAL_ERROR "break it ${NAME}: the test program did not run to its end "
        "(${result}); a crash is not a test that notices.\n${output}")
endif()
if(NOT output MATCHES "assertions: +[0-9]+ \\| +[0-9]+ passed \\| +([0-9]+) failed")
    message(FATAL_ERROR "break it ${NAME}: the output has no summary of doctest.\n${output}")
endif()
set(failed "${CMAKE_MATCH_1}")
if(failed EQUAL 0)
    message(FATAL_ERROR "break it ${NAME}: no assertion failed; an exception that escapes "
        "is not a test that notices.\n${output}")
endif()

# The change, its lines marked - and +; the texts may hold quotes, brackets and semicolons.
file(READ "${FOLDER}/from.txt" from)
file(READ "${FOLDER}/to.txt" to)
string(REPLACE "\n" "\n    - " from "${from}")
string(REPLACE "\n" "\n    + " to "${to}")
set(verdict "${NAME}, in ${HEADER}:\n    - ${from}\n    + ${to}\n")
# Each test case that noticed, once; brackets and semicolons would confuse CMake's lists.
string(REGEX REPLACE "[][;]" "." plain "${output}")
string(REGEX MATCHALL "TEST CASE: [^\n]*" cases "${plain}")
list(REMOVE_DUPLICATES cases)
foreach(case IN LISTS cases)
    string(REGEX REPLACE "^TEST CASE: +" "" case "${case}")
    string(APPEND verdict "  noticed by ${case}\n")
endforeach()
if(output MATCHES "[^/\n]*: (FATAL )?ERROR: [^\n]*\n( +values: [^\n]*\n)?( +logged: [^\n]*)?")
    string(STRIP "${CMAKE_MATCH_0}" first)
    string(REPLACE "\n" "\n    " first "${first}")
    string(APPEND verdict "  ${failed} assertions failed; the first:\n    ${first}\n")
endif()
file(WRITE "${FOLDER}/verdict.txt" "${verdict}")
message("${verdict}")
