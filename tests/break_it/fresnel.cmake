# The half vector of the report's program: the angle of the light does not count.
ljus_break_it(NAME fresnel-half-vector HEADER optics/fresnel.hpp TEST fresnel
    FROM "const T c = cos_theta_i;"
    TO   "const T c = T(1);"
    CASES "fresnel: a rim*")

# Total reflection ignored: the root of a negative number.
ljus_break_it(NAME fresnel-total-ignored HEADER optics/fresnel.hpp TEST fresnel
    FROM "if (g2 <= T(0)) return T(1); // total internal reflection"
    TO   "if (g2 <= T(0)) return T(0);"
    CASES "fresnel: all is reflected*")

# Indices swapped in one polarisation: Brewster's angle goes.
ljus_break_it(NAME fresnel-polarisation HEADER optics/fresnel.hpp TEST fresnel
    FROM "squared_contrast(n_t * (n_t * c), n_i * g)"
    TO   "squared_contrast(n_i * c, g)"
    CASES "fresnel: at Brewster*")

# 1 - small never used: three times the roundings.
ljus_break_it(NAME fresnel-roundings HEADER optics/fresnel.hpp TEST fresnel_exact
    FROM "if (through < T(0.6)) return T(1) - through;"
    TO   "")
