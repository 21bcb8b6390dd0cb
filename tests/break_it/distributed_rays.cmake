# One point of the lamp for all rays: Whitted's hard shadow, not a penumbra.
ljus_break_it(NAME distributed-rays-hard-shadow HEADER render/distributed.hpp
    TEST distributed_rays
    FROM "direct_light(world, light, vertex, material, u, MisT<T>{},"
    TO   "direct_light(world, light, vertex, material, Vec2T<T>{T(0.5)}, MisT<T>{},"
    CASES "distributed rays: the penumbra*")

# A lamp in gloss has two owners: the shadow ray and the reflected one.
ljus_break_it(NAME distributed-rays-two-owners HEADER render/distributed.hpp
    TEST distributed_rays
    FROM "if (gloss && met) continue;"
    TO   ""
    CASES "distributed rays: gloss sees*")

# Matt surfaces send their light on as well.
ljus_break_it(NAME distributed-rays-matt HEADER render/distributed.hpp
    TEST distributed_rays
    FROM "has(parts, Lobes::glossy) ? Lobes::all : Lobes::specular"
    TO   "Lobes::all"
    CASES "distributed rays: a matt surface*")

# The depth counts one turn too many.
ljus_break_it(NAME distributed-rays-depth HEADER render/distributed.hpp
    TEST distributed_rays
    FROM "if (path.depth > tracer.settings().max_depth) {"
    TO   "if (path.depth > tracer.settings().max_depth + 1) {"
    CASES "distributed rays: every path*")

# Nothing moves.
ljus_break_it(NAME distributed-rays-frozen HEADER geometry/moving.hpp
    TEST distributed_rays
    FROM "translated(moving.shape, time * moving.displacement)"
    TO   "translated(moving.shape, T(0) * time * moving.displacement)"
    CASES "distributed rays: a moving strip*")

# The tree knows what moves where it starts, and loses it on its way.
ljus_break_it(NAME distributed-rays-bounds HEADER geometry/moving.hpp
    TEST distributed_rays
    FROM "box_union(first, last)"
    TO   "first"
    CASES "distributed rays: at each time*")

# Shadow rays run through the scene as it was when the shutter opened.
ljus_break_it(NAME distributed-rays-shadow-time HEADER path/direct_light.hpp
    TEST distributed_rays
    FROM "visibility(world, point, sampled->point, vertex.time);"
    TO   "visibility(world, point, sampled->point);")

# Pixels, not planes: sharp on a sphere around the lens.
ljus_break_it(NAME lens-camera-sphere HEADER scene/lens_camera.hpp TEST lens_camera
    FROM "camera.focus / glm::dot(way, middle.forward) * way"
    TO   "camera.focus * way"
    CASES "lens: all rays*")

# Points of the square in place of the disc: blur is square, and too wide.
ljus_break_it(NAME lens-camera-square HEADER scene/lens_camera.hpp TEST lens_camera
    FROM "sample_concentric_disc(u)"
    TO   "(T(2) * u - T(1))"
    CASES "lens: the opening*")

# The circle of confusion as if the film stood at infinity.
ljus_break_it(NAME lens-camera-confusion HEADER scene/lens_camera.hpp TEST lens_camera
    FROM "camera.focus / depth) / camera.focus"
    TO   "depth / camera.focus) / camera.focus"
    CASES "lens: the circle*")

# The same order in all draws: the time of a ray tells its place on the lens.
ljus_break_it(NAME stratified-stream-order HEADER math/stratified_stream.hpp
    TEST stratified_stream
    FROM "static_cast<std::uint32_t>(stream.pattern.points), key);"
    TO   "static_cast<std::uint32_t>(stream.pattern.points), stream.key);"
    CASES "stratified stream: *")

# Cells that are not divided by their number.
ljus_break_it(NAME stratified-stream-random HEADER math/stratified_stream.hpp
    TEST stratified_stream
    FROM "spread(stream.pattern, cell, mix_bits(key), next_2d<T>(stream.rest));"
    TO   "next_2d<T>(stream.rest); (void)cell;"
    CASES "stratified stream: in each*")

# The order of the draw taken for the place in the cell, too: twice the same order of two
# rays is none, and all draws of a ray hang together.
ljus_break_it(NAME stratified-stream-twice HEADER math/stratified_stream.hpp
    TEST stratified_stream
    FROM "cell, mix_bits(key),"
    TO   "cell, ~key,"
    CASES "stratified stream: the draws of a ray*")

# Rays are spread evenly though the picture asks for chance.
ljus_break_it(NAME stratified-stream-chance HEADER math/stratified_stream.hpp
    TEST stratified_stream
    FROM "stream.pattern.points == 1 || stream.pattern.sampling == Sampling::random"
    TO   "stream.pattern.points == 1"
    CASES "stratified stream: by chance*")

# A ray that is black already looks on.
ljus_break_it(NAME distributed-rays-black HEADER render/distributed.hpp TEST distributed_rays
    FROM "if (is_black(path.throughput)) break;"
    TO   "(void)0;"
    CASES "distributed rays: max_depth*")

# Bounces whose draws overlap.
ljus_break_it(NAME stratified-stream-bounce HEADER math/stratified_stream.hpp
    TEST stratified_stream
    FROM "stream.dimension = bounce << 16;"
    TO   "stream.dimension = bounce;"
    CASES "stratified stream: of which*")

# Rays of neighbouring pixels that stand alike in their cells.
ljus_break_it(NAME stratified-stream-path HEADER math/stratified_stream.hpp
    TEST stratified_stream
    FROM "pixel * static_cast<std::uint64_t>(pattern.points) +"
    TO   "pixel +"
    CASES "stratified stream: of which*")

# The largest number of the last cell is rounded to 1.
ljus_break_it(NAME stratified-stream-last HEADER math/stratified_stream.hpp
    TEST stratified_stream
    FROM "return detail::below_one((cell + u) / T(stream.pattern.points));"
    TO   "return (cell + u) / T(stream.pattern.points);"
    CASES "stratified stream: the largest*")

# Glass that moves is not remarked on, or glass that rests is.
ljus_break_it(NAME moving-caustics-said HEADER inspect/scene_remarks.hpp TEST moving
    FROM "specular |= moves && world"
    TO   "specular &= moves && world"
    CASES "moving: light of all times*")
ljus_break_it(NAME moving-caustics-matt HEADER inspect/scene_remarks.hpp TEST moving
    FROM "return has(lobes(m), Lobes::specular);"
    TO   "return !has(lobes(m), Lobes::none);"
    CASES "moving: light of all times*")
# A scene that only lists what moves is said to move.
ljus_break_it(NAME moving-gathered HEADER inspect/scene_remarks.hpp TEST moving
    FROM "gathered && has_moving(world)"
    TO   "gathered"
    CASES "moving: light of all times*")

# A lamp that moves has the centre of a quad.
ljus_break_it(NAME moving-center HEADER geometry/moving.hpp TEST moving
    FROM "return center_sample(moving.shape);"
    TO   "return center_sample(moving.shape) + ScalarOf<S>(0.5);"
    CASES "moving: the centre*")
# The edges of a shape that moves are those of a shape that does not end.
ljus_break_it(NAME moving-corners HEADER geometry/moving.hpp TEST moving
    FROM "    return corners_of(moving.shape);"
    TO   "    return corners_of(translated(moving.shape, moving.displacement));"
    CASES "moving: half of a disc*")

# The survey takes every general map for one that indirect rays look up.
ljus_break_it(NAME moving-only-gathered HEADER inspect/survey.hpp TEST moving
    FROM "plan.general_map.on && detail::gathers(settings.indirect)"
    TO   "plan.general_map.on"
    CASES "moving: light of all times*")
