# The square root's two parts the wrong way round: metals turn into glass.
ljus_break_it(NAME conductor-root HEADER optics/conductor.hpp TEST conductor
    FROM "const T a = real >= T(0) ? larger : smaller;"
    TO   "const T a = larger;")

# One polarisation for both: no minimum before the grazing angle.
ljus_break_it(NAME conductor-polarisation HEADER optics/conductor.hpp TEST conductor
    FROM "return r_s * (T(1) + ratio) / T(2);"
    TO   "return r_s;"
    CASES "conductor: the light that*")

# The extinction forgotten.
ljus_break_it(NAME conductor-extinction HEADER optics/conductor.hpp TEST conductor
    FROM "const T real = (n - k) * (n + k) - sin2;"
    TO   "const T real = n * n - sin2;"
    CASES "conductor: what is known*")

# A metal that forgets at which angle it is seen.
ljus_break_it(NAME metal-angle HEADER materials/mirror.hpp TEST metal
    FROM "std::min(std::abs(wo.z), T(1))"
    TO   "T(1)")

# 0/0 at the grazing angle of an index of 1: NaN.
ljus_break_it(NAME conductor-nothing HEADER optics/conductor.hpp TEST conductor
    FROM "return all > T(0) ? part / all : T(1);"
    TO   "return part / all;"
    CASES "conductor: a share for every*")

# Two digits of silver's green change places.
ljus_break_it(NAME conductor-digits HEADER optics/conductor.hpp TEST conductor
    FROM "T(3.483)"
    TO   "T(3.843)"
    CASES "conductor: the indices*"
    COMPILED)
