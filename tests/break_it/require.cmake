# "Not below 0" lets NaN through, and 0 too.
ljus_break_it(NAME require-positive HEADER math/require.hpp TEST require
    FROM "std::isfinite(value) && value > T(0)"
    TO   "!(value < T(0))")

ljus_break_it(NAME require-unit-channel HEADER math/require.hpp TEST require
    FROM "value.x <= T(1) && value.y <= T(1) && value.z <= T(1)"
    TO   "value.x <= T(1) && value.y <= T(1)")
