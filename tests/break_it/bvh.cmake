# The planes chosen by the sign of the direction: -0 is not below 0.
ljus_break_it(NAME box-sign HEADER geometry/box.hpp TEST box
    FROM ".is_negative = {std::signbit(inverse.x), std::signbit(inverse.y),"
    TO   ".is_negative = {ray.direction.x < 0, ray.direction.y < 0,"
    CASES "box: what the slabs say*,box: along an axis*")

# Boxes as large as they say, and no larger.
ljus_break_it(NAME box-slack HEADER geometry/box.hpp TEST box
    FROM ".slack = T(8) * Limits::epsilon() * reach}"
    TO   ".slack = T(0)}"
    CASES "box: no ray at an edge*")

# The corner across of a quad is left out.
ljus_break_it(NAME box-quad HEADER geometry/quad.hpp TEST box
    FROM "{quad.edge_u, quad.edge_v, quad.edge_u + quad.edge_v}"
    TO   "{quad.edge_u, quad.edge_v}"
    CASES "box: no point of a shape*")

# On a tie whichever comes first wins.
ljus_break_it(NAME bvh-tie HEADER accel/bvh.hpp TEST bvh
    FROM "(hit.t == at.t && of < number)"
    TO   "false"
    CASES "bvh: huge and tiny*")

# The farther child first: right, and slow.
ljus_break_it(NAME bvh-order HEADER accel/bvh.hpp TEST bvh
    FROM "*two < *one"
    TO   "*one < *two"
    CASES "bvh: the nearer child first*")

# Half of what waits is forgotten.
ljus_break_it(NAME bvh-later HEADER accel/bvh.hpp TEST bvh
    FROM "if (one && two)"
    TO   "if (one && two && waiting < 3)"
    CASES "bvh: the same answers*")

# The costs of the lower halves are left out.
ljus_break_it(NAME bvh-cost HEADER accel/detail/bvh_build.hpp TEST bvh
    FROM "lower.bounds.half_area() * tests_of(lower.count, at_a_time) + above[i]"
    TO   "above[i]"
    CASES "bvh: the nearer child first*")

# The middle of a far box is infinite.
ljus_break_it(NAME bvh-middle HEADER accel/detail/bvh_build.hpp TEST bvh
    FROM "T(0.5) * bounds.side[axis] - T(0.5) * bounds.side[axis + 4]"
    TO   "T(0.5) * (bounds.side[axis] - bounds.side[axis + 4])"
    CASES "bvh: the split is the cheapest*")

# Wide boxes without slack.
ljus_break_it(NAME wide-bvh-slack HEADER accel/detail/bvh8_walk.hpp TEST bvh8
    FROM "8 * std::numeric_limits<float>::epsilon() * reach"
    TO   "0 * reach"
    CASES "wide bvh: no ray slips*,wide bvh: huge and tiny*")

# The first look at triangles trusts its rounding.
ljus_break_it(NAME triangle-bvh-border HEADER accel/triangle_bvh.hpp TEST bvh8
    FROM "const float wide = across * scale + min;"
    TO   "const float wide = 0 * across * scale;"
    CASES "wide bvh: no ray slips*")

# It trusts it about where a ray starts, too.
ljus_break_it(NAME triangle-bvh-start HEADER accel/triangle_bvh.hpp TEST bvh8
    FROM "(before > near)"
    TO   "(before > -near)"
    CASES "wide bvh: rays from the surfaces*")

# Of two types of shapes the second is numbered as the first.
ljus_break_it(NAME world-type HEADER scene/world.hpp TEST world
    FROM "all.push_back(id);"
    TO   "all.push_back({0, id.index});"
    CASES "world: in double*")

# The first child of a wide node's two gets all places but one, whatever they cost.
ljus_break_it(NAME bvh-collapse HEADER accel/detail/bvh8_build.hpp TEST bvh8
    FROM "if (low == 1 || sum < best.cost) best = {low, sum};"
    TO   "best = {low, sum};"
    CASES "wide bvh: few nodes*")

# A search for any forgets the lanes of a node that it has entered a child of.
ljus_break_it(NAME wide-bvh-any HEADER accel/detail/bvh8_walk.hpp TEST bvh8
    FROM "size_ += entered_ != 0 ? 1 : 0;"
    TO   "size_ += 0;"
    CASES "wide bvh: the same answers*")

# The surface of the lower half with the number of the upper: a tree that is right, and
# slow.
ljus_break_it(NAME bvh-heuristic HEADER accel/detail/bvh_build.hpp TEST bvh
    FROM "lower.bounds.half_area() * tests_of(lower.count, at_a_time) + above[i];"
    TO   "lower.bounds.half_area() * tests_of(upper.count, at_a_time) + above[i];"
    CASES "bvh: the split is the cheapest*")

# What is as far as the end of the ray is left out.
ljus_break_it(NAME bvh8-as-far HEADER accel/detail/bvh8_walk.hpp TEST bvh8
    FROM "entry > t_max"
    TO   "entry >= t_max"
    CASES "wide bvh: who is asked*")

# A triangle is as large as its longer edge, whichever that is.
ljus_break_it(NAME triangle-bvh-edges HEADER accel/triangle_bvh.hpp TEST bvh8
    FROM "max_component(glm::max(glm::abs(e1), glm::abs(e2)))"
    TO   "max_component(glm::abs(e1))"
    CASES "wide bvh: the filter errs*")
