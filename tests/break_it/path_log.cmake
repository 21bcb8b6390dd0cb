# An indirect ray that meets the lamp adds it again, straight or as a caustic.
ljus_break_it(NAME photon-mapping-emission HEADER render/photon_mapping.hpp TEST path_log
    FROM "at.emits() && !path.met_diffuse"
    TO   "at.emits()"
    CASES "path log: a gather ray*")

# Behind a mirror the camera has met nothing diffuse: it may see the lamp.
ljus_break_it(NAME photon-mapping-mirrored-lamp HEADER path/camera_path.hpp
    TEST path_log
    FROM "path.met_diffuse || !next.specular"
    TO   "true"
    CASES "path log: each term*")
