# One order of columns for all pixels: the pattern repeats from pixel to pixel.
ljus_break_it(NAME pattern-columns HEADER math/sampling_pattern.hpp
    TEST sampling_pattern
    FROM "shuffled(i % m, m, key)"
    TO   "i % m"
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
    CASES "sampling_pattern: multi-jittered*")

# The second dimension of a pixel is the first of its neighbour.
ljus_break_it(NAME pattern-sobol-key HEADER math/sampling_pattern.hpp
    TEST sampling_pattern
    FROM ".seed = mix_bits(key)"
    TO   ".seed = key"
    CASES "sampling_pattern: neighbouring*")

# A pattern that is asked for, and not made.
ljus_break_it(NAME pattern-not-made HEADER math/sampling_pattern.hpp
    TEST sampling_pattern
    FROM "return stratified(pattern.strata, number, key, u);"
    TO   "return u;"
    CASES "sampling_pattern: the error falls*")
