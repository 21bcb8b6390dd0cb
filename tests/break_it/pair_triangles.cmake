# A triangle that has its partner gets another one.
ljus_break_it(NAME pair-triangles-twice HEADER geometry/detail/pair_triangles.hpp
    TEST pair_triangles
    FROM "if (found == waiting.end() || paired[found->second.first]) continue;"
    TO   "if (found == waiting.end()) continue;"
    CASES "pair_triangles: one that has its partner is not*")

# 0 and -0 are two places.
ljus_break_it(NAME equal-points-zero HEADER geometry/detail/equal_points.hpp
    TEST pair_triangles
    FROM "point[axis] + T(0)"
    TO   "point[axis]"
    CASES "pair_triangles: equal points*")
