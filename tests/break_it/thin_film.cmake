# A wave that is reflected by the denser side turns over. Forgotten, a film of no
# thickness is the brightest.
ljus_break_it(NAME thin_film-half-wave HEADER optics/thin_film.hpp TEST thin_film
    FROM "std::sin(per_g * g)"
    TO   "std::cos(per_g * g)"
    CASES "thin film: the numbers*")

# The cosine outside in place of the one in the film: right from above only.
ljus_break_it(NAME thin_film-cosine HEADER optics/thin_film.hpp TEST thin_film
    FROM "return cos_theta * cos_theta + (index - T(1)) * (index + T(1));"
    TO   "return index * index * cos_theta * cos_theta;"
    CASES "thin film: any index*")

# One polarisation for both: no Brewster's angle.
ljus_break_it(NAME thin_film-polarisation HEADER optics/thin_film.hpp TEST thin_film
    FROM "const auto p_wave = shares(p);"
    TO   "const auto p_wave = shares(p == T(0) ? p : beat);"
    CASES "thin film: any index*")

# Colours that no screen shows, cut off instead of mixed with grey.
ljus_break_it(NAME cie_observer-cut HEADER optics/cie_observer.hpp TEST thin_film
    FROM "if (keep == T(1)) return c;"
    TO   "return glm::clamp(c, T(0), T(1));"
    CASES "observer: a colour*")

# An eye that sees fringes however thick the film is.
ljus_break_it(NAME film_color-fade HEADER optics/film_color.hpp TEST thin_film
    FROM "std::exp(-g.variance * phase * phase)"
    TO   "T(1)"
    CASES "film colours:*")

# Beyond the table: nothing.
ljus_break_it(NAME film_table-mean HEADER optics/film_table.hpp TEST thin_film
    FROM "thick_film(cosine(column), n)"
    TO   "0 * n"
    CASES "film table: as*")

# A square that underflows: 0/0 at the grazing angle.
ljus_break_it(NAME thin_film-underflow HEADER optics/thin_film.hpp TEST thin_film
    FROM "root = T(2) * cos_theta / q, ratio = root * root;"
    TO   "ratio = T(4) * c2 / (q * q);"
    CASES "thin film: shares of light*")

# The two widths of a bell change places: within what the fit is off its table.
ljus_break_it(NAME cie_observer-bell HEADER optics/cie_observer.hpp TEST thin_film
    FROM "bell(501.1, 0.0490, 0.0382)"
    TO   "bell(501.1, 0.0382, 0.0490)"
    CASES "observer: the fit's*")

# The cell behind the last one is read, and weighs nothing: but for infinity.
ljus_break_it(NAME film_table-behind HEADER optics/film_table.hpp TEST thin_film
    FROM "table.cosines - 2"
    TO   "table.cosines - 1"
    CASES "film colour: a table by hand*")

# One minus R, where next to nothing goes through.
ljus_break_it(NAME thin_film-small HEADER optics/thin_film.hpp TEST thin_film
    FROM "ratio < T(1) ? ratio"
    TO   "ratio < T(0) ? ratio"
    CASES "thin film: what is small*")

# Grey brighter than the screen.
ljus_break_it(NAME thin_film-gamut-grey HEADER optics/cie_observer.hpp TEST thin_film
    FROM "std::clamp(luminance(c), T(0), T(1))"
    TO   "luminance(c)"
    CASES "observer: what is brighter*")

# The fringes of long paths need more wavelengths.
ljus_break_it(NAME thin_film-table-step HEADER optics/film_table.hpp TEST thin_film
    FROM "std::min(2.0, finest)"
    TO   "2.0"
    CASES "film table: long paths*")

# A colour that can be shown is rounded, and counted as one that cannot.
ljus_break_it(NAME gamut-same HEADER optics/cie_observer.hpp TEST thin_film
    FROM "if (keep == T(1)) return c;"
    TO   ""
    CASES "observer: into the gamut*")

# Near grazing, an index near 1 is subtracted from 1.
ljus_break_it(NAME thin-film-cosine HEADER optics/thin_film.hpp TEST thin_film
    FROM "cos_theta * cos_theta + (index - T(1)) * (index + T(1))"
    TO   "index * index - (T(1) - cos_theta * cos_theta)"
    CASES "thin film: what is small*")
