# The number of a vertex, from the end, off by one.
ljus_break_it(NAME load-obj-from-the-end HEADER io/detail/obj_text.hpp TEST load_obj
    FROM "number > 0 ? number - 1LL"
    TO   "number > 1 ? number - 1LL"
    CASES "load_obj: a cube*")

# tinyobjloader's own numbers: what it cannot read is 0.
ljus_break_it(NAME load-obj-bad-number HEADER io/detail/obj_text.hpp TEST load_obj
    FROM "if (stop == end && error == std::errc{})"
    TO   ""
    CASES "load_obj: each trouble*")

# 4294967297 is 1 to an int.
ljus_break_it(NAME load-obj-overflow HEADER io/detail/obj_text.hpp TEST load_obj
    FROM "digits < 10 && "
    TO   ""
    CASES "load_obj: each trouble*")

# Both ends of a line count as lines.
ljus_break_it(NAME load-obj-line HEADER io/detail/obj_text.hpp TEST load_obj
    FROM "? 2 : 1);"
    TO   "? 1 : 1);"
    CASES "load_obj: line ends*")

# A fan instead of ears.
ljus_break_it(NAME polygon-fan HEADER geometry/detail/polygon.hpp TEST load_obj
    FROM "if (ears[i % n] == 0) continue;"
    TO   ""
    CASES "load_obj: polygons*")

# The neighbours of an ear that is cut off are not asked again.
ljus_break_it(NAME polygon-neighbours HEADER geometry/detail/polygon.hpp TEST load_obj
    FROM "ears[beside] = is_ear(beside) ? 1 : 0;"
    TO   "ears[beside] = 1;"
    CASES "load_obj: polygons*,load_obj: many corners*")

# A hostile texture coordinate is taken for none, and its face is kept.
ljus_break_it(NAME load-obj-uv-index HEADER io/detail/obj_reader.hpp TEST load_obj
    FROM "(named.texcoord_index != 0 && !place)"
    TO   "false"
    CASES "load_obj: each trouble*")

# All corners have the first texture coordinates of the file.
ljus_break_it(NAME load-obj-uv HEADER io/detail/obj_reader.hpp TEST load_obj
    FROM "corner.uv ? uv[*corner.uv]"
    TO   "corner.uv ? uv[0]"
    CASES "load_obj: texture coordinates*")

# A seam of the picture is an edge of the surface.
ljus_break_it(NAME load-obj-seam HEADER io/detail/obj_reader.hpp TEST load_obj
    FROM "smooth_across_seams(part);"
    TO   "smooth_normals(part.data);"
    CASES "load_obj: texture coordinates*")

# Kd without its picture.
ljus_break_it(NAME load-obj-picture HEADER io/load_obj.hpp TEST load_obj
    FROM "picture != loaded.pictures.end())"
    TO   "picture == loaded.pictures.end())"
    CASES "load_obj: a path-traced wall*")

# Exponents of ten digits reach tinyobjloader.
ljus_break_it(NAME obj-exponents HEADER io/detail/obj_text.hpp TEST load_obj
    FROM "last - first >= 10"
    TO   "last - first >= 11"
    CASES "load_obj: an exponent*")

# Names are changed as well.
ljus_break_it(NAME obj-exponent-names HEADER io/detail/obj_text.hpp TEST load_obj
    FROM "(c == 'e' || c == 'E') && number"
    TO   "c == 'e' || c == 'E'"
    CASES "load_obj: an exponent*")

# The first line that is met in place of the first line of the file.
ljus_break_it(NAME load-obj-first-line HEADER io/obj_report.hpp TEST load_obj
    FROM "if (at.count++ == 0 || line < at.line) at.line = line;"
    TO   "if (at.count++ == 0) at.line = line;"
    CASES "load_obj: a report has the first line*")

# What is glass and a mirror at once.
ljus_break_it(NAME load-obj-glass-first HEADER io/load_obj.hpp TEST load_obj
    FROM "if (is.is_glass()) return scene.add(glass);"
    TO   "if (is.is_glass() && !is.is_mirror()) return scene.add(glass);"
    CASES "load_obj: the rarer words*")

# A corner on the line that cuts an ear off does not keep it.
ljus_break_it(NAME polygon-ear-line HEADER geometry/detail/polygon.hpp TEST load_obj
    FROM "turn(c, a, p) >= 0"
    TO   "turn(c, a, p) > 0"
    CASES "load_obj: a corner on the line*")

# An ear is cut off though a corner touches its first side.
ljus_break_it(NAME polygon-ear-side HEADER geometry/detail/polygon.hpp TEST load_obj
    FROM "turn(a, b, p) >= 0"
    TO   "turn(a, b, p) > 0"
    CASES "load_obj: no ear is cut off*")

# A number that begins with a plus is taken for a name.
ljus_break_it(NAME obj-plus-exponent HEADER io/detail/obj_text.hpp TEST load_obj
    FROM "c == '.' || c == '-' || c == '+'));"
    TO   "c == '.' || c == '-'));"
    CASES "load_obj: an exponent*")

# A polygon on a line is cut into triangles without an area.
ljus_break_it(NAME polygon-no-area HEADER geometry/detail/polygon.hpp TEST load_obj
    FROM "if (!(glm::dot(across, across) > 0)) return triangles;"
    TO   ""
    CASES "load_obj: of corners without*")
