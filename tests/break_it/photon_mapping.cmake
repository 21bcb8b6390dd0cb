# Radiance that leaves glass as if it were flux.
ljus_break_it(NAME photon-mapping-n2 HEADER materials/glass.hpp TEST photon_mapping
    FROM "transport == Transport::radiance ? eta * eta : T(1)"
    TO   "transport == Transport::radiance ? T(1) : T(1)"
    CASES "photon mapping: a matt ball embedded*")

# Flux that enters glass as if it were radiance.
ljus_break_it(NAME photon-mapping-flux HEADER photons/photon_path.hpp TEST photon_mapping
    FROM "continue_path(path, vertex, material, Transport::flux, which, stream)"
    TO   "continue_path(path, vertex, material, Transport::radiance, which, stream)"
    CASES "photon mapping: a matt ball embedded*")

# A cosine in the estimate, which the arriving flux holds already: photons one by one, and
# eight at a time.
ljus_break_it(NAME photon-mapping-cosine HEADER photons/density_estimate.hpp TEST photon_mapping
    FROM "return evaluate(material, wo, from_light);"
    TO   "return std::abs(from_light.z) * evaluate(material, wo, from_light);"
    CASES "photon mapping: a matt ball embedded*")
ljus_break_it(NAME photon-mapping-lane-cosine HEADER photons/detail/flux_in_disc.hpp
    TEST photon_mapping
    FROM "towards < T(0) ? T(1) : T(0)"
    TO   "towards < T(0) ? -towards : T(0)"
    CASES "photon mapping: a matt ball embedded*")

# The report's weight of a photon, a hill whose volume is not 1.
ljus_break_it(NAME photon-mapping-kernel HEADER photons/kernel.hpp TEST photon_mapping
    FROM "return T(2) * (T(1) - x);"
    TO   "return T(1) - x;"
    CASES "photon mapping: away from edges*")

# The general map's shadow photons are not light.
ljus_break_it(NAME photon-mapping-shadow HEADER photons/photon.hpp
    TEST photon_mapping
    FROM "light_kinds{7}"
    TO   "light_kinds{13}"
    CASES "photon mapping: the general map*"
    COMPILED)

# A lamp within coloured glass shines as if the glass were clear.
ljus_break_it(NAME photon-mapping-start HEADER path/next_vertex.hpp TEST photon_mapping
    FROM "path.medium = medium_at(world, path.ray);"
    TO   ";"
    CASES "photon mapping: lamps and matt balls*")

# The plan says that nothing is lit, and rays look for light all the same.
ljus_break_it(NAME photon-mapping-plan HEADER render/photon_mapping.hpp TEST survey
    FROM "return passes_.indirect_rays"
    TO   "return settings_.max_depth > 0"
    CASES "survey: what the plan leaves out*")

# Caustics that come later without what the path is worth, and all samples' to the first
# one of them.
ljus_break_it(NAME later-throughput HEADER render/detail/caustics_batch.hpp TEST render
    FROM "place.throughput * light"
    TO   "light"
    CASES "render: caustics that*")
ljus_break_it(NAME later-item HEADER render/detail/sample_sums.hpp TEST render
    FROM "batch_.item = static_cast<std::uint32_t>(count_);"
    TO   "batch_.item = 0;"
    CASES "render: answers that come*")
ljus_break_it(NAME later-left HEADER render/render.hpp TEST render
    FROM "samples.finish();"
    TO   ""
    CASES "render: answers that come*")

# One pattern for all pixels.
ljus_break_it(NAME render-one-pattern HEADER render/render.hpp TEST render
    FROM "mix_bits(picture.seed) ^ pixel"
    TO   "mix_bits(picture.seed)"
    CASES "render: neighbours*")

# The irradiance cache's light through the clear part of a mixture, too.
ljus_break_it(NAME photon-mapping-cache-lobes HEADER render/gathering.hpp
    TEST photon_mapping_steps
    FROM "from_anywhere, Lobes::diffuse,"
    TO   "from_anywhere, Lobes::all,"
    CASES "photon mapping: who answers*")

# Both ways at glass behind a matt surface, too: the same light, for more rays.
ljus_break_it(NAME photon-mapping-split HEADER render/photon_mapping.hpp
    TEST photon_mapping_steps
    FROM "settings.split_glass && !path.met_diffuse &&"
    TO   "settings.split_glass &&"
    CASES "photon mapping: behind a matt*")

# With a cache a path that has come by gloss is not gathered where it ends.
ljus_break_it(NAME photon-mapping-cache-gathers HEADER render/photon_mapping_settings.hpp
    TEST photon_mapping_steps
    FROM "indirect == IndirectLight::map || uses_points(indirect)"
    TO   "indirect == IndirectLight::map || indirect == IndirectLight::gather"
    CASES "photon mapping: behind a glossy*")

# Once a path has split, roulette spares it behind matt surfaces, too.
ljus_break_it(NAME photon-mapping-spared HEADER render/photon_mapping.hpp
    TEST photon_mapping_steps
    FROM "!branches.empty() && !path.met_diffuse"
    TO   "!branches.empty()"
    CASES "photon mapping: behind a matt surface no branch*")

# A radius of another unit than the scene's loses all caustics without a word.
ljus_break_it(NAME photon-mapping-unit HEADER render/photon_mapping.hpp TEST photon_mapping_steps
    FROM "const bool few = found < 0.1;"
    TO   "const bool few = found < 0;"
    CASES "photon mapping: a radius in another unit*")

# A caustic of a hundred photons is blurred without a word.
ljus_break_it(NAME photon-mapping-few-caustics HEADER render/photon_mapping.hpp
    TEST photon_mapping_steps
    FROM "if (landed == 0 || landed >= 256) return {};"
    TO   "if (landed == 0 || landed >= 64) return {};"
    CASES "photon mapping: a caustic of few*")

# A disc that is wider than its object loses light: on a ball, on small objects together, and
# unsaid.
ljus_break_it(NAME photon-mapping-edge-loss HEADER inspect/scene_remarks.hpp
    TEST photon_mapping_steps
    FROM "found += double(kernel_weight(gather.kernel, distance2) / cosine);"
    TO   "found += double(kernel_weight(gather.kernel, distance2) * cosine);"
    CASES "photon mapping: what the edges*")
ljus_break_it(NAME photon-mapping-few-of-each HEADER inspect/scene_remarks.hpp
    TEST photon_mapping_steps
    FROM "rest.photons += sum.photons;"
    TO   "rest.photons += 0 * sum.photons;"
    CASES "photon mapping: what the edges*")
ljus_break_it(NAME photon-mapping-edges-said HEADER inspect/scene_remarks.hpp
    TEST photon_mapping_steps
    FROM "if (!(lost > 0.2)) return {};"
    TO   "if (!(lost > 0.5)) return {};"
    CASES "photon mapping: light that small*")
ljus_break_it(NAME photon-mapping-caustics-said HEADER inspect/scene_remarks.hpp
    TEST photon_mapping_steps
    FROM "!mapper.passes().gloss_as_mirrors)"
    TO   "mapper.passes().gloss_as_mirrors)"
    CASES "photon mapping: light that small*")

# A ray of its own to lamps was given up, and the next one forgets them.
ljus_break_it(NAME photon-mapping-next-ray HEADER render/photon_mapping.hpp
    TEST photon_mapping_steps
    FROM "if (sharing > 0 && !path.specular)"
    TO   "if (false)"
    CASES "photon mapping: after gloss*")

# The next ray brings what a ray of its own has brought.
ljus_break_it(NAME photon-mapping-own-ray HEADER path/all_lights.hpp
    TEST photon_mapping_steps
    FROM "if (both && next == Lobes::none)"
    TO   "if (both)"
    CASES "photon mapping: after gloss*")

# With a mirror in the scene, its caustics on gloss are lost.
ljus_break_it(NAME photon-mapping-caustics-on-gloss HEADER render/passes.hpp TEST survey
    FROM "!gloss || found.specular > 0}"
    TO   "!gloss}"
    CASES "survey: narrow gloss*")

# The faintest branch at glass sends as many shadow rays as the brightest.
ljus_break_it(NAME photon-mapping-faint HEADER render/photon_mapping.hpp
    TEST photon_mapping_steps
    FROM "std::min(T(1), 2 * carried)"
    TO   "std::min(T(1), 2 + carried)"
    CASES "photon mapping: faint branches*")

# A radius that the mapper chooses may be too small for a float's square.
ljus_break_it(NAME photon_mapping-chosen-radius HEADER render/photon_mapping.hpp
    TEST photon_mapping_steps
    FROM "        check(settings_.general_estimate, \"general_estimate\");"
    TO   "        (void)0;"
    CASES "photon mapping: a chosen radius*")

# The photons in a disc grow with its radius, not with the square.
ljus_break_it(NAME photon-mapping-unit-area HEADER render/photon_mapping.hpp
    TEST photon_mapping_steps
    FROM "double(some) * share * share;"
    TO   "double(some) * share;"
    CASES "photon mapping: a radius in another unit*")

# Thickness along the photon's normal, where an estimate has that of its own point.
ljus_break_it(NAME photon-mapping-tilted HEADER inspect/scene_remarks.hpp
    TEST photon_mapping_steps
    FROM "std::abs(glm::dot(way, point.normal)) < height"
    TO   "std::abs(glm::dot(way, photon.normal)) < height"
    CASES "photon mapping: what the edges*")

# After gloss, roulette ends all but the brightest paths, and makes these bright.
ljus_break_it(NAME photon-mapping-gloss-roulette HEADER render/photon_mapping.hpp
    TEST photon_mapping_steps
    FROM "sharing > 0 ? T(detail::gloss_threshold) : T(1)"
    TO   "T(1)"
    CASES "photon mapping: after dark gloss*")

# Gloss sends all shadow rays, though the path's next ray finds the lamps as well.
ljus_break_it(NAME photon-mapping-gloss-shadow-rays HEADER render/photon_mapping.hpp
    TEST photon_mapping_steps
    FROM "if (path.met_diffuse || how.next != Lobes::none) how.rays = 1;"
    TO   "if (path.met_diffuse) how.rays = 1;"
    CASES "photon mapping: after dark gloss*")

# A path ends at gloss also where the general map lacks the light of mirrors.
ljus_break_it(NAME photon-mapping-gloss-ends HEADER render/gathering.hpp
    TEST photon_mapping_steps
    FROM "if (mapper.passes().gloss_as_mirrors || scatters_through(material) ||"
    TO   "if (scatters_through(material) ||"
    CASES "photon mapping: behind a glossy*")

# A path ends at a ball or rod smaller than the disc, of which most lies beside it.
ljus_break_it(NAME photon-mapping-gloss-small HEADER render/gathering.hpp
    TEST photon_mapping_steps
    FROM "return is_below(x) && is_below(-x) && is_below(y) && is_below(-y);"
    TO   "return true;"
    CASES "photon mapping: a path goes on*")
