# 24 bits are what a float holds; 32 are rounded up to 1.
ljus_break_it(NAME random-below-one HEADER math/random.hpp TEST random
    FROM "static_cast<T>(bits >> 40) * T(0x1p-24)"
    TO   "static_cast<T>(bits >> 32) * T(0x1p-32)"
    CASES "random: never 1*")

# Streams of neighbouring paths must not overlap.
ljus_break_it(NAME random-key HEADER math/random.hpp TEST random
    FROM "mix_bits(path + odd)"
    TO   "path"
    CASES "random: the numbers stay*")

# A stream of doubles passes for one of floats.
ljus_break_it(NAME random-float HEADER math/random.hpp TEST random
    FROM "{ next_1d<float>(stream) } -> std::same_as<float>;"
    TO   "next_1d<float>(stream);"
    CASES "random: points are made*" COMPILED)
