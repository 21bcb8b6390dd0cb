/// \file inspect.cpp
/// \brief Prints the content of a mesh file or an EXR file, and its problems:
/// ljus-inspect.
///
///     ljus-inspect teapot.obj
///     ljus-inspect duck.glb --out duck.png
///     ljus-inspect room.exr
///
/// For a mesh file the program prints what was read, what add_meshes() makes of each
/// material, and each problem with its place in the file. For an EXR file it prints the
/// layers and the range of their values. The picture is path-traced.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/program_files.hpp"
#include "common/save_picture.hpp"
#include "ljus/io/load_mesh.hpp"
#include "ljus/lights/environment.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scene/world.hpp"

using namespace ljus;

namespace {

/// A picture of all meshes in their own colours, by the file's first camera, or else
/// from the front, a little to the right and above; under a sky if nothing glows.
Image picture_of(const LoadedMesh& loaded) {
    Scene<Shapes<Mesh>,
          Materials<Lambertian, Mirror, Glossy, Glass, MeshPicture, MeshMetalPicture,
                    MeshDetailed, MeshMetalDetailed>,
          Lights<PointLight, SpotLight, SunLight, EnvironmentLight>>
        scene;
    add_meshes(scene, loaded);
    if (scene.light_count() == 0)
        scene.add(
            EnvironmentLight{.picture = gradient_sky(Rgb{1}, Rgb{1.5f}, Rgb{0.3f})});
    Box box;
    for (const auto& part : loaded.parts) box = box_union(box, part.mesh.tree().box());
    const auto [low, high] = box;
    const Vec3 middle = 0.5f * (low + high), way{0.6f, 0.5f, 1.2f};
    const Camera camera =
        loaded.cameras.empty()
            ? look_at({.position = middle + glm::distance(low, high) * way,
                       .target = middle,
                       .vfov_degrees = 40})
            : loaded.cameras.front().camera;
    const World world(std::move(scene));
    return render(PathTracer(world), camera,
                  {.width = 400, .height = 300, .samples = 64})
        .image;
}

/// Prints the layers of an EXR file.
void print_layers(const std::string& path) {
    for (const Layer& layer : examples::load_exr_layers(path)) {
        std::string names;
        std::vector<float> values; // those that are finite
        for (std::size_t c = 0; c < layer.channels.size(); ++c) {
            names += (c == 0 ? "" : ", ") + shown(channel_name(layer, c));
            for (const Rgb& color : layer.image.pixels)
                if (std::isfinite(color[int(c)])) values.push_back(color[int(c)]);
        }
        const std::size_t others =
            layer.channels.size() * layer.image.pixels.size() - values.size();
        if (values.empty()) values = {0};
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        std::printf(
            "  layer      %s: %d x %d, from %.6g to %.6g, %zu values are not finite\n",
            names.c_str(), layer.image.width, layer.image.height, double(*low),
            double(*high), others);
    }
}

void body(examples::CommandLine& line) {
    std::string path;
    line.about(
        "Prints what a mesh file (OBJ, PLY, STL, glTF) has in it, and what is odd "
        "about it; or the layers of an EXR file. --out NAME.png makes a picture of a "
        "mesh.");
    line.without({"--quality", "--seed", "--threads", "--width", "--height", "--rays",
                  "--quiet"});
    line.add_positional("FILE", path, "The file");
    line.file_types(examples::picture_types());
    const examples::Options options = line.parse();
    const bool draws = line.given("--out");
    if (examples::is_exr(path)) {
        if (draws)
            throw std::invalid_argument("--out is for meshes; '" + path +
                                        "' is an EXR file");
        std::printf("%s\n", shown_path(path).c_str());
        return print_layers(path);
    }
    const std::string picture =
        options.path(options.file.empty() ? "mesh.png" : options.file);
    const FilesRead read;
    const LoadedMesh loaded = load_mesh(path);
    examples::require_outputs({{"--out", draws ? picture : ""}},
                              examples::paths_of(read));
    std::printf("%s\n%s", shown_path(path).c_str(), to_text(loaded).c_str());
    if (draws) examples::save_picture(picture_of(loaded), picture, 0);
}

} // namespace

/// Inspects a file.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, body);
}
