# What nobody sees counts as much as what is seen.
ljus_break_it(NAME lamp_shares-weight HEADER photons/budget.hpp TEST lamp_shares
    FROM "const double flux = weight(photon) * luminance("
    TO   "const double flux = (0 * weight(photon) + 1) * luminance("
    CASES "lamp shares: fifty*")

# A lamp that the pilot misses gets nothing.
ljus_break_it(NAME lamp_shares-floor HEADER photons/budget.hpp TEST lamp_shares
    FROM "std::min(0.9, photons / (photons + 200.0 / 9))"
    TO   "std::min(1.0, photons / (photons + 200.0 / 9) + 0.1)"
    CASES "lamp shares: fifty*")

# Camera paths end at the mirror.
ljus_break_it(NAME lamp_shares-mirror HEADER render/lamp_shares.hpp TEST lamp_shares
    FROM "if (has(lobes(m), Lobes::non_specular)) {"
    TO   "if (has(lobes(m), Lobes::all)) {"
    CASES "lamp shares: what a mirror*")

# Only what the camera sees itself is asked, not what lights it.
ljus_break_it(NAME lamp_shares-next HEADER render/lamp_shares.hpp TEST lamp_shares
    FROM "if (++matt == 2) return false;"
    TO   "if (++matt == 1) return false;"
    CASES "lamp shares: what a mirror*")

# A pilot of very few photons counts as much as any other.
ljus_break_it(NAME lamp_shares-certain HEADER photons/budget.hpp TEST lamp_shares
    FROM "std::min(0.9, photons / (photons + 200.0 / 9))"
    TO   "std::min(0.9, photons)"
    CASES "lamp shares: a pilot of few*")

# A pilot costs more photons than the picture has.
ljus_break_it(NAME lamp_shares-price HEADER photons/budget.hpp TEST lamp_shares
    FROM "std::min(200 * lights, pass.photons / 4)"
    TO   "200 * lights"
    CASES "lamp shares: a pilot of few*")
