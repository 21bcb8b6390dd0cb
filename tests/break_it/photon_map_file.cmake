# A file that was cut short or damaged is taken for a map.
ljus_break_it(NAME map-file-checksum HEADER io/detail/map_bytes.hpp TEST photon_map_file
    FROM "checksum != map_checksum(file.bytes)"
    TO   "false"
    CASES "photon_map_file: a file with any bit*")

# The number of photons is believed.
ljus_break_it(NAME map-file-count HEADER io/detail/map_bytes.hpp TEST photon_map_file
    FROM "left() / bytes_of_one == count"
    TO   "true"
    CASES "photon_map_file: photons that no map*")

# A map of another version is read as if it were this one's.
ljus_break_it(NAME map-file-version HEADER io/detail/map_bytes.hpp TEST photon_map_file
    FROM "found != format.version"
    TO   "false"
    CASES "photon_map_file: what is wrong*")

# Photons in the tree's order: a second save or load has another tree.
ljus_break_it(NAME map-file-order HEADER io/photon_map_file.hpp TEST photon_map_file
    FROM "photons[map.tree.point_ids()[i]]"
    TO   "photons[i]"
    CASES "photon_map_file: a map comes back*")
