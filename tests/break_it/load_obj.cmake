# The number of a vertex from the end is counted from the beginning.
ljus_break_it(NAME load-obj-from-the-end HEADER io/load_obj.hpp TEST load_obj
    FROM "number - 1 : number + all"
    TO   "number - 1 : -number - 1"
    CASES "load_obj: line ends*")

# What is no number is 0, as many a program has it.
ljus_break_it(NAME load-obj-bad-number HEADER io/detail/parse.hpp TEST load_obj
    FROM ": std::numeric_limits<double>::quiet_NaN();"
    TO   ": 0;"
    CASES "load_obj: each trouble*")

# A number that does not fit, or is none, is taken as far as it goes.
ljus_break_it(NAME load-obj-overflow HEADER io/load_obj.hpp TEST load_obj
    FROM "end > 0 && (stop != last || error != std::errc{})"
    TO   "false"
    CASES "load_obj: each trouble*")

# Both ends of a line count as lines.
ljus_break_it(NAME load-obj-line HEADER io/detail/parse.hpp TEST load_obj
    FROM "text.starts_with(\"\\r\\n\") ? 2 : 1"
    TO   "1"
    CASES "load_obj: line ends*")

# A fan instead of ears.
ljus_break_it(NAME polygon-fan HEADER geometry/detail/polygon.hpp TEST load_obj
    FROM "std::find(ears.begin() + 1, ears.end(), 1)"
    TO   "ears.begin() + 1"
    CASES "load_obj: polygons*")

# The neighbours of an ear that is cut off are not asked again.
ljus_break_it(NAME polygon-neighbours HEADER geometry/detail/polygon.hpp TEST load_obj
    FROM "ears[k] = is_ear(k) ? 1 : 0;"
    TO   "ears[k] = 1;"
    CASES "load_obj: polygons*,load_obj: many corners*")

# A hostile texture coordinate is taken for none without a word.
ljus_break_it(NAME load-obj-uv-index HEADER io/load_obj.hpp TEST load_obj
    FROM "if (end > 0 && at[k] == no_number) mesh_.miss(k);"
    TO   ""
    CASES "load_obj: each trouble*")

# All corners have the first texture coordinates of the file.
ljus_break_it(NAME load-obj-uv HEADER io/detail/mesh_builder.hpp TEST load_obj
    FROM "uv != no_number ? uvs[uv]"
    TO   "uv != no_number ? uvs[0]"
    CASES "load_obj: texture coordinates*")

# A seam of the picture is an edge of the surface.
ljus_break_it(NAME load-obj-seam HEADER io/detail/mesh_builder.hpp TEST load_obj
    FROM "part.smooth();"
    TO   "smooth_normals(part.data);"
    CASES "load_obj: texture coordinates*")

# Kd without its picture.
ljus_break_it(NAME load-obj-picture HEADER io/mesh_file.hpp TEST load_obj
    FROM "if (picture) return scene.add(painted(matt));"
    TO   "if (false) return scene.add(painted(matt));"
    CASES "load_obj: a wall shows*")

# The first line that is met in place of the first line of the file.
ljus_break_it(NAME load-obj-first-line HEADER io/mesh_report.hpp TEST load_obj
    FROM "if (at.count == 0 || line < at.line) at.line = line;"
    TO   "if (at.count == 0) at.line = line;"
    CASES "load_obj: a report has the first line*")

# What is glass and a mirror at once.
ljus_break_it(NAME load-obj-glass-first HEADER io/mesh_file.hpp TEST load_obj
    FROM "if (is.is_glass()) return scene.add(glass);"
    TO   "if (is.is_glass() && !is.is_mirror()) return scene.add(glass);"
    CASES "load_obj: the rarer words*")

# A corner on the line that cuts an ear off does not keep it.
ljus_break_it(NAME polygon-ear-line HEADER geometry/detail/polygon.hpp TEST load_obj
    FROM "turn(c, a, p) >= 0"
    TO   "turn(c, a, p) > 0"
    CASES "load_obj: an ear is cut off*")

# An ear is cut off though a corner touches its first side.
ljus_break_it(NAME polygon-ear-side HEADER geometry/detail/polygon.hpp TEST load_obj
    FROM "turn(a, b, p) >= 0"
    TO   "turn(a, b, p) > 0"
    CASES "load_obj: an ear is cut off*")

# An ear is cut off though a corner without a turn lies on its last side.
ljus_break_it(NAME polygon-straight HEADER geometry/detail/polygon.hpp TEST load_obj
    FROM "return !(turn(a, b, c) > 0);"
    TO   "return turn(a, b, c) < 0;"
    CASES "load_obj: an ear is cut off*")

# An ear is cut off over the gap between two parts that meet in its corner.
ljus_break_it(NAME polygon-gap HEADER geometry/detail/polygon.hpp TEST load_obj
    FROM "if (is_between(before) && is_between(after)) return false;"
    TO   ""
    CASES "load_obj: the parts of a polygon*")

# A corner without an area, between or beside corners that coincide, is no ear.
ljus_break_it(NAME polygon-back HEADER geometry/detail/polygon.hpp TEST load_obj
    FROM "if (is(a, b) || is(b, c) || is(c, a)) return true;"
    TO   ""
    CASES "load_obj: the parts of a polygon*")

# A polygon on a line is cut into triangles without an area.
ljus_break_it(NAME polygon-no-area HEADER geometry/detail/polygon.hpp TEST load_obj
    FROM "if (!(glm::dot(across, across) > 0)) return result;"
    TO   ""
    CASES "load_obj: of corners without*")

# A map without Kd is grey.
ljus_break_it(NAME obj-map-alone HEADER io/load_obj.hpp TEST load_obj
    FROM "(black || !has_diffuse)"
    TO   "black"
    CASES "load_obj: files of other programs")

# What one material says, the next one has.
ljus_break_it(NAME obj-next-material HEADER io/load_obj.hpp TEST load_obj
    FROM "has_diffuse = has_dissolve = false;"
    TO   ";"
    CASES "load_obj: files of other programs")

# Options before the name of a picture are a part of it.
ljus_break_it(NAME obj-map-options HEADER io/load_obj.hpp TEST load_obj
    FROM "if (option.size() < 2 || option[0] != '-') break;"
    TO   "break;"
    CASES "load_obj: files of other programs")

# One number of a colour is red.
ljus_break_it(NAME obj-one-number HEADER io/load_obj.hpp TEST load_obj
    FROM "glm::dvec3 value(number_of(words.next()));"
    TO   "glm::dvec3 value(number_of(words.next()), 0, 0);"
    CASES "load_obj: files of other programs")

# A byte order mark belongs to the first word.
ljus_break_it(NAME text-mark HEADER io/file.hpp TEST load_obj
    FROM "? 3 : 0"
    TO   "? 0 : 0"
    CASES "load_obj: files of other programs")

# A line does not go on behind a backslash.
ljus_break_it(NAME obj-backslash HEADER io/detail/parse.hpp TEST load_obj
    FROM "if (line.ends_with('\\\\') && !rest.empty()) {"
    TO   "if (false) {"
    CASES "load_obj: files of other programs")

# A mesh inside out is not remarked.
ljus_break_it(NAME obj-inside-out HEADER io/mesh_report.hpp TEST load_obj
    FROM "if (volume < 0)"
    TO   "if (volume > 0)"
    CASES "load_obj: files of other programs")

# The line feed of CR LF is a pixel.
ljus_break_it(NAME hdr-line-end HEADER io/hdr.hpp TEST hdr
    FROM "reader.size(reader.last_word())"
    TO   "reader.size(reader.word())"
    CASES "hdr: a header whose lines end*")

# Blanks behind the header are pixels.
ljus_break_it(NAME pfm-blanks HEADER io/pfm.hpp TEST pfm
    FROM "reader.skip_blanks(expected);"
    TO   ""
    CASES "pfm: blanks behind*")

# Only corners that stand out keep an ear.
ljus_break_it(NAME polygon-hollow HEADER geometry/detail/polygon.hpp TEST load_obj
    FROM "if (is_hollow(i)) hollow.push_back(left[i]);"
    TO   "if (!is_hollow(i)) hollow.push_back(left[i]);"
    CASES "load_obj: random polygons are cut*")

# A polygon that is not flat is seen along an axis.
ljus_break_it(NAME polygon-seen HEADER geometry/detail/polygon.hpp TEST load_obj
    FROM "const double along = from[axis] / across[axis];"
    TO   "const double along = 0;"
    CASES "load_obj: a polygon that is not flat*")

# The next piece of a file begins behind a line that has only begun.
ljus_break_it(NAME obj-piece HEADER io/detail/parse.hpp TEST load_obj
    FROM "if (rest.empty() && !last) return piece.size() - left;"
    TO   ";"
    CASES "load_obj: a file that comes in pieces*")

# A vertex for each corner of each face.
ljus_break_it(NAME obj-vertices HEADER io/detail/mesh_builder.hpp TEST load_obj
    FROM "if (corners_[vertex] == corner) return vertex;"
    TO   ";"
    CASES "load_obj: what is written*")

# A material file is read as often as it is named.
ljus_break_it(NAME obj-library-once HEADER io/load_obj.hpp TEST load_obj
    FROM "if (fresh) {"
    TO   "if (fresh || true) {"
    CASES "load_obj: a material file is read once*")

# The next faces have the material before.
ljus_break_it(NAME obj-part-reset HEADER io/load_obj.hpp TEST load_obj
    FROM "mesh_.material = known.number;"
    TO   "mesh_.material = 1;"
    CASES "load_obj: materials of a file*")

# A tetrahedron has a third of its parallelepiped in place of a sixth.
ljus_break_it(NAME obj-volume HEADER io/mesh_report.hpp TEST load_obj
    FROM "report.content.volume = volume / 6;"
    TO   "report.content.volume = volume / 3;"
    CASES "load_obj: a report has all*")

# A name keeps its quotation marks.
ljus_break_it(NAME obj-quotes HEADER io/detail/parse.hpp TEST load_obj
    FROM "text = text.substr(1, text.size() - 2);"
    TO   ";"
    CASES "load_obj: files of other programs,load_obj: two names*")

# A word in other letters is another word.
ljus_break_it(NAME obj-small-letters HEADER io/detail/parse.hpp TEST load_obj
    FROM "b.begin(), b.end(), same_letter);"
    TO   "b.begin(), b.end());"
    CASES "load_obj: files of other programs")

# A number that is nearly 0 is no number.
ljus_break_it(NAME obj-tiny-number HEADER io/detail/parse.hpp TEST load_obj
    FROM "return tiny ? 0 :"
    TO   "return false ? 0 :"
    CASES "load_obj: files of other programs")

# A 0 for "no normal" makes the whole corner unreadable.
ljus_break_it(NAME obj-zero-index HEADER io/load_obj.hpp TEST load_obj
    FROM "at[k] = place_of(number, counts[k]);"
    TO   "if (end > 0 && number == 0) break;"
    CASES "load_obj: files of other programs")

# Glass of index 1, which nobody sees.
ljus_break_it(NAME obj-glass-of-nothing HEADER io/mesh_file.hpp TEST load_obj
    FROM "(glass && index != 1)"
    TO   "glass"
    CASES "load_obj: files of other programs")

# A picture under a black Kd is black.
ljus_break_it(NAME obj-black-picture HEADER io/load_obj.hpp TEST load_obj
    FROM "const bool black = has_diffuse && is.diffuse == glm::dvec3(0);"
    TO   "const bool black = false;"
    CASES "load_obj: files of other programs")

# Tr 1 under a picture is glass.
ljus_break_it(NAME obj-tr-opaque HEADER io/load_obj.hpp TEST load_obj
    FROM "!has_dissolve && is.dissolve == 0)"
    TO   "false)"
    CASES "load_obj: files of other programs")

# That faces are meant to be smooth is not said.
ljus_break_it(NAME obj-not-smooth HEADER io/load_obj.hpp TEST load_obj
    FROM "mesh_.in_smooth_group = !group.empty() && group != \"off\" && group != \"0\";"
    TO   "mesh_.in_smooth_group = group == \"on\";"
    CASES "load_obj: each trouble*")

# A black mirror is not remarked.
ljus_break_it(NAME obj-black-mirror HEADER io/load_obj.hpp TEST load_obj
    FROM "is.is_mirror() && is.specular == glm::dvec3(0)"
    TO   "false"
    CASES "load_obj: which words*")

# A reduced picture has every second column.
ljus_break_it(NAME obj-reduced HEADER io/detail/mesh_builder.hpp TEST load_obj
    FROM "const int right = std::min(2 * x + 1, image.width - 1);"
    TO   "const int right = 2 * x;"
    CASES "load_obj: pictures that many*")

# The copies of pictures may be one pixel too many.
ljus_break_it(NAME obj-reduced-late HEADER io/detail/mesh_builder.hpp TEST load_obj
    FROM "for (; pixels > most; pixels"
    TO   "for (; pixels > most + 1; pixels"
    CASES "load_obj: pictures that many*")

# A name ends at any #, not at a comment.
ljus_break_it(NAME obj-name-comment HEADER io/detail/parse.hpp TEST load_obj
    FROM "rest.find(\" # \")"
    TO   "rest.find('#')"
    CASES "load_obj: the rarer words*")
# A house in the coordinates of its country is rounded out of shape without a word.
ljus_break_it(NAME obj-far HEADER io/detail/mesh_builder.hpp TEST load_obj
    FROM "step > size / T(10000)"
    TO   "step > size * T(10000)"
    CASES "load_obj: a report has all*")
