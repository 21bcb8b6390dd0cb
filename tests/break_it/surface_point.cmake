# A fixed distance is too long for a small scene.
ljus_break_it(NAME surface-fixed HEADER geometry/surface_point.hpp TEST surface_point
    FROM "T(2) * glm::dot(sizes(point.normal), point.error) + T(4) * last_place"
    TO   "T(1e-3)"
    CASES "surface: at a millionth*")

# The bound of the error alone is 0 on a wall along an axis.
ljus_break_it(NAME surface-last-place HEADER geometry/surface_point.hpp TEST surface_point
    FROM " + T(4) * last_place"
    TO   ""
    CASES "surface: coordinates of 0*")

# A wall through the origin has no last place of its own.
ljus_break_it(NAME surface-scale HEADER geometry/surface_point.hpp TEST surface_point
    FROM "T(4) * last_place"
    TO   "T(4) * std::numeric_limits<T>::epsilon() * max_component(glm::abs(point.position))"
    CASES "surface: coordinates of 0*")

# Always to the outer side, whichever way the ray goes.
ljus_break_it(NAME surface-side HEADER geometry/surface_point.hpp TEST surface_point
    FROM "std::copysign(distance, glm::dot(direction, n))"
    TO   "distance"
    CASES "surface: a ray leaves*")

# A lamp near the origin shades itself from afar.
ljus_break_it(NAME surface-own-light HEADER geometry/surface_point.hpp TEST surface_point
    FROM "seen.error += detail::rounding_bound<T>(8) * max_component(detail::sizes(way));"
    TO   ""
    CASES "surface: no lamp*")

# A shadow ray that starts where the hit was rounded to: its own surface hides the light.
ljus_break_it(NAME surface-shadow-stay HEADER geometry/surface_point.hpp TEST surface_point
    FROM "const Vec3T<T> origin = offset_ray_origin(from, way);"
    TO   "const Vec3T<T> origin = from.position;"
    CASES "surface: no lamp*,surface: a ray between*")

# In double, half of the rays that leave a sliver meet it again.
ljus_break_it(NAME surface-tilt HEADER geometry/surface_point.hpp TEST surface_point
    FROM "point.error += rounding_bound<T>(9) * (size_of(e1) + size_of(e2)) * tilt;"
    TO   ""
    CASES "surface: slivers*")

# A lamp that is a sliver shades itself.
ljus_break_it(NAME surface-tilt-own-light HEADER geometry/surface_point.hpp TEST surface_point
    FROM "seen.error += detail::rounding_bound<T>(18) * detail::size_of(way) * to.tilt;"
    TO   "(void)to;"
    CASES "surface: slivers*")

# Only along the normal of a square, and none of a sliver.
ljus_break_it(NAME surface-tilt-area HEADER geometry/surface_point.hpp TEST surface_point
    FROM "size_of(e1) * size_of(e2) / std::sqrt(glm::dot(up, up))"
    TO   "T(1)"
    CASES "surface: slivers*")

# An infinite tilt of parallel edges.
ljus_break_it(NAME surface-tilt-parallel HEADER geometry/surface_point.hpp
    TEST surface_point
    FROM "if (!std::isfinite(tilt)) return;"
    TO   ""
    CASES "surface: how badly*")

# At coordinates of 0 the error in the wall's plane is the only scale there is.
ljus_break_it(NAME surface-scale-of-error HEADER geometry/surface_point.hpp TEST surface_point
    FROM "max_component(sizes(point.position) + point.error)"
    TO   "max_component(sizes(point.position))"
    CASES "surface: the last place*")
