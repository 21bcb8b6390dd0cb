# The highest byte comes last in either order.
ljus_break_it(NAME ply-byte-order HEADER io/detail/parse.hpp TEST load_ply
    FROM "high_first ? k : bytes.size() - 1 - k"
    TO   "bytes.size() - 1 - k"
    CASES "load_ply: a mesh is the same*,load_ply: whole numbers*")

# A char of -1 is 255.
ljus_break_it(NAME ply-sign HEADER io/detail/parse.hpp TEST load_ply
    FROM "kind == 'i' && value >= range / 2"
    TO   "false"
    CASES "load_ply: whole numbers*")

# A list may be longer than its file.
ljus_break_it(NAME ply-list-length HEADER io/load_ply.hpp TEST load_ply
    FROM "if (!(count >= 0 && count == std::floor(count)))"
    TO   "if (false)"
    CASES "load_ply: a file that cannot be right*")

# Every list of a face names vertices.
ljus_break_it(NAME ply-other-list HEADER io/load_ply.hpp TEST load_ply
    FROM "face && !found &&"
    TO   "face ||"
    CASES "load_ply: what other programs write")

# Colours of a screen are taken for linear ones.
ljus_break_it(NAME ply-color-linear HEADER io/load_ply.hpp TEST load_ply
    FROM "color[k] = srgb_decode(color[k]);"
    TO   "color[k] = color[k] * 1;"
    CASES "load_ply: the colours of vertices*")

# The fourth pixel of a triangle is a mean, and the middle of its long side is off.
ljus_break_it(NAME vertex-colors-fourth HEADER io/detail/mesh_builder.hpp TEST load_ply
    FROM "return colors[corner[1]] + colors[corner[2]] - colors[corner[0]];"
    TO   "return (colors[corner[1]] + colors[corner[2]]) / T(2);"
    CASES "load_ply: the colours of vertices*")

# The fourth pixel leaves [0, 1].
ljus_break_it(NAME vertex-colors-clamp HEADER io/detail/mesh_builder.hpp TEST load_ply
    FROM "return glm::clamp(fourth(), RgbT<T>{0}, RgbT<T>{1});"
    TO   "return fourth();"
    CASES "load_ply: colours that vary widely*")

# The corners of a face share the texture coordinates of the first.
ljus_break_it(NAME ply-face-uv HEADER io/load_ply.hpp TEST load_ply
    FROM "add_uv(face_uv[2 * k], face_uv[2 * k + 1])"
    TO   "add_uv(face_uv[0], face_uv[1])"
    CASES "load_ply: the corners of a face*")

# Every second triangle of a strip shows its back.
ljus_break_it(NAME ply-strip HEADER io/load_ply.hpp TEST load_ply
    FROM "const std::size_t odd = in_strip % 2;"
    TO   "const std::size_t odd = 0;"
    CASES "load_ply: strips of triangles*")

# Strips are joined to each other.
ljus_break_it(NAME ply-strip-end HEADER io/load_ply.hpp TEST load_ply
    FROM "in_strip = 0;\n                continue;"
    TO   "continue;"
    CASES "load_ply: strips of triangles*")

# CR LF taken for CR: the numbers begin with LF.
ljus_break_it(NAME ply-cr-lf HEADER io/load_ply.hpp TEST load_ply
    FROM "all[3] == '\\r' && all[4] != '\\n'"
    TO   "all[3] == '\\r'"
    CASES "load_ply: behind a header*")
