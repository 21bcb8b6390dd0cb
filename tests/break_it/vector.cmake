ljus_break_it(NAME vector-is-finite HEADER math/vector.hpp TEST vector
    FROM " && std::isfinite(v.z)"
    TO   "")

ljus_break_it(NAME vector-max HEADER math/vector.hpp TEST vector
    FROM "v.y < v.z ? v.z : v.y"
    TO   "v.y")
