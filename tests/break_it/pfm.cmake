# The same of a scale.
ljus_break_it(NAME pfm-scale-end HEADER io/pfm.hpp TEST pfm
    FROM "if (std::isfinite(value) && !std::isfinite(scaled))"
    TO   "if (std::isnan(scaled))"
    CASES "pfm: big-endian*")
