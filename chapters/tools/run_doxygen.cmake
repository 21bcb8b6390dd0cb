# Runs Doxygen in FOLDER and shows its warnings, which it also leaves in warnings.txt;
# with GATE they are errors. What a program has for itself needs no documentation.
cmake_minimum_required(VERSION 3.22)
file(REMOVE "${FOLDER}/warnings.txt")
# The pages' numbers: Doxygen's filter pulls them from the tables of this folder.
set(ENV{LJUS_FIGURES} "${FIGURES}")
file(GLOB pages "${CMAKE_CURRENT_LIST_DIR}/../*.md")
execute_process(COMMAND "${PERL}" "${CMAKE_CURRENT_LIST_DIR}/numbers" --check ${pages}
    RESULT_VARIABLE lost OUTPUT_VARIABLE missing ERROR_VARIABLE missing)
execute_process(COMMAND "${DOXYGEN}" Doxyfile WORKING_DIRECTORY "${FOLDER}"
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "Doxygen failed (${result}).\n${output}")
endif()
execute_process(COMMAND "${PERL}" "${CMAKE_CURRENT_LIST_DIR}/finish" "${HTML}" "${FOLDER}/ljus.tag"
        "${QUALITY}"
    RESULT_VARIABLE result)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "The pages could not be finished; see above.")
endif()
execute_process(COMMAND "${PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/slides" "${HTML}"
    RESULT_VARIABLE result)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "The slides could not be made; see above.")
endif()
set(warnings)
if(EXISTS "${FOLDER}/warnings.txt")
    file(READ "${FOLDER}/warnings.txt" warnings)
    string(REGEX REPLACE "[^\n]*/(tests|benchmarks|examples|chapters)/[^\n]* is not documented\\.\n?" "" warnings "${warnings}")
    string(STRIP "${warnings}" warnings)
endif()
if(NOT lost EQUAL 0)
    string(APPEND warnings "\n${missing}")
endif()
if("x${warnings}" STREQUAL "x")
    return()
endif()
message("${warnings}")
if(GATE)
    message(FATAL_ERROR "Doxygen is not content with the book; its warnings are above.")
endif()
