# Light without end is loaded.
ljus_break_it(NAME hdr-exposure-end HEADER io/hdr.hpp TEST hdr
    FROM "if (!is_finite(color))"
    TO   "if (false)"
    CASES "hdr: the exposure*")

# A row is coded only if it has at least eight pixels.
ljus_break_it(NAME hdr-narrow-row HEADER io/hdr.hpp TEST hdr
    FROM "width >= 8 && width <= 0x7fff"
    TO   "width <= 0x7fff"
    CASES "hdr: a row too narrow*")

# A run of no pixels is passed over.
ljus_break_it(NAME hdr-empty-run HEADER io/hdr.hpp TEST hdr
    FROM "count == 0 || count > row.size() - x"
    TO   "count > row.size() - x"
    CASES "hdr: what is wrong with a header*")

# Of a wide coded row the width's upper byte is taken for a colour's.
ljus_break_it(NAME hdr-wide-row HEADER io/hdr.hpp TEST hdr
    FROM "first[2] < 128)"
    TO   "first[2] < 2)"
    CASES "hdr: a coded row may have*")

# A colour is taken for the beginning of a coded row.
ljus_break_it(NAME hdr-plain-row HEADER io/hdr.hpp TEST hdr
    FROM "first[1] == 2 && first[2] < 128)"
    TO   "first[1] == 2)"
    CASES "hdr: a plain row*")

# The colour correction stays in the pixels.
ljus_break_it(NAME hdr-color-correction HEADER io/hdr.hpp TEST hdr
    FROM "if (!three && !line.starts_with(\"EXPOSURE=\")) continue;"
    TO   "if (!line.starts_with(\"EXPOSURE=\")) continue;"
    CASES "hdr: the colour correction*")

# Colours of other primaries are taken for those of sRGB.
ljus_break_it(NAME hdr-primaries HEADER io/hdr.hpp TEST hdr
    FROM "detail::convert(image.pixels, header.to_srgb, std::numeric_limits<T>::max());"
    TO   ""
    CASES "hdr: the colour correction*")

# A picture of a screen is taken for radiance.
ljus_break_it(NAME hdr-gamma HEADER io/hdr.hpp TEST hdr
    FROM "!= std::vector<double>{1.0})"
    TO   "== std::vector<double>{0.0})"
    CASES "hdr: the colour correction*")

# Of a long run the lower byte alone is counted.
ljus_break_it(NAME hdr-old-run HEADER io/hdr.hpp TEST hdr
    FROM "<< 8 * digit"
    TO   "<< 0 * digit"
    CASES "hdr: the coding from before 1991*")

# A repeat may be the first of a row.
ljus_break_it(NAME hdr-old-first HEADER io/hdr.hpp TEST hdr
    FROM "if (row.empty() || digit > 1"
    TO   "if (row.empty()) row.push_back(rgbe);\n        if (digit > 1"
    CASES "hdr: the coding from before 1991*")

# An exposure of 0 divides the pixels.
ljus_break_it(NAME hdr-exposure-unknown HEADER io/hdr.hpp TEST hdr
    FROM "numbers == std::vector{0.0}"
    TO   "numbers == std::vector{2.0}"
    CASES "hdr: the exposure*")

# A tab at the end of a line belongs to its last word.
ljus_break_it(NAME hdr-tab HEADER io/detail/byte_reader.hpp TEST hdr
    FROM [[find_last_not_of(" \t")]]
    TO   "find_last_not_of(' ')"
    CASES "hdr: what is wrong with a header*")
