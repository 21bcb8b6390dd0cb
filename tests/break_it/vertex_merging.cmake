# Mergers are forgotten in the sums of the vertices after them.
ljus_break_it(NAME vertex_merging-eta HEADER path/subpath_weights.hpp TEST vertex_merging
    FROM "(at.join + merging + back * at.further) * cosine / pdf"
    TO   "(at.join + back * at.further) * cosine / pdf"
    CASES "vertex merging: the recursion*")

# A mirror can be joined to.
ljus_break_it(NAME vertex_merging-mirror HEADER path/subpath_weights.hpp
    TEST vertex_merging
    FROM "return {0, at.further * cosine};"
    TO   "return {1, at.further * cosine};"
    CASES "vertex merging: the recursion*")

# A shadow ray is taken to choose its point as photons do.
ljus_break_it(NAME vertex_merging-start HEADER path/subpath_weights.hpp
    TEST vertex_merging
    FROM "return {end.direct / end.pdf,"
    TO   "return {1 / end.pdf,"
    CASES "vertex merging: the recursion*")

# The density of the way there is taken for that of the way back.
ljus_break_it(NAME vertex_merging-back HEADER path/subpath_weights.hpp
    TEST vertex_merging
    FROM "pdf(material, to_local(at.frame, wi), at.wo)"
    TO   "pdf(material, at.wo, to_local(at.frame, wi))"
    CASES "vertex merging: in a sphere*")

# The density of a point of the lamp is not one per area.
ljus_break_it(NAME vertex_merging-lamp HEADER path/subpath_weights.hpp
    TEST vertex_merging
    FROM "double(glm::dot(way, way)),"
    TO   "1,"
    CASES "vertex merging: in a sphere*")

# One light path of N is connected, with the flux of one of N.
ljus_break_it(NAME vertex_merging-paths HEADER render/vertex_merging.hpp
    TEST vertex_merging
    FROM "double(merger.settings().paths) * weight_against(sum)"
    TO   "weight_against(sum)"
    CASES "vertex merging: in a sphere*")

# Photons count whole, and connections besides.
ljus_break_it(NAME vertex_merging-twice HEADER render/vertex_merging.hpp
    TEST vertex_merging
    FROM "T(weight_against(sum) / area)"
    TO   "T(1 / area)"
    CASES "vertex merging: below a point light*")

# A connection does not see at which angle it meets the light path's surface.
ljus_break_it(NAME vertex_merging-cosine HEADER render/vertex_merging.hpp
    TEST vertex_merging
    FROM "T(there.cosine / d2 * factor)"
    TO   "T(1 / d2 * factor)"
    CASES "vertex merging: in a sphere*")

# A photon's vertex is counted by both of its paths.
ljus_break_it(NAME vertex_merging-depth HEADER render/vertex_merging.hpp
    TEST vertex_merging
    FROM "x.depth + y.depth - 1 > settings.max_depth"
    TO   "x.depth + y.depth > settings.max_depth"
    CASES "vertex merging: the limit*")

# The letters of a connected path lack a surface.
ljus_break_it(NAME vertex_merging-letters HEADER photons/light_paths.hpp
    TEST vertex_merging
    FROM [["DD" + letters]]
    TO   [["D" + letters]]
    CASES "vertex merging: its terms*")

# All passes have the same light paths.
ljus_break_it(NAME vertex_merging-passes HEADER render/vertex_merging.hpp
    TEST vertex_merging
    FROM "settings.iteration = static_cast<std::uint64_t>(pass);"
    TO   ""
    CASES "vertex merging: passes*")

# The density of the camera's vertex has the cosine of the other end.
ljus_break_it(NAME vertex_merging-density HEADER render/vertex_merging.hpp
    TEST vertex_merging
    FROM "there.pdf * here.cosine / d2"
    TO   "there.pdf * there.cosine / d2"
    CASES "vertex merging: a connection*")

# The questions to the map are not counted.
ljus_break_it(NAME vertex_merging-queries HEADER render/vertex_merging.hpp
    TEST vertex_merging
    FROM "++counts.map_queries;"
    TO   ""
    CASES "vertex merging: below a point light*")
