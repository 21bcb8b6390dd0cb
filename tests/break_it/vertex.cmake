# The dead are not paid for.
ljus_break_it(NAME vertex-roulette HEADER path/path_state.hpp TEST vertex
    FROM "throughput /= probability;"
    TO   ""
    CASES "vertex: roulette*")

# Roulette takes the n^2 of radiance in glass for a loss.
ljus_break_it(NAME vertex-eta_scale HEADER path/path_state.hpp TEST vertex
    FROM "max_component(throughput) / eta_scale"
    TO   "max_component(throughput)"
    CASES "vertex: roulette*")

# Coming out of glass, a path takes the glass along.
ljus_break_it(NAME vertex-medium HEADER path/continue_path.hpp TEST vertex
    FROM "wi.z < T(0) ? absorption(material) : RgbT<T>{T(0)}"
    TO   "absorption(material)"
    CASES "vertex: a path through glass*")

# Photons and camera paths do not see the same scene.
ljus_break_it(NAME vertex-adjoint HEADER path/continue_path.hpp TEST vertex
    FROM "scattered.sample.weight *= std::abs(factor);"
    TO   ""
    CASES "vertex: with two normals*")

# A lamp in glass shines as if there were none.
ljus_break_it(NAME vertex-begins-inside HEADER path/next_vertex.hpp TEST vertex
    FROM "path.medium = medium_at(world, path.ray);"
    TO   ";"
    CASES "vertex: a path that begins in glass*")

# A shape that is turned inside out keeps its frame in the world.
ljus_break_it(NAME vertex-known_frame HEADER scene/world.hpp TEST vertex
    FROM "inside_out ? -n : n"
    TO   "inside_out ? n : n"
    CASES "vertex: a world knows*")

# A lamp's area counts half.
ljus_break_it(NAME vertex-known_area HEADER lights/area_light.hpp TEST vertex
    FROM ".area = area(shape),"
    TO   ".area = area(shape) / 2,"
    CASES "vertex: a world knows*")

# The density of the scattering before, kept at a mirror: a lamp behind it is weighed as if
# a shadow ray could have found it.
ljus_break_it(NAME vertex-stale-pdf HEADER path/continue_path.hpp TEST vertex
    FROM "path.pdf = next.pdf;"
    TO   "if (!next.specular) path.pdf = next.pdf;"
    CASES "vertex: a path keeps nothing*")

# Shadow rays that find all things where they were when the shutter opened; the second row
# in scenes with thin surfaces.
ljus_break_it(NAME vertex-shadow-time HEADER path/next_vertex.hpp TEST vertex
    FROM "const RayT<T> ray = spawn_ray_to(from, to, time);"
    TO   "const RayT<T> ray = spawn_ray_to(from, to);"
    CASES "vertex: what stands in the way*")
ljus_break_it(NAME vertex-shadow-time-thin HEADER path/next_vertex.hpp TEST vertex
    FROM "spawn_ray_to(last, to, time)"
    TO   "spawn_ray_to(last, to)"
    CASES "vertex: what stands in the way*")

# A path that split off has the numbers of the one that it left.
ljus_break_it(NAME vertex-branch HEADER path/next_vertex.hpp TEST vertex
    FROM "path.branch + static_cast<std::uint64_t>(++path.depth)"
    TO   "static_cast<std::uint64_t>(++path.depth)"
    CASES "vertex: the numbers of a bounce*")

# Sampled again about the other normal, but of all lobes: a mirror's path ends by chance.
ljus_break_it(NAME vertex-again-lobes HEADER path/continue_path.hpp TEST vertex
    FROM "to_local(flat, back), u, transport, which)"
    TO   "to_local(flat, back), u, transport)"
    CASES "vertex: what two normals disagree*")

# Only where a stop is rare is it made up for: at a pane that stops most, too dark.
ljus_break_it(NAME vertex-stop HEADER path/continue_path.hpp TEST vertex
    FROM "if (vertex.stop_probability < T(1))"
    TO   "if (vertex.stop_probability < T(0.5))"
    CASES "vertex: a path that stops at a pane*")

# What is sampled again after a mirror's disagreement may be matt.
ljus_break_it(NAME vertex-again-matt HEADER path/continue_path.hpp TEST vertex
    FROM "if (!again || !again->specular) return std::nullopt;"
    TO   "if (!again) return std::nullopt;"
    CASES "vertex: what two normals disagree*")

# Roulette plays by the red of a path: blue ones end.
ljus_break_it(NAME vertex-roulette-red HEADER path/path_state.hpp TEST vertex
    FROM "max_component(throughput) / eta_scale"
    TO   "throughput.x / eta_scale"
    CASES "vertex: roulette's threshold*")

# Who leaves a bubble in glass is in air.
ljus_break_it(NAME medium-nested HEADER path/continue_path.hpp TEST vertex
    FROM "!leaves_body<M>(vertex.wo, next.wi);"
    TO   "true;"
    CASES "vertex: where a path begins*")

# A body that was entered on the way counts as one around the beginning.
ljus_break_it(NAME medium-entered HEADER path/next_vertex.hpp TEST vertex
    FROM "if (body != last)"
    TO   "if (false)"
    CASES "vertex: where a path begins*")

# Light from behind a surface comes through what is before it.
ljus_break_it(NAME medium-behind HEADER path/direct_light.hpp TEST vertex
    FROM "medium_beyond(vertex.medium, material, vertex.wo, wi)"
    TO   "vertex.medium"
    CASES "vertex: light from behind*")
