# Refuses an answer that includes a header of the library which is not given: some of them
# hold what is asked for.
cmake_minimum_required(VERSION 3.22)
file(STRINGS "${ANSWER}" lines REGEX "^ *# *include")
string(REPLACE "," ";" GIVEN "${GIVEN}")
foreach(line IN LISTS lines)
    if(line MATCHES "(ljus/[^\">]*|course/[^\">]*|glm/[^\">]*)")
        set(header "${CMAKE_MATCH_1}")
        if(NOT header IN_LIST GIVEN AND NOT header MATCHES "^glm/")
            string(REPLACE ";" ", " list "${GIVEN}")
            message(FATAL_ERROR "answer.hpp includes ${header}; it may include ${list}.")
        endif()
    endif()
endforeach()
