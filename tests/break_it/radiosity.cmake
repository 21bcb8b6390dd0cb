# A polygon that is not cut at the plane of the other: light from behind a wall.
ljus_break_it(NAME exchange-area-clip HEADER radiosity/exchange_area.hpp TEST form_factor
    FROM "const Facet a = detail::clipped(one, two.corners[0], n2, 1e-13 * unit);"
    TO   "const Facet a = one;"
    CASES "exchange_area: what lies behind*")

# The constant that is the same for all edges but not for those that are parallel.
ljus_break_it(NAME exchange-area-constant HEADER radiosity/exchange_area.hpp TEST form_factor
    FROM " - 1.5 * length_v * back"
    TO   ""
    CASES "exchange_area: quads anywhere*")

# Edges that touch in between are left to a rule that can cope with ends only.
ljus_break_it(NAME exchange-area-ends HEADER radiosity/exchange_area.hpp TEST form_factor
    FROM "ends[i] = glm::clamp(ends[i], 0.0, 1.0);"
    TO   "ends[i] = 1;"
    CASES "exchange_area: reciprocity*")

# Far away the closed form is a small difference of large numbers.
ljus_break_it(NAME exchange-area-far HEADER radiosity/exchange_area.hpp TEST form_factor
    FROM "> 8 * longer"
    TO   "> 1e9 * longer"
    CASES "exchange_area: sizes*")

# What lies below the horizon counts against what lies above.
ljus_break_it(NAME form-factor-horizon HEADER geometry/facet.hpp TEST form_factor
    FROM "const Facet seen = detail::clipped(facet, point, normal);"
    TO   "const Facet seen = facet;"
    CASES "form_factor: from a point*")

# The series of the fast twin with another ratio of its terms.
ljus_break_it(NAME form-factor-series HEADER geometry/facet.hpp TEST form_factor
    FROM "(double(n) + 1.5)"
    TO   "(double(n) + 1.6)"
    CASES "form_factor: the fast twin*" COMPILED)

# It does not see the horizon.
ljus_break_it(NAME form-factor-fast-horizon HEADER geometry/facet.hpp TEST form_factor
    FROM "!(high[i] >= 0 && cosine[i] >= 0.5)"
    TO   "!(cosine[i] >= 0.5)"
    CASES "form_factor: the fast twin*")

# Emission on both sides.
ljus_break_it(NAME patches-emission HEADER radiosity/patches.hpp TEST radiosity
    FROM "back ? 0 : std::numbers::pi"
    TO   "std::numbers::pi"
    CASES "radiosity: the light of one lamp*")

# Radiance for radiosity: pi is missing.
ljus_break_it(NAME patches-pi HEADER radiosity/patches.hpp TEST radiosity
    FROM "back ? 0 : std::numbers::pi"
    TO   "back ? 0 : 1"
    CASES "radiosity: furnaces")

# The upper triangle of a cell taken for the lower one.
ljus_break_it(NAME patches-upper HEADER radiosity/patch_grid.hpp TEST patches
    FROM "+ (upper ? 1 : 0)"
    TO   ""
    CASES "patches: each place*")

# Nothing ever stands between two patches.
ljus_break_it(NAME form-factors-visible HEADER radiosity/patch_rays.hpp TEST patches
    FROM "if (!occluded(world, spawn_ray_to(a, b))) visible += weight;"
    TO   "visible += weight;"
    CASES "form_factors: what stands between")

# Directions uniform over the hemisphere: the cosine is forgotten.
ljus_break_it(NAME form-factors-cosine HEADER radiosity/patch_rays.hpp TEST patches
    FROM "sample_cosine_hemisphere(u)"
    TO   "sample_uniform_hemisphere(u)"
    CASES "form_factors: rays agree*")

# Each row as its rays found it: what one patch sends is not what the others get.
ljus_break_it(NAME form-factors-symmetry HEADER radiosity/form_factor_matrix.hpp TEST patches
    FROM "            back = there;"
    TO   ""
    CASES "form_factors: the closed form*")

# Rows are closed by rows alone: symmetry, and with it the columns, are lost.
ljus_break_it(NAME form-factors-closed HEADER radiosity/form_factor_matrix.hpp TEST radiosity
    FROM "factors.exchange[i * n + j] *= scale[i] * scale[j];"
    TO   "factors.exchange[i * n + j] *= scale[i] * scale[i];"
    CASES "radiosity: furnaces")

# The transpose: light goes by the form factor of the other direction.
ljus_break_it(NAME solve-transpose HEADER radiosity/radiosity_solve.hpp TEST radiosity
    FROM "unsent[j] += row[j] / factors.area[j] * patches[j].albedo * sent;"
    TO   "unsent[j] += row[j] / factors.area[i] * patches[j].albedo * sent;"
    CASES "radiosity: a ball within a ball*")

# A hollow patch sends nothing to itself.
ljus_break_it(NAME solve-hollow HEADER radiosity/radiosity_solve.hpp TEST radiosity
    FROM "unsent[i] / (1.0 - factors(i, i) * patches[i].albedo)"
    TO   "unsent[i]"
    CASES "radiosity: furnaces")

# Rows that sum to more than 1 make light out of nothing.
ljus_break_it(NAME solve-endless HEADER radiosity/radiosity_solve.hpp TEST radiosity
    FROM "require(most < 1 - 1e-12,"
    TO   "require(most > -1,"
    CASES "radiosity: extremes")

# What escapes is forgotten.
ljus_break_it(NAME radiosity-escaped HEADER radiosity/radiosity.hpp TEST radiosity
    FROM "(1 - factors.row_sum(i))"
    TO   "(0 * factors.row_sum(i))"
    CASES "radiosity: the light of one lamp*")

# Irradiance shown as if it were radiance.
ljus_break_it(NAME light-map-pi HEADER radiosity/light_map.hpp TEST light_map
    FROM "diffuse_albedo(m) * std::numbers::inv_pi * irradiance"
    TO   "diffuse_albedo(m) * irradiance"
    CASES "light_map: what a ray finds")

# A wall shows its front's light on its back.
ljus_break_it(NAME light-map-side HEADER radiosity/light_map.hpp TEST light_map
    FROM "view.grid_of()[hit->object.type][hit->object.index][side.back];"
    TO   "view.grid_of()[hit->object.type][hit->object.index][0];"
    CASES "light_map: what a ray finds")

# A file that was cut short or damaged is taken for a light map.
ljus_break_it(NAME light-map-checksum HEADER io/binary_file.hpp TEST light_map
    FROM "checksum != detail::checksum(file.bytes)"
    TO   "false"
    CASES "light_map: a file cut short*")

# Pieces of one plane, which by rounding stand before each other.
ljus_break_it(NAME patches-rounding HEADER radiosity/patches.hpp TEST patches
    FROM "64 * unit *"
    TO   "0 * unit *"
    CASES "patches: what stands between*")

# Rays from two patches, weighted the wrong way round.
ljus_break_it(NAME form-factor-weights HEADER radiosity/form_factor_matrix.hpp TEST patches
    FROM "(there * aj + back * ai)"
    TO   "(there * ai + back * aj)"
    CASES "form_factors: rays from both*")

# Grey by two of three channels.
ljus_break_it(NAME radiosity-grey HEADER radiosity/radiosity_solve.hpp TEST radiosity
    FROM "patch.albedo == RgbT<double>(patch.albedo.x)"
    TO   "patch.albedo.x == patch.albedo.y"
    CASES "radiosity: patches of different areas*")

# What only touches a plane is left as a facet of two corners.
ljus_break_it(NAME facet-touch HEADER geometry/facet.hpp TEST form_factor
    FROM "return part.count < 3 ? Facet{} : part;"
    TO   "return part;"
    CASES "facet: what only touches*")

# The width of the plane forgotten.
ljus_break_it(NAME facet-width HEADER geometry/facet.hpp TEST form_factor
    FROM "std::abs(h) <= width ? 0.0 : h"
    TO   "h"
    CASES "facet: what only touches*")

# A light map of another version is read as if it were this one's.
ljus_break_it(NAME light-map-version HEADER io/binary_file.hpp TEST light_map
    FROM "found != format.version"
    TO   "false"
    CASES "light_map: a file cut short*")

# The number of patches is believed, though there are more.
ljus_break_it(NAME light-map-count HEADER io/binary_file.hpp TEST light_map
    FROM "left() / bytes_of_one == count"
    TO   "left() / bytes_of_one >= count"
    CASES "light_map: a file cut short*")

# A file of a few large grids holds more patches than were allowed.
ljus_break_it(NAME light-map-most HEADER io/light_map_file.hpp TEST light_map
    FROM "if (patches > most)"
    TO   "if (false)"
    CASES "light_map: it comes back*")

# A map is believed that has a grid of a shape beyond the last one.
ljus_break_it(NAME light-map-beyond HEADER radiosity/light_map.hpp TEST light_map
    FROM "grid.object.index < grid_of_[grid.object.type].size()"
    TO   "grid.object.index <= grid_of_[grid.object.type].size()"
    CASES "light_map: a map of another scene*")

# A textured lamp is drawn in one colour.
ljus_break_it(NAME light-map-picture HEADER radiosity/light_map.hpp TEST patches
    FROM "if (!side.back) sum = vertex_at(world, ray, *hit).object.emission;"
    TO   ""
    CASES "patches: a textured lamp*")
