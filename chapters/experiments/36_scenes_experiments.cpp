// smoke: --quality draft --scene fog
/// \file chapters/experiments/36_scenes_experiments.cpp
/// \brief Chapter 36: the presets against path tracing in scenes of the part "Beyond
/// the room".
///
/// What a preset may be off by is what tests/random_scenes_test.cpp allows.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <ljus/inspect/survey.hpp>
#include <ljus/io/load_json.hpp>
#include <ljus/io/load_mesh.hpp>
#include <ljus/math/stratified_stream.hpp>
#include <ljus/render/gathering.hpp>
#include <ljus/render/lamp_shares.hpp>
#include <ljus/render/path_tracing.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

using examples::text;
using FileWorld = World<decltype(LoadedScene::scene)>;

// --- The scenes ----------------------------------------------------------------------

/// A point or a vector as JSON.
std::string list(double x, double y, double z) {
    return "[" + text(x) + "," + text(y) + "," + text(z) + "]";
}

std::string quad(const char* material, const std::string& corner, const std::string& u,
                 const std::string& v, const std::string& more = "") {
    return R"({"type":"quad","material":")" + std::string(material) + R"(","corner":)" +
           corner + R"(,"edge_u":)" + u + R"(,"edge_v":)" + v + more + "},";
}

std::string box(const char* material, const std::string& low, const std::string& high) {
    return R"({"type":"box","material":")" + std::string(material) + R"(","low":)" +
           low + R"(,"high":)" + high + "},";
}

std::string ball(const char* material, const std::string& center, double radius,
                 const std::string& more = "") {
    return R"({"type":"sphere","material":")" + std::string(material) +
           R"(","center":)" + center + R"(,"radius":)" + text(radius) + more + "},";
}

std::string tube(const char* material, double low, double high, double radius) {
    return R"({"type":"cylinder","ends":"closed","material":")" +
           std::string(material) + R"(","base":)" + list(0, low, 0) + R"(,"axis":)" +
           list(0, high - low, 0) + R"(,"radius":)" + text(radius) + "},";
}

/// A square lamp that shines down.
std::string lamp(double x, double y, double z, double side, double radiance,
                 const char* material = "wall") {
    return quad(material, list(x - side / 2, y, z - side / 2), list(side, 0, 0),
                list(0, 0, side),
                R"(,"emission":)" + list(radiance, radiance, radiance));
}

/// A scene of this program.
struct Scenery {
    const char* chapter;
    const char* name;
    std::string materials; ///< Besides those of make().
    std::string objects;
    std::string rest = ""; ///< Members of the file: lights, fog.
    bool open = false;     ///< Light leaves it.
    bool sun = false;      ///< It has a sky with a sun, as a picture.
    double bias_of(Preset preset) const {
        return (preset == Preset::draft ? 0.06 : 0.05) * (open ? 2 : 1);
    }
};

std::vector<Scenery> sceneries() {
    const std::string room = box("wall", list(-1, 0, -1), list(1, 2, 1));
    const std::string lit = room + lamp(0, 1.98, 0, 0.6, 8);
    const std::string yard =
        quad("wall", list(-6, 0, -6), list(0, 0, 12), list(12, 0, 0)) +
        ball("clay", list(-0.7, 0.4, -0.4), 0.4) +
        ball("mirror", list(0, 0.3, -0.7), 0.3) +
        ball("glass", list(0.6, 0.41, 0), 0.4);
    const std::string shiny = R"("glass":{"type":"dielectric","ior":1.5},
        "mirror":{"type":"mirror","reflectance":[0.9,0.9,0.9]},)";
    const auto glass = [](const char* name, double index, int priority) {
        return "\"" + std::string(name) + R"(":{"type":"dielectric","ior":)" +
               text(index) + R"(,"priority":)" + std::to_string(priority) + "},";
    };
    const auto fog = [](double scattering) {
        return R"("fog":[{"type":"box","low":[-1.1,-0.1,-1.1],"high":[1.1,2.1,1.1],
               "scattering":)" +
               list(scattering, scattering, scattering) + R"(,"g":0.3}],)";
    };
    const std::string gradient = R"("lights":[{"type":"environment","gradient":
        {"horizon":[0.9,1,1.1],"zenith":[0.2,0.4,0.9],"ground":[0.5,0.4,0.3]}}],)";
    std::string window;
    for (const auto& [corner, u, v] :
         {std::array{list(-1, 0, -1), list(0, 0, 2), list(2, 0, 0)},
          std::array{list(-1, 2, -1), list(2, 0, 0), list(0, 0, 2)},
          std::array{list(-1, 0, -1), list(2, 0, 0), list(0, 2, 0)},
          std::array{list(-1, 0, 1), list(0, 2, 0), list(2, 0, 0)},
          std::array{list(1, 0, -1), list(0, 0, 2), list(0, 2, 0)},
          std::array{list(-1, 0, -1), list(0, 2, 0), list(0, 0, 0.5)},
          std::array{list(-1, 0, 0.5), list(0, 2, 0), list(0, 0, 0.5)},
          std::array{list(-1, 0, -0.5), list(0, 0.6, 0), list(0, 0, 1)},
          std::array{list(-1, 1.6, -0.5), list(0, 0.4, 0), list(0, 0, 1)}})
        window += quad("wall", corner, u, v);
    std::string sealed = room + lamp(0, 1.98, 0, 0.4, 10);
    for (int i = 0; i < 50; ++i) {
        const double x = -2 + 0.4 * (i % 10), y = 0.4 * (i / 10);
        sealed += box("wall", list(x, y, -3), list(x + 0.3, y + 0.3, -2.7)) +
                  lamp(x + 0.15, y + 0.285, -2.85, 0.12, 1000.0 / 9);
    }
    const std::string places =
        R"(,"places":[[0.4,0.2,0,-0.7, -0.2,0.4,0,0.2, 0,0,0.4,-0.6],
        [0.3,0,0.1,0.2, 0,0.6,0,0.01, -0.1,0,0.3,-0.3]]},)";
    const auto cubes = [&](const char* material, const std::string& where) {
        return R"({"type":"instances","file":"d4_cube_bom.obj","material":")" +
               std::string(material) + "\"" + where;
    };
    return {
        {"39", "even sky", shiny, yard,
         R"("lights":[{"type":"environment","radiance":[1,1,1]}],)", true},
        {"39", "gradient", shiny, yard, gradient, true},
        {"39", "sky with a sun", shiny, yard, gradient, true, true},
        {"39", "window", "", window + ball("clay", list(0.2, 0.35, -0.3), 0.35),
         gradient, true},
        {"40", "rough glass",
         R"("frost":{"type":"rough-glass","ior":1.5,"roughness":0.4},
            "blur":{"type":"rough-glass","ior":1.5,"roughness":0.1},)",
         lit + ball("frost", list(-0.4, 0.41, -0.3), 0.4) +
             ball("blur", list(0.45, 0.41, 0), 0.4)},
        {"40", "water in a glass",
         glass("glass", 1.5, 1) + glass("hollow", 1, 2) + glass("water", 1.33, 3) +
             glass("bubble", 1, 4),
         lit + tube("glass", 0.002, 0.8, 0.4) + tube("hollow", 0.08, 0.9, 0.34) +
             tube("water", 0.07, 0.6, 0.35) +
             ball("bubble", list(0.05, 0.35, 0.05), 0.15)},
        {"41", "fog", "", lit + ball("clay", list(-0.3, 0.4, -0.3), 0.4), fog(0.3)},
        {"42", "fog with a glass ball", shiny,
         lit + ball("glass", list(0, 0.9, -0.1), 0.4), fog(0.3)},
        {"43", "prism", R"("flint":{"type":"dispersive-glass","ior":1.75,"abbe":25},)",
         lit + R"({"type":"triangles","material":"flint","vertices":
             [[-0.4,0.4,-0.5],[0.4,0.4,-0.5],[0,1,-0.5],
              [-0.4,0.4,0.3],[0.4,0.4,0.3],[0,1,0.3]],"indices":
             [[0,2,1],[3,4,5],[0,1,4],[0,4,3],[1,2,5],[1,5,4],[2,0,3],[2,3,5]]},)"},
        {"44", "instances", shiny, lit + cubes("clay", places)},
        {"44", "an instance's lamp", "",
         room + ball("clay", list(-0.3, 0.4, -0.4), 0.4) +
             cubes("wall", R"(,"emission":[6,6,6],"places":
                 [[0.4,0.2,0,0.1, -0.2,0.4,0,1.2, 0,0,0.2,-0.2]]},)")},
        {"45", "texture", R"("tiles":{"type":"mapped","file":"tile.png"},)",
         lit + quad("tiles", list(-0.9, 0.01, -0.9), list(0, 0, 1.8), list(1.8, 0, 0))},
        {"45", "holes",
         shiny + R"("leaf":{"type":"mapped","file":"holes.png","cutoff":0.5,
                    "scale":[2,2],"filter":"nearest"},)",
         lit + quad("leaf", list(-0.8, 1.2, -0.8), list(0, 0, 1.6), list(1.6, 0, 0)) +
             ball("glass", list(0.3, 0.41, -0.2), 0.4)},
        {"45", "normal map",
         R"("waves":{"type":"mapped","file":"white.png","normals":"dents.png",
            "scale":[3,3]},)",
         lit + quad("waves", list(-0.9, 0.01, -0.9), list(0, 0, 1.8), list(1.8, 0, 0))},
        {"46", "IES file", "", room + ball("clay", list(-0.3, 0.4, -0.3), 0.4),
         R"("lights":[{"type":"goniometric","position":[0,1.7,0],
            "direction":[0,-1,0],"reference":[0,0,-1],"file":"wall_washer.ies",
            "watts_per_lumen":[0.005,0.005,0.005]}],)"},
        {"46", "textured lamp",
         R"("screen":{"type":"picture-lamp","file":"tile.png"},)",
         room + ball("clay", list(-0.3, 0.4, -0.3), 0.4) +
             lamp(0, 1.98, 0, 0.8, 9, "screen")},
        {"46", "fifty sealed lamps", "", sealed},
    };
}

/// A closed scene with its camera.
struct Made {
    FileWorld world;
    LensCamera camera;
};

Made make(const Scenery& of) {
    std::string objects = of.objects;
    objects.pop_back(); // the last comma
    const bool outside = of.objects.find("[-6,0,-6]") != std::string::npos;
    const std::string camera =
        outside ? R"({"position":[0,1.2,3.5],"look_at":[0,0.35,0],"up":[0,1,0],
                     "vfov_deg":36})"
                : R"({"position":[0,1,0.95],"look_at":[0,0.8,-1],"up":[0,1,0],
                     "vfov_deg":75})";
    auto file = read_json_scene(
        R"({"image":{"width":48,"height":48},"camera":)" + camera + "," + of.rest +
            R"("materials":{)" + of.materials +
            R"("wall":{"type":"lambertian","albedo":[0.7,0.6,0.5]},
               "clay":{"type":"oren-nayar","albedo":[0.6,0.3,0.2],"sigma_deg":30}},
               "objects":[)" +
            objects + "]}",
        LJUS_SOURCE_FOLDER "/tests/inputs/" + std::string(of.name), MeshFiles{});
    if (of.sun) {
        Image& sky =
            std::get<std::vector<EnvironmentLight>>(file.scene.lights)[0].picture;
        sky = make_image(64, 32, Rgb{0.3f, 0.4f, 0.6f});
        pixel(sky, 40, 9) = Rgb{300, 280, 240};
    }
    return {FileWorld(std::move(file.scene)), file.camera};
}

// --- The comparison ------------------------------------------------------------------

constexpr int across = 3, blocks = across * across; // and the picture after them

/// Means of several pictures, with the error that their scatter gives.
struct Means {
    std::vector<std::array<double, blocks + 1>> pictures;

    void add(const Image& image) {
        std::array<double, blocks + 1> mean{};
        const int side = image.width / across;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const Rgb& c = pixel(image, x, y);
                const double value = double(c.x + c.y + c.z) / 3;
                mean[std::size_t(y / side * across + x / side)] += value / side / side;
                mean[blocks] += value / image.width / image.height;
            }
        pictures.push_back(mean);
    }
    [[nodiscard]] double mean(std::size_t i) const {
        double sum = 0;
        for (const auto& picture : pictures) sum += picture[i];
        return sum / double(pictures.size());
    }
    [[nodiscard]] double error(std::size_t i) const {
        double squares = 0;
        const double n = double(pictures.size()), middle = mean(i);
        for (const auto& picture : pictures)
            squares += (picture[i] - middle) * (picture[i] - middle);
        return std::sqrt(squares / (n * (n - 1)));
    }
};

/// A picture by a preset, as the program `render` makes it, with the same rays in every
/// pixel.
Image by_preset(const Made& made, Preset preset, int size, std::uint64_t seed,
                int threads) {
    auto settings = preset_settings(preset, size, size);
    if (made.world.has_fog()) settings.indirect = IndirectLight::photons;
    settings.caustics.seed = settings.general.seed = seed;
    settings.caustics.threads = settings.general.threads = threads;
    settings = share_by_sight(made.world, made.camera, settings, size, size);
    const RenderSettings picture{.width = size,
                                 .height = size,
                                 .samples = preset == Preset::draft ? 1 : 4,
                                 .seed = seed,
                                 .threads = threads};
    PhotonMapper mapper(made.world, settings, abilities<Gathering, StratifiedStream>);
    if (mapper.passes().cache) mapper.fill_cache(made.camera, picture);
    return render(mapper, made.camera, picture).image;
}

void compare(const Scenery& scenery, const examples::Options& options,
             examples::Table& table) {
    const Made made = make(scenery);
    const int seeds = options.pick(2, 16, 32);
    Means right;
    const PathTracer tracer(made.world);
    for (int seed = 0; seed < seeds; ++seed)
        right.add(render(tracer, made.camera,
                         {.width = options.width / 2,
                          .height = options.width / 2,
                          .samples = options.samples,
                          .seed = options.seed + std::uint64_t(seed),
                          .threads = options.threads})
                      .image);
    for (const Preset preset : {Preset::draft, Preset::fast}) {
        Means found;
        for (int seed = 0; seed < seeds; ++seed)
            found.add(by_preset(made, preset, options.width,
                                options.seed + 1000 + std::uint64_t(seed),
                                options.threads));
        const auto all = std::size_t(blocks);
        const double ratio = found.mean(all) / right.mean(all);
        const double ratio_error =
            ratio * std::hypot(found.error(all) / found.mean(all),
                               right.error(all) / right.mean(all));
        double worst = 0, worst_error = 0;
        bool kept = true;
        for (std::size_t i = 0; i <= all; ++i) {
            const double scale = right.mean(i) + right.mean(all);
            const double off = std::abs(found.mean(i) - right.mean(i)) / scale;
            const double error = std::hypot(found.error(i), right.error(i)) / scale;
            kept = kept && off < scenery.bias_of(preset) + 4 * error;
            if (off > worst) worst = off, worst_error = error;
        }
        table.rows.push_back(
            {scenery.name, preset == Preset::draft ? "draft" : "fast",
             text(ratio, "%.3f") + " ± " + text(ratio_error, "%.3f"),
             text(100 * worst, "%.1f") + " ± " + text(100 * worst_error, "%.1f"),
             text(100 * scenery.bias_of(preset), "%.0f"), kept ? "yes" : "no"});
        if (!options.quiet) examples::print_row(table.rows.back(), 22);
    }
    if (options.quiet) return;
    for (const std::string& remark : path_remarks(made.world))
        std::printf("  %s\n", remark.c_str());
}

} // namespace

/// Makes the table.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 36: the presets in scenes beyond the room.");
        line.without({"--height"});
        std::string only;
        line.add("--scene", only, "Only this one");
        const examples::Options options = line.parse(
            {.draft{12, 12, 4}, .report{48, 48, 100}, .reference{48, 48, 1024}});
        require(options.width > 0 && options.width % (2 * across) == 0, "--width",
                static_cast<long long>(options.width), "a multiple of 6");
        examples::Table table{.name = "trades-scenes",
                              .columns = {"scene", "preset", "mean over the true mean",
                                          "largest error of a block, %", "stated, %",
                                          "kept"}};
        for (const Scenery& scenery : sceneries())
            if (only.empty() || only == scenery.name) compare(scenery, options, table);
        save_table(options.path(""), table);
    });
}
