// smoke: --quality draft --width 16 --height 16 --rays 1
/// \file chapters/experiments/46_experiments.cpp
/// \brief Chapter 46: the experiments behind its tables: how the points of a textured
/// lamp are drawn, and shares of photons with lamps that nobody sees.

#include <cmath>
#include <string>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>
#include <ljus/math/stratified_stream.hpp>
#include <ljus/render/gathering.hpp>
#include <ljus/render/lamp_shares.hpp>
#include <ljus/scene/picture_lamp.hpp>

#include "common/example.hpp"

namespace {

using ljus::Quad;
using ljus::Rgb;
using ljus::Vec2T;
using ljus::Vec3;
using ljus::Vec3T;

/// A square window, one of whose 16 x 16 pixels is brighter than the others.
ljus::PictureLightT<double> window_with_sun(double sun) {
    auto picture = ljus::make_image<double>(16, 16, ljus::RgbT<double>{1.0});
    pixel(picture, 5, 7) = ljus::RgbT<double>{sun};
    return make_picture_light(
        ljus::QuadT<double>{{-0.5, -0.5, 0}, {1, 0, 0}, {0, 1, 0}}, picture,
        ljus::RgbT<double>{1.0}, false);
}

/// Variance over squared mean of one sample, over a grid of the unit square.
template <typename Estimate>
double relative_variance(int size, const Estimate& estimate) {
    double sum = 0, squares = 0;
    for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) {
            const double value =
                estimate(Vec2T<double>{(i + 0.5) / size, (j + 0.5) / size});
            sum += value;
            squares += value * value;
        }
    return squares * size * size / (sum * sum) - 1;
}

/// Table: the variance of shadow rays to points that are uniform over the window, and
/// drawn by brightness, from a metre and from a decimetre before its middle.
void tabulate_contrast(const std::string& folder, int size) {
    examples::Table table{.name = "lamps-contrast",
                          .columns = {"sun over sky", "uniform at 1 m",
                                      "by brightness at 1 m", "uniform at 0.1 m",
                                      "by brightness at 0.1 m"}};
    for (const double sun : {1.0, 10.0, 100.0, 1000.0, 10'000.0}) {
        const auto light = window_with_sun(sun);
        std::vector<std::string> row{examples::text(sun, "%.0f")};
        for (const double away : {1.0, 0.1}) {
            const Vec3T<double> from{0, 0, away};
            const auto uniform = [&](const Vec2T<double>& u) {
                const Vec3T<double> way = Vec3T<double>{u.x - 0.5, u.y - 0.5, 0} - from;
                const double d2 = glm::dot(way, way);
                return radiance_at(light, u).x * away * away / (d2 * d2);
            };
            const auto bright = [&](const Vec2T<double>& u) {
                const auto sample = sample_light(light, from, u, 0.0);
                return sample->weight.x * -sample->wi.z;
            };
            row.push_back(examples::text(relative_variance(size, uniform), "%.3g"));
            row.push_back(examples::text(relative_variance(size, bright), "%.3g"));
        }
        examples::print_row(row, 20);
        table.rows.push_back(row);
    }
    save_table(folder, table);
}

using RoomScene = ljus::Scene<ljus::Shapes<Quad>, ljus::Materials<ljus::Lambertian>>;

/// A room with a lamp, other lamps behind the camera, and lamps in closed boxes behind
/// the room; all have the same power.
ljus::World<RoomScene> room_with_lamps(int others, int sealed) {
    RoomScene scene;
    const auto wall = scene.add(ljus::Lambertian{.albedo{0.7f, 0.6f, 0.5f}});
    const auto add_lamp = [&](const Vec3& corner, float side, float radiance) {
        scene.add(Quad{corner, {side, 0, 0}, {0, 0, side}}, wall, Rgb{radiance});
    };
    for (const Quad& side : sides_of(ljus::Box{{-1, 0, -1}, {1, 2, 1}}))
        scene.add(side, wall, {}, true);
    add_lamp({-0.2f, 1.99f, -0.2f}, 0.4f, 10);
    for (int i = 0; i < others; ++i)
        add_lamp({-0.9f + 0.3f * float(i), 1.9f, 0.5f}, 0.2f, 40);
    for (int i = 0; i < sealed; ++i) {
        const Vec3 low{-2 + 0.4f * float(i % 10), 0.4f * float(i / 10), -3};
        for (const Quad& side : sides_of(ljus::Box{low, low + Vec3{0.3f}}))
            scene.add(side, wall);
        add_lamp(low + Vec3{0.09f, 0.285f, 0.09f}, 0.12f, 1000.0f / 9);
    }
    return ljus::World(std::move(scene));
}

/// Table: the error of a picture by the preset fast, with photons shared by power and by
/// sight. Its light is that of the room without sealed lamps.
void tabulate_shares(const examples::Options& options) {
    examples::Table table{.name = "lamps-shares",
                          .columns = {"lamps in the room", "sealed lamps",
                                      "photons kept by power", "by sight",
                                      "error by power", "error by sight"}};
    const auto camera = look_at(
        ljus::View{.position{0, 1, 0.95f}, .target{0, 1, -1}, .vfov_degrees = 80});
    const int width = options.width, height = options.height;
    for (const auto& [others, sealed] :
         {std::pair(0, 1), {0, 5}, {0, 20}, {0, 50}, {2, 0}, {6, 0}, {6, 6}}) {
        const auto clear = room_with_lamps(others, 0);
        auto settings = examples::picture_settings(options);
        settings.samples = 64 * options.samples;
        const auto reference = examples::rendered("reference", ljus::PathTracer(clear),
                                                  camera, settings, options)
                                   .image;
        const auto world = room_with_lamps(others, sealed);
        double error[2] = {}, kept[2] = {};
        constexpr int seeds = 4;
        for (int seed = 0; seed < seeds; ++seed)
            for (const bool by_sight : {false, true}) {
                auto maps = ljus::preset_settings(ljus::Preset::fast, width, height);
                maps.general.photons = 45'000;
                maps.general.seed = options.seed + std::uint64_t(seed);
                if (by_sight) maps = share_by_sight(world, camera, maps, width, height);
                ljus::PhotonMapper mapper(
                    world, maps,
                    ljus::abilities<ljus::Gathering, ljus::StratifiedStream>);
                settings.samples = options.samples;
                settings.seed = options.seed + std::uint64_t(seed);
                mapper.fill_cache(camera, settings);
                const auto image =
                    examples::rendered("shares", mapper, camera, settings, options)
                        .image;
                error[by_sight] += ljus::block_error(image, reference, 8) / seeds;
                for (std::size_t i = 0; i < mapper.maps().general.records.size(); ++i)
                    kept[by_sight] +=
                        mapper.maps().general.tree.point(i).z > -1.1f ? 1.0 / seeds : 0;
            }
        table.rows.push_back({std::to_string(1 + others), std::to_string(sealed),
                              examples::text(kept[0], "%.0f"),
                              examples::text(kept[1], "%.0f"),
                              examples::text(100 * std::sqrt(error[0]), "%.2f %%"),
                              examples::text(100 * std::sqrt(error[1]), "%.2f %%")});
        examples::print_row(table.rows.back(), 18);
    }
    save_table(options.path(""), table);
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 46, lamps: how their points and their photons are drawn.");
        const examples::Options options = line.parse(
            {.draft{32, 32, 1}, .report{64, 64, 2}, .reference{192, 192, 8}});
        tabulate_contrast(options.path(""), options.pick(160, 1600, 3200));
        tabulate_shares(options);
    });
}
