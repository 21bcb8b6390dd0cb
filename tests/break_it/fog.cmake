# Light is turned by another angle than the mean cosine says.
ljus_break_it(NAME fog-phase HEADER media/phase_function.hpp TEST fog
    FROM "square * std::sqrt(square));"
    TO   "square);"
    CASES "fog: the phase function*")

# Few samples are drawn where the density is high.
ljus_break_it(NAME fog-backwards HEADER media/phase_function.hpp TEST fog
    FROM "const T below = T(1) + g * v;"
    TO   "const T below = T(1) - g * v;"
    CASES "fog: samples follow*")

# A ray that starts in fog has fog behind it.
ljus_break_it(NAME fog-behind HEADER media/fog.hpp TEST fog
    FROM "std::max(ray.t_min, nearest - half)"
    TO   "nearest - half"
    CASES "fog: the part of a ray*")

# The angle is taken for the length.
ljus_break_it(NAME fog-equi-angular HEADER media/equi_angular.hpp TEST fog
    FROM "angles.away / (angles.opening *"
    TO   "T(1) / (angles.opening *"
    CASES "fog: equi-angular*")

# The path is divided by the density of the channel that was chosen.
ljus_break_it(NAME fog-colour HEADER path/fog_path.hpp TEST fog
    FROM "return glm::dot(channel_probabilities(segment.throughput),
                    extinction * vertex.transmittance);"
    TO   "return (extinction * vertex.transmittance)[0];"
    CASES "fog: what a ray gathers*")

# The fog scatters what it absorbs.
ljus_break_it(NAME fog-albedo HEADER path/fog_path.hpp TEST fog
    FROM "path.throughput *= scattering(medium) *"
    TO   "path.throughput *= extinction(medium) *"
    CASES "fog: under a sky*")

# Light that flights and angles both find counts twice.
ljus_break_it(NAME fog-twice HEADER path/fog_path.hpp TEST fog
    FROM "how == FogLight::both ? balance_heuristic(pdf, flight) : T(1);"
    TO   "T(1);"
    CASES "fog: what a ray gathers*")

# Light on its way to the fog is not dimmed, nor that to a surface.
ljus_break_it(NAME fog-shadow-ray HEADER path/next_vertex.hpp TEST fog
    FROM "if constexpr (W::lists_fog) return fog_transmittance(world, ray);"
    TO   ""
    CASES "fog: it dims the shadow rays*")

# A shadow ray does not have unit length.
ljus_break_it(NAME fog-length HEADER path/next_vertex.hpp TEST fog
    FROM "depth += (span.last - span.first) * unit *"
    TO   "depth += (span.last - span.first) *"
    CASES "fog: it dims the shadow rays*")

# Fog is in glass, and nowhere near it.
ljus_break_it(NAME fog-in-glass HEADER path/next_vertex.hpp TEST fog
    FROM "!interior_at("
    TO   "!!interior_at("
    CASES "fog: glass keeps it out*")

# Only bodies that absorb are known.
ljus_break_it(NAME fog-clear-glass HEADER scene/world.hpp TEST fog
    FROM "has_fog() || has_priorities()"
    TO   "has_priorities()"
    CASES "fog: glass keeps it out*")

# A lamp that a scattered path meets counts in full, as if after a mirror.
ljus_break_it(NAME fog-lamp-twice HEADER path/fog_path.hpp TEST fog
    FROM "path.pdf = phase(medium, glm::dot(vertex.travel, next));"
    TO   "path.pdf = T(0);"
    CASES "fog: in a glowing room*")

# The sky's light starts at a sphere that leaves the fog out.
ljus_break_it(NAME fog-around HEADER scene/world.hpp TEST fog
    FROM "all = box_union(all, bounds(medium));"
    TO   "(void)medium;"
    CASES "fog: under a sky*")

# Renderers that know no fog render the scene without it.
ljus_break_it(NAME fog-unsaid HEADER render/render.hpp TEST fog
    FROM "require_no_fog(renderer.world(), \"this renderer\");"
    TO   "(void)renderer;"
    CASES "fog: what does not carry*")

# Scene files have white fog only.
ljus_break_it(NAME fog-file HEADER io/detail/json_lights.hpp TEST load_json
    FROM ".absorption = vector(\"absorption\"),"
    TO   ""
    CASES "load_json: fog*")

# A scattered ray passes fog as surely as a shadow ray does.
ljus_break_it(NAME fog-passing HEADER path/fog_path.hpp TEST fog
    FROM "path.pdf *= detail::passing(vertex.transmittance);"
    TO   ""
    CASES "fog: in a glowing room*")

# A light of several media is a factor too strong on rays that cross more than one.
ljus_break_it(NAME fog-media HEADER path/fog_path.hpp TEST fog
    FROM "           T(aim->media);"
    TO   "           T(1);"
    CASES "fog: several media*")

# What fog scatters sees all that moves where it is when the shutter opens.
ljus_break_it(NAME fog-time HEADER path/fog_path.hpp TEST fog
    FROM ".time = segment.ray.time};"
    TO   ".time = T(0)};"
    CASES "fog: at each time*")

# Behind glass the last ray from fog finds no lamp.
ljus_break_it(NAME fog-last-ray HEADER path/fog_path.hpp TEST fog
    FROM "    path.specular = false;
    path.met"
    TO   "    path.met"
    CASES "fog: at the limit of depth*")

# Who selects paths of a renderer is not asked whether it carries fog.
ljus_break_it(NAME fog-refused-selection HEADER render/render.hpp TEST fog
    FROM "    if constexpr (requires { renderer.whole(); })"
    TO   "    if constexpr (requires { renderer.nothing(); })"
    CASES "fog: what does not carry*")
