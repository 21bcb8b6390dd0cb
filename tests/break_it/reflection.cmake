# I - D is -(D.N)N: every ray leaves along the normal.
ljus_break_it(NAME reflection-half HEADER optics/reflection.hpp TEST reflection
    FROM "T(2) * along - d"
    TO   "along - d")

# The sign of the usual form, D - 2(D.N)N, with the minus forgotten.
ljus_break_it(NAME reflection-sign HEADER optics/reflection.hpp TEST reflection
    FROM "d - glm::dot(d, n) * n"
    TO   "d + glm::dot(d, n) * n")
