# A term of the recurrence left out: each dimension is still a net, two are none.
ljus_break_it(NAME sobol-recurrence HEADER math/low_discrepancy.hpp
    TEST low_discrepancy
    FROM "table[d][i - seed.s] ^ (table[d][i - seed.s] >> seed.s)"
    TO   "table[d][i - seed.s] >> seed.s"
    CASES "low_discrepancy: any two*"
    COMPILED)

# A polynomial's coefficients read from the wrong end.
ljus_break_it(NAME sobol-polynomial HEADER math/low_discrepancy.hpp
    TEST low_discrepancy
    FROM "(seed.a >> (seed.s - 1 - k)) & 1u"
    TO   "(seed.a >> k) & 1u"
    CASES "low_discrepancy: any two*"
    COMPILED)

# Without the mirror image the lower bits would turn over the upper ones.
ljus_break_it(NAME owen-direction HEADER math/low_discrepancy.hpp TEST low_discrepancy
    FROM "std::uint32_t x = reversed_bits(bits);"
    TO   "std::uint32_t x = bits;"
    CASES "low_discrepancy: the scrambling*")

# One scrambling for all dimensions: x and y move together.
ljus_break_it(NAME owen-seed HEADER math/low_discrepancy.hpp TEST low_discrepancy
    FROM "stream.seed + d * odd);"
    TO   "stream.seed + 0 * odd);"
    CASES "low_discrepancy: one point is uniform*")

# The scramblings of neighbouring dimensions know of each other: some cells of a square
# are taken half as often again as others.
ljus_break_it(NAME owen-seeds-near HEADER math/low_discrepancy.hpp TEST low_discrepancy
    FROM "stream.seed + d * odd);"
    TO   "stream.seed + d + 0 * odd);"
    CASES "low_discrepancy: one point is uniform*")

# A stream without points that begins with points.
ljus_break_it(NAME low_discrepancy-without HEADER math/low_discrepancy.hpp
    TEST low_discrepancy
    FROM "return {.dimension = sobol_dimensions, .rest = rest};"
    TO   "return {.rest = rest};"
    CASES "low_discrepancy: what a stream draws*")

# A scrambling, too, but another one: all pictures would change.
ljus_break_it(NAME low_discrepancy-other HEADER math/low_discrepancy.hpp
    TEST low_discrepancy
    FROM "x += static_cast<std::uint32_t>(key);"
    TO   "x ^= static_cast<std::uint32_t>(key);"
    CASES "low_discrepancy: the scrambling stays*")
