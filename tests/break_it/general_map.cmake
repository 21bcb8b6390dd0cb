# Shadow photons only where the surface's own normal faces the light: the other side of a
# quad, lit or not, would look as if nothing could ever stand in its way.
ljus_break_it(NAME general-map-shadow-normal HEADER photons/photon_path.hpp TEST general_map
    FROM "if (world.visit_material(vertex->object.material, diffuse))"
    TO   [[if (world.visit_material(vertex->object.material, diffuse) &&
               glm::dot(vertex->point.normal, path.ray.direction) < T(0))]]
    CASES "general map: direct + shadow*")

# And the wrong way round.
ljus_break_it(NAME general-map-shadow-side HEADER photons/photon_path.hpp TEST general_map
    FROM "out.push_back({at_rest(world, *vertex).point.position, path.ray.direction,"
    TO   "out.push_back({at_rest(world, *vertex).point.position, -path.ray.direction,"
    CASES "general map: direct + shadow*")

# One shadow photon a path: only the next surface behind is told.
ljus_break_it(NAME general-map-shadow-one HEADER photons/photon_path.hpp TEST general_map
    FROM "path.depth < 1000"
    TO   "path.depth < 1"
    CASES "general map: direct + shadow*")

# The surface that hides counts itself among the hidden.
ljus_break_it(NAME general-map-shadow-first HEADER photons/photon_path.hpp TEST general_map
    FROM "PathStateT<T> path{.ray = straight_on(first)};"
    TO   "(void)first; PathStateT<T> path{.ray = photon.ray};"
    CASES "general map: direct + shadow*")

# Photons on mirrors and glass.
ljus_break_it(NAME general-map-mirror HEADER photons/photon_path.hpp TEST general_map
    FROM "if (!owned || !has(lobes(material), Lobes::non_specular)) return;"
    TO   "if (!owned) return;"
    CASES "general map: photons lie on matt*")

# Shadow photons on mirrors and glass.
ljus_break_it(NAME general-map-shadow-mirror HEADER photons/photon_path.hpp TEST general_map
    FROM "has(lobes(m), Lobes::non_specular)"
    TO   "has(lobes(m), Lobes::all)"
    CASES "general map: photons lie on matt*")

# Each photon says that it comes from the first light.
ljus_break_it(NAME general-map-light HEADER photons/photon_path.hpp TEST general_map
    FROM ".light = static_cast<std::uint16_t>(chosen.light)};"
    TO   ".light = 0};"
    CASES "general map: photons lie on matt*")

# Direct photons counted as indirect, and the other way round.
ljus_break_it(NAME general-map-kind HEADER photons/photon_path.hpp TEST general_map
    FROM "if (path.met_diffuse) return PhotonKind::indirect;"
    TO   "if (!path.met_diffuse) return PhotonKind::indirect;"
    CASES "general map: direct and indirect*")

# The power of all paths in each photon.
ljus_break_it(NAME general-map-number HEADER photons/tracing.hpp TEST general_map
    FROM [[sent.photon.flux /= static_cast<T>(pass.photons);]]
    TO   [[(void)0;]]
    CASES "general map: direct and indirect*")

# The cosine a second time, as the report's program has it at each bounce.
ljus_break_it(NAME general-map-cosine HEADER photons/photon_path.hpp TEST general_map
    FROM [[path.throughput = *survivor;
    return true;]]
    TO   [[path.throughput = *survivor * std::abs(glm::dot(path.ray.direction, vertex.point.normal));
    return true;]]
    CASES "general map: direct and indirect*")

# A disc of the wrong area.
ljus_break_it(NAME general-map-area HEADER photons/irradiance_estimate.hpp TEST general_map
    FROM [[return RgbT<T>(sum / (std::numbers::pi * radius2));]]
    TO   [[return RgbT<T>(sum / radius2);]]
    CASES "general map: a flat estimate*")

# Photons of the other side count too.
ljus_break_it(NAME general-map-other-side HEADER photons/detail/flux_in_disc.hpp TEST general_map
    FROM "towards < T(0) ? T(1) : T(0)"
    TO   "towards < T(0) ? T(1) : T(1)"
    CASES "general map: a flat estimate*")

# A candle beside a lamp sends photons by its power: no verdict knows it.
ljus_break_it(NAME general-map-equal-lights HEADER render/photon_mapping.hpp TEST general_map
    FROM "general.equal_lights = true;"
    TO   "(void)0;"
    CASES "general map: for shadow rays alone*")

# The second pass was complete, and so is all, whatever became of the first one.
ljus_break_it(NAME general-map-complete HEADER render/photon_mapping.hpp TEST general_map
    FROM "maps.complete && traced.complete"
    TO   "traced.complete"
    CASES "general map: a pass that was stopped*")

# The irradiance by the seed of the caustics.
ljus_break_it(NAME general-map-irradiance-seed HEADER render/photon_mapping.hpp TEST general_map
    FROM "settings_.general.seed, settings_"
    TO   "settings_.caustics.seed, settings_"
    CASES "general map: who is asked*")

# A map with too few indirect photons is used without a word.
ljus_break_it(NAME general-map-blurred HEADER render/photon_mapping.hpp
    TEST general_map
    FROM "if (blurred && !maps.starved)"
    TO   "if (blurred && maps.starved)"
    CASES "general map: which maps are made*")
