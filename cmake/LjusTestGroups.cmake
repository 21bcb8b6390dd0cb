# ljus_test_group(<target> <test>...)
#
# A program that compiles these tests at once, each in a namespace of its own, so that what
# they share is read and instantiated once.
set(LJUS_TEST_GROUPS_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")
function(ljus_test_group target)
    set(source "${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp")
    list(TRANSFORM ARGN PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/" OUTPUT_VARIABLE files)
    list(TRANSFORM files APPEND "_test.cpp")
    add_custom_command(OUTPUT "${source}"
        COMMAND "${CMAKE_COMMAND}" -D "SOURCE=${source}" -D "FILES=${files}"
            -P "${LJUS_TEST_GROUPS_SCRIPT}"
        DEPENDS ${files} "${LJUS_TEST_GROUPS_SCRIPT}"
        COMMENT "Listing the tests of ${target}"
        VERBATIM)
    add_executable(${target} "${source}" $<TARGET_OBJECTS:ljus_test_main>)
endfunction()

# As a script, writes the source file. The headers come first, outside the namespaces: where
# a test includes them again, they are empty. The lines around an #include are copied with
# it, since they may ask whether the header is there.
if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
    include("${CMAKE_CURRENT_LIST_DIR}/LjusWriteIfDifferent.cmake")
    set(headers)
    set(tests)
    foreach(file IN LISTS FILES)
        file(STRINGS "${file}" lines REGEX "^#(include|if|elif|else|endif|define|pragma)")
        list(JOIN lines "\n" lines)
        string(APPEND headers "${lines}\n")
        get_filename_component(name "${file}" NAME)
        get_filename_component(space "${file}" NAME_WE)
        string(APPEND tests "namespace ${space} {\n#include \"${name}\"\n}\n")
    endforeach()
    ljus_write_if_different("${SOURCE}" "${headers}\n${tests}")
endif()
