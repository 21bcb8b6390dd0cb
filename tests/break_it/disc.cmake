# A disc without its border is the whole plane.
ljus_break_it(NAME disc-border HEADER geometry/disc.hpp TEST disc
    FROM "if (!(glm::dot(p, p) <= r * r)) return std::nullopt;"
    TO   "if (!(max_component(glm::abs(p)) <= r)) return std::nullopt;"
    CASES "disc: the unit disc*")

# Samples crowd in the middle.
ljus_break_it(NAME disc-samples HEADER geometry/disc.hpp TEST disc
    FROM "const Vec2T<T> p = sample_concentric_disc(u);"
    TO   "const Vec2T<T> p = u.x * Vec2T<T>{std::cos(T(6.2831853) * u.y), std::sin(T(6.2831853) * u.y)};"
    CASES "disc: samples are spread*")
