# The report's gain, set by hand.
ljus_break_it(NAME caustics-gain HEADER photons/irradiance_estimate.hpp TEST caustics
    FROM "sum / (std::numbers::pi * radius2)"
    TO   "5.0 * sum / (std::numbers::pi * radius2)"
    CASES "caustics: the estimate is*")

# The report's clamp: no caustic brighter than a white wall.
ljus_break_it(NAME caustics-clamp HEADER photons/irradiance_estimate.hpp TEST caustics
    FROM "sum / (std::numbers::pi * radius2)"
    TO   "glm::min(sum / (std::numbers::pi * radius2), RgbT<double>{0.1})"
    CASES "caustics: the estimate is*")

# A cube's range query used as a ball: the corners count, over the disc's area.
ljus_break_it(NAME caustics-cube HEADER photons/irradiance_estimate.hpp TEST caustics
    FROM "sum / (std::numbers::pi * radius2)"
    TO   "sum * (4 / std::numbers::pi) / (std::numbers::pi * radius2)"
    CASES "caustics: the estimate is*")

# A parabola whose volume is half of what it should be.
ljus_break_it(NAME caustics-kernel HEADER photons/kernel.hpp TEST caustics
    FROM "return T(2) * (T(1) - x);"
    TO   "return T(1) - x;"
    CASES "caustics: the estimate is*")

# The k-th photon sets the radius and is counted, too.
ljus_break_it(NAME caustics-k HEADER photons/irradiance_estimate.hpp TEST caustics
    FROM "full ? 1 : 0"
    TO   "0"
    CASES "caustics: k nearest*")

# Photons that were aimed at one ball and meet another first count for both.
ljus_break_it(NAME caustics-overlap HEADER photons/photon_path.hpp TEST caustics
    FROM "vertex->id != *sent.target"
    TO   "false"
    CASES "caustics: overlapping targets*")

# The cosine at the lamp, which a point light does not have.
ljus_break_it(NAME caustics-lamp-cosine HEADER lights/area_light.hpp TEST caustics
    FROM "cosine * std::numbers::inv_pi_v<T>"
    TO   "std::numbers::inv_pi_v<T>"
    CASES "caustics: overlapping targets*")

# Points of a mirror as if they were directions.
ljus_break_it(NAME caustics-area HEADER photons/aiming.hpp TEST caustics
    FROM "aimed.pdf = seen.pdf;"
    TO   "aimed.pdf = pdf_uniform_cone(at.cone.one_minus_cos);"
    CASES "caustics: a mirror ball*")

# The report's program: photons do not reflect from glass.
ljus_break_it(NAME caustics-reflect HEADER materials/glass.hpp TEST caustics
    FROM "!met.refracted || u.z < met.reflectance"
    TO   "!met.refracted"
    CASES "caustics: the light of a point light*")

# The report's program: a photon starts a tenth of a unit inside the glass, which is then
# a lens of another shape.
ljus_break_it(NAME caustics-start HEADER geometry/surface_point.hpp TEST caustics
    FROM "return {.origin = offset_ray_origin(point, direction),
            .direction = direction,"
    TO   "return {.origin = offset_ray_origin(point, direction) - (glm::dot(direction, point.normal) < T(0) ? T(0.1) : T(0)) * point.normal,
            .direction = direction,"
    CASES "caustics: the light of a point light*")

# Coloured glass that absorbs nothing.
ljus_break_it(NAME caustics-absorption HEADER optics/absorption.hpp TEST caustics
    FROM "std::exp(-sigma.x * distance)"
    TO   "T(1)"
    CASES "caustics: the three colours*")

# Photons count as lone among others.
ljus_break_it(NAME caustics-lone HEADER photons/lone_photons.hpp TEST lone_photons
    FROM "if (near >= room.size()) continue;"
    TO   ""
    CASES "lone photons: those with fewer*")

# Lone photons are added once more, and not moved.
ljus_break_it(NAME caustics-lone-twice HEADER render/detail/caustics_batch.hpp
    TEST lone_photons
    FROM "add(maps.lone, how, T(-1));"
    TO   ""
    CASES "lone photons: the same picture*")

# The wide disc is as narrow as any other.
ljus_break_it(NAME caustics-lone-radius HEADER render/photon_mapping_settings.hpp
    TEST lone_photons
    FROM "wide.radius *= settings.lone_radius;"
    TO   ""
    CASES "lone photons: no dots*")
