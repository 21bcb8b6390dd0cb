# The cells around the pole count as much as those at the horizon.
ljus_break_it(NAME goniometric-sine HEADER lights/goniometric_light.hpp TEST goniometric
    FROM "detail::line_times_sine(first, (last - first) / length, made.polar[i],"
    TO   "detail::line_times_sine(first, (last - first) / length, 0 * made.polar[i],"
    CASES "goniometric: the flux*,goniometric: the density*")

# Directions are uniform within a cell.
ljus_break_it(NAME goniometric-in-cell HEADER lights/goniometric_light.hpp TEST goniometric
    FROM "const double both = part * (a + b);"
    TO   "const double both = 0 * part * (a + b);"
    CASES "goniometric: directions*")

# The polar angle is uniform within a cell.
ljus_break_it(NAME goniometric-polar HEADER lights/goniometric_light.hpp TEST goniometric
    FROM "double low = 0, high = length, x = part * length;"
    TO   "double low = 0, high = 0 * length, x = part * length;"
    CASES "goniometric: directions*")

# The type B has the axes of the type A.
ljus_break_it(NAME goniometric-axes HEADER lights/goniometric_light.hpp TEST goniometric
    FROM "return {aim, reference, side};"
    TO   "return {aim, side, reference};"
    CASES "goniometric: where the angles*")

# Half a turn is dark.
ljus_break_it(NAME goniometric-turn HEADER lights/goniometric_light.hpp TEST goniometric
    FROM "std::max(first, around - turn * std::floor((around - first) / turn))"
    TO   "around + 0 * turn"
    CASES "goniometric: the same in all*")

# Candelas count as watts per steradian.
ljus_break_it(NAME goniometric-candela HEADER lights/goniometric_light.hpp TEST goniometric
    FROM "return static_cast<T>(detail::lumens_of(light)) * light.watts_per_lumen;"
    TO   "return RgbT<T>{static_cast<T>(detail::lumens_of(light))};"
    CASES "goniometric: the density*,goniometric: photons*")

# The second half of the azimuths is a copy of the first, not its mirror image.
ljus_break_it(NAME ies-mirror HEADER io/load_ies.hpp TEST goniometric
    FROM "append(2 * plane - horizontal[column - 1], *this, column - 1);"
    TO   "append(2 * plane - horizontal[column - 1], *this, horizontal.size() - column);"
    CASES "goniometric: what a file leaves out*")

# The ballast factor is forgotten.
ljus_break_it(NAME ies-ballast HEADER io/load_ies.hpp TEST goniometric
    FROM [[factor *= in.number("the ballast factor", 1e-9, 1e9);]]
    TO   [[(void)in.number("the ballast factor", 1e-9, 1e9);]]
    CASES "goniometric: versions*")

# The number that tells how a file was made scales its intensities.
ljus_break_it(NAME ies-generation HEADER io/load_ies.hpp TEST goniometric
    FROM "if (!since_2019) factor *= second;"
    TO   "factor *= second;"
    CASES "goniometric: versions*")

# A comma separates only with a blank behind it.
ljus_break_it(NAME ies-comma HEADER io/load_ies.hpp TEST goniometric
    FROM "words.rest = {next, static_cast<std::size_t>(end - next)};"
    TO   ""
    CASES "goniometric: versions*")
