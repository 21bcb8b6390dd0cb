# Packages that the project uses. A package that is not installed is fetched into the build
# folder at a pinned commit, if LJUS_FETCH allows it. LJUS_<NAME>_REPOSITORY and
# LJUS_<NAME>_COMMIT choose another source.
include_guard(DIRECTORY)
include(FetchContent)

# ljus_package(<name> HEADER <file> PACKAGE <CMake package> TARGET <its target>
#              APT <Debian package> REPOSITORY <address> COMMIT <full commit>
#              INCLUDE <folder of the headers in the repository>)
#
# Describes a package; ljus_dependency(<name>) uses the description.
macro(ljus_package name)
    cmake_parse_arguments(ljus_package_${name} ""
        "HEADER;PACKAGE;TARGET;APT;REPOSITORY;COMMIT;INCLUDE" "" ${ARGN})
endmacro()

ljus_package(glm HEADER glm/vec3.hpp PACKAGE glm TARGET glm::glm APT libglm-dev
    REPOSITORY https://github.com/g-truc/glm.git
    COMMIT 0af55ccecd98d4e5a8d1fad7de25ba429d60e863 # 1.0.1
    INCLUDE .)
ljus_package(stb HEADER stb_image_write.h APT libstb-dev
    REPOSITORY https://github.com/nothings/stb.git
    COMMIT 31c1ad37456438565541f4919958214b6e762fb4
    INCLUDE .)
ljus_package(doctest HEADER doctest/doctest.h PACKAGE doctest TARGET doctest::doctest
    APT doctest-dev
    REPOSITORY https://github.com/doctest/doctest.git
    COMMIT 1da23a3e8119ec5cce4f9388e91b065e20bf06f5 # 2.4.12
    INCLUDE .)
ljus_package(cli11 HEADER CLI/CLI.hpp PACKAGE CLI11 TARGET CLI11::CLI11
    APT libcli11-dev
    REPOSITORY https://github.com/CLIUtils/CLI11.git
    COMMIT 37bb6edc5317e99af72ef48405e65d9ca5218861 # 2.6.2
    INCLUDE include)
ljus_package(nlohmann_json HEADER nlohmann/json.hpp PACKAGE nlohmann_json
    TARGET nlohmann_json::nlohmann_json APT nlohmann-json3-dev
    REPOSITORY https://github.com/nlohmann/json.git
    COMMIT 9cca280a4d0ccf0c08f47a99aa71d1b0e52f8d03 # 3.11.3
    INCLUDE include)
ljus_package(benchmark HEADER benchmark/benchmark.h PACKAGE benchmark
    TARGET benchmark::benchmark APT libbenchmark-dev
    REPOSITORY https://github.com/google/benchmark.git
    COMMIT 192ef10025eb2c4cdd392bc502f0c852196baa48 # 1.9.5
    INCLUDE BUILD) # not only headers: it is compiled as a CMake project of its own
ljus_package(openexr PACKAGE OpenEXR TARGET OpenEXR::OpenEXRCore APT libopenexr-dev
    INCLUDE BUILD) # a library with libraries of its own: it is not fetched

# ljus_dependency(<name> [REQUIRED])
#
# Makes the target ljus_<name> and sets LJUS_HAS_<NAME>. If a REQUIRED package is neither
# installed nor fetched, CMake stops with one sentence that says what to do.
function(ljus_dependency name)
    string(TOUPPER "${name}" upper)
    set(LJUS_HAS_${upper} TRUE PARENT_SCOPE)
    if(TARGET ljus_${name})
        return()
    endif()
    set(about ljus_package_${name})
    set(LJUS_${upper}_REPOSITORY "${${about}_REPOSITORY}" CACHE STRING
        "Where ${name} is fetched from")
    set(LJUS_${upper}_COMMIT "${${about}_COMMIT}" CACHE STRING
        "Which commit of ${name} is fetched")
    mark_as_advanced(LJUS_${upper}_REPOSITORY LJUS_${upper}_COMMIT)

    add_library(ljus_${name} INTERFACE)
    if(NOT LJUS_FETCH STREQUAL "ALWAYS" OR NOT ${about}_REPOSITORY)
        ljus_find_installed(${name} found)
        if(found)
            message(STATUS "Ljus: ${name} found: ${found}")
            return()
        endif()
    endif()
    if(LJUS_FETCH AND ${about}_REPOSITORY)
        message(STATUS "Ljus: ${name} is fetched from ${LJUS_${upper}_REPOSITORY} "
                       "(faster: sudo apt-get install ${${about}_APT})")
        ljus_fetch(${name} "${LJUS_${upper}_REPOSITORY}" "${LJUS_${upper}_COMMIT}")
        return()
    endif()
    set(LJUS_HAS_${upper} FALSE PARENT_SCOPE)
    if("REQUIRED" IN_LIST ARGN)
        message(FATAL_ERROR "Ljus: ${name} is not installed; install it "
            "(sudo apt-get install ${${about}_APT}) or allow fetching "
            "(-DLJUS_FETCH=ON).")
    endif()
    message(STATUS "Ljus: ${name} is not installed (sudo apt-get install "
                   "${${about}_APT}); going on without it")
endfunction()

# Sets `result` to the location of the installed package, or to FALSE, and adds the package to
# the target ljus_<name>.
function(ljus_find_installed name result)
    set(about ljus_package_${name})
    string(TOUPPER "${name}" upper)
    set(target "${${about}_TARGET}")
    if(target AND NOT TARGET "${target}")
        find_package("${${about}_PACKAGE}" CONFIG QUIET)
        if(TARGET "${target}")
            # Projects that use Ljus by add_subdirectory must see the target as well.
            get_target_property(imported "${target}" IMPORTED)
            if(imported)
                set_target_properties("${target}" PROPERTIES IMPORTED_GLOBAL TRUE)
            endif()
        endif()
    endif()
    if(target AND TARGET "${target}")
        target_link_libraries(ljus_${name} INTERFACE "${target}")
        set(${result} "${target} ${${${about}_PACKAGE}_VERSION}" PARENT_SCOPE)
        return()
    endif()
    find_path(LJUS_${upper}_INCLUDE_DIR
        NAMES "${name}/${${about}_HEADER}" "${${about}_HEADER}")
    mark_as_advanced(LJUS_${upper}_INCLUDE_DIR)
    if(LJUS_${upper}_INCLUDE_DIR AND NOT "${${about}_INCLUDE}" STREQUAL "BUILD")
        target_include_directories(ljus_${name} SYSTEM INTERFACE
            "${LJUS_${upper}_INCLUDE_DIR}")
        set(${result} "${LJUS_${upper}_INCLUDE_DIR}" PARENT_SCOPE)
        return()
    endif()
    set(${result} FALSE PARENT_SCOPE)
endfunction()

# Fetches a package. Only its headers are used: its CMake project is not run, except for a
# package that must be compiled.
function(ljus_fetch name repository commit)
    set(include "${ljus_package_${name}_INCLUDE}")
    string(REPLACE "_" "-" content "ljus-${name}")
    if(include STREQUAL "BUILD")
        set(BENCHMARK_ENABLE_TESTING OFF CACHE BOOL "" FORCE)
        set(BENCHMARK_ENABLE_INSTALL OFF CACHE BOOL "" FORCE)
        FetchContent_Declare(${content}
            GIT_REPOSITORY "${repository}" GIT_TAG "${commit}")
        FetchContent_MakeAvailable(${content})
        target_link_libraries(ljus_${name} INTERFACE "${ljus_package_${name}_TARGET}")
        return()
    endif()
    FetchContent_Declare(${content}
        GIT_REPOSITORY "${repository}" GIT_TAG "${commit}"
        SOURCE_SUBDIR ljus-takes-the-headers-only)
    FetchContent_MakeAvailable(${content})
    FetchContent_GetProperties(${content} SOURCE_DIR folder)
    if(NOT EXISTS "${folder}/${include}/${ljus_package_${name}_HEADER}")
        message(FATAL_ERROR "Ljus: ${repository} at ${commit} has no "
            "${include}/${ljus_package_${name}_HEADER}.")
    endif()
    target_include_directories(ljus_${name} SYSTEM INTERFACE "${folder}/${include}")
endfunction()

# Looks for OpenMP as LJUS_OPENMP demands, and sets LJUS_HAS_OPENMP.
macro(ljus_openmp)
    set(LJUS_HAS_OPENMP FALSE)
    if(LJUS_OPENMP STREQUAL "AUTO" OR LJUS_OPENMP)
        if(NOT TARGET OpenMP::OpenMP_CXX)
            find_package(OpenMP QUIET COMPONENTS CXX)
            if(TARGET OpenMP::OpenMP_CXX)
                set_target_properties(OpenMP::OpenMP_CXX PROPERTIES IMPORTED_GLOBAL TRUE)
            endif()
        endif()
        if(TARGET OpenMP::OpenMP_CXX)
            set(LJUS_HAS_OPENMP TRUE)
            message(STATUS "Ljus: OpenMP found: ${OpenMP_CXX_FLAGS}")
        elseif(LJUS_OPENMP STREQUAL "AUTO")
            message(STATUS "Ljus: OpenMP not found; one thread is used")
        else()
            message(FATAL_ERROR "Ljus: this compiler has no OpenMP; install it "
                "(for clang: sudo apt-get install libomp-dev) or pass -DLJUS_OPENMP=OFF.")
        endif()
    endif()
endmacro()
