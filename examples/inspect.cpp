/// \file inspect.cpp
/// \brief What a mesh file has in it, and what is odd about it: ljus-inspect.
///
///     ljus-inspect teapot.obj
///
/// It prints what was read and what was made of it: triangles, box, area, whether the
/// mesh is closed and its volume, the materials; then each problem with its line, and
/// what is done about it.

#include <cstdio>
#include <string>

#include "common/command_line.hpp"
#include "ljus/io/load_obj.hpp"

namespace {

using namespace ljus;

std::string vector_text(const glm::dvec3& v) {
    char text[100];
    std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g)", v.x, v.y, v.z);
    return text;
}

/// What add_obj() makes of a material.
std::string surface_text(const ObjMaterial& is) {
    std::string text = is.is_glass()    ? "glass of index " + to_text(is.index)
                       : is.is_mirror() ? "mirror of " + vector_text(is.specular)
                                        : "matt " + vector_text(is.diffuse);
    if (is.emission != glm::dvec3(0)) text += ", emits " + vector_text(is.emission);
    if (!is.picture.empty()) text += ", picture " + shown_path(is.picture);
    return text;
}

void print_whole(const LoadedObjT<double>& loaded) {
    const ObjContent& has = loaded.report.content;
    double area = 0;
    BoxT<double> box;
    std::size_t triangles = 0;
    for (const auto& part : loaded.parts) {
        area += part.mesh.area_up_to().back();
        triangles += part.mesh.size();
        box = box_union(box, part.mesh.tree().box());
    }
    std::printf(
        "  read       %lld vertices (%lld in no face), %lld normals, %lld texture "
        "coordinates,\n             %lld objects, %lld groups\n",
        has.vertices, has.unused, has.normals, has.uvs, has.objects, has.groups);
    std::printf(
        "  faces      %lld, %lld of them with more than three corners, which are "
        "cut;\n             %lld without normals, %lld without texture "
        "coordinates\n",
        has.faces, has.polygons, has.flat_faces, has.no_uv_faces);
    std::printf("  triangles  %zu; materials %zu\n", triangles, loaded.parts.size());
    std::printf("  box        %s to %s\n", vector_text(box.low).c_str(),
                vector_text(box.high).c_str());
    std::printf("  area       %.6g\n", area);
    if (has.closed)
        std::printf("  closed     yes; volume %.6g%s\n", has.volume,
                    has.volume < 0 ? ": the faces look inwards, it is inside out" : "");
    else
        std::printf("  closed     no\n");
}

void body(examples::CommandLine& line) {
    std::string path;
    ObjSettings settings;
    line.about("Prints what a mesh file (OBJ) has in it, and what is odd about it.");
    line.file_types(
        {".obj"}); // no folder for files of its own, which parse() would try
    line.without({"--quality", "--seed", "--threads", "--width", "--height", "--rays",
                  "--out", "--quiet"});
    line.add_positional("MESH", path, "The file");
    line.add("--scale", settings.scale, "Factor of every coordinate", 1e-9, 1e9);
    line.add("--normals", settings.normals, "Of the file, smooth, or flat");
    (void)line.parse();

    const LoadedObjT<double> loaded = load_obj<double>(path, settings);
    std::printf("%s\n", shown_path(path).c_str());
    print_whole(loaded);
    for (const auto& [mesh, material] : loaded.parts)
        std::printf("  material   %s: %u triangles, %s, %s, %s\n",
                    material.name.empty() ? "(none)" : shown(material.name).c_str(),
                    mesh.size(), surface_text(material).c_str(),
                    mesh.data().normals.empty() ? "flat" : "smooth",
                    mesh.data().uv.empty() ? "no texture coordinates"
                                           : "with texture coordinates");
    const std::string odd = to_text(loaded.report);
    std::printf("%s%s", odd.empty() ? "nothing is odd\n" : "odd:\n", odd.c_str());
}

} // namespace

/// Inspects a mesh file.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, body);
}
