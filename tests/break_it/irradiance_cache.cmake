# All points count alike: steps where one comes in.
ljus_break_it(NAME irradiance-cache-weight HEADER render/irradiance_cache.hpp
    TEST irradiance_cache
    FROM "sum += (T(1) - share) * record.irradiance;
        weights += T(1) - share;"
    TO   "sum += record.irradiance;
        weights += T(1);"
    CASES "irradiance cache: the mean*")

# A point in a corner counts as far as one in the open.
ljus_break_it(NAME irradiance-cache-reach HEADER render/irradiance_cache.hpp
    TEST irradiance_cache
    FROM "!(T(distance2) < limit * limit) ||"
    TO   "!(limit == limit) ||"
    CASES "irradiance cache: the mean*")

# The light of a wall on the floor beside it.
ljus_break_it(NAME irradiance-cache-normal HEADER render/irradiance_cache.hpp
    TEST irradiance_cache
    FROM "return glm::dot(a, b) > T(0.95);"
    TO   "return glm::dot(a, b) > T(-2);"
    CASES "irradiance cache: the mean*")

# Gather rays that always leave on the side of the normal.
ljus_break_it(NAME irradiance-cache-side HEADER render/final_gathering.hpp
    TEST irradiance_cache
    FROM "Vec3T<T>{up.x, up.y, side * up.z}"
    TO   "Vec3T<T>{up.x, up.y, up.z}"
    CASES "irradiance cache: surfaces seen*")

# Photons compared by the side that is seen, not by the normal that they keep.
ljus_break_it(NAME irradiance-cache-turned HEADER photons/irradiance_points.hpp
    TEST irradiance_cache
    FROM "map, vertex.point, radius, std::span"
    TO   "map, {.position = vertex.point.position, .normal = normal}, radius, std::span"
    CASES "irradiance cache: surfaces seen*")

# The weight of the visible share forgotten: lamps shine through walls.
ljus_break_it(NAME all-lights-share HEADER path/all_lights.hpp TEST all_lights
    FROM "all[c] * (arrived[c] / sent[c])"
    TO   "all[c]"
    CASES "all lights: in a penumbra*")

# A lamp that a ray meets counts wholly, though a shadow ray has been there.
ljus_break_it(NAME all-lights-weight HEADER path/all_lights.hpp TEST all_lights
    FROM "balance_heuristic(reaching, T(rays) * pdf) * path.throughput"
    TO   "path.throughput"
    CASES "all lights: multiple importance*")

# Each picture's points in the same places of their squares.
ljus_break_it(NAME irradiance-cache-seed HEADER render/irradiance_cache.hpp
    TEST irradiance_cache
    FROM "random_stream(picture.seed, Pass::gathering"
    TO   "random_stream(1, Pass::gathering"
    CASES "irradiance cache: each square*")

# What was gathered stays in the order of the picture, while the tree has its own.
ljus_break_it(NAME irradiance-cache-order HEADER render/irradiance_cache.hpp
    TEST irradiance_cache
    FROM "cache.records.push_back(records[i]);"
    TO   "(void)i; cache.records.push_back(records[cache.records.size()]);"
    CASES "irradiance cache: each point has*")

# Points of the other side answer for a surface that is seen from behind.
ljus_break_it(NAME irradiance-cache-behind HEADER render/irradiance_cache.hpp
    TEST irradiance_cache
    FROM "detail::seen_normal(vertex), T(settings.reach)"
    TO   "vertex.frame.normal, T(settings.reach)"
    CASES "irradiance cache: what is known*")

# Where no point is near, each camera ray gathers as many rays as a point.
ljus_break_it(NAME irradiance-cache-once HEADER render/irradiance_cache.hpp
    TEST irradiance_cache
    FROM "(settings.rays + 3) / 4"
    TO   "settings.rays"
    CASES "irradiance cache: what is known*")

# What one ray has found is added to the neighbours, but stays at the point as well.
ljus_break_it(NAME irradiance-cache-spread HEADER render/irradiance_cache.hpp
    TEST irradiance_cache
    FROM "record.irradiance -= record.brightest;"
    TO   ""
    CASES "irradiance cache: what one ray*")

# The last ray that has found any light counts as the brightest.
ljus_break_it(NAME irradiance-cache-brightest HEADER render/final_gathering.hpp
    TEST irradiance_cache
    FROM "if (max_component(found.radiance) > max_component(gathered.brightest))"
    TO   "if (max_component(found.radiance) > 0)"
    CASES "irradiance cache: points where*")
