# The half vector between the ray and its mirror direction is the normal: cos = 1 always.
ljus_break_it(NAME schlick-half-vector HEADER optics/schlick.hpp TEST schlick
    FROM "const T m = T(1) - cos_theta;"
    TO   "const T m = T(1) - T(1);"
    CASES "schlick: the curve*,schlick: the largest*")

# The incoming angle from either side, as printed.
ljus_break_it(NAME schlick-thin-side HEADER optics/schlick.hpp TEST schlick
    FROM "n_i > n_t ? cos_t : cos_i"
    TO   "cos_i"
    CASES "schlick: with both cosines*")

ljus_break_it(NAME schlick-power HEADER optics/schlick.hpp TEST schlick
    FROM "(m2 * m2 * m)"
    TO   "(m2 * m2)"
    CASES "schlick: the largest*")
