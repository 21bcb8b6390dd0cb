# 1 - cos by subtraction: a far lamp has no solid angle left.
ljus_break_it(NAME solid-angle-cancels HEADER math/sampling.hpp TEST solid_angle
    FROM "sin_squared / (T(1) + std::sqrt(T(1) - sin_squared))"
    TO   "T(1) - std::sqrt(T(1) - sin_squared)"
    CASES "solid angle: the cone of a sphere*")

# The cosine at the lamp, which the report's program forgot.
ljus_break_it(NAME solid-angle-cosine HEADER geometry/solid_angle.hpp TEST solid_angle
    FROM "distance2 / (cosine * area)"
    TO   "distance2 / area"
    CASES "solid angle: triangles and quads*")

# And the inverse square.
ljus_break_it(NAME solid-angle-distance HEADER geometry/solid_angle.hpp TEST solid_angle
    FROM "distance2 / (cosine * area)"
    TO   "T(1) / (cosine * area)"
    CASES "solid angle: triangles and quads*")

# A point on the wall of a room is rounded to its outside half of the time.
ljus_break_it(NAME solid-angle-doubt HEADER geometry/sphere.hpp TEST solid_angle
    FROM "sphere.radius + doubt;"
    TO   "sphere.radius;"
    CASES "solid angle: on the wall*")

# A way of length 0 has no cosine.
ljus_break_it(NAME solid-angle-no-way HEADER geometry/solid_angle.hpp TEST solid_angle
    FROM "if (!(distance2 > T(0))) return T(0);"
    TO   ""
    CASES "solid angle: an observer at the very*")

# The area of the lamp: a small one is as bright as a large one.
ljus_break_it(NAME solid-angle-area HEADER geometry/solid_angle.hpp TEST solid_angle
    FROM "distance2 / (cosine * area)"
    TO   "distance2 / (cosine + 0 * area)"
    CASES "solid angle: triangles and quads*")
