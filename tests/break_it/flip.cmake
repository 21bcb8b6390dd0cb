# The eye's blur of blue and yellow without its second part.
ljus_break_it(NAME flip-blue-yellow HEADER image/flip.hpp TEST flip
    FROM "{13.5, 0.025}"
    TO   "{0, 0.025}"
    CASES "flip: a second*"
    COMPILED)

# In the dark colours are as strong as in the light.
ljus_break_it(NAME flip-hunt HEADER image/flip.hpp TEST flip
    FROM "return {lightness, 0.01 * lightness * 500 * (x - y),"
    TO   "return {lightness, 500 * (x - y),"
    CASES "flip: the distance*")

# A distance for small differences: the root of all three squares.
ljus_break_it(NAME flip-hyab HEADER image/flip.hpp TEST flip
    FROM "std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z)"
    TO   "glm::distance(a, b)"
    CASES "flip: the distance*")

# Edges are found, and points are not.
ljus_break_it(NAME flip-points HEADER image/flip.hpp TEST flip
    FROM "glm::max(std::abs(change.x), std::abs(change.y))"
    TO   "std::abs(change.x)"
    CASES "flip: a second*")

# Edges make a difference smaller.
ljus_break_it(NAME flip-power HEADER image/flip.hpp TEST flip
    FROM "std::pow(color, 1 - feature)"
    TO   "std::pow(color, 1 + feature)"
    CASES "flip: an edge*")

# Nothing blurred away: the colours are compared pixel by pixel.
ljus_break_it(NAME flip-blur HEADER image/flip.hpp TEST flip
    FROM "std::exp(-pi * pi * i * i / (ppd * ppd * breadth))"
    TO   "(i == 0 ? 1.0 : 0.0 * breadth)"
    CASES "flip: a chequerboard*")

# Outside of the picture it is dark.
ljus_break_it(NAME flip-border HEADER image/flip.hpp TEST flip
    FROM "const int row = glm::clamp(y + i, 0, height - 1);"
    TO   "const int row = glm::clamp(y + i, 0, height - 1); if (row != y + i) continue;"
    CASES "flip: pictures without*")

# One exposure for all.
ljus_break_it(NAME flip-exposures HEADER image/hdr_flip.hpp TEST flip
    FROM "std::exp2(exposures.first + part * (exposures.last - exposures.first))"
    TO   "std::exp2(exposures.last + 0 * part)"
    CASES "flip: HDR: the second*")

# A pixel without end, for which no exposure would be dark enough.
ljus_break_it(NAME flip-hdr-most HEADER image/hdr_flip.hpp TEST flip
    FROM "std::min(y, most)"
    TO   "y"
    CASES "flip: HDR: the film's curve*")

# A tile comes without what is around it.
ljus_break_it(NAME flip-tiles HEADER image/flip.hpp TEST flip
    FROM "const int around = eye_radius(ppd),"
    TO   "const int around = eye_radius(ppd) - 2,"
    CASES "flip: of a large*")
