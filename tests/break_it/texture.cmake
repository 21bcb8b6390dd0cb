# An image upside down.
ljus_break_it(NAME texture-upside-down HEADER image/texture.hpp TEST texture
    FROM "(T(1) - inside(at.y)) * T(image.height)"
    TO   "inside(at.y) * T(image.height)"
    CASES "texture: an image*")

# Pixels by their corners in place of their middles.
ljus_break_it(NAME texture-half-pixel HEADER image/texture.hpp TEST texture
    FROM "const T x = wide - T(0.5), y"
    TO   "const T x = wide, y"
    CASES "texture: an image*")

# Rounded towards zero: the fields around the origin are twice as wide.
ljus_break_it(NAME texture-towards-zero HEADER image/texture.hpp TEST texture
    FROM "std::floor(at.x * T(checker.columns))"
    TO   "std::trunc(at.x * T(checker.columns))"
    CASES "texture: a chessboard*")

# The texture's colour in place of the product.
ljus_break_it(NAME textured-product HEADER materials/textured.hpp TEST texture
    FROM "base.albedo *= color;
    else if constexpr (requires { base.reflectance *= color; })"
    TO   "base.albedo = color;
    else if constexpr (requires { base.reflectance *= color; })"
    CASES "texture: the hook*")

# The hook forgotten: every place looks like the base.
ljus_break_it(NAME textured-hook HEADER path/next_vertex.hpp TEST texture
    FROM "const auto& here = material_at(m, vertex.point.position, vertex.uv);"
    TO   "const auto& here = m;"
    CASES "texture: in a white furnace*")

# The shape's coordinates never worked out: an image in its own first pixel's colour.
ljus_break_it(NAME texture-no-uv HEADER path/next_vertex.hpp TEST texture
    FROM "if (detail::uses_uv(world, vertex.object.material))"
    TO   "if (!detail::uses_uv(world, vertex.object.material))"
    CASES "texture: a UvMap*")

# A ball by the coordinates of its hit, which has none.
ljus_break_it(NAME texture-ball HEADER geometry/sphere.hpp TEST texture
    FROM "globe_coordinates(point.normal)"
    TO   "globe_coordinates(point.position)"
    CASES "texture: each shape*")

# The repetitions forgotten.
ljus_break_it(NAME texture-scale HEADER image/texture.hpp TEST texture
    FROM "scaled = map.scale * uv;"
    TO   "scaled = uv;"
    CASES "texture: a UvMap*")

# A chunk's sum is not asked.
ljus_break_it(NAME png-sum HEADER io/detail/picture_damage.hpp TEST texture
    FROM "png_number(file, at + size) == png_sum(file, at - 4, at + size)"
    TO   "size < 1u << 30"
    CASES "texture: of pictures only*")

# Bytes behind the last chunk are taken for chunks.
ljus_break_it(NAME png-end HEADER io/detail/picture_damage.hpp TEST texture
    FROM "if (name == \"IEND\") return;"
    TO   ""
    CASES "texture: of pictures only*")

# Formats whose readers cannot be trusted are handed on.
ljus_break_it(NAME image-kinds HEADER io/load_image.hpp TEST texture
    FROM "if (!png && !jpeg && !text.starts_with(\"BM\"))"
    TO   "if (bytes.empty())"
    CASES "texture: of pictures only*")

# A table of more entries than there are places.
ljus_break_it(NAME jpeg-tables HEADER io/detail/picture_damage.hpp TEST texture
    FROM "entries > 255"
    TO   "entries > 4080"
    CASES "texture: of pictures only*")

# A file of a few bytes may promise as many pixels as it likes.
ljus_break_it(NAME load-image-size HEADER io/load_image.hpp TEST texture
    FROM "std::size_t(width) * std::size_t(high) / most > bytes.size()"
    TO   "false"
    CASES "texture: a file of many pixels*")

# Photons through a textured body as if they were radiance.
ljus_break_it(NAME textured-transport HEADER materials/material.hpp TEST texture
    FROM "return sample(m.base, wo, u, transport, which);"
    TO   "return (void)transport, sample(m.base, wo, u, Transport::radiance, which);"
    CASES "texture: what its colour is*")

# A picture is as high as wide.
ljus_break_it(NAME picture-height HEADER image/texture.hpp TEST texture
    FROM "(T(1) - inside(at.y)) * T(image.height)"
    TO   "(T(1) - inside(at.y)) * T(image.width)"
    CASES "texture: rows and columns*")

# Nobody looks for the marker behind the coded pixels.
ljus_break_it(NAME jpeg-second-table HEADER io/detail/picture_damage.hpp TEST texture
    FROM "if (kind == scan) at = behind_pixels(file, at);"
    TO   ""
    CASES "texture: the tables of a JPEG*")

# A scan may use a table that no file has filled.
ljus_break_it(NAME jpeg-missing-table HEADER io/detail/picture_damage.hpp TEST texture
    FROM "if (asks_ac && (there >> (16 + (numbers & 15u)) & 1u) == 0) return false;"
    TO   ""
    CASES "texture: a JPEG file has*")

# A file without progressive parts may have as many scans as one with them.
ljus_break_it(NAME jpeg-scans HEADER io/detail/picture_damage.hpp TEST texture
    FROM "++scans > (in_parts ? 64 : 4)"
    TO   "++scans > 64"
    CASES "texture: a JPEG file of many scans*")

# An edge whose square is infinite, or too small for all its digits, is taken.
ljus_break_it(NAME texture-edge-size HEADER image/texture.hpp TEST texture
    FROM [[require(std::isnormal(v2), "plane_map.edge_v"]]
    TO   [[require(v2 > T(0), "plane_map.edge_v"]]
    CASES "texture: fields? edges? colours*")

# The gamma of a PNG file is passed over.
ljus_break_it(NAME png-gamma HEADER io/detail/picture_colors.hpp TEST texture
    FROM "colors.decode_by_gamma(1 / gamma);"
    TO   "{}"
    CASES "texture: a PNG file of another kind*")

# A photograph that was taken upright lies.
ljus_break_it(NAME jpeg-orientation HEADER io/load_image.hpp TEST texture
    FROM "const bool from_below = turn == 3 || turn == 4 || turn == 6 || turn == 7;"
    TO   "const bool from_below = turn == 3 || turn == 4 || turn == 8 || turn == 7;"
    CASES "texture: a photograph*")

# Red and blue of Apple's PNG files are exchanged.
ljus_break_it(NAME png-apple HEADER io/load_image.hpp TEST texture
    FROM "if (png && stands_at(bytes, 12, \"CgBI\"))"
    TO   "if (false)"
    CASES "texture: a PNG file of another kind*")

# Each picture of a scene may be as large as all of them together.
ljus_break_it(NAME load-image-together HEADER io/detail/picture_size.hpp TEST texture
    FROM "wide * high <= max_image_pixels - others"
    TO   "wide * high <= max_image_pixels"
    CASES "texture: pictures that are kept*")

# A picture too wide for the decoder is called damaged.
ljus_break_it(NAME load-image-side HEADER io/load_image.hpp TEST texture
    FROM "wide > max_image_side || high > max_image_side"
    TO   "false"
    CASES "texture: of pictures only*")

# The colours behind the end of a short palette are other than black.
ljus_break_it(NAME png-short-palette HEADER io/detail/picture_damage.hpp TEST texture
    FROM "full - size, 0);"
    TO   "full - size, 255);"
    CASES "texture: files that other readers*")

# A PNG file is not turned upright.
ljus_break_it(NAME png-turned HEADER io/load_image.hpp TEST texture
    FROM "if (png) picture.orientation = png_orientation(bytes);"
    TO   ""
    CASES "texture: files that other readers*")

# Four channels are taken for brightness, two differences and nothing.
ljus_break_it(NAME jpeg-four-channels HEADER io/detail/picture_damage.hpp TEST texture
    FROM "file[at + 5] == 4 && !adobe"
    TO   "false"
    CASES "texture: files that other readers*")

# Bytes that fill the gap before a segment end the search for the orientation.
ljus_break_it(NAME jpeg-padding HEADER io/detail/picture_damage.hpp TEST texture
    FROM "if (kind == padding) {"
    TO   "if (kind == padding) return;\n        if (kind == padding) {"
    CASES "texture: files that other readers*")

# Beyond its border a picture repeats, although it ends there.
ljus_break_it(NAME texture-clamp HEADER image/texture.hpp TEST texture
    FROM "return repeats ? (i + size) % size : std::clamp(i, 0, size - 1);"
    TO   "return (i + size) % size;"
    CASES "texture: a picture ends*")

# A mirrored picture repeats.
ljus_break_it(NAME texture-mirror HEADER image/texture.hpp TEST texture
    FROM "x = std::abs(x - T(2) * std::round(x / T(2)));"
    TO   "x = x - std::floor(x);"
    CASES "texture: a mirrored*")

# The nearest pixel is a row too low.
ljus_break_it(NAME texture-nearest HEADER image/texture.hpp TEST texture
    FROM "std::ceil(high) - T(1)"
    TO   "std::floor(high)"
    CASES "texture: a picture ends*")

# Turned the other way round.
ljus_break_it(NAME texture-turn HEADER image/texture.hpp TEST texture
    FROM "map.turn.x * scaled.x - map.turn.y * scaled.y,"
    TO   "map.turn.x * scaled.x + map.turn.y * scaled.y,"
    CASES "texture: a UvMap scales*")

# A BMP file that is cut off is black where it ends.
ljus_break_it(NAME bmp-cut HEADER io/detail/picture_damage.hpp TEST texture
    FROM "(height - 1) * row + (width * bits + 7) / 8"
    TO   "(height - 1) * row"
    CASES "texture: BMP files*")

# Colours behind the end of a BMP file's palette are from memory that nobody has set.
ljus_break_it(NAME bmp-palette HEADER io/load_image.hpp TEST texture
    FROM ": is_bmp ? bmp_with_whole_palette(bytes)"
    TO   ": is_bmp ? Bytes{}"
    CASES "texture: BMP files*")

# The brightness of an HDR picture is taken for that of a plain one.
ljus_break_it(NAME png-cicp HEADER io/detail/picture_colors.hpp TEST texture
    FROM "(curve != 8 && curve != 13) ||"
    TO   ""
    CASES "texture: a PNG file of another kind*")

# The colours of a screen or a camera are taken for those of sRGB.
ljus_break_it(NAME profile-primaries HEADER io/detail/picture_colors.hpp TEST texture
    FROM "if (rgb)
            colors.matrix ="
    TO   "if (rgb && false)
            colors.matrix ="
    CASES "texture: colours of other profiles*")

# A part of a curve's formula is forgotten.
ljus_break_it(NAME profile-curve HEADER io/detail/picture_colors.hpp TEST texture
    FROM "(kind == 2 ? c : e)"
    TO   "e"
    CASES "texture: colours of other profiles*")

# A profile of tables gives a black picture.
ljus_break_it(NAME profile-tables HEADER io/detail/picture_colors.hpp TEST texture
    FROM "!(values.front() < values.back())"
    TO   "values.empty()"
    CASES "texture: colours of other profiles*")

# The primaries of a PNG file without a profile are passed over.
ljus_break_it(NAME png-primaries HEADER io/detail/picture_colors.hpp TEST texture
    FROM "k < xy.size() && primaries != 0"
    TO   "k < xy.size() && false"
    CASES "texture: colours of other profiles*")

# The numbers of a normal map are changed by its profile, which says nothing of them.
ljus_break_it(NAME profile-numbers HEADER io/load_image.hpp TEST texture
    FROM "    if (colors)
        picture.colors ="
    TO   "    if (colors || wanted == 3)
        picture.colors ="
    CASES "texture: colours of other profiles*")

# A gamma of 1 is 256 of its units.
ljus_break_it(NAME profile-gamma HEADER io/detail/picture_colors.hpp TEST texture
    FROM "number(curve + 12, 2) / 256.0"
    TO   "number(curve + 12, 2) / 255.0"
    CASES "texture: colours of other profiles*")
