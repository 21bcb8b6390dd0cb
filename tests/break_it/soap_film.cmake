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
ljus_break_it(NAME thin_surfaces-shadow HEADER path/next_vertex.hpp TEST soap_film
    FROM "if (!passed) break;
            through"
    TO   "if (!passed || passed) break;
            through"
    CASES "thin sheets: a lamp*")

# The film is not there.
ljus_break_it(NAME thin_surfaces-clear HEADER path/next_vertex.hpp TEST soap_film
    FROM "through *= *passed;"
    TO   "through *= T(1);"
    CASES "thin sheets: a lamp*")

# The paths that pass do not make up for those that were stopped.
ljus_break_it(NAME thin_surfaces-chance HEADER path/next_vertex.hpp TEST soap_film
    FROM "passage.through *= *passed / (T(1) - stop);"
    TO   "passage.through *= *passed;"
    CASES "thin sheets: what a path*")

# One of 25 paths is stopped, and the 24 others are not made up for: the bubble's caustic
# is dark.
ljus_break_it(NAME thin_surfaces-photon HEADER path/continue_path.hpp TEST soap_film
    FROM "path.throughput /= vertex.stop_probability;"
    TO   "(void)0;"
    CASES "thin sheets: a bubble in a furnace*")

# Reflected as if the film were equally thick everywhere: the bubble shows in a furnace.
ljus_break_it(NAME thin_surfaces-place HEADER path/next_vertex.hpp TEST soap_film
    FROM "const auto& here = material_at(m, vertex.point.position, vertex.uv);"
    TO   "const auto& here = m;"
    CASES "thin sheets: a bubble in a furnace*")

# What the sheets on the way to the sky let through is forgotten: a mean of all colours.
ljus_break_it(NAME thin_surfaces-sky HEADER path/next_vertex.hpp TEST sky
    FROM "        path.throughput *= passage.through;\n        return vertex;"
    TO   "        return vertex;"
    CASES "sky: behind a pane*")
