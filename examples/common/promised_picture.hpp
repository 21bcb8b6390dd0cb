#pragma once

/// \file examples/common/promised_picture.hpp
/// \brief The picture that a promise of seconds or of error is kept by.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "clock.hpp"
#include "ljus/inspect/survey.hpp"
#include "ljus/math/stratified_stream.hpp"
#include "ljus/render/adaptive.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "promise.hpp"
#include "terminal.hpp"

namespace examples {

/// A picture by a recipe, and how long it took.
template <std::floating_point T>
struct Shot {
    ljus::RenderedT<T> rendered{};          ///< The picture.
    ljus::PhotonMappingSettings settings{}; ///< With the radii that were chosen.
    std::string remarks{};                  ///< Of the first pass, each a line.
    double bytes = 0;                       ///< Of the photon maps.
    double photons = 0;                     ///< Seconds of the photon maps.
    double rest = 0;                        ///< Seconds of all else.
};

/// Makes one picture.
/// \param scene    The scene, or an IndexedScene.
/// \param camera   Its camera.
/// \param recipe   Photons and rays.
/// \param picture  Size, seed, threads, progress; its samples are not looked at.
/// \param now      A clock, in seconds.
/// \param map_seed Of the photons, if it is not that of the picture.
/// \return The picture; not complete if the progress callback stopped it.
template <ljus::SceneLike S, template <std::floating_point> typename AnyCamera,
          std::floating_point T, typename Clock>
[[nodiscard]] Shot<T> shoot(const S& scene, const AnyCamera<T>& camera,
                            const Recipe& recipe, ljus::RenderSettings picture,
                            Clock&& now, std::optional<std::uint64_t> map_seed = {}) {
    Shot<T> shot{.settings = recipe.settings};
    for (auto* pass : {&shot.settings.caustics, &shot.settings.general}) {
        pass->seed = map_seed.value_or(picture.seed);
        pass->threads = picture.threads;
        pass->progress = picture.progress;
    }
    const double begin = now();
    auto maps = make_photon_maps(scene, shot.settings);
    shot.remarks = maps.remarks;
    shot.bytes = double(maps.caustics.tree.bytes() + maps.caustics.records.bytes() +
                        maps.general.tree.bytes() + maps.general.records.bytes());
    const double middle = now();
    if (maps.complete)
        add_irradiance_cache(maps, scene, camera, picture, shot.settings);
    const auto mapper =
        ljus::make_photon_mapper<ljus::StratifiedStream>(scene, maps, shot.settings);
    shot.settings = mapper.settings;
    picture.samples = recipe.rays + recipe.more;
    if (!maps.complete) {
        shot.rendered.complete = false;
    } else if (recipe.more > 0) {
        auto seen = render_adaptive(mapper, camera, picture,
                                    {.first = recipe.rays,
                                     .more = recipe.more,
                                     .batches = 1,
                                     .disagreement = 0.22});
        shot.rendered = {std::move(seen.image), seen.counts, seen.complete};
    } else {
        shot.rendered = render(mapper, camera, picture);
    }
    shot.photons = middle - begin;
    shot.rest = now() - middle;
    return shot;
}

/// The seed of the i-th picture of several.
[[nodiscard]] constexpr std::uint64_t seed_of(std::uint64_t seed, long long i) {
    return seed + 0x9e3779b97f4a7c15u * static_cast<std::uint64_t>(i);
}

/// What each recipe would bring, by small pictures: at most 64 x 64 pixels, and photons
/// in proportion. Bias is how far the mean of the others lies from that of "exact", and
/// shrinks with the root of the photons; that of "exact" is taken from the book.
/// \param scene     The scene, or an IndexedScene.
/// \param camera    Its camera.
/// \param picture   The one that is promised.
/// \param patience  Seconds, after which no further recipe is tried.
/// \param now       A clock, in seconds.
/// \return A forecast for each recipe that was tried, for the picture itself.
template <ljus::SceneLike S, template <std::floating_point> typename AnyCamera,
          std::floating_point T, typename Clock>
[[nodiscard]] std::vector<Forecast> pilot(const S& scene, const AnyCamera<T>& camera,
                                          const ljus::RenderSettings& picture,
                                          double patience, Clock&& now) {
    constexpr std::size_t runs = 3;
    const double all = double(picture.width) * double(picture.height);
    ljus::RenderSettings small = picture;
    for (int* side : {&small.width, &small.height})
        *side =
            std::max(1, int(std::lround(*side * std::min(1.0, 64 / std::sqrt(all)))));
    const double pixels = double(small.width) * double(small.height);
    const auto large = recipes(picture.width, picture.height);
    const auto tried = recipes(small.width, small.height);
    std::vector<Forecast> found;
    std::vector<ljus::ImageT<double>> means;
    const double begin = now();
    for (std::size_t i = 0; i < tried.size(); ++i) {
        if (i > 0 && now() - begin > patience) break;
        const double photons = double(large[i].settings.caustics.photons) /
                               double(tried[i].settings.caustics.photons);
        std::array<double, runs> seconds{};
        ljus::ProgressiveState state{.alpha = 1};
        for (std::size_t run = 0; run < runs; ++run) {
            small.seed = seed_of(picture.seed, -1 - int(run));
            const auto shot = shoot(scene, camera, tried[i], small, now);
            stop_if_asked();
            add_pass(state, shot.rendered.image);
            seconds[run] = shot.photons * photons + shot.rest * all / pixels;
        }
        std::sort(seconds.begin(), seconds.end());
        means.push_back(ljus::mean_image<double>(state));
        found.push_back({.seconds = std::max(seconds[runs / 2], 1e-6),
                         .noise = relative_noise(state) * runs,
                         .bias = large[i].bias});
    }
    if (found.size() < tried.size()) return found; // nothing to compare with
    auto& best = found.back();                     // without caustics no map blurs it
    if (!survey(scene, large.back().settings).caustics_map.on) best.bias = 0;
    for (std::size_t i = 0; i + 1 < found.size(); ++i) {
        auto apart = means[i];
        for (std::size_t p = 0; p < apart.pixels.size(); ++p) {
            apart.pixels[p] -= means.back().pixels[p];
            apart.pixels[p] *= apart.pixels[p];
        }
        const double bias =
            relative(apart, means.back()) - (found[i].noise + best.noise) / runs;
        const double photons = double(tried[i].settings.caustics.photons) /
                               double(large[i].settings.caustics.photons);
        found[i].bias = best.bias + std::max(bias, 0.0) * std::sqrt(photons);
    }
    return found;
}

/// A picture as it was promised.
template <std::floating_point T>
struct Kept {
    ljus::RenderedT<T> rendered{}; ///< The mean of all pictures, and what all cost.
    Recipe recipe{};               ///< By which each was made.
    std::vector<Forecast> found{}; ///< What the pilot said.
    Choice choice{};               ///< What was chosen then.
    long long pictures = 0;        ///< How many there are.
    double seconds = 0;            ///< Since the clock began, the pilot's included.
    double noise = 0;              ///< Of the mean, by the scatter of the pictures.

    /// relMSE as far as is known.
    [[nodiscard]] double error() const { return noise + found[choice.recipe].bias; }
};

/// Keeps a promise: a pilot, a choice, and pictures until it is kept.
/// \param scene    The scene, or an IndexedScene.
/// \param camera   Its camera.
/// \param picture  Size, seed, threads.
/// \param promise  Seconds, or an error.
/// \param now      A clock, in seconds; it began at 0 when the promise was given.
/// \param quiet    Draw no progress bar.
/// \param tell     Called with a Kept of which the choice is known, and all before it.
/// \return The picture.
/// \throws Interrupted  after Ctrl-C.
/// \throws std::invalid_argument  for an error that is below the bias of all recipes.
template <ljus::SceneLike S, template <std::floating_point> typename AnyCamera,
          std::floating_point T, typename Clock, typename Tell>
[[nodiscard]] Kept<T> keep(const S& scene, const AnyCamera<T>& camera,
                           ljus::RenderSettings picture, const Promise& promise,
                           Clock&& now, bool quiet, Tell&& tell) {
    Kept<T> kept;
    auto go_on = [](long long, long long) { return stop_signal() == 0; };
    picture.progress = go_on;
    kept.found = pilot(scene, camera, picture,
                       promise.seconds > 0 ? promise.seconds / 8 : 10.0, now);
    kept.choice = choose(kept.found, promise, promise.seconds - now());
    kept.recipe = recipes(picture.width, picture.height)[kept.choice.recipe];
    const double bias = kept.found[kept.choice.recipe].bias;
    if (promise.error > 0 && bias >= promise.error)
        throw std::invalid_argument("--error is " + two_digits(promise.error) +
                                    "; the least bias of all "
                                    "settings is " +
                                    two_digits(bias) +
                                    " here, and no time takes it away.");
    tell(kept);

    ProgressBar bar("pictures", quiet);
    const double pilot_seconds = now();
    auto draw = [&](long long, long long) {
        const double part = (now() - pilot_seconds) / kept.choice.seconds;
        return bar(static_cast<long long>(1000 * std::min(part, 1.0)), 1000);
    };
    if (!quiet) picture.progress = draw;
    ljus::ProgressiveState state{.alpha = 1};
    const std::uint64_t seed = picture.seed;
    // [keep]
    for (bool done = false; !done;) {
        picture.seed = seed_of(seed, kept.pictures);
        auto shot = shoot(scene, camera, kept.recipe, picture, now);
        stop_if_asked();
        add_pass(state, shot.rendered.image);
        ++kept.pictures;
        kept.rendered.counts += shot.rendered.counts;
        kept.recipe.settings = shot.settings;
        kept.noise = relative_noise(state);
        kept.seconds = now();
        const double one = (kept.seconds - pilot_seconds) / double(kept.pictures);
        const double unsure = 2 * kept.noise / double(kept.pictures);
        done = promise.seconds > 0 ? kept.seconds + one / 2 > promise.seconds
                                   : kept.error() + unsure <= promise.error;
    }
    // [keep]
    kept.rendered.image = ljus::mean_image<T>(state);
    return kept;
}

} // namespace examples
