# The cosine of the angle at which light arrives.
ljus_break_it(NAME direct-light-cosine HEADER path/direct_light.hpp TEST direct_light
    FROM "std::abs(wi.z) * weigh"
    TO   "weigh"
    CASES "direct light: a point light*")

# The inverse square, as the report's program has it.
ljus_break_it(NAME direct-light-distance HEADER lights/light.hpp TEST direct_light
    FROM ".weight = sent / distance2"
    TO   ".weight = sent"
    CASES "direct light: a point light*")

# The density of the point of a lamp.
ljus_break_it(NAME direct-light-pdf HEADER lights/area_light.hpp TEST direct_light
    FROM "sample->weight = light.lamp.radiance / pdf;"
    TO   "sample->weight = light.lamp.radiance;"
    CASES "direct light: lamps give*")

# A lamp that shines on both sides.
ljus_break_it(NAME direct-light-side HEADER lights/area_light.hpp TEST direct_light
    FROM "glm::dot(sample->wi, point.normal) < T(0) && "
    TO   ""
    CASES "direct light: no ray*")

# Nothing hides anything.
ljus_break_it(NAME direct-light-shadow HEADER path/direct_light.hpp TEST direct_light
    FROM "visibility(world, point, sampled->point, vertex.time);"
    TO   "RgbT<T>{T(1)};"
    CASES "direct light: what stands between*")

# The test for visibility the wrong way round, at one kind of light: what is hidden from it
# is lit.
ljus_break_it(NAME direct-light-inverted HEADER path/direct_light.hpp TEST direct_light
    FROM "visible = visibility(world, point, sampled->point, vertex.time);"
    TO   "visible = visibility(world, point, sampled->point, vertex.time);
        if (!world.can_be_met(light)) visible = RgbT<T>{T(1)} - visible;"
    CASES "direct light: what stands between*")

# The lamp where it was when the shutter opened.
ljus_break_it(NAME direct-light-lamp-time HEADER path/direct_light.hpp TEST direct_light
    FROM "sample_light(world, light, point.position, u, vertex.time)"
    TO   "sample_light(world, light, point.position, u)"
    CASES "direct light: a lamp? and what stands*")

# The mirror of a mixture has its part in the density of its matt part.
ljus_break_it(NAME all-lights-lobes HEADER path/all_lights.hpp TEST all_lights
    FROM ".lobes = next == Lobes::none ? Lobes::non_specular : next}"
    TO   ".lobes = Lobes::all}"
    CASES "all lights: of a material that is part mirror*")

# Where no ray is needed, the fog is forgotten with it.
ljus_break_it(NAME direct-light-lit-fog HEADER path/direct_light.hpp TEST direct_light
    FROM "if (!is_black(medium))"
    TO   "if (!is_black(medium) && verdict != Verdict::lit)"
    CASES "direct light: what is known*")

# All rays of a pixel look at the same few cells of a lamp.
ljus_break_it(NAME all-lights-cells HEADER path/all_lights.hpp TEST all_lights
    FROM "stream.key + std::uint32_t(u.x * T(0x1p24))"
    TO   "stream.key"
    CASES "all lights: the rays of a pixel*")

# Where normals lean, what a ray finds is weighed as if it were flux.
ljus_break_it(NAME all-lights-found-flux HEADER path/all_lights.hpp TEST all_lights
    FROM "scatter(vertex, material, next_3d<T>(context.stream),
                              Transport::radiance,"
    TO   "scatter(vertex, material, next_3d<T>(context.stream),
                              Transport::flux,"
    CASES "all lights: what a ray finds*")

# The ray towards a lamp takes the numbers of the path's next bounce.
ljus_break_it(NAME all-lights-branch HEADER path/all_lights.hpp TEST all_lights
    FROM ".branch = std::uint64_t(1) << 44"
    TO   ".branch = 0"
    CASES "all lights: the ray towards a lamp*")

# A faint lamp among many takes as many rays as a bright one alone.
ljus_break_it(NAME all-lights-faint HEADER path/all_lights.hpp TEST all_lights
    FROM "std::min(T(1), T(2) * by_it / sent_by_all_) * T(rays_)"
    TO   "T(rays_)"
    CASES "all lights: faint lamps*")

# A lamp that is chosen more often counts more as well.
ljus_break_it(NAME all-lights-faint-weight HEADER path/all_lights.hpp TEST all_lights
    FROM "T(rays) / (by_it * scale_)"
    TO   "T(rays)"
    CASES "all lights: faint lamps*")

# Lamps without a ray send nothing.
ljus_break_it(NAME all-lights-faint-rest HEADER path/all_lights.hpp TEST all_lights
    FROM "        all_ += all;
        if (rays == 0) return;"
    TO   "        if (rays == 0) return;
        all_ += all;"
    CASES "all lights: faint lamps*")
