# One boundary for two.
ljus_break_it(NAME thin-glass-one-boundary HEADER materials/thin_glass.hpp TEST thin_glass
    FROM "(T(1) - r) * (T(1) - r) * a /"
    TO   "(T(1) - r) * a /"
    CASES "thin glass: the sum*,thin glass: what textbooks*")

# Nothing goes back and forth within the pane.
ljus_break_it(NAME thin-glass-once HEADER materials/thin_glass.hpp TEST thin_glass
    FROM "shares.reflected[c] = r * (T(1) + a * shares.transmitted[c]);"
    TO   "shares.reflected[c] = r;"
    CASES "thin glass: what textbooks*")

# A tint that does not know how long the way is.
ljus_break_it(NAME thin-glass-tint HEADER materials/thin_glass.hpp TEST thin_glass
    FROM "std::pow(pane.tint[c], T(1) / cosine)"
    TO   "pane.tint[c]"
    CASES "thin glass: the sum*,thin glass: what textbooks*")

# The probability of the choice forgotten.
ljus_break_it(NAME thin-glass-choice HEADER materials/thin_glass.hpp TEST thin_glass
    FROM "shares.transmitted * (sum / through)"
    TO   "shares.transmitted"
    CASES "thin glass: samples*")
