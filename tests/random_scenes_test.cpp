// long: 9 ways of carrying light in each of 20 scenes
// concept: photon_mapping
/// \file random_scenes_test.cpp
/// \brief Every way of carrying light against path tracing, in scenes drawn at random.
///
/// Each scene is rendered by a path tracer and by each carrier of light, with several
/// seeds, and the pictures are compared block by block. A carrier may be off by its
/// stated bias, a part of the sum of the block's mean and the picture's mean, and by
/// what chance allows: by Welch's t test, whose errors come from the scatter of the
/// seeds. Of all comparisons of a run together one fails by chance in a thousand runs
/// (Bonferroni).
///
/// A carrier that says itself that it has too few photons is not compared. One that says
/// what small objects lose at their edges may lose that much: half of it in a block as
/// bright as the picture.
///
/// What seems wrong is judged again with four times the seeds: where few paths are bright,
/// the scatter of a few seeds may be too small.
///
/// A block whose reference is too noisy is undecided: its standard error is too large,
/// or one seed alone makes most of its variance, as a few bright pixels do.
///
///     LJUS_SCENES=200 random_scenes_test      200 scenes instead of 20
///     LJUS_FIRST_SCENE=17 LJUS_SCENES=1 SHOW=1 random_scenes_test
///                                             scene 17, with all numbers

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "ljus/inspect/scene_remarks.hpp"
#include "ljus/math/stratified_stream.hpp"
#include "ljus/render/gathering.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/progressive.hpp"
#include "ljus/render/vertex_merging.hpp"
#include "support/random_scene.hpp"
#include "support/seed.hpp"
#include "support/student.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

constexpr int across = 3; // blocks, and down
constexpr int blocks = across * across;
constexpr int traced_seeds = 12;
constexpr int carried_seeds = 8;
constexpr int small = 24, large = 48; // pixels on a side of a picture
constexpr long long map_photons = 20000, pass_photons = 10000;
constexpr double run_risk = 1e-3; // of a false alarm

long long number_of(const char* name, long long otherwise) {
    const char* const text = std::getenv(name);
    return text ? std::strtoll(text, nullptr, 10) : otherwise;
}

/// The means of the blocks, and last of the whole picture, over several seeds.
struct Blocks {
    std::array<Mean, blocks + 1> of;

    template <typename T>
    void add(const ImageT<T>& image) {
        const int side = image.width / across;
        std::array<double, blocks + 1> sum{};
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const auto& c = pixel(image, x, y);
                const double value = double(c.x + c.y + c.z) / 3;
                sum[std::size_t(y / side * across + x / side)] += value / (side * side);
                sum[blocks] += value / (image.width * image.height);
            }
        for (std::size_t b = 0; b <= blocks; ++b) {
            of[b].add(sum[b]);
            all[b].push_back(sum[b]);
        }
    }

    /// The part of the variance that comes from one seed.
    [[nodiscard]] double part_of_one(std::size_t b) const {
        double most = 0;
        for (const double x : all[b])
            most = std::max(most, (x - of[b].mean) * (x - of[b].mean));
        return of[b].squares > 0 ? most / of[b].squares : 0;
    }

private:
    std::array<std::vector<double>, blocks + 1> all;
};

/// A way of carrying light.
struct Carrier {
    const char* name;
    double bias;          ///< Of a block, part of its mean and the picture's together.
    double specular_bias; ///< The same in a scene with mirrors or glass.
    bool blurs = false;   ///< Needs indirect photons, and says if it lacks them.
};
constexpr std::array carriers{
    Carrier{"rays", 0, 0.03},
    Carrier{"map", 0.03, 0.03, true},
    Carrier{"photons", 0.06, 0.06, true},
    Carrier{"gather", 0.03, 0.03, true},
    Carrier{"cache", 0.04, 0.04, true},
    Carrier{"draft", 0.06, 0.06},
    Carrier{"fast", 0.05, 0.05},
    Carrier{"progressive", 0.08, 0.08, true},
    Carrier{"merging", 0.03, 0.05},
};

constexpr auto listed = abilities<Gathering, StratifiedStream>;

/// Without the further rays of noisy pixels.
Image by_preset(const DrawnScene& drawn, Preset preset, std::uint64_t seed) {
    PhotonMappingSettings settings = preset_settings(preset, large, large);
    settings.caustics.seed = settings.general.seed = seed;
    settings.caustics.threads = settings.general.threads = 1;
    const RenderSettings picture{.width = large,
                                 .height = large,
                                 .samples = preset == Preset::draft ? 1 : 4,
                                 .seed = seed,
                                 .threads = 1};
    PhotonMapper mapper(drawn.world, settings, listed);
    mapper.fill_cache(drawn.camera, picture);
    return render(mapper, drawn.camera, picture).image;
}

/// Photons for the carriers that are no preset.
PhotonMappingSettings map_settings(const DrawnScene& drawn, std::uint64_t seed) {
    PhotonMappingSettings settings;
    settings.direct = drawn.sharp ? DirectLight::mis : DirectLight::sampled;
    settings.caustics = {.photons = map_photons, .seed = seed, .threads = 1};
    settings.general = {
        .photons = map_photons, .seed = seed, .shadow_photons = false, .threads = 1};
    settings.caustics_estimate.radius = settings.general_estimate.radius = 0;
    return settings;
}

/// What a mapper says about few photons, which blur the light.
std::string remarks_of(const DrawnScene& drawn, std::uint64_t seed, long long photons) {
    PhotonMappingSettings settings = map_settings(drawn, seed);
    settings.caustics.photons = settings.general.photons = photons;
    settings.indirect = IndirectLight::photons;
    const PhotonMapper mapper(drawn.world, settings, listed);
    return mapper_remarks(mapper);
}

/// The part of the light that small objects lose, by what a mapper says.
double part_lost(const std::string& remarks) {
    const std::string words = "its edges lose about ";
    const auto at = remarks.find(words);
    if (at == remarks.npos) return 0;
    return std::strtod(remarks.c_str() + at + words.size(), nullptr) / 100;
}

/// One picture by a carrier.
Image carried(const DrawnScene& drawn, const std::string& name, std::uint64_t seed) {
    if (name == "draft") return by_preset(drawn, Preset::draft, seed);
    if (name == "fast") return by_preset(drawn, Preset::fast, seed);
    if (name == "merging") {
        const VertexMerger merger(
            drawn.world, {.paths = 20000, .radius = 0.05f, .seed = seed, .threads = 1});
        return render(merger, drawn.camera,
                      {.width = small,
                       .height = small,
                       .samples = 16,
                       .seed = seed,
                       .threads = 1})
            .image;
    }
    PhotonMappingSettings settings = map_settings(drawn, seed);
    settings.indirect = name == "rays"     ? IndirectLight::rays
                        : name == "map"    ? IndirectLight::map
                        : name == "gather" ? IndirectLight::gather
                        : name == "cache"  ? IndirectLight::cache
                                           : IndirectLight::photons;
    RenderSettings picture{
        .width = small, .height = small, .samples = 16, .seed = seed, .threads = 1};
    if (name == "progressive") {
        settings.caustics.photons = settings.general.photons = pass_photons;
        settings = settings_for_passes(PhotonMapper(drawn.world, settings, listed));
        for (float* const radius :
             {&settings.caustics_estimate.radius, &settings.general_estimate.radius})
            if (*radius == 0) *radius = 0.1f; // there are no photons
        picture.samples = 4;
        ProgressiveState state;
        (void)run_progressive(
            state, 4,
            [&](long long pass, double scale) {
                return photon_mapping_pass(drawn.world, drawn.camera, settings, picture,
                                           pass, scale, listed);
            },
            [](const auto&) { return true; });
        return mean_image(state);
    }
    if (settings.indirect == IndirectLight::cache)
        picture.width = picture.height = large, picture.samples = 4;
    PhotonMapper mapper(drawn.world, settings, listed);
    mapper.fill_cache(drawn.camera, picture);
    return render(mapper, drawn.camera, picture).image;
}

/// What was found over all scenes.
struct Found {
    int compared = 0, undecided = 0, alarms = 0;
    int said = 0; ///< Carriers that say themselves that they are wrong.
};

} // namespace

TEST_CASE("random scenes: every carrier of light agrees with path tracing") {
    const auto scenes = number_of("LJUS_SCENES", 20);
    const auto first = number_of("LJUS_FIRST_SCENE", 0);
    const bool show = std::getenv("SHOW") != nullptr;
    const double risk =
        run_risk / (double(scenes) * double(carriers.size()) * (blocks + 1));
    Found all;
    for (long long scene = first; scene < first + scenes; ++scene) {
        const auto number = static_cast<std::uint64_t>(scene);
        const DrawnScene drawn = SceneDrawer(number).draw();
        const std::uint64_t key = test_seed(1000 * number);
        Blocks traced;
        const PathTracer tracer(drawn.world);
        for (std::uint64_t s = 0; s < traced_seeds; ++s)
            traced.add(render(tracer, drawn.camera,
                              {.width = small,
                               .height = small,
                               .samples = 48,
                               .seed = key + s,
                               .threads = 1})
                           .image);
        if (show) std::printf("%lld %s\n", scene, drawn.what.c_str());
        std::uint64_t seed = key + 500;
        const std::string said = remarks_of(drawn, key, map_photons);
        const auto says = [&](const char* what) {
            return said.find(what) != said.npos;
        };
        const bool blurred = says("the light between surfaces is blurred over");
        const bool blurred_caustics = says("the light of caustics is blurred over");
        const double lost = part_lost(said);
        const double lost_by_pass = part_lost(remarks_of(drawn, key, pass_photons));
        for (const Carrier& carrier : carriers) {
            const bool merges = carrier.name == std::string("merging");
            if ((blurred && carrier.blurs) || (blurred_caustics && !merges)) {
                ++all.said;
                continue;
            }
            if (merges && !drawn.merges) continue;
            const double loss = carrier.name == std::string("photons") ? lost
                                : carrier.name == std::string("progressive")
                                    ? lost_by_pass
                                    : 0;
            const double stated =
                (drawn.specular ? carrier.specular_bias : carrier.bias) *
                (drawn.open ? 2 : 1); // few photons land twice in the open
            Blocks blocks_of;
            const auto scale_of = [&](std::size_t b) {
                return traced.of[b].mean + traced.of[blocks].mean;
            };
            const auto is_vague = [&](std::size_t b) {
                return traced.of[b].error() > 0.02 * scale_of(b) ||
                       traced.part_of_one(b) > 0.6;
            };
            const auto is_alarm = [&](std::size_t b) {
                const double bias = std::max(stated, loss / 2) * scale_of(b);
                return !is_vague(b) &&
                       chance_of(blocks_of.of[b], traced.of[b], bias) < risk;
            };
            bool suspect = true;
            for (const int seeds : {carried_seeds, 3 * carried_seeds}) {
                if (!suspect) break;
                for (int s = 0; s < seeds; ++s)
                    blocks_of.add(carried(drawn, carrier.name, ++seed));
                suspect = false;
                for (std::size_t b = 0; b <= blocks; ++b)
                    suspect = suspect || is_alarm(b);
            }
            if (show) std::printf("  %-11s", carrier.name);
            for (std::size_t b = 0; b <= blocks; ++b) {
                const Mean &right = traced.of[b], &found = blocks_of.of[b];
                const double scale = scale_of(b);
                const bool vague = is_vague(b), alarm = is_alarm(b);
                ++all.compared;
                all.undecided += vague ? 1 : 0;
                all.alarms += alarm ? 1 : 0;
                if (show)
                    std::printf(" %+5.1f(%.1f)%s",
                                100 * (found.mean - right.mean) / scale,
                                100 * std::hypot(found.error(), right.error()) / scale,
                                vague   ? "?"
                                : alarm ? "!"
                                        : "");
                CAPTURE(scene);
                CAPTURE(drawn.what);
                CAPTURE(std::string(carrier.name));
                CAPTURE(b);
                CHECK_FALSE(alarm);
            }
            if (show) std::printf("\n"), std::fflush(stdout);
        }
    }
    MESSAGE(all.compared, " compared, ", all.undecided, " undecided, ", all.alarms,
            " alarms; ", all.said, " carriers said that they lack photons");
    CHECK(all.undecided < all.compared / 10);
}
