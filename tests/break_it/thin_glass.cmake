# One boundary for two.
ljus_break_it(NAME thin-glass-one-boundary HEADER materials/glass.hpp TEST thin_glass
    FROM "(T(1) - r) * (T(1) - r) * a /"
    TO   "(T(1) - r) * a /"
    CASES "thin glass: the sum*,thin glass: what textbooks*")

# Nothing goes back and forth within the pane.
ljus_break_it(NAME thin-glass-once HEADER materials/glass.hpp TEST thin_glass
    FROM "shares.reflected[c] = r * (T(1) + a * shares.transmitted[c]);"
    TO   "shares.reflected[c] = r;"
    CASES "thin glass: what textbooks*")

# A tint that does not know how long the way is.
ljus_break_it(NAME thin-glass-tint HEADER materials/glass.hpp TEST thin_glass
    FROM "std::pow(tint, T(1) / cosine)"
    TO   "tint"
    CASES "thin glass: the sum*,thin glass: what textbooks*")

# What comes back in place of what goes on.
ljus_break_it(NAME thin-glass-pass_through HEADER materials/glass.hpp TEST thin_glass
    FROM "return detail::pane_fractions(pane, std::min(std::abs(wo.z), T(1))).transmitted;"
    TO   "return detail::pane_fractions(pane, std::min(std::abs(wo.z), T(1))).reflected;"
    CASES "thin glass: samples*,thin glass: a lamp*")

# The texture of a pane asked at no place.
ljus_break_it(NAME thin-glass-textured HEADER materials/textured.hpp TEST thin_glass
    FROM "return pass_through(at_point(textured, position, Vec2T<T>{T(0)}), position, wo);"
    TO   "return pass_through(textured.base, position, wo);"
    CASES "thin glass: a lamp*")
