# ljus_compile_quickly(<target>)
#
# For programs that take longer to compile than to run: -O1, and g++ leaves out passes that
# take a tenth of its time and save such a program hardly any.
function(ljus_compile_quickly target)
    if(MSVC)
        return()
    endif()
    target_compile_options(${target} PRIVATE -O1)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${target} PRIVATE -fno-tree-pta -fno-tree-loop-optimize
            -fno-tree-dominator-opts -fno-tree-sink -fno-ssa-phiopt)
    endif()
    ljus_hide_false_warnings(${target})
endfunction()

# ljus_hide_false_warnings(<target>)
#
# At -O1, g++ 12 warns that moving a short string reads beyond its end, which it does not.
function(ljus_hide_false_warnings target)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
        target_compile_options(${target} PRIVATE
            -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
    endif()
endfunction()
