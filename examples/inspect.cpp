/// \file inspect.cpp
/// \brief Prints the content of a mesh file or an EXR file, and its problems:
/// ljus-inspect.
///
///     ljus-inspect teapot.obj
///     ljus-inspect duck.glb --picture duck.png
///     ljus-inspect room.exr
///
/// For a mesh file the program prints what was read, what add_meshes() makes of each
/// material, and each problem with its place in the file. For an EXR file it prints the
/// layers and the range of their values. The picture is path-traced.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/command_line.hpp"
#include "common/program_files.hpp"
#include "common/save_picture.hpp"
#include "ljus/io/load_mesh.hpp"
#include "ljus/lights/environment.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scene/world.hpp"

namespace {

using namespace ljus;

/// The kind of surface that add_meshes() makes of a material, in words.
std::string surface_text(const MeshMaterial& is) {
    std::string text = is.is_glass()    ? "glass of index " + to_text(is.index)
                       : is.is_mirror() ? "mirror of " + to_text(Vec3(is.specular))
                                        : "matt " + to_text(Vec3(is.diffuse));
    if (is.is_mirror() && is.roughness > 0)
        text += ", roughness " + to_text(is.roughness);
    if (is.emission != glm::dvec3(0)) text += ", emits " + to_text(Vec3(is.emission));
    const auto named = [&](const char* what, const MeshImage& image) {
        if (!image.name.empty()) text += what + shown_path(image.name);
    };
    named(", picture ", is.picture);
    named(", holes by ", is.mask);
    named(", normals by ", is.normals);
    return text;
}

Box box_of(const LoadedMesh& loaded) {
    Box box;
    for (const auto& part : loaded.parts) box = box_union(box, part.mesh.tree().box());
    return box;
}

void print_content(const LoadedMesh& loaded) {
    const MeshContent& has = loaded.report.content;
    std::printf("  read       %lld vertices (%lld in no face), %lld normals, %lld "
                "texture coordinates,\n             %lld objects, %lld groups\n",
                has.vertices, has.unused, has.normals, has.uvs, has.objects,
                has.groups);
    std::printf("  faces      %lld, %lld of them with more than three corners, which "
                "are cut;\n             %lld without normals, %lld without texture "
                "coordinates\n",
                has.faces, has.polygons, has.flat_faces, has.no_uv_faces);
    double area = 0;
    std::size_t triangles = 0;
    for (const auto& part : loaded.parts) {
        area += part.mesh.area_up_to().back();
        triangles += part.mesh.size();
    }
    const Box box = box_of(loaded);
    std::printf("  triangles  %zu; materials %zu\n  box        %s to %s\n"
                "  area       %.6g\n",
                triangles, loaded.parts.size(), to_text(box.low).c_str(),
                to_text(box.high).c_str(), area);
    if (has.closed)
        std::printf("  closed     yes; volume %.6g%s\n", has.volume,
                    has.volume < 0 ? ": the faces look inwards, it is inside out" : "");
    else
        std::printf("  closed     no\n");
    for (const auto& [mesh, material] : loaded.parts)
        std::printf("  material   %s: %u triangles, %s, %s, %s\n",
                    material.name.empty() ? "(none)" : shown(material.name).c_str(),
                    mesh.size(), surface_text(material).c_str(),
                    mesh.data().normals.empty() ? "flat" : "smooth",
                    mesh.data().uv.empty() ? "no texture coordinates"
                                           : "with texture coordinates");
    for (const MeshCameraT<float>& one : loaded.cameras)
        std::printf("  camera     %s at %s\n",
                    one.name.empty() ? "(no name)" : one.name.c_str(),
                    to_text(one.camera.position).c_str());
    if (loaded.points.size() + loaded.spots.size() + loaded.suns.size() > 0)
        std::printf("  lights     %zu points, %zu spots, %zu suns\n",
                    loaded.points.size(), loaded.spots.size(), loaded.suns.size());
    const std::string odd = to_text(loaded.report);
    std::printf("%s%s", odd.empty() ? "nothing is odd\n" : "odd:\n", odd.c_str());
}

/// The camera of this name, or the first camera of the file if the name is empty. If
/// the file has no camera: a camera in front of all meshes, a little to the right and
/// above.
Camera camera_of(const LoadedMesh& loaded, const std::string& name) {
    std::string names;
    for (const MeshCameraT<float>& one : loaded.cameras) {
        if (name.empty() || one.name == name) return one.camera;
        names += (names.empty() ? "" : ", ") + shown(one.name);
    }
    if (!name.empty())
        throw std::invalid_argument("--camera is " + shown(name) + "; the file has " +
                                    (names.empty() ? "no camera" : names) + ".");
    const auto [low, high] = box_of(loaded);
    const Vec3 middle = 0.5f * (low + high), way{0.6f, 0.5f, 1.2f};
    return look_at({.position = middle + glm::distance(low, high) * way,
                    .target = middle,
                    .vfov_degrees = 40});
}

/// A picture of all meshes in their own colours. If nothing in the file emits light, a
/// sky lights them.
Image picture_of(const LoadedMesh& loaded, const Camera& camera) {
    Scene<Shapes<Mesh>,
          Materials<Lambertian, Mirror, Glossy, Glass, MeshPicture, MeshMetalPicture,
                    MeshDetailed, MeshMetalDetailed>,
          Lights<PointLight, SpotLight, SunLight, EnvironmentLight>>
        scene;
    add_meshes(scene, loaded);
    if (scene.light_count() == 0)
        scene.add(
            EnvironmentLight{.picture = gradient_sky(Rgb{1}, Rgb{1.5f}, Rgb{0.3f})});
    const World world(std::move(scene));
    return render(PathTracer(world), camera,
                  {.width = 400, .height = 300, .samples = 64})
        .image;
}

/// Prints the layers of an EXR file.
void print_layers(const std::string& path) {
    std::printf("%s\n", shown_path(path).c_str());
    for (const Layer& layer : examples::load_exr_layers(path)) {
        std::string names;
        double low = 0, high = 0, sum = 0;
        long long finite = 0, others = 0;
        for (std::size_t c = 0; c < layer.channels.size(); ++c) {
            names += (c == 0 ? "" : ", ") + shown(channel_name(layer, c));
            for (const Rgb& color : layer.image.pixels) {
                const double value = color[int(c)];
                if (!std::isfinite(value)) {
                    ++others;
                    continue;
                }
                low = finite == 0 ? value : std::min(low, value);
                high = finite == 0 ? value : std::max(high, value);
                sum += value;
                ++finite;
            }
        }
        std::printf("  layer      %s: %d x %d, from %.6g to %.6g, mean %.6g; %lld "
                    "values are not finite\n",
                    names.c_str(), layer.image.width, layer.image.height, low, high,
                    finite == 0 ? 0 : sum / double(finite), others);
    }
}

void body(examples::CommandLine& line) {
    std::string path, picture, camera;
    MeshFileSettings settings;
    line.about(
        "Prints what a mesh file (OBJ, PLY, STL, glTF) has in it, and what is odd "
        "about it; or the layers of an EXR file.");
    line.file_types({".obj"}); // parse() then creates no folder
    line.without({"--quality", "--seed", "--threads", "--width", "--height", "--rays",
                  "--out", "--quiet"});
    line.add_positional("MESH", path, "The file");
    line.add("--scale", settings.scale, "Factor of every coordinate", 1e-9, 1e9);
    line.add("--normals", settings.normals, "Of the file, smooth, or flat");
    line.add("--picture", picture, "Makes this picture of it (PNG, HDR, PFM or EXR)");
    line.add("--camera", camera, "The camera of the picture, by its name in the file");
    (void)line.parse();
    if (examples::is_exr(path)) {
        for (const std::string& option : line.all_given())
            throw std::invalid_argument(option + " is for meshes; '" + path +
                                        "' is an EXR file");
        return print_layers(path);
    }

    if (!camera.empty() && picture.empty())
        throw std::invalid_argument("--camera needs --picture");
    constexpr std::string_view types[]{".png", ".hdr", ".pfm", ".exr"};
    if (!picture.empty() && std::find(std::begin(types), std::end(types),
                                      examples::type_of(picture)) == std::end(types))
        throw std::invalid_argument("--picture is " + picture +
                                    "; its name must end in .png, .hdr, .pfm or .exr");
    const FilesRead read;
    const LoadedMesh loaded = load_mesh(path, settings);
    if (!picture.empty())
        examples::require_outputs({{"--picture", picture}}, examples::paths_of(read));
    std::printf("%s\n", shown_path(path).c_str());
    print_content(loaded);
    if (!picture.empty())
        examples::save_picture(picture_of(loaded, camera_of(loaded, camera)), picture,
                               0);
}

} // namespace

/// Inspects a mesh file.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, body);
}
