# ljus_sort_headers(<required> <optional>): lists all headers below include/.
#
# A header that needs a package other than GLM and stb is optional: it is checked only if
# that package is installed, and no other header includes it.
set(LJUS_OPTIONAL_PACKAGES nlohmann/json.hpp tiny_obj_loader.h stb/stb_image.h
    OpenEXR/openexr.h)

function(ljus_sort_headers required optional)
    file(GLOB_RECURSE headers CONFIGURE_DEPENDS "${LJUS_INCLUDE_DIR}/ljus/*.hpp")
    set(with)
    set(without)
    foreach(header IN LISTS headers)
        ljus_packages_of("${header}" packages)
        if(packages)
            list(APPEND with "${header}")
        else()
            list(APPEND without "${header}")
        endif()
    endforeach()
    set(${required} "${without}" PARENT_SCOPE)
    set(${optional} "${with}" PARENT_SCOPE)
endfunction()

# The headers of other packages that this header includes.
function(ljus_packages_of header result)
    file(READ "${header}" text)
    set(packages)
    foreach(package IN LISTS LJUS_OPTIONAL_PACKAGES)
        string(FIND "${text}" "#include <${package}>" at)
        if(NOT at EQUAL -1)
            list(APPEND packages "${package}")
        endif()
    endforeach()
    set(${result} "${packages}" PARENT_SCOPE)
endfunction()
