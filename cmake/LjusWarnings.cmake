# Our own programs are compiled with the warnings that a careful user turns on, as
# errors; the library itself passes none of them on.
add_library(ljus_warnings INTERFACE)
if(MSVC)
    target_compile_options(ljus_warnings INTERFACE /W4 /WX)
else()
    target_compile_options(ljus_warnings INTERFACE
        -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)
endif()
