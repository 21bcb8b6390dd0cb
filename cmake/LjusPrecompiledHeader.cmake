# ljus_use_precompiled_header(<target> [<other target> | HEADERS <headers>])
#
# Has ljus.hpp or other headers precompiled for a target, or shares what another target of
# the same flags has had precompiled. It saves most of what the headers take to be read, some 0.8 s a
# file; to make it takes as long as five files. A source file includes what it uses all
# the same. For g++ only: clang 14 crashes when it writes these headers;
# with other compilers it does nothing.
function(ljus_use_precompiled_header target)
    if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        return()
    endif()
    # So that a compiler cache may look at what was precompiled.
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
