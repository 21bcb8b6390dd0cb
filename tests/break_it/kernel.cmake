# The report's program: 1 - d/r over pi r^2 is a third of the light.
ljus_break_it(NAME kernel-cone-factor HEADER photons/kernel.hpp TEST kernel
    FROM "T(3) * (T(1) - std::sqrt(x))"
    TO   "T(1) - std::sqrt(x)"
    CASES "kernel: the mean over*")

# A Gaussian as it comes, cut off at r, holds less than half of the light.
ljus_break_it(NAME kernel-gaussian-factor HEADER photons/kernel.hpp TEST kernel
    FROM "T(2.3130352854993312) *"
    TO   ""
    CASES "kernel: the mean over*")

# Epanechnikov's parabola for one dimension: 3/4 (1 - x^2) over [-1, 1].
ljus_break_it(NAME kernel-epanechnikov-factor HEADER photons/kernel.hpp TEST kernel
    FROM "T(2) * (T(1) - x)"
    TO   "T(1.5) * (T(1) - x)"
    CASES "kernel: the mean over*")
