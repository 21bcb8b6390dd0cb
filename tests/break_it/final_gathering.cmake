# The photon that a point was chosen for counts, too: two photons too many of fifty.
ljus_break_it(NAME final-gathering-own-photon HEADER photons/irradiance_points.hpp
    TEST final_gathering
    FROM "found[k].index == here"
    TO   "false"
    CASES "final gathering: an even light*")

# Light from the other side of a wall shines through it.
ljus_break_it(NAME final-gathering-side HEADER photons/irradiance_points.hpp
    TEST final_gathering
    FROM "!(glm::dot(photon.direction, normal) < T(0)) ||"
    TO   ""
    CASES "final gathering: an even light*")

# No correction at edges: half of the light is missing there.
ljus_break_it(NAME final-gathering-edge HEADER photons/detail/kernel_border.hpp
    TEST final_gathering
    FROM "product *= kernel_part(distance / radius);"
    TO   "product *= T(1);"
    CASES "final gathering: an even light*")

# The diagonal of a wall of two triangles taken for an edge.
ljus_break_it(NAME final-gathering-diagonal HEADER photons/detail/kernel_border.hpp
    TEST final_gathering
    FROM "return std::abs(glm::dot(there, normal)) > T(0.99);"
    TO   "return std::abs(glm::dot(there, normal)) > T(2);"
    CASES "final gathering: what lies on*")

# A gather ray takes the light of whatever surface is near.
ljus_break_it(NAME final-gathering-normal HEADER photons/irradiance_points.hpp
    TEST final_gathering
    FROM "return glm::dot(points.records[i].normal, normal) > T(0.9);"
    TO   "return glm::dot(points.records[i].normal, normal) > T(-2);"
    CASES "final gathering: points answer*")

# Irradiance taken for radiance: pi times too bright.
ljus_break_it(NAME final-gathering-pi HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "return scattered->weight * irradiance * std::numbers::inv_pi_v<T>;"
    TO   "return scattered->weight * irradiance;"
    CASES "final gathering: in a furnace*")

# Where there are few photons: the radius that was asked for, which is 0 for one that is
# chosen, and it is dark there.
ljus_break_it(NAME final-gathering-few HEADER photons/irradiance_points.hpp
    TEST final_gathering
    FROM "full ? found[0].distance2 : double(radius) * double(radius);"
    TO   "full ? found[0].distance2 : double(settings.radius) * double(settings.radius);"
    CASES "final gathering: an estimate of few*")

# The harmonic mean of the gather rays' lengths for their mean: points count too far.
ljus_break_it(NAME final-gathering-distance HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "inverse += T(1) / found.distance;"
    TO   "inverse += found.distance;"
    CASES "final gathering: the irradiance of a square*")

# A gather ray through a mirror is as long as its last part.
ljus_break_it(NAME final-gathering-first HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "if (first) found.distance = vertex->distance;"
    TO   "found.distance = vertex->distance;"
    CASES "final gathering: what a gather ray brings*")
