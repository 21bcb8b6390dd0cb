# An indirect ray that meets the lamp adds it again, straight or as a caustic.
ljus_break_it(NAME photon-mapping-emission HEADER render/photon_mapping.hpp TEST path_log
    FROM "vertex->emits() && !path.met_diffuse"
    TO   "vertex->emits()"
    CASES "path log: a gather ray*")

# Behind a mirror the camera has met nothing diffuse: it may see the lamp.
ljus_break_it(NAME photon-mapping-mirrored-lamp HEADER path/continue_path.hpp
    TEST path_log
    FROM "(next.specular ? path.met_specular : path.met_diffuse) = true;"
    TO   "path.met_diffuse = true;"
    CASES "path log: each term*")
