# Bumps for dents where the coordinates are mirrored.
ljus_break_it(NAME normal_map-mirrored HEADER path/next_vertex.hpp TEST normal_map
    FROM "WideT<T>(mirrored ? -local.y : local.y)"
    TO   "(void(mirrored), WideT<T>(local.y))"
    CASES "normal map: red goes*")

# The tangent of a smooth mesh is not at right angles to its normal.
ljus_break_it(NAME normal_map-slanted HEADER path/next_vertex.hpp TEST normal_map
    FROM "const Wide u = along - glm::dot(along, up) * up;"
    TO   "const Wide u = along;"
    CASES "normal map: what faces*")

# A normal that points below the surface.
ljus_break_it(NAME normal_map-below HEADER path/next_vertex.hpp TEST normal_map
    FROM "return glm::dot(mapped, geometric) > T(0) ? mapped : geometric;"
    TO   "return mapped;"
    CASES "normal map: what faces*")

# A flat surface that is inside out has its dents on the wrong side.
ljus_break_it(NAME normal_map-inside-out HEADER path/next_vertex.hpp TEST normal_map
    FROM "if (is_plane<G> && vertex.object.inside_out)"
    TO   "if (false)"
    CASES "normal map: red goes*")

# The colour itself is the normal.
ljus_break_it(NAME normal_map-decode HEADER materials/normal_map.hpp TEST normal_map
    FROM "T(2) * color_at(picture, Vec3T<T>{T(0)}, uv) - T(1);"
    TO   "color_at(picture, Vec3T<T>{T(0)}, uv);"
    CASES "normal map: a tilted*")

# A turned picture whose normals are not turned back.
ljus_break_it(NAME normal_map-turned HEADER image/texture.hpp TEST normal_map
    FROM "(map.turn.x * along.x + map.turn.y * along.y)"
    TO   "(map.turn.x * along.x - map.turn.y * along.y)"
    CASES "normal map: red goes*")

# The derivatives by u and v exchanged.
ljus_break_it(NAME normal_map-tangents HEADER accel/mesh.hpp TEST normal_map
    FROM "return {Vec3T<T>((b.y * e1 - a.y * e2) / area),"
    TO   "return {Vec3T<T>((a.y * e1 - b.y * e2) / area),"
    CASES "normal map: a mesh*")

# A ball is taken, and its normal map forgotten.
ljus_break_it(NAME normal_map-refused HEADER scene/world.hpp TEST normal_map
    FROM "if constexpr (!HasTangents<G>)"
    TO   "if constexpr (false && !HasTangents<G>)"
    CASES "normal map: textures over*")
