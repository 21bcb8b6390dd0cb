# Without u + v <= 1 the triangle is a strip without an end.
ljus_break_it(NAME triangle-u-plus-v HEADER geometry/surface_point.hpp TEST triangle
    FROM " && u + v <= C(1) + border"
    TO   ""
    CASES "triangle: each of the three edges*")

# u + v <= 1 holds where v is negative.
ljus_break_it(NAME triangle-v HEADER geometry/surface_point.hpp TEST triangle
    FROM "v >= -border && u + v"
    TO   "u + v"
    CASES "triangle: each of the three edges*")

# The conditions that the report forgets: what lies beside the triangle is hit.
ljus_break_it(NAME triangle-conditions HEADER geometry/surface_point.hpp TEST triangle
    FROM "if (!(within(near) && inverse != C(0)))"
    TO   "if (!(inverse != C(0)))"
    CASES "triangle: each of the three edges*")

# The usual guard against parallel rays: an epsilon with a unit loses every small mesh.
ljus_break_it(NAME triangle-epsilon HEADER geometry/surface_point.hpp TEST triangle
    FROM "inverse != C(0)"
    TO   "glm::abs(inverse) < C(1e6)"
    CASES "triangle: a mesh of any size*")

# A determinant that overflows makes all quotients 0.
ljus_break_it(NAME triangle-overflow HEADER geometry/surface_point.hpp TEST triangle
    FROM " && inverse != C(0)"
    TO   ""
    CASES "triangle: sizes beyond*")

# t_max is infinite by default, and so may be t.
ljus_break_it(NAME triangle-infinity HEADER geometry/surface_point.hpp TEST triangle
    FROM " && t <= max"
    TO   ""
    CASES "triangle: sizes beyond*")

# The cube of a size leaves the range of float.
ljus_break_it(NAME triangle-cube HEADER geometry/surface_point.hpp TEST triangle
    FROM "glm::dot(inverse * q, e2)"
    TO   "glm::dot(q, e2) * inverse"
    CASES "triangle: a mesh of any size*")

# In float the normal of a small or a thin triangle is off.
ljus_break_it(NAME triangle-normal HEADER geometry/triangle.hpp TEST triangle
    FROM "Vec3T<T>(glm::normalize(detail::cross_of_edges(triangle)))"
    TO   "glm::normalize(glm::cross(triangle.v2 - triangle.v1, triangle.v3 - triangle.v1))"
    CASES "triangle: the normal is that*")

# In double, without a border as wide as the rounding: ties are lost.
ljus_break_it(NAME triangle-open HEADER geometry/surface_point.hpp TEST watertight
    FROM "!within(detail::border_of_rounding(d, to, e1, e2, inverse, near))"
    TO   "true"
    CASES "watertight: rays at edges*")

ljus_break_it(NAME triangle-no-area HEADER geometry/triangle.hpp TEST triangle
    FROM "if (hit && !has_area(triangle)) hit.reset();"
    TO   ""
    CASES "triangle: rays aimed at where*")

ljus_break_it(NAME triangle-default HEADER geometry/triangle.hpp TEST tree_leaks
    FROM "using C = ComputeT<Compute, WideT<T>>;"
    TO   "using C = ComputeT<Compute, T>;"
    CASES "tree leaks: half a million*")

# In the plane of a sliver rounding moves u and v by any amount: the border must end.
ljus_break_it(NAME triangle-sliver HEADER geometry/surface_point.hpp TEST triangle
    FROM "return border <= most ? border : C(0);"
    TO   "return border <= most ? border : most;"
    CASES "triangle: the border*")

# A border that is narrower than the rounding: the two triangles at an edge miss.
ljus_break_it(NAME triangle-narrow-border HEADER geometry/surface_point.hpp TEST triangle
    FROM "rounding_bound<C>(16)"
    TO   "C(0)"
    CASES "triangle: the border*")

# Doubles in a line span what rounding leaves of 0.
ljus_break_it(NAME triangle-no-area-rounded HEADER geometry/surface_point.hpp
    TEST triangle
    FROM "bound * (std::abs(p) + std::abs(q))"
    TO   "0 * bound"
    CASES "triangle: no area in data*")

# A coordinate just below 0, where an image begins again from its other end.
ljus_break_it(NAME triangle-below-0 HEADER geometry/surface_point.hpp TEST triangle
    FROM "static_cast<T>(glm::max(u, C(0)))"
    TO   "static_cast<T>(u)"
    CASES "triangle: a hit in the border*")

# Open on the third side alone.
ljus_break_it(NAME triangle-open-side HEADER geometry/surface_point.hpp TEST triangle
    FROM "u + v <= C(1) + border"
    TO   "u + v <= C(1)"
    CASES "triangle: a hit in the border*")

# Open at the far end of the first edge.
ljus_break_it(NAME triangle-open-end HEADER geometry/surface_point.hpp TEST triangle
    FROM "u <= C(1) + near)"
    TO   "u <= C(1))"
    CASES "triangle: a hit in the border*")

# Near its first corner a point of a triangle seems to be known better than it is.
ljus_break_it(NAME triangle-first-corner HEADER geometry/triangle.hpp TEST triangle
    FROM "(detail::sizes(a) + detail::sizes(b) + detail::sizes(c))"
    TO   "(detail::sizes(b) + detail::sizes(c))"
    CASES "triangle: near each*")
