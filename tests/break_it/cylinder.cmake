# A cylinder without its ends is infinitely long.
ljus_break_it(NAME cylinder-length HEADER geometry/cylinder.hpp TEST cylinder
    FROM "C(0) <= along &&"
    TO   ""
    CASES "cylinder: the unit cylinder*")

# The distance across the axis is that in space.
ljus_break_it(NAME cylinder-across HEADER geometry/cylinder.hpp TEST cylinder
    FROM "const Vec3T<C> d = across(ray_d), o = across(ray_o);"
    TO   "const Vec3T<C> d = across(ray_d), o = ray_o;"
    CASES "cylinder: what is hit*")

# The normal that stands in for a lost one faces away from the ray.
ljus_break_it(NAME cylinder-lost-normal HEADER geometry/cylinder.hpp TEST cylinder
    FROM "way = -across(d);"
    TO   "way = across(d);"
    CASES "cylinder: one so thin*")
