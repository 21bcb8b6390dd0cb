ljus_break_it(NAME quad-u HEADER geometry/triangle.hpp TEST quad
    FROM "u >= C(0) && u <= C(1)"
    TO   "u >= C(0)")

ljus_break_it(NAME quad-v HEADER geometry/quad.hpp TEST quad
    FROM "v >= C(0) && v <= C(1)"
    TO   "v <= C(1)")
