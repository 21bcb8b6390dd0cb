/// \file inspect.cpp
/// \brief What a mesh file has in it, and what is odd about it: ljus-inspect.
///
///     ljus-inspect teapot.obj
///     ljus-inspect duck.glb --picture duck.png
///
/// It prints what was read and what was made of it: triangles, box, area, whether the
/// mesh is closed and its volume, the materials, cameras and lights; then each problem
/// with its place in the file, and what is done about it. The picture shows the meshes
/// as they are made by add_meshes(), path-traced.

#include <cstdio>
#include <string>

#include "common/command_line.hpp"
#include "common/save_picture.hpp"
#include "ljus/io/load_mesh.hpp"
#include "ljus/lights/environment.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scene/world.hpp"

namespace {

using namespace ljus;

std::string vector_text(const glm::dvec3& v) {
    char text[100];
    std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g)", v.x, v.y, v.z);
    return text;
}

/// What add_meshes() makes of a material.
std::string surface_text(const MeshMaterial& is) {
    std::string text = is.is_glass()    ? "glass of index " + to_text(is.index)
                       : is.is_mirror() ? "mirror of " + vector_text(is.specular)
                                        : "matt " + vector_text(is.diffuse);
    if (is.is_mirror() && is.roughness > 0)
        text += ", roughness " + to_text(is.roughness);
    if (is.emission != glm::dvec3(0)) text += ", emits " + vector_text(is.emission);
    const auto named = [&](const char* what, const MeshImage& image) {
        if (!image.name.empty()) text += what + shown_path(image.name);
    };
    named(", picture ", is.picture);
    named(", holes by ", is.mask);
    named(", normals by ", is.normals);
    return text;
}

void print_whole(const LoadedMeshT<double>& loaded) {
    const MeshContent& has = loaded.report.content;
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

/// The camera of this name, or the first one if the name is empty. Without cameras, one
/// in front of all meshes, a little to the right and above.
Camera camera_of(const LoadedMesh& loaded, const std::string& name) {
    std::string names;
    for (const MeshCameraT<float>& one : loaded.cameras) {
        if (name.empty() || one.name == name) return one.camera;
        names += (names.empty() ? "" : ", ") + shown(one.name);
    }
    if (!name.empty())
        throw std::invalid_argument("--camera is " + shown(name) + "; the file has " +
                                    (names.empty() ? "no camera" : names) + ".");
    BoxT<float> box;
    for (const auto& part : loaded.parts) box = box_union(box, part.mesh.tree().box());
    const Vec3 middle = 0.5f * (box.low + box.high);
    return look_at(View{.position = middle + glm::distance(box.low, box.high) *
                                                 Vec3{0.6f, 0.5f, 1.2f},
                        .target = middle,
                        .vfov_degrees = 40});
}

/// Makes a picture of all meshes in their own colours; under a sky if nothing glows.
void draw(const std::string& mesh, const MeshFileSettings& settings,
          const std::string& camera, const std::string& file) {
    const LoadedMesh loaded = load_mesh(mesh, settings);
    Scene<Shapes<Mesh>,
          Materials<Lambertian, Mirror, Glossy, Glass, MeshPicture, MeshMetalPicture,
                    MeshDetailed, MeshMetalDetailed>,
          Lights<PointLight, SpotLight, SunLight, EnvironmentLight>>
        scene;
    add_meshes(scene, loaded);
    if (scene.light_count() == 0)
        scene.add(
            EnvironmentLight{.picture = gradient_sky({1, 1, 1}, {1.5f, 1.5f, 1.5f},
                                                     {0.3f, 0.3f, 0.3f})});
    const World world(std::move(scene));
    const auto rendered = render(PathTracer(world), camera_of(loaded, camera),
                                 {.width = 400, .height = 300, .samples = 64});
    examples::save_picture(rendered.image, file, 0);
}

void body(examples::CommandLine& line) {
    std::string path, picture, camera;
    MeshFileSettings settings;
    line.about(
        "Prints what a mesh file (OBJ, PLY, STL, glTF) has in it, and what is odd "
        "about it.");
    line.file_types(
        {".obj"}); // no folder for files of its own, which parse() would try
    line.without({"--quality", "--seed", "--threads", "--width", "--height", "--rays",
                  "--out", "--quiet"});
    line.add_positional("MESH", path, "The file");
    line.add("--scale", settings.scale, "Factor of every coordinate", 1e-9, 1e9);
    line.add("--normals", settings.normals, "Of the file, smooth, or flat");
    line.add("--picture", picture, "Makes this picture of it (PNG, HDR or PFM)");
    line.add("--camera", camera, "The camera of the picture, by its name in the file");
    (void)line.parse();

    const LoadedMeshT<double> loaded = load_mesh<double>(path, settings);
    std::printf("%s\n", shown_path(path).c_str());
    print_whole(loaded);
    for (const auto& [mesh, material] : loaded.parts)
        std::printf("  material   %s: %u triangles, %s, %s, %s\n",
                    material.name.empty() ? "(none)" : shown(material.name).c_str(),
                    mesh.size(), surface_text(material).c_str(),
                    mesh.data().normals.empty() ? "flat" : "smooth",
                    mesh.data().uv.empty() ? "no texture coordinates"
                                           : "with texture coordinates");
    for (const MeshCameraT<double>& one : loaded.cameras)
        std::printf("  camera     %s at %s\n",
                    one.name.empty() ? "(no name)" : one.name.c_str(),
                    vector_text(one.camera.position).c_str());
    if (const std::size_t points = loaded.points.size(), spots = loaded.spots.size(),
        suns = loaded.suns.size();
        points + spots + suns > 0)
        std::printf("  lights     %zu points, %zu spots, %zu suns\n", points, spots,
                    suns);
    const std::string odd = to_text(loaded.report);
    std::printf("%s%s", odd.empty() ? "nothing is odd\n" : "odd:\n", odd.c_str());
    if (!picture.empty()) draw(path, settings, camera, picture);
}

} // namespace

/// Inspects a mesh file.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, body);
}
