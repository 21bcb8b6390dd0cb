# ljus_use_precompiled_header(<target> [<other target> | HEADERS <headers>])
#
# Precompiles ljus.hpp or other headers for a target, or shares the precompiled header of
# another target with the same flags. It saves most of the time that reading the headers
# takes, some 0.8 s per source file, and is made in the time of five files. Source files
# still include what they use. For g++ only (clang 14 crashes when it writes these headers);
# with other compilers it does nothing.
function(ljus_use_precompiled_header target)
    if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        return()
    endif()
    # Lets a compiler cache look into the precompiled header.
    target_compile_options(${target} PRIVATE -fpch-preprocess)
    if(ARGC GREATER 1 AND "${ARGV1}" STREQUAL "HEADERS")
        list(POP_FRONT ARGN)
        target_precompile_headers(${target} PRIVATE ${ARGN})
    elseif(ARGC GREATER 1)
        target_precompile_headers(${target} REUSE_FROM ${ARGV1})
    else()
        target_precompile_headers(${target} PRIVATE <ljus/ljus.hpp>)
    endif()
endfunction()
