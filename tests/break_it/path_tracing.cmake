# One light of several is asked, but answers for all.
ljus_break_it(NAME path-tracing-light-choice HEADER path/direct_light.hpp
    TEST path_tracing
    FROM "chosen.probability;"
    TO   "T(1);"
    CASES "path tracing: two lamps*")

# A lamp that is met counts in full, though shadow rays have counted it.
ljus_break_it(NAME path-tracing-emission-weight HEADER render/path_tracing.hpp
    TEST path_tracing
    FROM "return mis_weight(settings.heuristic, path.pdf,
                      pdf() * probability_of<T>(tracer.world().light_choice(), light));"
    TO   "return T(pdf() > T(0) ? 1 : 0);"
    CASES "path tracing: in a furnace every*")

# The last surface's lamp, seen by nobody but its shadow ray, which is weighed down.
ljus_break_it(NAME path-tracing-last-surface HEADER render/path_tracing.hpp
    TEST path_tracing
    FROM "if (path.depth == settings.max_depth && path.specular) {"
    TO   "if (path.depth == settings.max_depth) {"
    CASES "path tracing: in a furnace every*")

# Radiance leaves glass unchanged: only light that starts in the glass notices.
ljus_break_it(NAME path-tracing-n2 HEADER materials/glass.hpp TEST path_tracing
    FROM "transport == Transport::radiance ? eta * eta : T(1)"
    TO   "transport == Transport::radiance ? T(1) : T(1)"
    CASES "path tracing: a lamp embedded*")

# The way through glass is not measured.
ljus_break_it(NAME path-tracing-medium HEADER path/next_vertex.hpp TEST path_tracing
    FROM "path.throughput *= transmittance(path.medium, vertex->distance) * passage.through;"
    TO   "path.throughput *= passage.through;"
    CASES "path tracing: a slab*")

# A lamp that the path meets is taken for the only one.
ljus_break_it(NAME path-tracing-light-density HEADER render/path_tracing.hpp
    TEST path_strategies
    FROM "pdf() * probability_of<T>(tracer.world().light_choice(), light)"
    TO   "pdf()"
    CASES "multiple importance: all ways*")

# Shadow rays are believed, and the lamp that a path meets is counted as well.
ljus_break_it(NAME path-tracing-shadow-rays-alone HEADER render/path_tracing.hpp
    TEST path_strategies
    FROM "if (settings.heuristic == MisHeuristic::shadow_rays) return T(0);"
    TO   "if (settings.heuristic == MisHeuristic::shadow_rays) return T(1);"
    CASES "multiple importance: all ways*")

# Squares on one side only.
ljus_break_it(NAME path-tracing-power HEADER path/direct_light.hpp
    TEST path_strategies
    FROM "(pdf > other ? T(1) : q * q) / (T(1) + q * q)"
    TO   "(pdf > other ? T(1) : q) / (T(1) + q * q)"
    CASES "multiple importance: the shares*")

# A survivor is paid for as if the most likely outcome had been certain.
ljus_break_it(NAME path-tracing-roulette-most HEADER path/path_state.hpp
    TEST path_strategies
    FROM "throughput /= probability;"
    TO   "throughput /= std::min(T(1), carried / threshold);"
    CASES "roulette: a hundred seeds*")

# The plain tracer counts a lamp twice: by a shadow ray and by the next one on.
ljus_break_it(NAME path-tracing-plain-twice HEADER render/plain_path_tracing.hpp
    TEST path_tracing
    FROM "lamps_count = next->specular;"
    TO   ""
    CASES "path tracing: the plain one*")

# The density of a moving lamp's point as if it had not moved.
ljus_break_it(NAME path-tracing-lamp-time HEADER path/direct_light.hpp
    TEST path_tracing
    FROM "at_time(shape, lamp.time)"
    TO   "at_time(shape, T(0))"
    CASES "path tracing: a lamp's share*")

# Roulette takes what n^2 does to the throughput for a loss.
ljus_break_it(NAME path-tracing-eta HEADER render/path_tracing.hpp TEST path_tracing
    FROM "!survives(path.throughput, path.eta_scale,"
    TO   "!survives(path.throughput, T(1),"
    CASES "path tracing: what n^2 takes*")
