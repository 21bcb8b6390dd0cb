# The index swapped: light bends away from the normal where it should bend to it.
ljus_break_it(NAME refraction-index-swapped HEADER optics/refraction.hpp TEST refraction
    FROM "const Vec3T<T> wi{-eta * wo.x, -eta * wo.y, -cos_2};"
    TO   "const Vec3T<T> wi{-wo.x / eta, -wo.y / eta, -cos_2};"
    CASES "refraction: a path*")

# Total reflection ignored: the root of 0 instead.
ljus_break_it(NAME refraction-total-ignored HEADER optics/refraction.hpp TEST refraction
    FROM [[    if (!(square >= T(0))) return std::nullopt; // NaN is a miss

    const T cos_2 = std::copysign(std::sqrt(square), cos_1);]]
    TO   [[    const T cos_2 = std::copysign(std::sqrt(square > T(0) ? square : T(0)), cos_1);]]
    CASES "refraction: total reflection*")

# NaN is not a miss.
ljus_break_it(NAME refraction-nan HEADER optics/refraction.hpp TEST refraction
    FROM "if (!(square >= T(0))) return std::nullopt; // NaN is a miss"
    TO   "if (square < T(0)) return std::nullopt;"
    CASES "refraction: NaN*")

# The cosine stays what it was: only the part along the surface becomes shorter.
ljus_break_it(NAME refraction-cosine HEADER optics/refraction.hpp TEST refraction
    FROM "cos_1 * cos_1 + (T(1) - eta) * (T(1) + eta) * glm::dot(along, along)"
    TO   "cos_1 * cos_1"
    CASES "refraction: the known bend*")

# The part along the surface without a cross product: it is lost near the normal.
ljus_break_it(NAME refraction-cancellation HEADER optics/refraction.hpp
    TEST refraction_exact
    FROM "cross(normal, cross(direction, normal)); // P"
    TO   "direction - glm::dot(direction, normal) * normal;"
    CASES "refraction_exact: unit length*")
