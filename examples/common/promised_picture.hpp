#pragma once

/// \file examples/common/promised_picture.hpp
/// \brief The picture that a promise of seconds or of error is kept by.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "clock.hpp"
#include "convergence.hpp"
#include "ljus/inspect/survey.hpp"
#include "ljus/math/stratified_stream.hpp"
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
    picture.samples = recipe.rays;
    if (maps.complete)
        shot.rendered = render(mapper, camera, picture);
    else
        shot.rendered.complete = false;
    shot.rendered.counts += maps.cache.counts;
    shot.photons = middle - begin;
    shot.rest = now() - middle;
    return shot;
}

/// The seed of the i-th picture of several.
[[nodiscard]] constexpr std::uint64_t seed_of(std::uint64_t seed, long long i) {
    return seed + 0x9e3779b97f4a7c15u * static_cast<std::uint64_t>(i);
}

namespace detail {

/// What a pilot tries: a recipe, and the small pictures by it.
struct Trial {
    Recipe recipe{};
    std::vector<double> seconds{}; ///< As long as the large picture would take.
    std::vector<ljus::ImageT<double>> pictures{}; ///< Of different seeds.
    ljus::ProgressiveState state{.alpha = 1};     ///< Their sums.
};

/// How far the pictures of a trial are from those of the judge, seed by seed: both have
/// the same camera rays, so that what they share falls out.
/// \param trial  The trial.
/// \param judge  Of as many pictures.
[[nodiscard]] inline std::vector<ljus::ImageT<double>> apart(const Trial& trial,
                                                             const Trial& judge) {
    const auto truth = levels(judge.state);
    std::vector<ljus::ImageT<double>> all;
    for (std::size_t run = 0; run < trial.pictures.size(); ++run) {
        auto away = trial.pictures[run];
        for (std::size_t p = 0; p < away.pixels.size(); ++p)
            away.pixels[p] -= judge.pictures[run].pixels[p];
        all.push_back(weighed(away, truth));
    }
    return all;
}

} // namespace detail

/// What each recipe would bring, by small pictures: at most 64 x 64 pixels, and photons
/// in proportion.
///
/// The bias is measured against a *judge*: "exact" with eight times the photons, and so
/// about a third of the radius. What is left of the blur at that radius is not seen.
/// The estimate is unbiased itself, since it multiplies differences of different seeds
/// only; it shrinks with the root of the photons, and is weighed with what the book
/// knows.
/// \param scene    The scene, or an IndexedScene.
/// \param camera   Its camera.
/// \param picture  The one that is promised.
/// \param promise  It goes on for an eighth of the time that the promise will take, and
///                 for 10 s at most if that is not promised. After it no recipe is
///                 tried if seconds are promised, and the judge not after half of it.
/// \param now      A clock, in seconds.
/// \return A forecast for each recipe that was tried, for the picture itself.
template <ljus::SceneLike S, template <std::floating_point> typename AnyCamera,
          std::floating_point T, typename Clock>
[[nodiscard]] std::vector<Forecast> pilot(const S& scene, const AnyCamera<T>& camera,
                                          const ljus::RenderSettings& picture,
                                          const Promise& promise, Clock&& now) {
    constexpr std::size_t least = 3, most = 64; // pictures by each
    const double all = double(picture.width) * double(picture.height);
    ljus::RenderSettings small = picture;
    for (int* side : {&small.width, &small.height})
        *side =
            std::max(1, int(std::lround(*side * std::min(1.0, 64 / std::sqrt(all)))));
    const double pixels = double(small.width) * double(small.height);
    auto large = recipes(picture.width, picture.height);
    std::vector<detail::Trial> trials;
    for (const Recipe& recipe : recipes(small.width, small.height))
        trials.push_back({.recipe = recipe});
    if (survey(scene, large.back().settings).caustics_map.on) {
        trials.push_back({.recipe = trials.back().recipe}); // the judge
        trials.back().recipe.settings.caustics.photons *= 8;
    } else {
        large.back().bias = 0; // exact needs no map, and is the judge itself
    }

    // How many of the large picture's photons the small one has not.
    const auto photons = [&](std::size_t i) {
        return double(large[i].settings.caustics.photons) /
               double(trials[i].recipe.settings.caustics.photons);
    };
    const auto try_again = [&](std::size_t i) {
        detail::Trial& trial = trials[i];
        small.seed = seed_of(picture.seed, -1 - trial.state.passes);
        const auto shot = shoot(scene, camera, trial.recipe, small, now);
        stop_if_asked();
        add_pass(trial.state, shot.rendered.image);
        auto& kept = trial.pictures.emplace_back(
            ljus::ImageT<double>{small.width, small.height, {}});
        for (const auto& color : shot.rendered.image.pixels)
            kept.pixels.push_back(ljus::RgbT<double>(color));
        if (i < large.size())
            trial.seconds.push_back(shot.photons * photons(i) +
                                    shot.rest * all / pixels);
    };
    const auto forecast = [&](bool judged) {
        const auto none = ljus::make_image<double>(small.width, small.height);
        std::vector<Forecast> found;
        for (std::size_t i = 0; i < std::min(trials.size(), large.size()); ++i) {
            const detail::Trial& trial = trials[i];
            double bias = 0, error = std::numeric_limits<double>::infinity();
            if (judged) {
                const auto apart = detail::apart(trial, trials.back());
                const double shrink = 1 / std::sqrt(photons(i));
                bias = bias_variance(apart, none).bias_squared * shrink;
                error = bias_error(apart) * shrink;
            }
            found.push_back(weigh(bias, error, large[i].bias));
            auto seconds = trial.seconds;
            std::sort(seconds.begin(), seconds.end());
            found.back().seconds = std::max(seconds[seconds.size() / 2], 1e-6);
            found.back().noise =
                relative_noise(trial.state) * double(trial.state.passes);
        }
        return found;
    };

    const double begin = now();
    const auto patience = [&](const std::vector<Forecast>& found) {
        return promise.seconds > 0 ? promise.seconds / 8
                                   : std::min(choose(found, promise).seconds / 8, 10.0);
    };
    for (std::size_t i = 0; i < trials.size(); ++i) {
        const bool judge = i == large.size(); // takes as long as the others together
        const double limit = judge                 ? patience(forecast(false)) / 2
                             : promise.seconds > 0 ? promise.seconds / 8
                                                   : std::numeric_limits<double>::max();
        if (i > 0 && now() - begin > limit) {
            trials.resize(i);
            return forecast(false);
        }
        for (std::size_t run = 0; run < least; ++run) try_again(i);
    }
    auto found = forecast(true);
    for (std::size_t runs = least; runs < most; ++runs) {
        const double took = now() - begin;
        if (took + took / double(runs) > patience(found)) break;
        for (std::size_t i = 0; i < trials.size(); ++i) try_again(i);
        found = forecast(true);
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

    /// What the pilot said of the recipe that was chosen.
    [[nodiscard]] const Forecast& forecast() const { return found[choice.recipe]; }
    /// relMSE as far as is known.
    [[nodiscard]] double error() const { return noise + forecast().bias; }
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
    kept.found = pilot(scene, camera, picture, promise, now);
    kept.choice = choose(kept.found, promise, promise.seconds - now());
    kept.recipe = recipes(picture.width, picture.height)[kept.choice.recipe];
    const Forecast found = kept.forecast();
    if (promise.error > 0 && found.bias >= promise.error)
        throw std::invalid_argument("--error is " + two_digits(promise.error) +
                                    "; the least bias of all "
                                    "settings is " +
                                    two_digits(found.bias) +
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
        const double noise = kept.noise * (1 + 2 / double(kept.pictures));
        done = promise.seconds > 0 ? kept.seconds + one / 2 > promise.seconds
                                   : noise <= room_for_noise(found, promise.error);
    }
    // [keep]
    kept.rendered.image = ljus::mean_image<T>(state);
    return kept;
}

} // namespace examples
