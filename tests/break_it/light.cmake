# Light from behind the lamp.
ljus_break_it(NAME light-one-sided HEADER scene/light.hpp TEST light
    FROM "glm::dot(wi, seen.point.normal) < T(0) && "
    TO   ""
    CASES "light: a square lamp*")

# The inverse square that the report's program forgot.
ljus_break_it(NAME light-inverse-square HEADER scene/light.hpp TEST light
    FROM "light.emission / distance2"
    TO   "light.emission"
    CASES "light: a point light*")
