# The blob's field ends at R; without that, blobs attract each other from any distance.
ljus_break_it(NAME metaballs-support HEADER geometry/metaballs.hpp TEST metaballs
    FROM "if (s > C(0)) sum += C(blob.weight) * s * s;"
    TO   "sum += C(blob.weight) * s * s;"
    CASES "metaballs: the field of one*")

ljus_break_it(NAME metaballs-gradient HEADER geometry/metaballs.hpp TEST metaballs
    FROM "sum -= C(4) * C(blob.weight) * s * q / C(blob.radius);"
    TO   "sum -= C(2) * C(blob.weight) * s * q / C(blob.radius);"
    CASES "metaballs: the gradient agrees*")

# A bound of the slope that is too low lets steps jump over the surface.
ljus_break_it(NAME metaballs-lipschitz HEADER geometry/detail/metaball_quartic.hpp TEST metaballs
    FROM "steepest_blob = T(8) / (T(3) * std::numbers::sqrt3_v<T>);"
    TO   "steepest_blob = T(1);"
    CASES "metaballs: the gradient agrees*"
    COMPILED)

# The middle coefficient of s^2 is not the square of the middle one of s.
ljus_break_it(NAME metaballs-blossom HEADER geometry/detail/metaball_quartic.hpp TEST metaballs
    FROM "(s0 * s2 + C(2) * s1 * s1) / C(3)"
    TO   "s1 * s1"
    CASES "metaballs: one blob is a sphere*")

# From within, the hit is where the ray leaves.
ljus_break_it(NAME metaballs-inside HEADER geometry/detail/metaball_quartic.hpp TEST metaballs
    FROM "const bool inside = line.value(a) >= C(0);"
    TO   "const bool inside = false;"
    CASES "metaballs: the first hit*")

ljus_break_it(NAME metaballs-range HEADER geometry/detail/metaball_quartic.hpp TEST metaballs
    FROM "const C end = glm::min(t_max, line.leave);"
    TO   "const C end = line.leave;"
    CASES "metaballs: the first hit*")

# A seventeenth blob that forgets the sixteen before it.
ljus_break_it(NAME metaballs-heap HEADER geometry/detail/metaball_quartic.hpp TEST metaballs
    FROM "if (many.empty()) many.assign(few.begin(), few.end());"
    TO   ""
    CASES "metaballs: more than 16*")

ljus_break_it(NAME metaballs-carving HEADER geometry/metaballs.hpp TEST metaballs
    FROM "for (const BlobT<T>& blob : balls.blobs) positive += blob.weight > T(0) ? 1 : 0;"
    TO   "positive = 1;"
    CASES "metaballs: the bounding sphere*")

# The point stays where t was rounded to.
ljus_break_it(NAME metaballs-refined HEADER geometry/isosurface.hpp TEST metaballs
    FROM "x -= step * g;"
    TO   "x += step * g;"
    CASES "metaballs: a hit lies*")

ljus_break_it(NAME metaballs-normal HEADER geometry/isosurface.hpp TEST metaballs
    FROM "Vec3T<T>(-glm::normalize(g))"
    TO   "Vec3T<T>(glm::normalize(g))"
    CASES "metaballs: a hit lies*")

# A part whose slope has both signs may hold two crossings.
ljus_break_it(NAME metaballs-monotone HEADER geometry/detail/field_on_ray.hpp TEST metaballs_exact
    FROM "if (slope.low > T(0) || slope.high < T(0)) {"
    TO   "{"
    CASES "metaballs exact: interval*")

# Steps of twice the safe length.
ljus_break_it(NAME metaballs-overstep HEADER geometry/detail/field_on_ray.hpp TEST metaballs
    FROM "t += distance / steepest;"
    TO   "t += T(4) * distance / steepest;"
    CASES "metaballs: *")

# What cannot be sampled must not become a light.
ljus_break_it(NAME metaballs-light HEADER scene/scene.hpp TEST metaballs
    FROM "require(false, \"the radiance"
    TO   "require(true, \"the radiance"
    CASES "metaballs: no light*")

# What carves adds to what the field may have been rounded by, and takes nothing away.
ljus_break_it(NAME metaballs-carving-error HEADER geometry/metaballs.hpp TEST metaballs
    FROM "size += std::abs(WideT<T>(blob.weight));"
    TO   "size += WideT<T>(blob.weight);"
    CASES "metaballs: what a carving blob*")

# A ray that starts on the surface finds it behind itself.
ljus_break_it(NAME metaballs-on-surface HEADER geometry/detail/metaball_quartic.hpp
    TEST metaballs
    FROM "if (p.c[0] == C(0)) p.c[0] = std::numeric_limits<C>::min();"
    TO   ""
    CASES "metaballs: a start on the surface*")

# What the solver leaves of f is no part of a hit's error: in double it meets itself.
ljus_break_it(NAME isosurface-solver HEADER geometry/isosurface.hpp TEST metaballs
    FROM "std::min(rounding / glm::length(g), std::sqrt(rounding))"
    TO   "0.0"
    CASES "isosurface: what it refuses*")

# The normal of the point where t led to, not of the one on the surface.
ljus_break_it(NAME isosurface-normal-there HEADER geometry/isosurface.hpp TEST metaballs
    FROM "if (const Wide there = gradient(x); glm::dot(there, there) > 0) g = there;"
    TO   ""
    CASES "metaballs: the normal is that of the point*")

# A surface exactly where a span ends is passed by.
ljus_break_it(NAME metaballs-border-of-span HEADER geometry/detail/metaball_quartic.hpp
    TEST metaballs
    FROM "if ((p.c[0] >= C(0)) != inside) return a;"
    TO   ""
    CASES "metaballs: a surface on the border*")

# On the heap the first sixteen blobs are all the first one.
ljus_break_it(NAME metaballs-heap-order HEADER geometry/detail/metaball_quartic.hpp TEST metaballs
    FROM "many.assign(few.begin(), few.end())"
    TO   "many.assign(few.size(), few.front())"
    CASES "metaballs: more than 16*")

# What carves counts as if it filled.
ljus_break_it(NAME metaballs-sum HEADER geometry/metaballs.hpp TEST metaballs
    FROM "if (blob.weight > T(0)) most += blob.weight;"
    TO   "most += std::abs(blob.weight);"
    CASES "metaballs: refused are*")

# A surface that is touched, where nothing bounds the slope.
ljus_break_it(NAME isosurface-touched HEADER geometry/detail/field_on_ray.hpp TEST metaballs
    FROM "if (side * line.value(b) <= T(0)) return b;
            continue;"
    TO   "continue;"
    CASES "solvers: without bounds*")

# A hit beyond the largest number is one at infinity.
ljus_break_it(NAME isosurface-beyond HEADER geometry/isosurface.hpp TEST metaballs
    FROM "if (!t || !(*t <= std::numeric_limits<T>::max())) return std::nullopt;"
    TO   "if (!t) return std::nullopt;"
    CASES "isosurface: what it refuses*")
