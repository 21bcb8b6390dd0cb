# Every surface is there.
ljus_break_it(NAME nested_bodies-hidden HEADER scene/nested_bodies.hpp
    TEST nested_bodies
    FROM "crossing.hidden = from == to;"
    TO   "crossing.hidden = false;"
    CASES "nested bodies: the boundaries along*")

# Each body stands in air.
ljus_break_it(NAME nested_bodies-outside HEADER path/next_vertex.hpp TEST nested_bodies
    FROM "vertex.outside = outside == 0 ? T(1)"
    TO   "vertex.outside = true ? T(1)"
    CASES "nested bodies: water on glass*")

# The index on the outside is always that behind the surface.
ljus_break_it(NAME nested_bodies-entered HEADER scene/nested_bodies.hpp
    TEST nested_bodies
    FROM "return entered ? before.top() : behind.top();"
    TO   "return behind.top();"
    CASES "nested bodies: what a ray crosses*")

# The lowest priority holds.
ljus_break_it(NAME nested_bodies-order HEADER scene/world.hpp TEST nested_bodies
    FROM "return a.order < b.order;"
    TO   "return a.order > b.order;"
    CASES "nested bodies: the boundaries along*")

# The light on a path is absorbed by the body behind its vertex.
ljus_break_it(NAME nested_bodies-medium HEADER path/next_vertex.hpp TEST nested_bodies
    FROM "medium_of_rank(world, path.bodies.top()).value_or"
    TO   "medium_of_rank(world, path.behind.top()).value_or"
    CASES "nested bodies: the boundaries along*")

# A hidden surface casts a shadow.
ljus_break_it(NAME nested_bodies-shadow HEADER path/next_vertex.hpp TEST nested_bodies
    FROM "if (world.has_priorities() && world.may_be_in_medium(ray.origin))"
    TO   "if (false)"
    CASES "nested bodies: shadow rays*")

# A path that goes through a surface stays in the bodies before it.
ljus_break_it(NAME nested_bodies-through HEADER path/continue_path.hpp
    TEST nested_bodies
    FROM "if (!same_side(vertex.wo, next.wi)) path.bodies = path.behind;"
    TO   ""
    CASES "nested bodies: a random path*")

# A path begins outside all bodies.
ljus_break_it(NAME nested_bodies-start HEADER path/next_vertex.hpp TEST nested_bodies
    FROM "path.bodies = bodies_at(world, ray);"
    TO   "path.bodies = {};"
    CASES "nested bodies: the boundaries along*")

# A body that ends was not there if the path did not know it.
ljus_break_it(NAME nested_bodies-unknown HEADER scene/nested_bodies.hpp
    TEST nested_bodies
    FROM "crossing.before = crossing.before.with(rank);"
    TO   ""
    CASES "nested bodies: what a ray crosses*")

# A list has the lowest body first.
ljus_break_it(NAME nested_bodies-list HEADER scene/body_list.hpp TEST nested_bodies
    FROM "if (rank > place) std::swap(rank, place);"
    TO   "if (rank < place || place == 0) std::swap(rank, place);"
    CASES "nested bodies: a list*")

# Any two bodies that overlap are without an order.
ljus_break_it(NAME nested_bodies-remark HEADER inspect/scene_remarks.hpp TEST nested_bodies
    FROM "priority_of(around.ranks[n]) == priority_of(around.ranks[n - 1])"
    TO   "true"
    CASES "nested bodies: what cannot be*")

# Photons are scaled by the index, as radiance is.
ljus_break_it(NAME nested_bodies-photons HEADER photons/photon_path.hpp
    TEST nested_bodies
    FROM "continue_path(path, vertex, material, Transport::flux, which, stream)"
    TO   "continue_path(path, vertex, material, Transport::radiance, which, stream)"
    CASES "nested bodies: photons bring*")

# A texture over glass hides its index of refraction, or its priority.
ljus_break_it(NAME nested-textured-index HEADER materials/textured.hpp TEST nested_bodies
    FROM "return refractive_index(m.base);"
    TO   "return 0 * refractive_index(m.base);"
    CASES "nested bodies: a normal map*")
ljus_break_it(NAME nested-textured-priority HEADER materials/textured.hpp
    TEST nested_bodies
    FROM "return priority(m.base);"
    TO   "return 0 * priority(m.base);"
    CASES "nested bodies: a normal map*")

# The body's own numbers are not asked for.
ljus_break_it(NAME nested-check HEADER materials/nested.hpp TEST nested_bodies
    FROM "check(nested.base);"
    TO   ""
    CASES "nested bodies: what cannot be right is*")

# Bodies that only touch along an edge are said to overlap.
ljus_break_it(NAME nested-touching HEADER inspect/scene_remarks.hpp TEST nested_bodies
    FROM "bool real = false;"
    TO   "bool real = true;"
    CASES "nested bodies: what cannot be right*")
