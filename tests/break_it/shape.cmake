# The place of the centre rounds the way from it.
ljus_break_it(NAME shape-far-sphere HEADER geometry/sphere.hpp TEST shape
    FROM "(ray.origin - sphere.center) + hit.t * ray.direction"
    TO   "point_at(ray, hit.t) - sphere.center"
    CASES "shape: a hit point of a sphere*")

ljus_break_it(NAME shape-grain HEADER geometry/sphere.hpp TEST shape
    FROM "way == Vec3T<WideT<T>>{0}"
    TO   "false"
    CASES "shape: a sphere too small*")

# Of a moving shape only the middle of its way is bounded.
ljus_break_it(NAME shape-moving-bound HEADER geometry/moving.hpp TEST moving
    FROM "sphere.radius += T(glm::length(Vec3T<WideT<T>>(moving.displacement)) / 2);"
    TO   ""
    CASES "moving: *")

# Only the way of a moving shape is looked at.
ljus_break_it(NAME shape-moving-check HEADER geometry/moving.hpp TEST moving
    FROM "    check(moving.shape);"
    TO   ""
    CASES "moving: *")

# Photons lie where they have landed, wherever the shape is later.
ljus_break_it(NAME moving-photons HEADER path/next_vertex.hpp TEST moving
    FROM "resting.point.position -= vertex.time * shape.displacement;"
    TO   ";"
    CASES "moving: photons see*")

# A time is drawn for what only might move.
ljus_break_it(NAME shape-still-time HEADER path/next_vertex.hpp TEST moving
    FROM "if (has_moving(world)) return next_1d"
    TO   "return next_1d"
    CASES "moving: a time is drawn*")

# Only the first namespace in the name of a type is left out.
ljus_break_it(NAME shape-type-name HEADER hook.hpp TEST shape
    FROM [[for (std::size_t at; (at = text.find("ljus::")) != std::string::npos;)]]
    TO   [[if (const std::size_t at = text.find("ljus::"); at != std::string::npos)]]
    CASES "shape: a table of hooks*")
