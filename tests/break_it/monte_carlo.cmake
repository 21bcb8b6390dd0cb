# Divided by n where one of the n distances is used up by the mean.
ljus_break_it(NAME monte_carlo-variance HEADER inspect/estimate.hpp TEST estimate
    FROM "return estimate.squares / (estimate.count - 1);"
    TO   "return estimate.squares / estimate.count;"
    CASES "estimate: the variance has*")

# The deviation of one sample in place of that of the mean.
ljus_break_it(NAME monte_carlo-standard-error HEADER inspect/estimate.hpp TEST estimate
    FROM "std::sqrt(variance(estimate) / estimate.count)"
    TO   "std::sqrt(variance(estimate))"
    CASES "estimate: four numbers*")

# The tails of a normal distribution, for a standard error from few samples.
ljus_break_it(NAME monte_carlo-student HEADER inspect/estimate.hpp TEST estimate
    FROM "std::pow(std::cos((i + 0.5) * end / steps), n - 1)"
    TO   "std::exp(-n * std::pow((i + 0.5) * end / steps, 2) / 2)"
    CASES "estimate: how often*")

# Both distances from the old mean.
ljus_break_it(NAME monte_carlo-welford HEADER inspect/estimate.hpp TEST estimate
    FROM "from_old * (x - estimate.mean)"
    TO   "from_old * from_old"
    CASES "estimate: four numbers*")

# Two halves with different means scatter more than either.
ljus_break_it(NAME monte_carlo-joined HEADER inspect/estimate.hpp TEST estimate
    FROM "apart * apart * (a.count * b.count / count)"
    TO   "0"
    CASES "estimate: two halves*")

# Weights that do not add up to 1 count some light twice.
ljus_break_it(NAME monte_carlo-balance HEADER path/direct_light.hpp TEST monte_carlo
    FROM "T(1) / (T(1) + other / pdf)"
    TO   "T(1)"
    CASES "monte carlo: weights*")
ljus_break_it(NAME monte_carlo-power HEADER path/direct_light.hpp TEST monte_carlo
    FROM "(pdf > other ? T(1) : q * q) / (T(1) + q * q)"
    TO   "T(1) / (T(1) + q * q)"
    CASES "monte carlo: weights*")

# The survivors are not divided by their chance, as in the report's program.
ljus_break_it(NAME monte_carlo-roulette HEADER path/path_state.hpp TEST monte_carlo
    FROM "throughput /= probability;"
    TO   "(void)throughput;"
    CASES "monte carlo: roulette*")

# A density that forgets what its sampler does.
ljus_break_it(NAME monte_carlo-uniform HEADER math/sampling.hpp TEST monte_carlo
    FROM "return d.z > T(0) ? std::numbers::inv_pi_v<T> / T(2) : T(0);"
    TO   "return d.z > T(0) ? std::numbers::inv_pi_v<T> : T(0);"
    CASES "monte carlo: the cosine*")

# Sobol's points as they are, the same in every run: an error that no run can see.
ljus_break_it(NAME monte_carlo-owen HEADER math/low_discrepancy.hpp TEST monte_carlo
    FROM "detail::owen_scrambled(detail::sobol(stream.index, d), stream.seed + d * odd);"
    TO   "detail::sobol(stream.index, d + 0 * odd);"
    CASES "monte carlo: errors fall*")
