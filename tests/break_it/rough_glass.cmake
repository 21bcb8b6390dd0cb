# Light that enters glass is as bright inside.
ljus_break_it(NAME rough_glass-index HEADER materials/rough_glass.hpp TEST rough_glass
    FROM "f *= (here / beyond) * (here / beyond);"
    TO   ""
    CASES "rough glass: f is the formula*")

# The solid angle of facets, as if they refracted light like mirrors.
ljus_break_it(NAME rough_glass-jacobian HEADER materials/rough_glass.hpp
    TEST rough_glass
    FROM "(length * length);"
    TO   "length;"
    CASES "rough glass: where a small*")

# What a facet reflects goes through it.
ljus_break_it(NAME rough_glass-fraction HEADER materials/rough_glass.hpp
    TEST rough_glass
    FROM "const T through = T(1) - fresnel("
    TO   "const T through = fresnel("
    CASES "rough glass: where a small*")

# The facet that refracts into a denser body is upside down.
ljus_break_it(NAME rough_glass-facet HEADER materials/rough_glass.hpp TEST rough_glass
    FROM "sum / (eta > T(1) ? length : -length)"
    TO   "sum / length"
    CASES "rough glass: f is the formula*")

# Photons become fewer in glass, and more outside.
ljus_break_it(NAME rough_glass-flux HEADER materials/rough_glass.hpp TEST rough_glass
    FROM "!reflected && transport == Transport::radiance ?"
    TO   "!reflected ?"
    CASES "rough glass: radiance that goes in*")

# Roulette is not told that the index scales radiance.
ljus_break_it(NAME rough_glass-roulette HEADER materials/rough_glass.hpp
    TEST rough_glass
    FROM "next.eta_scale = scale;"
    TO   ""
    CASES "rough glass: radiance that goes in*")

# Nothing blocks light that goes through.
ljus_break_it(NAME rough_glass-unblocked HEADER materials/rough_glass.hpp
    TEST rough_glass
    FROM "if (in.z < T(0)) return T(2) / (r_in - in.z);"
    TO   "if (in.z < T(0)) return T(-1) / in.z;"
    CASES "rough glass: f is the formula*")

# Rough where a float direction cannot tell.
ljus_break_it(NAME rough_glass-surroundings HEADER materials/rough_glass.hpp
    TEST rough_glass
    FROM "> T(2e-5);"
    TO   ">= T(0);"
    CASES "rough glass: the index of its surroundings*")

# Refracted light may come out of the side that it entered by.
ljus_break_it(NAME rough_glass-side HEADER materials/rough_glass.hpp TEST rough_glass
    FROM "if (!in || !(reflected ? in->z > T(0) : in->z < T(0)))"
    TO   "if (!in)"
    CASES "rough glass: samples follow*")

# Fresnel's fraction at the surface, not at the facet.
ljus_break_it(NAME rough_glass-cosine HEADER materials/rough_glass.hpp TEST rough_glass
    FROM "std::clamp(glm::dot(out, h), T(0), T(1))"
    TO   "out.z"
    CASES "rough glass: where a small*")

# A verdict about one side decides for light from both.
ljus_break_it(NAME rough_glass-verdict HEADER render/photon_mapping.hpp
    TEST rough_glass_scenes
    FROM "if (!scatters_through(material)) // a verdict"
    TO   "if (true) // a verdict"
    CASES "rough glass scenes: photons of one side*")

# No ray goes on through glass on whose outside no photon is near.
ljus_break_it(NAME rough_glass-bounce HEADER render/photon_mapping.hpp
    TEST rough_glass_scenes
    FROM "if (has(which, Lobes::diffuse) && !scatters_through(material) &&"
    TO   "if (has(which, Lobes::diffuse) &&"
    CASES "rough glass scenes: photons of one side*")

# Paths end on the far side of the glass that they enter.
ljus_break_it(NAME rough_glass-gather HEADER render/photon_mapping.hpp
    TEST rough_glass_scenes
    FROM "{.gather = second && !through}"
    TO   "{.gather = second}"
    CASES "rough glass scenes: no photon map*")

# Photons count on glass, and once more behind it.
ljus_break_it(NAME rough_glass-photons HEADER render/photon_mapping.hpp
    TEST rough_glass_scenes
    FROM "IndirectLight::photons && !scatters_through(material))"
    TO   "IndirectLight::photons)"
    CASES "rough glass scenes: no photon map*")

# Beyond each body there is air: for shadow rays.
ljus_break_it(NAME rough_glass-medium HEADER path/direct_light.hpp
    TEST rough_glass_scenes
    FROM "if (leaves_body<M>(vertex.wo, wi) && world.has_nested_media())"
    TO   "if (false)"
    CASES "rough glass scenes: a shadow ray out*")

# The same for rays that the material samples.
ljus_break_it(NAME rough_glass-medium-sampled HEADER path/all_lights.hpp
    TEST rough_glass_scenes
    FROM "!leaves_body<M>(vertex.wo, next->sample.wi)"
    TO   "true"
    CASES "rough glass scenes: a shadow ray out*")
