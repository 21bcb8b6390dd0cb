# Tinted once, whatever lies between the boundaries: the report's program.
ljus_break_it(NAME absorption-distance HEADER optics/absorption.hpp TEST absorption
    FROM "std::exp(-sigma.x * distance)"
    TO   "std::exp(-sigma.x)")
