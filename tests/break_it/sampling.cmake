# A disc that is uniform in radius crowds the middle; so do the directions above it.
ljus_break_it(NAME sampling-radius HEADER math/sampling.hpp TEST sampling
    FROM "return {a * std::cos(phi), a * std::sin(phi)};"
    TO   "return {a * a * std::cos(phi), a * a * std::sin(phi)};"
    CASES "sampling: points of disc*,sampling: the moments*")

# The border of the disc lies on the horizon.
ljus_break_it(NAME sampling-horizon HEADER math/sampling.hpp TEST sampling
    FROM "glm::max((T(1) - r) * (T(1) + r), least)"
    TO   "(T(1) - r) * (T(1) + r)"
    CASES "sampling: at the corners*")

# The density of the cosine-weighted hemisphere without its 1/pi.
ljus_break_it(NAME sampling-missing-pi HEADER math/sampling.hpp TEST sampling
    FROM "d.z > T(0) ? d.z * std::numbers::inv_pi_v<T> : T(0)"
    TO   "d.z > T(0) ? d.z : T(0)"
    CASES "sampling: every density*")

# Inclination uniform instead of its cosine: the naive rotation, dense at the pole.
ljus_break_it(NAME sampling-naive-cone HEADER math/sampling.hpp TEST sampling
    FROM "u.x * one_minus_cos_max;"
    TO   "T(1) - std::cos(u.x * std::acos(T(1) - one_minus_cos_max));"
    CASES "sampling: the moments*,sampling: directions agree*")

# 1 - cos, by subtraction.
ljus_break_it(NAME sampling-cancellation HEADER math/sampling.hpp TEST sampling
    FROM "return sin_squared / (T(1) + std::sqrt(T(1) - sin_squared));"
    TO   "return T(1) - std::sqrt(T(1) - sin_squared);"
    CASES "sampling: a cone as narrow*")

# The fold of the square forgotten.
ljus_break_it(NAME sampling-triangle HEADER math/sampling.hpp TEST sampling
    FROM "return {half, u.y - half, T(1) - u.y};"
    TO   "return {half, u.y, T(1) - u.y - half};"
    CASES "sampling: points of disc*,sampling: at the corners*")

# The disc as rounding leaves it: half of its border lies outside.
ljus_break_it(NAME sampling-disc-border HEADER math/sampling.hpp TEST sampling
    FROM "< T(1) - two ? p : (T(1) - two) * p;"
    TO   "< T(1) - two ? p : p;"
    CASES "sampling: a point of the disc has*")

# The height from the rounded place on the disc: near the horizon no digit is right.
ljus_break_it(NAME sampling-height HEADER math/sampling.hpp TEST sampling
    FROM "glm::max((T(1) - r) * (T(1) + r), least)"
    TO   "glm::max(T(1) - p.x * p.x - p.y * p.y, least)"
    CASES "sampling: near the horizon*")
