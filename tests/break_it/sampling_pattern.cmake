# One order of columns for all pixels: the pattern repeats from pixel to pixel.
ljus_break_it(NAME pattern-columns HEADER math/sampling_pattern.hpp
    TEST sampling_pattern
    FROM ": shuffled(i % m, m, key) * n"
    TO   ": (i % m) * n"
    CASES "sampling_pattern: *uniform*,sampling_pattern: *neighbouring*")

# No place of its own for each row: the columns' parts are heaped.
ljus_break_it(NAME pattern-places HEADER math/sampling_pattern.hpp
    TEST sampling_pattern
    FROM "shuffled(i / m, n, ~key)"
    TO   "i % n"
    CASES "sampling_pattern: multi-jittered*")

# The broken row forgotten: the report's program once more.
ljus_break_it(NAME pattern-broken-row HEADER math/sampling_pattern.hpp
    TEST sampling_pattern
    FROM "(points - 1) / columns + 1"
    TO   "points / columns"
    CASES "sampling_pattern: multi-jittered with any*")

# The scramblings of neighbouring pixels know of each other.
ljus_break_it(NAME pattern-sobol-key HEADER math/sampling_pattern.hpp
    TEST sampling_pattern
    FROM ".seed = mix_bits(key)"
    TO   ".seed = key"
    CASES "sampling_pattern: neighbouring*")

# A pattern that is asked for, and not made.
ljus_break_it(NAME pattern-not-made HEADER math/sampling_pattern.hpp
    TEST sampling_pattern
    FROM "return detail::stratified(pattern.strata, number, key, u);"
    TO   "return u;"
    CASES "sampling_pattern: the error falls*")

# A broken row in a grid that has room for a whole one: strips of x stay empty.
ljus_break_it(NAME pattern-empty-strips HEADER math/sampling_pattern.hpp
    TEST sampling_pattern
    FROM "(T(strip) + u.x) / T(pattern.points)"
    TO   "(T(strip) + u.x) / T(m * n)"
    CASES "sampling_pattern: multi-jittered with any*")

# 32 as 5 x 7 less 3, though 4 x 8 is at hand.
ljus_break_it(NAME pattern-exact-grid HEADER math/sampling_pattern.hpp
    TEST sampling_pattern
    FROM "pattern.strata.rows > 2 * columns"
    TO   "true"
    CASES "sampling_pattern: multi-jittered with any*")

# The wide columns not moved on: the first strip is in one of them too seldom.
ljus_break_it(NAME pattern-step HEADER math/sampling_pattern.hpp
    TEST sampling_pattern
    FROM "(strip + step) % all"
    TO   "strip"
    CASES "sampling_pattern: multi-jittered with a broken row*")
