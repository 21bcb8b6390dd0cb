# The triangle's own bound for u + v does not stand in for these two.
ljus_break_it(NAME quad-u HEADER geometry/surface_point.hpp TEST quad
    FROM "u <= C(1) + border && "
    TO   "")

ljus_break_it(NAME quad-v HEADER geometry/surface_point.hpp TEST quad
    FROM "v >= -border && v"
    TO   "v")

ljus_break_it(NAME quad-default HEADER geometry/quad.hpp TEST tree_leaks
    FROM "using C = ComputeT<Compute, WideT<T>>;"
    TO   "using C = ComputeT<Compute, T>;"
    CASES "tree leaks: a room of loose quads*")

# Open on one of its four sides, where the next quad may be missed as well.
ljus_break_it(NAME quad-open-side HEADER geometry/surface_point.hpp TEST quad
    FROM "v >= -border && v"
    TO   "v >= C(0) && v"
    CASES "quad: what meets an edge*")

ljus_break_it(NAME quad-tilt HEADER geometry/quad.hpp TEST quad
    FROM "detail::add_tilt(point, quad.edge_u, quad.edge_v);"
    TO   ""
    CASES "quad: a point of doubles*")
