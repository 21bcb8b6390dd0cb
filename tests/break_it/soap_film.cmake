# All light goes through, and some is reflected as well.
ljus_break_it(NAME soap_film-energy HEADER materials/soap_film.hpp TEST soap_film
    FROM "RgbT<T>{T(1)} - reflectance(film, wo.z, thickness_at(film, position))"
    TO   "RgbT<T>{T(1)} - T(0) * reflectance(film, wo.z, thickness_at(film, position))"
    CASES "soap film: what is not*")

# Thick at the top.
ljus_break_it(NAME soap_film-gravity HEADER materials/soap_film.hpp TEST soap_film
    FROM "std::exp(-height / film.scale)"
    TO   "std::exp(height / film.scale)"
    CASES "soap film: hangs*")

# The film hides the lamp.
ljus_break_it(NAME thin_surfaces-shadow HEADER path/thin_surfaces.hpp TEST soap_film
    FROM "if (!t) break;"
    TO   "if (!t || t) break;"
    CASES "thin sheets: a lamp*")

# The film is not there.
ljus_break_it(NAME thin_surfaces-clear HEADER path/thin_surfaces.hpp TEST soap_film
    FROM "through *= *t;"
    TO   "through *= T(1);"
    CASES "thin sheets: a lamp*")

# One of 25 paths is stopped, and the 24 others are not made up for.
ljus_break_it(NAME thin_surfaces-chance HEADER path/thin_surfaces.hpp TEST soap_film
    FROM "return through / chance;"
    TO   "return through;"
    CASES "thin sheets: what a path*")

# The same of photons: the bubble's caustic is dark.
ljus_break_it(NAME thin_surfaces-photon HEADER photons/photon_path.hpp TEST soap_film
    FROM "scattered.weight / photon.chance"
    TO   "scattered.weight"
    CASES "thin sheets: photon mapping*")

# Reflected as if the film were equally thick everywhere: the bubble shows in a furnace.
ljus_break_it(NAME thin_surfaces-place HEADER path/scatter.hpp TEST soap_film
    FROM "material_at(material, surface.point.position, surface.uv)"
    TO   "material"
    CASES "thin sheets: a bubble in a furnace*")
