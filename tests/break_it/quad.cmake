ljus_break_it(NAME quad-u HEADER geometry/quad.hpp TEST quad
    FROM "u <= C(1) && v"
    TO   "v")

ljus_break_it(NAME quad-v HEADER geometry/quad.hpp TEST quad
    FROM " && v >= C(0)"
    TO   "")
