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

# A path that split off tells its last vertex once for each of its letters.
ljus_break_it(NAME path-log-split HEADER path/path_log.hpp TEST path_log
    FROM "log.letters += 'S';"
    TO   "log_vertex(log, path);"
    CASES "path log: a vertex behind*")
