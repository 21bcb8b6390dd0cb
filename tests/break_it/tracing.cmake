# As the report's program has it: survivors carry no more than before.
ljus_break_it(NAME tracing-roulette HEADER photons/photon_path.hpp TEST tracing
    FROM "reflected / probability"
    TO   "reflected"
    CASES "tracing: all the lights' flux*")

# Photons share the flux among those that were stored, not those that were emitted.
ljus_break_it(NAME tracing-stored HEADER photons/tracing.hpp TEST tracing
    FROM "    return traced;"
    TO   "    for (auto& part : traced.parts)
        for (auto& photon : part) photon.flux *= T(pass.photons) / T(traced.stored);
    return traced;"
    CASES "tracing: a caustic has*")

# What the glass has focused is kept by both maps.
ljus_break_it(NAME tracing-owner HEADER photons/photon_path.hpp TEST tracing
    FROM "const bool owned = (kind == PhotonKind::caustic) == caustics && keep.has(kind);"
    TO   "const bool owned = true;"
    CASES "tracing: the kinds*")

# Where cones overlap, photons count for whatever they meet.
ljus_break_it(NAME tracing-target HEADER photons/photon_path.hpp TEST tracing
    FROM "first && sent.target && vertex->id != *sent.target"
    TO   "false"
    CASES "tracing: aimed photons*")

# Aimed photons carry as much as blind ones.
ljus_break_it(NAME tracing-aim HEADER photons/aiming.hpp TEST tracing
    FROM "flux_leaving(light, point) * (emitted / (pdf * u.probability))"
    TO   "flux_leaving(light, point) / u.probability"
    CASES "tracing: a caustic has*")

# From each light as many photons as from the next, all with its own flux.
ljus_break_it(NAME tracing-light-choice HEADER photons/photon_path.hpp TEST tracing
    FROM ".flux = photon.flux / chosen.probability,"
    TO   ".flux = photon.flux,"
    CASES "tracing: all the lights' flux*")

# Directions uniform over the hemisphere, with the flux of Lambert's.
ljus_break_it(NAME tracing-cosine HEADER lights/area_light.hpp TEST tracing
    FROM "sample_cosine_hemisphere(u)"
    TO   "sample_uniform_hemisphere(u)"
    CASES "tracing: the first hits*")

# Memory is asked for before anybody has reckoned how much.
ljus_break_it(NAME tracing-memory HEADER photons/photon_pass.hpp TEST tracing
    FROM "if (bytes <= pass.max_memory) return;"
    TO   "if (bytes <= 1e3 * pass.max_memory) return;"
    CASES "tracing: memory*")

# Goes on for ever after nothing.
ljus_break_it(NAME tracing-give-up HEADER photons/tracing.hpp TEST tracing
    FROM "if (traced.stored == 0 && result.emitted >= pass.give_up) break;"
    TO   ""
    CASES "tracing: a pass that stores nothing*")

# Both passes draw the same numbers.
ljus_break_it(NAME tracing-one-pass HEADER photons/tracing.hpp TEST tracing
    FROM "? Pass::caustics_photons :"
    TO   "? Pass::general_photons :"
    CASES "tracing: each path*")

# A pass that gave up audits the flux of those it sent as if they were all.
ljus_break_it(NAME tracing-gave-up HEADER photons/tracing.hpp TEST tracing
    FROM "result.audit *= double(pass.photons) / double(result.emitted);"
    TO   ""
    CASES "tracing: a pass that stores*")

# Each stage of a pass begins its progress anew.
ljus_break_it(NAME tracing-progress HEADER photons/tracing.hpp TEST tracing
    FROM "pass.progress(done + now, count)"
    TO   "pass.progress(now, count)"
    CASES "tracing: progress*")

# Shadows fall where things were when the shutter opened.
ljus_break_it(NAME tracing-shadow-time HEADER photons/photon_path.hpp TEST tracing
    FROM "spawn_ray(from, photon.ray.direction, photon.ray.time)"
    TO   "spawn_ray(from, photon.ray.direction)"
    CASES "tracing: a shadow falls*")

# No shadow falls on what is matt and a mirror at once.
ljus_break_it(NAME tracing-shadow-mixture HEADER photons/photon_path.hpp TEST tracing
    FROM "has(lobes(m), Lobes::non_specular);
        };"
    TO   "!has(lobes(m), Lobes::specular);
        };"
    CASES "tracing: a shadow photon on each*")

# Kinds that nobody wants are kept all the same.
ljus_break_it(NAME tracing-keep HEADER photons/photon_path.hpp TEST tracing
    FROM "== caustics && keep.has(kind);"
    TO   "== caustics;"
    CASES "tracing: only kinds*")

# Who is stopped before anything was stored says that it gave up.
ljus_break_it(NAME tracing-stopped-remark HEADER photons/tracing.hpp TEST tracing
    FROM "if (traced.stored == 0 && result.complete &&"
    TO   "if (traced.stored == 0 &&"
    CASES "tracing: progress ascends*")

# Light that gloss throws counts as indirect as well as a caustic.
ljus_break_it(NAME tracing-gloss-kind HEADER photons/photon_path.hpp TEST tracing
    FROM "        path.met_diffuse = met_diffuse;
"
    TO   ""
    CASES "tracing: with gloss*")

# It is kept on the next glossy surface, where paths carry it.
ljus_break_it(NAME tracing-gloss-kept HEADER photons/photon_path.hpp TEST tracing
    FROM "!by_gloss || path.met_diffuse ||"
    TO   "true ||"
    CASES "tracing: with gloss*")

# No photon is aimed at it.
ljus_break_it(NAME tracing-gloss-aim HEADER photons/aiming.hpp TEST tracing
    FROM "(gloss && nearly_specular(m))"
    TO   "(gloss && false)"
    CASES "tracing: with gloss*")

# Each machine of several traces the paths of the first one.
ljus_break_it(NAME tracing-parts HEADER photons/tracing.hpp TEST tracing
    FROM "{first, last}, block);"
    TO   "{0, last - first}, block);"
    CASES "tracing: the parts of a pass*")
