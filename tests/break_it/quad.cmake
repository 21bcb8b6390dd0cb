# The triangle's own bound for u + v does not stand in for these two.
ljus_break_it(NAME quad-u HEADER geometry/quad.hpp TEST quad
    FROM "u <= C(1) + border && "
    TO   "")

ljus_break_it(NAME quad-v HEADER geometry/quad.hpp TEST quad
    FROM "v >= -border &&"
    TO   "")
