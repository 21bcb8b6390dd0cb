# Light without end is loaded.
ljus_break_it(NAME hdr-exposure-end HEADER io/hdr.hpp TEST hdr
    FROM "if (!is_finite(color))"
    TO   "if (false)"
    CASES "hdr: the exposure*")
