# Normals and albedos of mirrors and glass, in which denoisers see no edge.
ljus_break_it(NAME layers-mirror HEADER render/layers.hpp TEST layers
    FROM "path.depth == max_guide_depth ||"
    TO   "path.depth >= 1 ||"
    CASES "layers: normal and albedo*")

# The albedo behind glass with the n^2 of radiance.
ljus_break_it(NAME layers-flux HEADER render/layers.hpp TEST layers
    FROM "Transport::flux"
    TO   "Transport::radiance"
    CASES "layers: glass passes*")

# Caustics that come later are in the picture, and in no layer.
ljus_break_it(NAME layers-delayed HEADER render/layers.hpp TEST layers
    FROM "if ((log_.takers[item] >> k & 1) != 0)"
    TO   "if (false)"
    CASES "layers: the picture keeps*")

# Objects of different types have the same number.
ljus_break_it(NAME layers-object HEADER render/layers.hpp TEST layers
    FROM "number += world.objects()[type].size();"
    TO   "number += 0;"
    CASES "layers: a matt wall*")

# A caustic through glass has two letters S: it is in none of the four classes.
ljus_break_it(NAME layers-classes HEADER render/layers.hpp TEST layers
    FROM "ES*DS+L"
    TO   "ES*DSL"
    CASES "layers: the picture keeps*")

# Depth and position at the pixel's corner.
ljus_break_it(NAME layers-middle HEADER render/layers.hpp TEST layers
    FROM "T(x) + T(0.5), T(y) + T(0.5)"
    TO   "T(x), T(y)"
    CASES "layers: a matt wall*")
