# The dead are not paid for.
ljus_break_it(NAME vertex-roulette HEADER path/path_state.hpp TEST vertex
    FROM "throughput /= probability;"
    TO   ""
    CASES "vertex: roulette*")

# Roulette takes the n^2 of radiance in glass for a loss.
ljus_break_it(NAME vertex-eta_scale HEADER path/path_state.hpp TEST vertex
    FROM "max_component(throughput) / eta_scale"
    TO   "max_component(throughput)"
    CASES "vertex: roulette*")

# Coming out of glass, a path takes the glass along.
ljus_break_it(NAME vertex-medium HEADER path/continue_path.hpp TEST vertex
    FROM "wi.z < T(0) ? absorption(material) : RgbT<T>{T(0)}"
    TO   "absorption(material)"
    CASES "vertex: what a path is in*")
