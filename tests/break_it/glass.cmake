# The forgotten n^2: a lamp inside glass is too bright, a room seen from inside too dark.
ljus_break_it(NAME glass-squared-index HEADER materials/glass.hpp TEST glass
    FROM "transport == Transport::radiance ? eta * eta : T(1)"
    TO   "T(1)")

# ... and given to photons, which do not have it.
ljus_break_it(NAME glass-squared-index-of-flux HEADER materials/glass.hpp TEST glass
    FROM "transport == Transport::radiance ? eta * eta : T(1)"
    TO   "eta * eta")

# The index swapped: the ball becomes an air bubble.
ljus_break_it(NAME glass-index-swapped HEADER materials/glass.hpp TEST glass
    FROM "const T eta = n_i / n_t;"
    TO   "const T eta = n_t / n_i;")

# Fresnel at the half vector, which is the normal: no bright rim.
ljus_break_it(NAME glass-half-vector HEADER materials/glass.hpp TEST glass
    FROM "fresnel(glass.fresnel, std::abs(wo.z), n_i, n_t)"
    TO   "fresnel(glass.fresnel, T(1), n_i, n_t)"
    CASES "glass: the share*,glass: a slab*")

# Photons that never reflect.
ljus_break_it(NAME glass-no-reflection HEADER materials/glass.hpp TEST glass
    FROM "if (!met.refracted || u.z < met.reflectance)"
    TO   "if (!met.refracted)"
    CASES "glass: the share*,glass: a slab*")
