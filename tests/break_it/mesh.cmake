# Each ray would ask its triangles, and all hits would be the first one's.
ljus_break_it(NAME mesh-part HEADER accel/mesh.hpp TEST mesh
    FROM "nearest.at.part = nearest.number;"
    TO   ""
    CASES "mesh: hits are those*")

# The corners the other way round: inside is outside.
ljus_break_it(NAME mesh-winding HEADER accel/mesh_data.hpp TEST mesh
    FROM "return {data.positions[corner[0]], data.positions[corner[1]],"
    TO   "return {data.positions[corner[1]], data.positions[corner[0]],"
    CASES "mesh: finer triangles*")

# The second and the third corner change places in the normal only.
ljus_break_it(NAME mesh-normal-corners HEADER accel/mesh.hpp TEST mesh
    FROM "hit.u * normals[corner[1]] + hit.v * normals[corner[2]]"
    TO   "hit.v * normals[corner[1]] + hit.u * normals[corner[2]]"
    CASES "mesh: finer triangles*")

# A normal against the winding is a frame that looks into the surface.
ljus_break_it(NAME mesh-normal-side HEADER accel/mesh.hpp TEST mesh
    FROM "if (!(glm::dot(n, geometric) > T(0))) return geometric;"
    TO   ""
    CASES "mesh: triangles without*")

# Each triangle as often as any other, whatever its size.
ljus_break_it(NAME mesh-area HEADER accel/mesh.hpp TEST mesh
    FROM "sums.push_back(area)"
    TO   "sums.push_back(double(i + 1))"
    CASES "mesh: points are uniform*")

# What the choice of the triangle left of u is not stretched again.
ljus_break_it(NAME mesh-left-of-u HEADER accel/mesh.hpp TEST mesh
    FROM "Vec2T<T>{left, u.y}"
    TO   "Vec2T<T>{u.x, u.y}"
    CASES "mesh: points are uniform*")

# Every triangle of a corner has the same say, however it was cut.
ljus_break_it(NAME mesh-angle HEADER accel/mesh_data.hpp TEST mesh
    FROM "angle * normal"
    TO   "normal"
    CASES "mesh: smooth_normals() finds*")

# A shadow ray asks the first triangle of the tree, whichever it may hit.
ljus_break_it(NAME mesh-meets HEADER accel/mesh.hpp TEST mesh
    FROM "mesh.triangle_at(slot), prepared).has_value()"
    TO   "mesh.triangle_at(0 * slot), prepared).has_value()"
    CASES "mesh: hits are those*")

# The texture coordinates of the second and the third corner change places.
ljus_break_it(NAME mesh-uv-corners HEADER accel/mesh.hpp TEST mesh
    FROM "hit.u * uv[corner[1]] +"
    TO   "hit.u * uv[corner[2]] +"
    CASES "mesh: texture coordinates*")

# Each corner by the sine of its angle: of blunt ones the smaller angle.
ljus_break_it(NAME mesh-blunt-angle HEADER accel/mesh_data.hpp TEST mesh
    FROM "std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b))"
    TO   "std::asin(glm::length(glm::cross(a, b)) / (glm::length(a) * glm::length(b)))"
    CASES "mesh: smooth_normals() finds*")

# Below 0 the sphere is made smaller by its rounding.
ljus_break_it(NAME mesh-sphere HEADER accel/mesh.hpp TEST mesh
    FROM "max_component(glm::abs(sphere_.center))"
    TO   "max_component(sphere_.center)"
    CASES "mesh: finer triangles*")
