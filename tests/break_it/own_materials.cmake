# Alpha is not multiplied by that of the factor.
ljus_break_it(NAME own_materials-alpha HEADER io/detail/gltf_reader.hpp
    TEST own_materials
    FROM "\"alphaCutoff\", 0.5, 0, 1e6) / alpha;"
    TO   "\"alphaCutoff\", 0.5, 0, 1e6);"
    CASES "own materials: a glTF*")

# A picture that is turned the other way round.
ljus_break_it(NAME own_materials-turn HEADER io/detail/gltf_reader.hpp
    TEST own_materials
    FROM "turn(std::cos(angle), std::sin(angle));"
    TO   "turn(std::cos(angle), -std::sin(angle));"
    CASES "own materials: a glTF*")

# Normals that are decoded like colours.
ljus_break_it(NAME own_materials-numbers HEADER io/load_image.hpp TEST own_materials
    FROM "colors ? picture.colors.linear[k][byte] : byte / 255.0"
    TO   "picture.colors.linear[k][byte]"
    CASES "own materials: pictures of MTL*")

# A picture without alpha is a mask by its red, which nobody reads.
ljus_break_it(NAME own_materials-red HEADER io/load_image.hpp TEST own_materials
    FROM "content == PictureContent::mask && !picture.has_alpha;"
    TO   "false;"
    CASES "own materials: pictures of MTL*")

# The factor of a group of lamps does not reach what glows in a file.
ljus_break_it(NAME own_materials-group HEADER io/detail/json_objects.hpp
    TEST own_materials
    FROM "radiance + static_cast<T>(factor) * surface->emission);"
    TO   "radiance + surface->emission);"
    CASES "own materials: three*")

# The first surface of a file for all of its parts.
ljus_break_it(NAME own_materials-parts HEADER io/detail/json_objects.hpp
    TEST own_materials
    FROM "surfaces.empty() ? nullptr : &surfaces[i];"
    TO   "surfaces.empty() ? nullptr : &surfaces[0 * i];"
    CASES "own materials: three*")

# A metal with a picture and without holes is matt.
ljus_break_it(NAME own_materials-painted-metal HEADER io/mesh_file.hpp
    TEST own_materials
    FROM "(details || (picture && !lists_painted))"
    TO   "details"
    CASES "own materials: a glTF file's picture*")

# A sampler that mirrors repeats.
ljus_break_it(NAME own_materials-mirror HEADER io/detail/gltf_reader.hpp TEST own_materials
    FROM "{33648, PictureWrap::mirror}"
    TO   "{33648, PictureWrap::repeat}"
    CASES "own materials: what a glTF*")

# A scene file's mirrored picture repeats.
ljus_break_it(NAME own_materials-mirror-word HEADER io/detail/json_textures.hpp
    TEST own_materials
    FROM [[wrap == "mirror" ?]]
    TO   [[wrap == "mirrors" ?]]
    CASES "own materials: pictures in scene*")

# Every normal map counts as flat, and a disc forgets its own.
ljus_break_it(NAME own_materials-flat HEADER materials/normal_map.hpp TEST own_materials
    FROM "return color.x == T(0.5) && color.y == T(0.5);"
    TO   "return color.x <= T(1) && color.y <= T(1);"
    CASES "own materials: pictures in scene*")
