# The flux is spread over a ball as if it were a disc of another size.
ljus_break_it(NAME volume-photons-area HEADER photons/volume_photons.hpp
    TEST volume_photons
    FROM "(std::numbers::pi_v<T> * radius2)"
    TO   "(std::numbers::pi_v<T> * radius2 * photon.radius)"
    CASES "volume_photons: over all parallel rays*")

# Light goes on where it came from.
ljus_break_it(NAME volume-photons-phase HEADER photons/volume_photons.hpp
    TEST volume_photons
    FROM "phase(medium, -glm::dot(ray.direction, photon.direction));"
    TO   "phase(medium, glm::dot(ray.direction, photon.direction));"
    CASES "volume_photons: over all parallel rays*")

# The fog between photon and eye is forgotten.
ljus_break_it(NAME volume-photons-dimmed HEADER photons/volume_photons.hpp
    TEST volume_photons
    FROM "before.t_max = at.x;"
    TO   "before.t_max = T(0);"
    CASES "volume_photons: over all parallel rays*")

# Photons behind a wall are seen.
ljus_break_it(NAME volume-photons-behind HEADER photons/volume_photons.hpp
    TEST volume_photons
    FROM "at.x > span->first && at.x < span->last && at.y"
    TO   "at.x > span->first && at.y"
    CASES "volume_photons: the tree finds*")

# The fog is dark along its border.
ljus_break_it(NAME volume-photons-border HEADER media/fog.hpp
    TEST volume_photons
    FROM "image[axis] += shift;"
    TO   "image[axis] += 2 * shift;"
    CASES "volume_photons: along its border*")

# In a sphere the mirror image stands on the border.
ljus_break_it(NAME volume-photons-border-sphere HEADER media/fog.hpp
    TEST volume_photons
    FROM "const T ratio = 2 * sphere.radius / distance - 1;"
    TO   "const T ratio = sphere.radius / distance;"
    CASES "volume_photons: along its border*")

# The photon counts among its neighbours.
ljus_break_it(NAME volume-photons-itself HEADER photons/volume_photons.hpp
    TEST volume_photons
    FROM "found(room.data(), nearest + 1);"
    TO   "found(room.data(), nearest);"
    CASES "volume_photons: the radius is*")

# Balls without an extent divide by 0.
ljus_break_it(NAME volume-photons-one-place HEADER photons/volume_photons.hpp
    TEST volume_photons
    FROM "radius > T(0) ? radius : least;"
    TO   "radius;"
    CASES "volume_photons: the radius is*")

# Fog scatters the light that it absorbs, in photons alone.
ljus_break_it(NAME volume-photons-roulette HEADER photons/photon_path.hpp
    TEST volume_photons
    FROM "path.throughput = *survivor;
        visit_fog"
    TO   "path.throughput = segment.throughput;
        visit_fog"
    CASES "volume_photons: in fog without end*")

# The light of shadow rays is in the map as well.
ljus_break_it(NAME volume-photons-owner HEADER photons/photon_path.hpp
    TEST volume_photons
    FROM "keep.has(PhotonKind::fog) && kind_of(path) == owned"
    TO   "keep.has(PhotonKind::fog)"
    CASES "volume_photons: in fog without end*")

# Photons on their way to a caustic are not dimmed.
ljus_break_it(NAME volume-photons-caustics HEADER photons/photon_path.hpp
    TEST volume_photons
    FROM "caustics ? transmittance(optical_depth(world, segment.ray), T(1))"
    TO   "caustics ? RgbT<T>{T(1)}"
    CASES "volume_photons: a beam from a mirror*")

# What lies behind the fog is as bright as without it.
ljus_break_it(NAME volume-photons-camera HEADER render/photon_mapping.hpp
    TEST volume_photons
    FROM "path.throughput *= transmittance(optical_depth(world, segment.ray), T(1));"
    TO   "(void)surface;"
    CASES "volume_photons: in a glowing room*")

# What the map holds counts twice.
ljus_break_it(NAME volume-photons-twice HEADER render/photon_mapping.hpp
    TEST volume_photons
    FROM "ask(maps.fog));"
    TO   "2.0f * ask(maps.fog));"
    CASES "volume_photons: in a glowing room*")

# Photons in fog lie on surfaces as well.
ljus_break_it(NAME volume-photons-surfaces HEADER render/photon_mapping.hpp
    TEST volume_photons
    FROM "return photon.kind == PhotonKind::fog;"
    TO   "return photon.kind == PhotonKind::fog && photon.light > 9;"
    CASES "volume_photons: maps are made*")

# A scattered ray through fog weighs as much as in clear air.
ljus_break_it(NAME volume-photons-found HEADER path/all_lights.hpp
    TEST volume_photons
    FROM "path.throughput *= through;"
    TO   ""
    CASES "volume_photons: fog dims both halves*")

# Passes do not shrink the balls.
ljus_break_it(NAME volume-photons-shrink HEADER render/progressive.hpp
    TEST volume_photons
    FROM "settings.fog_estimate.radius *= static_cast<float>(scale);"
    TO   ""
    CASES "volume_photons: the balls of a pass*")

# Behind dense fog a flight divides by a throughput of 0.
ljus_break_it(NAME volume-photons-black HEADER render/photon_mapping.hpp
    TEST volume_photons
    FROM " || is_black(before)"
    TO   ""
    CASES "volume_photons: behind fog*")
