# One strength of a resonance for all of them.
ljus_break_it(NAME dispersion-sellmeier HEADER optics/dispersion.hpp TEST dispersion
    FROM "n2 += law.b[i] * square / (square - law.c[i]);"
    TO   "n2 += law.b[0] * square / (square - law.c[i]);"
    CASES "dispersion: indices*")

# An index for yellow light that is the index for long waves.
ljus_break_it(NAME dispersion-abbe HEADER optics/dispersion.hpp TEST dispersion
    FROM "return {index - b * per_square(line_d<T>), b};"
    TO   "return {index, b};"
    CASES "dispersion: indices*")

# Each channel as strong as its negative part makes it: white light turns red.
ljus_break_it(NAME dispersion-white HEADER optics/dispersion.hpp TEST dispersion
    FROM "table.colors[i] / all;"
    TO   "table.colors[i] / all.y;"
    CASES "dispersion: the mean colour*")

# Negative channels stay.
ljus_break_it(NAME dispersion-negative HEADER optics/dispersion.hpp TEST dispersion
    FROM "= glm::max(pure, 0.0);"
    TO   "= pure;"
    CASES "dispersion: the mean colour*")

# Wavelengths are chosen evenly, but weighted as if by the response.
ljus_break_it(NAME dispersion-evenly HEADER optics/dispersion.hpp TEST dispersion
    FROM "(band.index + band.within) / double(sums.size())"
    TO   "double(u)"
    CASES "dispersion: wavelengths are chosen*")

# All light is refracted as yellow light.
ljus_break_it(NAME dispersion-one-index HEADER materials/dispersive_glass.hpp
    TEST dispersion
    FROM "return {.index = refractive_index(glass.law, nm), .absorption"
    TO   "return {.index = refractive_index(glass.law, line_d<T> + nm * T(0)), .absorption"
    CASES "dispersion: a prism*")

# A new wavelength, and another colour, at each surface of the glass.
ljus_break_it(NAME dispersion-again HEADER path/next_vertex.hpp TEST dispersion
    FROM "if (path.wavelength == T(0)) {"
    TO   "if (path.wavelength >= T(0)) {"
    CASES "dispersion: a path keeps*")

# The path has a wavelength, but carries the light of all.
ljus_break_it(NAME dispersion-colorless HEADER path/next_vertex.hpp TEST dispersion
    FROM "path.throughput *= wavelength_color(path.wavelength);"
    TO   ""
    CASES "dispersion: a path keeps*")

# The body beyond a contact has the index of yellow light.
ljus_break_it(NAME dispersion-contact HEADER path/next_vertex.hpp TEST dispersion
    FROM "return refractive_index(at_wavelength(m, wavelength));"
    TO   "return refractive_index(at_wavelength(m, line_d<decltype(wavelength)>));"
    CASES "dispersion: bodies that touch*")

# What the choice of a wavelength takes counts as absorbed.
ljus_break_it(NAME dispersion-audit HEADER photons/photon_path.hpp TEST dispersion
    FROM "audit.roulette += all - before;"
    TO   "audit.absorbed += all - before;"
    CASES "dispersion: photons keep account*")

# Paths of two wavelengths are joined.
ljus_break_it(NAME dispersion-joined HEADER photons/light_paths.hpp TEST dispersion
    FROM "require(!Dispersive<M> || list.empty(),"
    TO   "require(true || list.empty(),"
    CASES "dispersion: what is not possible*")

# A texture over glass hides its index at another wavelength.
ljus_break_it(NAME dispersion-textured HEADER materials/textured.hpp TEST dispersion
    FROM "return at_wavelength(m.base, nm);"
    TO   "return at_wavelength(m.base, nm + T(100));"
    CASES "dispersion: a normal map*")
