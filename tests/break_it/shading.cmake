# The dead are not paid for.
ljus_break_it(NAME shading-roulette HEADER path/shading.hpp TEST shading
    FROM "throughput /= probability;"
    TO   ""
    CASES "shading: roulette*")

# Roulette takes the n^2 of radiance in glass for a loss.
ljus_break_it(NAME shading-eta_scale HEADER path/shading.hpp TEST shading
    FROM "max_component(throughput) / eta_scale"
    TO   "max_component(throughput)"
    CASES "shading: roulette*")

# Coming out of glass, a path takes the glass along.
ljus_break_it(NAME shading-medium HEADER path/shading.hpp TEST shading
    FROM "wi.z < T(0) ? absorption(material) : RgbT<T>{T(0)}"
    TO   "absorption(material)"
    CASES "shading: what a path is in*")
