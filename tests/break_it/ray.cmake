# Backwards.
ljus_break_it(NAME ray-at HEADER geometry/ray.hpp TEST ray
    FROM "ray.origin + t * ray.direction"
    TO   "ray.origin - t * ray.direction")

# A ray that may look behind itself.
ljus_break_it(NAME ray-t-min HEADER geometry/ray.hpp TEST ray
    FROM "T t_min = T(0);"
    TO   "T t_min = -std::numeric_limits<T>::infinity();"
    COMPILED)

# A test that starts where the hit was counted: definition 3.1 hits its own surface.
ljus_break_it(NAME ray-stay HEADER geometry/surface_point.hpp TEST ray
    FROM "return {.origin = offset_ray_origin(point, direction),
            .direction = direction,"
    TO   "return {.origin = point.position, .direction = direction,"
    CASES "ray: t >= 0 hits*")

# The test that was asked for is forgotten where it has nothing to prepare.
ljus_break_it(NAME ray-prepared-test HEADER geometry/ray.hpp TEST ray
    FROM "return intersect<Test>(ray, shape);"
    TO   "return intersect(ray, shape);"
    CASES "ray: what has no use*")
