# Ljus's own programs are compiled with the warnings that a careful user turns on, as errors;
# programs that link the library do not inherit them. (With sanitizers, g++ gives false
# warnings, so their presets set LJUS_WERROR to OFF.)
add_library(ljus_warnings INTERFACE)
if(MSVC)
    target_compile_options(ljus_warnings INTERFACE /W4 $<$<BOOL:${LJUS_WERROR}>:/WX>)
else()
    target_compile_options(ljus_warnings INTERFACE
        -Wall -Wextra -Wpedantic -Wconversion -Wshadow $<$<BOOL:${LJUS_WERROR}>:-Werror>)
endif()
