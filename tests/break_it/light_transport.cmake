# The report's g: no surface casts a shadow.
ljus_break_it(NAME transport-visibility HEADER path/light_transport.hpp
    TEST light_transport
    FROM "if (!(squared > T(0)) || occluded(world, spawn_ray_to(x, other))) return T(0);"
    TO   "if (!(squared > T(0))) return T(0);"
    CASES "light_transport: g is*")

# 1/r in place of 1/r^2.
ljus_break_it(NAME transport-square HEADER path/light_transport.hpp
    TEST light_transport
    FROM "return T(1) / squared;"
    TO   "return T(1) / std::sqrt(squared);"
    CASES "light_transport: g is*")

# What was scattered before is forgotten: every term counts as seen by the eye.
ljus_break_it(NAME transport-vertex HEADER path/light_transport.hpp
    TEST light_transport
    FROM "states = wanted.step(states, letter);"
    TO   "(void)letter;"
    CASES "light_transport: cut short*")

# A star that asks for one at least.
ljus_break_it(NAME class-star HEADER path/light_path_expression.hpp TEST light_transport
    FROM "if (sign != '+') part.empty = true;"
    TO   "if (sign == '?') part.empty = true;"
    CASES "light_transport: classes of paths*")

# A part that may be empty hides what stands before it.
ljus_break_it(NAME class-empty HEADER path/light_path_expression.hpp TEST light_transport
    FROM "next.last | (next.empty ? all.last : 0)"
    TO   "next.last"
    CASES "light_transport: classes of paths*")

# A renderer that carries some paths is said to cost nothing.
ljus_break_it(NAME only-paths-counts HEADER path/light_transport.hpp TEST light_transport
    FROM "auto own = context_of(context.stream, context.counts, log);"
    TO   "Counts none; auto own = context_of(context.stream, none, log);"
    CASES "light_transport: the parts of a picture*")
