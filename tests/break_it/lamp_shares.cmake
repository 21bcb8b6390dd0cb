# What nobody sees counts as much as what is seen.
ljus_break_it(NAME lamp_shares-weight HEADER photons/budget.hpp TEST lamp_shares
    FROM "const double flux = weight(photon) * luminance("
    TO   "const double flux = (0 * weight(photon) + 1) * luminance("
    CASES "lamp shares: fifty*")

# A lamp that the pilot misses gets nothing.
ljus_break_it(NAME lamp_shares-floor HEADER photons/budget.hpp TEST lamp_shares
    FROM "0.1 * probability_of<double>(world.light_choice(), k) +"
    TO   "0 * probability_of<double>(world.light_choice(), k) +"
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

# The pilot is sent, whether or not it costs more than it saves.
ljus_break_it(NAME lamp_shares-affords HEADER photons/budget.hpp TEST lamp_shares
    FROM "return 800 * static_cast<long long>(lights) <= photons;"
    TO   "return 0 * photons + static_cast<long long>(lights) >= 0;"
    CASES "lamp shares: what is given*")
