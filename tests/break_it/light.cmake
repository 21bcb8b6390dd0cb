# Light from behind the lamp.
ljus_break_it(NAME light-one-sided HEADER scene/light.hpp TEST light
    FROM "glm::dot(sample->wi, point.normal) < T(0) && "
    TO   ""
    CASES "light: a square lamp*")

# The inverse square that the report's program forgot.
ljus_break_it(NAME light-inverse-square HEADER scene/light.hpp TEST light
    FROM "light.emission / distance2"
    TO   "light.emission"
    CASES "light: a point light*")

# A spot has the flux of its inner cone.
ljus_break_it(NAME light-spot-flux HEADER scene/make_light.hpp TEST light
    FROM "(made.inner + made.outer)"
    TO   "(made.outer + made.outer)"
    CASES "light: a spot's flux*")

# The corners of the scene are dark in a caustic of the sun.
ljus_break_it(NAME light-sun-disc HEADER scene/make_light.hpp TEST light
    FROM "T(1.001) * glm::length(half)"
    TO   "T(0.9) * glm::length(half)"
    CASES "light: a sun has the flux*")

# A density beyond all numbers, and 0/0 behind it.
ljus_break_it(NAME light-density HEADER scene/light.hpp TEST light
    FROM "std::isfinite(pdf)"
    TO   "true"
    CASES "light: what no picture*")

# A lamp that moves shines from where it was at first.
ljus_break_it(NAME light-time HEADER scene/light.hpp TEST light
    FROM "sample_towards(at_time(shape, time), from, u)"
    TO   "sample_towards(at_time(shape, T(0)), from, u)"
    CASES "light: a lamp that moves*")

# The density of a sample is forgotten.
ljus_break_it(NAME light-pdf HEADER scene/light.hpp TEST light
    FROM "const T pdf = sample->pdf;"
    TO   "const T pdf = sample->pdf;
    sample->pdf = T(0);"
    CASES "light: a sample says its density*")
