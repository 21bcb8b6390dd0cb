# Our own programs are compiled with the warnings that a careful user turns on, as
# errors; the library itself passes none of them on. (The sanitizers make g++ warn of
# what is not there, so their presets set LJUS_WERROR to OFF.)
add_library(ljus_warnings INTERFACE)
if(MSVC)
    target_compile_options(ljus_warnings INTERFACE /W4 $<$<BOOL:${LJUS_WERROR}>:/WX>)
else()
    target_compile_options(ljus_warnings INTERFACE
        -Wall -Wextra -Wpedantic -Wconversion -Wshadow $<$<BOOL:${LJUS_WERROR}>:-Werror>)
endif()
