# Photons that are in the map already are kept until all are.
ljus_break_it(NAME memory-photons HEADER photons/photon_map.hpp TEST memory
    FROM "std::vector<PhotonT<T>>().swap(part);"
    TO   ""
    CASES "memory: a photon*")

# What was freed stays with the process, beside the arrays that are made of it.
ljus_break_it(NAME memory-freed HEADER accel/detail/stored_array.hpp TEST memory
    FROM "::malloc_trim(0);"
    TO   ""
    CASES "memory: a photon takes*")

# The sums of all pixels at a time.
ljus_break_it(NAME memory-pixels HEADER render/adaptive.hpp TEST memory
    FROM "picture.samples - rule.first < rule.more)"
    TO   "picture.samples > 0)"
    CASES "memory: adaptive*")

# The lists of a mesh file, until its tree is there.
ljus_break_it(NAME memory-triangles HEADER accel/detail/bvh_build.hpp TEST memory
    FROM "std::vector<BoxT<T>>().swap(boxes);"
    TO   ""
    CASES "memory: a triangle*")

# An STL file, until its tree is there.
ljus_break_it(NAME memory-stl HEADER io/load_stl.hpp TEST memory
    FROM "const Bytes own = std::move(bytes);"
    TO   "static Bytes own;
            own = std::move(bytes);"
    CASES "memory: a triangle*")

# Memory is foretold as before photons were freed while their map is made.
ljus_break_it(NAME memory-foretold HEADER photons/photon_pass.hpp TEST memory
    FROM "(sizeof(PhotonT<T>) + 4 * sizeof(T))"
    TO   "2 * sizeof(PhotonT<T>)"
    CASES "memory: a photon takes*")
