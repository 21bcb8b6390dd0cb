# The flux of a photon is not divided by its object's share.
ljus_break_it(NAME caustic_budget-flux HEADER photons/aiming.hpp
    TEST caustic_budget
    FROM "if (aimed) aimed->photon.flux /= static_cast<T>(shares[chosen]);"
    TO   ""
    CASES "caustic_budget: any shares*")

# A share of 0 is chosen where rounding leaves something over.
ljus_break_it(NAME caustic_budget-zero HEADER photons/aiming.hpp
    TEST caustic_budget
    FROM "if (!(shares[k] > 0)) continue;"
    TO   ""
    CASES "caustic_budget: no shares*")

# Shares by the squares: n ~ a^2.
ljus_break_it(NAME caustic_budget-squares HEADER photons/budget.hpp TEST caustic_budget
    FROM "floor * equal + (1 - floor) * (a / sum)"
    TO   "floor * equal + (1 - floor) * a * a / (sum * sum)"
    CASES "caustic_budget: shares follow*")

# A pilot of lamps sends photons by power, as if every lamp had got as many.
ljus_break_it(NAME caustic_budget-lamps HEADER photons/budget.hpp TEST caustic_budget
    FROM "pass.equal_lights = true;"
    TO   ""
    CASES "caustic_budget: who has one lamp*")

# No floor: who is missed by the pilot starves.
ljus_break_it(NAME caustic_budget-floor HEADER photons/budget.hpp TEST caustic_budget
    FROM "floor * equal + (1 - floor) * (a / sum)"
    TO   "a / sum"
    CASES "caustic_budget: who gets nothing*")

# Photons are counted, whatever flux they carry.
ljus_break_it(NAME caustic_budget-count HEADER photons/budget.hpp TEST caustic_budget
    FROM "pilot.absolute += double(paths) * flux * flux;"
    TO   "pilot.absolute += 1;"
    CASES "caustic_budget: the pilot*")

# What else lights the scene is not asked.
ljus_break_it(NAME caustic_budget-light HEADER photons/budget.hpp TEST caustic_budget
    FROM "flux / (own + dark + irradiance_around(rest, photon, wide))"
    TO   "flux / (own + dark)"
    CASES "caustic_budget: the pilot*")

# Light on the other side of a surface counts for this one.
ljus_break_it(NAME caustic_budget-side HEADER photons/budget.hpp TEST caustic_budget
    FROM "photon_side(photon.direction, normal) == side"
    TO   "side != 0"
    CASES "caustic_budget: the pilot*")

# The pilot of every object is aimed at all of them.
ljus_break_it(NAME caustic_budget-pilot HEADER photons/budget.hpp TEST caustic_budget
    FROM "pass.shares[object] = 1;"
    TO   "pass.shares.clear();"
    CASES "caustic_budget: the pilot's numbers*")

# A radius that is to be chosen, taken for a disc without an area.
ljus_break_it(NAME caustic_budget-radius HEADER photons/budget.hpp TEST caustic_budget
    FROM "if (radius == 0) //"
    TO   "if (radius < 0) //"
    CASES "caustic_budget: a radius of 0*")

# The radius of the pilot's own photons, which lie wider than those of the picture.
ljus_break_it(NAME caustic_budget-denser HEADER photons/budget.hpp TEST caustic_budget
    FROM "T(std::sqrt(double(paths * count) / double(std::max(pass.photons, 1LL))));"
    TO   "T(1);"
    CASES "caustic_budget: a radius of 0*")

# The pilot draws from the streams of the picture.
ljus_break_it(NAME budget-pilot-streams HEADER photons/budget.hpp TEST caustic_budget
    FROM "pass.iteration = ~pass.iteration - object;"
    TO   ""
    CASES "caustic_budget: the pilot's numbers*")

# The dark of caustics alone is asked within half the radius of their photons.
ljus_break_it(NAME budget-pilot-dark HEADER photons/budget.hpp TEST caustic_budget
    FROM "mean_irradiance(caustics, all, 2 * radius)"
    TO   "mean_irradiance(caustics, all, radius)"
    CASES "caustic_budget: the pilot's numbers*")

# The light of a pilot is that of the picture's own first photons.
ljus_break_it(NAME budget-pilot-light HEADER render/budgeting.hpp TEST caustic_budget
    FROM "pass.iteration = ~pass.iteration;"
    TO   ""
    CASES "caustic_budget: the pilot of the other light*")

# Shadow photons are light to a pilot.
ljus_break_it(NAME budget-pilot-shadows HEADER photons/budget.hpp TEST caustic_budget
    FROM "return p.kind == PhotonKind::shadow;"
    TO   "return p.kind == PhotonKind::caustic;"
    CASES "caustic_budget: the pilot's numbers*")

# Only a budget asks which lamps matter.
ljus_break_it(NAME budget-lights-preset HEADER render/budgeting.hpp TEST caustic_budget
    FROM "measures || settings.share_lights"
    TO   "measures"
    CASES "caustic_budget: lamps that nobody sees*,caustic_budget: who has one lamp*")
