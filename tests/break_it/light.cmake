# Light from behind the lamp.
ljus_break_it(NAME light-one-sided HEADER lights/area_light.hpp TEST light
    FROM "glm::dot(sample->wi, point.normal) < T(0) && "
    TO   ""
    CASES "light: a square lamp*")

# The inverse square that the report's program forgot.
ljus_break_it(NAME light-inverse-square HEADER lights/light.hpp TEST light
    FROM ".weight = sent / distance2"
    TO   ".weight = sent"
    CASES "light: a point light*")

# A spot has the flux of its inner cone.
ljus_break_it(NAME light-spot-flux HEADER lights/spot_light.hpp TEST light
    FROM "(light.inner + light.outer) * light.intensity"
    TO   "(light.outer + light.outer) * light.intensity"
    CASES "light: a spot's flux*")

# The corners of the scene are dark in a caustic of the sun.
ljus_break_it(NAME light-sun-disc HEADER scene/world.hpp TEST light
    FROM "Scalar(1.001) * glm::length(half)"
    TO   "Scalar(0.9) * glm::length(half)"
    CASES "light: a sun has the flux*")

# A density beyond all numbers, and 0/0 behind it.
ljus_break_it(NAME light-density HEADER lights/area_light.hpp TEST light
    FROM "std::isfinite(pdf)"
    TO   "true"
    CASES "light: what no picture*")

# A lamp that moves shines from where it was at first.
ljus_break_it(NAME light-time HEADER lights/area_light.hpp TEST light
    FROM "const auto& now = at_time(light.shape, time);
        const auto seen"
    TO   "const auto& now = at_time(light.shape, T(0));
        const auto seen"
    CASES "light: a lamp that moves*")

# The density of a sample is forgotten.
ljus_break_it(NAME light-pdf HEADER lights/area_light.hpp TEST light
    FROM "const T pdf = sample->pdf;"
    TO   "const T pdf = sample->pdf;
    sample->pdf = T(0);"
    CASES "light: a sample says its density*")

# A cone so narrow that it is empty.
ljus_break_it(NAME light-spot-needle HEADER lights/spot_light.hpp TEST light
    FROM "light.outer_degrees >= T(0.001)"
    TO   "light.outer_degrees > T(0)"
    CASES "light: the ends of what a spot*")
