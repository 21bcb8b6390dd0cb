# The same of a scale.
ljus_break_it(NAME pfm-scale-end HEADER io/pfm.hpp TEST pfm
    FROM "if (std::isfinite(value) && !std::isfinite(scaled))"
    TO   "if (std::isnan(scaled))"
    CASES "pfm: big-endian*")

# A comment is a width.
ljus_break_it(NAME pfm-comment HEADER io/detail/byte_reader.hpp TEST pfm
    FROM "if (c == '#') (void)line();"
    TO   ""
    CASES "pfm: comments*")
