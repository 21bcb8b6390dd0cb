# What -march=native makes of a product that is not exact: the sides of an edge differ.
ljus_break_it(NAME watertight-contracted HEADER geometry/watertight.hpp TEST watertight
    FROM "return W(p.x) * W(q.y) - W(p.y) * W(q.x);"
    TO   "return W(std::fma(p.x, q.y, -(p.y * q.x)));"
    CASES "watertight: a mesh of any size*")

# On an edge is inside, on both sides of it.
ljus_break_it(NAME watertight-ties HEADER geometry/watertight.hpp TEST watertight
    FROM "(u >= 0 && v >= 0 && w >= 0)"
    TO   "(u > 0 && v > 0 && w > 0)"
    CASES "watertight: a tie*")

# Only triangles that turn one way.
ljus_break_it(NAME watertight-one-sided HEADER geometry/watertight.hpp TEST watertight
    FROM " || (u <= 0 && v <= 0 && w <= 0)"
    TO   ""
    CASES "watertight: it agrees*")

# An infinite direction makes every t zero.
ljus_break_it(NAME watertight-infinity HEADER geometry/watertight.hpp TEST watertight
    FROM " && shear.sz != 0"
    TO   ""
    CASES "watertight: invalid data*")

# The longest axis must become z, or the shear divides by nearly zero.
ljus_break_it(NAME watertight-axis HEADER geometry/watertight.hpp TEST watertight
    FROM "size.x > size.y ? (size.x > size.z ? 0 : 2) : size.y > size.z ? 1 : 2"
    TO   "2"
    CASES "watertight: a mesh of any size*")

# A triangle on the other side of the axis is not all that lies beside it.
ljus_break_it(NAME watertight-bounds HEADER geometry/watertight.hpp TEST watertight
    FROM "high.y < 0"
    TO   "high.y <= 0"
    CASES "watertight: a tie*")

ljus_break_it(NAME watertight-no-area HEADER geometry/watertight.hpp TEST triangle
    FROM "if (!has_area(triangle)) return std::nullopt;"
    TO   ""
    CASES "triangle: rays aimed at where*")

# The inverse of a denormal is infinite in float.
ljus_break_it(NAME watertight-short HEADER geometry/watertight.hpp TEST watertight
    FROM "1 / static_cast<double>(d[z])"
    TO   "static_cast<double>(T(1) / d[z])"
    CASES "watertight: a direction so short*")

# A hit beyond the largest number is one at infinity.
ljus_break_it(NAME watertight-beyond HEADER geometry/watertight.hpp TEST watertight
    FROM "t <= W(ray.t_max) && t <= max &&"
    TO   "t <= W(ray.t_max) &&"
    CASES "watertight: what lies farther*")

# Of two axes the longer one, whatever the third.
ljus_break_it(NAME watertight-third-axis HEADER geometry/watertight.hpp TEST watertight
    FROM "size.x > size.y ? (size.x > size.z ? 0 : 2)"
    TO   "size.x > size.y ? 0"
    CASES "watertight: the axis*")
