# Rows are counted from 0, wherever the data window begins.
ljus_break_it(NAME exr-window HEADER io/exr.hpp TEST exr
    FROM "int(window.y + y)"
    TO   "int(y)"
    CASES "exr: what another library*")

# A channel alone is red.
ljus_break_it(NAME exr-grey HEADER io/exr.hpp TEST exr
    FROM "for (Rgb& color : image.pixels) color = Rgb{color.x};"
    TO   "{}"
    CASES "exr: several parts*")

# A channel with half of the rows is read as one that has all.
ljus_break_it(NAME exr-half-the-rows HEADER io/exr.hpp TEST exr
    FROM "channel.y_samples > 1 &&"
    TO   "channel.y_samples > 2 &&"
    CASES "exr: several parts*")

# A short file makes a large picture.
ljus_break_it(NAME exr-short HEADER io/exr.hpp TEST exr
    FROM "dwa ? 65536 : 1024"
    TO   "1 << 30"
    CASES "exr: what is wrong*")

# Of two channels of one name the file keeps one.
ljus_break_it(NAME exr-two-names HEADER io/exr.hpp TEST exr
    FROM "name == channels[i - 1].name"
    TO   "name.empty()"
    CASES "exr: layers that no file*")

# The colours of other primaries are taken for those of sRGB.
ljus_break_it(NAME exr-primaries HEADER io/exr.hpp TEST exr
    FROM "if (!matrix)"
    TO   "return glm::dmat3{1}; if (!matrix)"
    CASES "exr: colours of other primaries*")

# The faces of a cube are taken for the rows of a sky.
ljus_break_it(NAME exr-cube HEADER io/exr.hpp TEST exr
    FROM "kind == EXR_ENVMAP_CUBE"
    TO   "false"
    CASES "exr: colours of other primaries*")

# A chunk that is stored as it is is unpacked.
ljus_break_it(NAME exr-stored HEADER io/exr.hpp TEST exr
    FROM "if (chunk.packed_size == chunk.unpacked_size)"
    TO   "if (false)"
    CASES "exr: what another library*")

# A part that is stored of a picture is taken for the whole of it.
ljus_break_it(NAME exr-display-window HEADER io/exr.hpp TEST exr
    FROM "if (window == shown) continue;"
    TO   "continue;"
    CASES "exr: several parts*")

# The colours beside a luminance are lost.
ljus_break_it(NAME exr-chroma HEADER io/exr.hpp TEST exr
    FROM "reader.require_no_chroma(found->part);"
    TO   ";"
    CASES "exr: several parts*")

# The rows of tiles are counted by the width of a tile.
ljus_break_it(NAME exr-tile-rows HEADER io/exr.hpp TEST exr
    FROM "int(y / high)"
    TO   "int(y / wide)"
    CASES "exr: several parts*")

# The first part is asked whether another one is a cube.
ljus_break_it(NAME exr-cube-part HEADER io/exr.hpp TEST exr
    FROM "reader.require_no_cube(found->part);"
    TO   "reader.require_no_cube(0);"
    CASES "exr: several parts*")
