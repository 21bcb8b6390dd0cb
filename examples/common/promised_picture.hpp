#pragma once

/// \file examples/common/promised_picture.hpp
/// \brief Keeps a promise of a time or an error. Small pictures forecast the result of
/// each recipe. One recipe is chosen, and its pictures are averaged.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "convergence.hpp"
#include "ljus/inspect/survey.hpp"
#include "ljus/math/stratified_stream.hpp"
#include "ljus/render/budgeting.hpp"
#include "ljus/render/gathering.hpp"
#include "ljus/render/skipping.hpp"
#include "picture_check.hpp"
#include "promise.hpp"
#include "terminal.hpp"

namespace examples {

/// The abilities that recipes need from a photon mapper.
inline constexpr auto recipe_abilities =
    ljus::abilities<ljus::StratifiedStream, ljus::Gathering, ljus::Skipping,
                    ljus::Budgeting>;

/// A picture made by a recipe, and its cost.
template <std::floating_point T>
struct Shot {
    ljus::RenderedT<T> rendered{};          ///< The picture.
    ljus::PhotonMappingSettings settings{}; ///< The settings, with the radii that were
                                            ///< chosen.
    std::string remarks{};                  ///< The result of mapper_remarks().
    double bytes = 0;                       ///< Memory of the photon maps.
    double photons = 0;                     ///< Time of the photon maps, seconds.
    double rest = 0;                        ///< Time of everything else, seconds.
};

/// Makes one picture.
/// \param world    The closed scene.
/// \param camera   Any camera.
/// \param recipe   Photons and rays.
/// \param picture  Size, seed, threads, progress; its samples are ignored.
/// \param now      A clock, in seconds.
/// \param map_seed The seed of the photons, if it differs from the picture's.
/// \return The picture; not complete if the progress callback stopped it.
template <ljus::AnyWorld W, ljus::CameraLike C, typename Clock>
[[nodiscard]] Shot<typename C::Scalar>
shoot(const W& world, const C& camera, const Recipe& recipe,
      ljus::RenderSettings picture, Clock&& now,
      std::optional<std::uint64_t> map_seed = {}) {
    Shot<typename C::Scalar> shot{.settings = recipe.settings};
    for (auto* pass : {&shot.settings.caustics, &shot.settings.general}) {
        pass->seed = map_seed.value_or(picture.seed);
        pass->threads = picture.threads;
        pass->progress = picture.progress;
    }
    const double begin = now();
    ljus::PhotonMapper mapper(world, shot.settings, recipe_abilities);
    const auto& maps = mapper.maps();
    shot.remarks = mapper_remarks(mapper);
    shot.bytes = double(maps.caustics.tree.bytes() + maps.caustics.records.bytes() +
                        maps.general.tree.bytes() + maps.general.records.bytes());
    const double middle = now();
    if (maps.complete) mapper.fill_cache(camera, picture);
    shot.settings = mapper.settings();
    picture.samples = recipe.rays;
    if (maps.complete)
        shot.rendered = render(mapper, camera, picture);
    else
        shot.rendered.complete = false;
    shot.rendered.counts += mapper.template state<ljus::Gathering>().cache.counts;
    shot.photons = middle - begin;
    shot.rest = now() - middle;
    return shot;
}

/// The seed of the i-th picture of several.
[[nodiscard]] constexpr std::uint64_t seed_of(std::uint64_t seed, long long i) {
    return seed + 0x9e3779b97f4a7c15u * static_cast<std::uint64_t>(i);
}

/// A recipe that a pilot tries, with its small pictures.
struct Trial {
    Recipe recipe{};
    std::vector<double> seconds{}; ///< Forecasts of the time of the large picture.
    std::vector<ljus::ImageT<double>> pictures{}; ///< Small pictures with different
                                                  ///< seeds.
    ljus::ProgressiveState state{.alpha = 1};     ///< Sums of the small pictures.
};

/// The differences between the pictures of a trial and those of the judge with the same
/// seeds. Both have the same camera rays, so that their common noise cancels. For the
/// judge see pilot().
/// \param trial  The trial.
/// \param judge  The judge; it has as many pictures.
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

/// The state of a pilot: the recipes that it tries, and their pictures so far.
struct PilotRun {
    ljus::RenderSettings small{}; ///< Settings of the small pictures.
    double all = 0;               ///< Number of pixels of the large picture.
    double pixels = 0;            ///< Number of pixels of a small picture.
    std::vector<Recipe> large{};  ///< The recipes for the large picture.
    std::vector<Trial> trials{};  ///< The trials. The judge is the last of them, as one
                                  ///< more trial or as one of the recipes.

    /// The number of caustic photons in the large picture, divided by that in a small
    /// one.
    [[nodiscard]] double photons(std::size_t i) const {
        return double(large[i].settings.caustics.photons) /
               double(trials[i].recipe.settings.caustics.photons);
    }
};

/// Prepares a pilot.
/// \param world    The closed scene.
/// \param picture  The large picture.
template <ljus::AnyWorld W>
[[nodiscard]] PilotRun make_pilot(const W& world, const ljus::RenderSettings& picture) {
    PilotRun run{.small = picture,
                 .all = double(picture.width) * double(picture.height),
                 .large = recipes(picture.width, picture.height)};
    const double scale = std::min(1.0, 64 / std::sqrt(run.all));
    for (int* side : {&run.small.width, &run.small.height})
        *side = std::max(1, int(std::lround(*side * scale)));
    run.pixels = double(run.small.width) * double(run.small.height);
    for (const Recipe& recipe : recipes(run.small.width, run.small.height))
        run.trials.push_back({.recipe = recipe});
    if (survey(world, run.large.back().settings).caustics_map.on) {
        run.trials.push_back({.recipe = run.trials.back().recipe}); // the judge
        run.trials.back().recipe.settings.caustics.photons *= 8;
    } else {
        run.large.back().bias = 0; // exact needs no map, and serves as the judge
    }
    return run;
}

/// Makes one more small picture of a trial.
/// \param run     The pilot.
/// \param i       Index of the trial.
/// \param world   The closed scene.
/// \param camera  Any camera.
/// \param seed    The seed of the large picture.
/// \param now     A clock, in seconds.
template <ljus::AnyWorld W, ljus::CameraLike C, typename Clock>
void try_again(PilotRun& run, std::size_t i, const W& world, const C& camera,
               std::uint64_t seed, Clock& now) {
    Trial& trial = run.trials[i];
    run.small.seed = seed_of(seed, -1 - trial.state.passes);
    const auto shot = shoot(world, camera, trial.recipe, run.small, now);
    stop_if_asked();
    add_pass(trial.state, shot.rendered.image);
    auto& kept = trial.pictures.emplace_back(
        ljus::ImageT<double>{run.small.width, run.small.height, {}});
    for (const auto& color : shot.rendered.image.pixels)
        kept.pixels.push_back(ljus::RgbT<double>(color));
    if (i < run.large.size())
        trial.seconds.push_back(shot.photons * run.photons(i) +
                                shot.rest * run.all / run.pixels);
}

/// The forecasts for the large picture, from the trials so far.
/// \param run     The pilot; each trial has at least one picture.
/// \param judged  Whether the judge was tried as well, so that the bias can be
///                measured.
/// \return A forecast for each recipe that was tried.
[[nodiscard]] inline std::vector<Forecast> forecasts(const PilotRun& run, bool judged) {
    const auto none = ljus::make_image<double>(run.small.width, run.small.height);
    std::vector<Forecast> found;
    for (std::size_t i = 0; i < std::min(run.trials.size(), run.large.size()); ++i) {
        const Trial& trial = run.trials[i];
        double bias = 0, error = std::numeric_limits<double>::infinity();
        if (judged) {
            const auto away = apart(trial, run.trials.back());
            const double shrink = 1 / std::sqrt(run.photons(i));
            bias = bias_variance(away, none).bias_squared * shrink;
            error = bias_error(away) * shrink;
        }
        found.push_back(weigh(bias, error, run.large[i].bias));
        auto seconds = trial.seconds;
        std::sort(seconds.begin(), seconds.end());
        found.back().seconds = std::max(seconds[seconds.size() / 2], 1e-6);
        found.back().noise = relative_noise(trial.state) * double(trial.state.passes);
    }
    return found;
}

/// Forecasts the result of each recipe by small pictures of at most about 4096 pixels,
/// with photons in proportion.
///
/// The bias is measured against a *judge*: the recipe "exact" with eight times the
/// photons, and therefore about a third of the radius. The bias of the judge itself is
/// not measured. The squared bias is estimated without bias, by products of differences
/// with different seeds. It is divided by the square root of PilotRun::photons(), for
/// the large picture, and combined with the value of the book.
/// \param world    The closed scene.
/// \param camera   Any camera.
/// \param picture  The picture that is promised.
/// \param promise  The promise. The pilot takes an eighth of the promised time. If an
///                 error is promised, the pilot takes an eighth of the expected time,
///                 at most 10 s. If a time is promised and the pilot's time is over, no
///                 further recipe is tried. The judge is not tried after half of the
///                 pilot's time.
/// \param now      A clock, in seconds.
/// \return A forecast for each recipe that was tried.
template <ljus::AnyWorld W, ljus::CameraLike C, typename Clock>
[[nodiscard]] std::vector<Forecast> pilot(const W& world, const C& camera,
                                          const ljus::RenderSettings& picture,
                                          const Promise& promise, Clock&& now) {
    constexpr std::size_t least = 3, most = 64; // pictures by each recipe
    PilotRun run = make_pilot(world, picture);
    const auto try_again = [&](std::size_t i) {
        examples::try_again(run, i, world, camera, picture.seed, now);
    };
    const double begin = now();
    const auto patience = [&](const std::vector<Forecast>& found) {
        return promise.seconds > 0 ? promise.seconds / 8
                                   : std::min(choose(found, promise).seconds / 8, 10.0);
    };
    for (std::size_t i = 0; i < run.trials.size(); ++i) {
        const bool judge = i == run.large.size(); // it takes as long as all others
        const double limit = judge                 ? patience(forecasts(run, false)) / 2
                             : promise.seconds > 0 ? promise.seconds / 8
                                                   : std::numeric_limits<double>::max();
        if (i > 0 && now() - begin > limit) {
            run.trials.resize(i);
            return forecasts(run, false);
        }
        for (std::size_t runs = 0; runs < least; ++runs) try_again(i);
    }
    auto found = forecasts(run, true);
    for (std::size_t runs = least; runs < most; ++runs) {
        const double took = now() - begin;
        if (took + took / double(runs) > patience(found)) break;
        for (std::size_t i = 0; i < run.trials.size(); ++i) try_again(i);
        found = forecasts(run, true);
    }
    return found;
}

/// A picture that keeps a promise.
template <std::floating_point T>
struct Kept {
    ljus::RenderedT<T> rendered{}; ///< The mean of all pictures, and their total cost.
    Recipe recipe{};               ///< The recipe of these pictures.
    std::vector<Forecast> found{}; ///< The pilot's forecasts.
    Choice choice{};               ///< The choice of the recipe.
    std::string why{};             ///< The reason for the choice, in sentences.
    std::string remarks{};         ///< The result of mapper_remarks().
    long long pictures = 0;        ///< The number of pictures.
    double seconds = 0;            ///< Time since the clock began, including the pilot.
    double noise = 0;     ///< Variance of the mean, from the scatter of the pictures.
    PictureCheck check{}; ///< Path-traced pixels; without rounds if paths do
                          ///< not carry all light of the scene.
    StatedError stated{}; ///< The stated error; without a check the upper end
                          ///< for blocks is infinity.

    /// The forecast for the chosen recipe, with the bias that the check has measured.
    [[nodiscard]] const Forecast& forecast() const { return found[choice.recipe]; }
    /// The estimated relMSE.
    [[nodiscard]] double error() const { return noise + forecast().bias; }
    /// The number of path-traced pixels.
    [[nodiscard]] std::size_t checked_pixels() const {
        std::size_t count = 0;
        for (const auto& pixels : check.blocks)
            count += check.rounds > 0 ? pixels.size() : 0;
        return count;
    }
};

/// The stated error of a picture and how it was measured, such as "0.004 to 0.007
/// (...)".
template <std::floating_point T>
[[nodiscard]] std::string stated_text(const Kept<T>& kept) {
    const auto text = [](const ErrorInterval& interval) {
        return two_digits(interval.low) + " to " + two_digits(interval.high);
    };
    const std::size_t pixels = kept.checked_pixels();
    if (pixels == 0)
        return text(kept.stated.pixels) +
               " (not checked: paths do not carry all light)";
    return text(kept.stated.pixels) + ", of squares of 8 x 8 pixels " +
           text(kept.stated.blocks) + " (by " + std::to_string(pixels) +
           " path-traced pixels)";
}

/// Measures the error of the pictures so far by a check, and replaces the forecast of
/// the bias by the measured bias.
/// \param kept    Has the check; receives the stated error and the bias.
/// \param state   The pictures.
/// \param trace   Called as trace(check) for one more round of rays.
/// \param limit   Seconds that all rounds may take.
template <std::floating_point T, typename Trace>
void measure_error(Kept<T>& kept, const ljus::ProgressiveState& state, Trace&& trace,
                   double limit) {
    do trace(kept.check);
    while (kept.check.seconds < limit);
    const CheckedError found = check_picture(kept.check, state);
    kept.stated = stated_error(state, found);
    Forecast& forecast = kept.found[kept.choice.recipe];
    forecast.bias = std::max(found.bias.value, 0.0);
    forecast.unsure = found.bias.error;
}

/// Keeps a promise: runs a pilot, chooses a recipe, and makes pictures until the
/// promise is kept.
///
/// A fifth of the time is spent on about 400 path-traced pixels of the picture, by
/// which the bias of the mean is measured. If the measured bias is larger than the
/// forecast, a recipe with less bias may take over.
/// \param world    The closed scene.
/// \param camera   Any camera.
/// \param picture  Size, seed, threads.
/// \param promise  Seconds, or an error.
/// \param now      A clock in seconds, which was 0 when the promise was given.
/// \param quiet    Whether to draw no progress bar.
/// \param tell     Called once when the recipe has been chosen, with a Kept whose
///                 members down to `why` are set.
/// \return The picture.
/// \throws Interrupted  after Ctrl-C.
/// \throws std::invalid_argument  for an error that is below the bias of all recipes.
template <ljus::AnyWorld W, ljus::CameraLike C, typename Clock, typename Tell>
[[nodiscard]] Kept<typename C::Scalar>
keep(const W& world, const C& camera, ljus::RenderSettings picture,
     const Promise& promise, Clock&& now, bool quiet, Tell&& tell) {
    using T = typename C::Scalar;
    Kept<T> kept;
    auto go_on = [](long long, long long) { return stop_signal() == 0; };
    picture.progress = go_on;
    kept.found = pilot(world, camera, picture, promise, now);
    kept.choice = choose(kept.found, promise, promise.seconds - now());
    const auto ways = recipes(picture.width, picture.height);
    kept.recipe = ways[kept.choice.recipe];
    kept.why = reason(kept.found, ways, promise, kept.choice);
    if (promise.error > 0 && kept.forecast().bias >= promise.error)
        throw std::invalid_argument("--error is " + two_digits(promise.error) +
                                    "; the least bias of all "
                                    "settings is " +
                                    two_digits(kept.forecast().bias) +
                                    " here, and more time does not reduce it.");
    tell(kept);

    ProgressBar bar("pictures", quiet);
    const double pilot_seconds = now();
    double begun = pilot_seconds; // start of this recipe
    auto draw = [&](long long, long long) {
        const double part = (now() - pilot_seconds) / kept.choice.seconds;
        return bar(static_cast<long long>(1000 * std::min(part, 1.0)), 1000);
    };
    if (!quiet) picture.progress = draw;
    ljus::ProgressiveState state{.alpha = 1};
    const std::uint64_t seed = picture.seed;
    const bool checks = paths_carry_all(world);
    kept.check = choose_pixels(picture.width, picture.height, seed);
    const auto trace = [&](PictureCheck& check) {
        trace_round(check, world, camera, picture, now);
        stop_if_asked();
    };
    for (bool done = false; !done;) {
        picture.seed = seed_of(seed, kept.pictures);
        auto shot = shoot(world, camera, kept.recipe, picture, now);
        stop_if_asked();
        add_pass(state, shot.rendered.image);
        ++kept.pictures;
        kept.rendered.counts += shot.rendered.counts;
        kept.recipe.settings = shot.settings;
        kept.remarks = shot.remarks;
        kept.noise = relative_noise(state);
        if (checks) measure_error(kept, state, trace, (now() - pilot_seconds) / 5);
        kept.seconds = now();
        const double one = (kept.seconds - begun) / double(kept.pictures);
        const double noise = kept.noise * (1 + 2 / double(kept.pictures));
        const Forecast& found = kept.forecast();
        if (promise.seconds > 0)
            done = kept.seconds + one / 2 > promise.seconds;
        else if (checks)
            done =
                kept.stated.pixels.high <= promise.error || noise < promise.error / 8;
        else
            done = noise <= room_for_noise(found, promise.error);
        // If the measured bias is larger than the forecast, another recipe may be
        // better.
        if (!checks || done || kept.pictures != 2) continue;
        const Choice again = choose(kept.found, promise, promise.seconds - now());
        if (again.recipe <= kept.choice.recipe) continue;
        kept.choice = again;
        kept.recipe = ways[again.recipe];
        kept.pictures = 0;
        state = {.alpha = 1};
        begun = now();
    }
    if (!checks)
        kept.stated = {{kept.noise, kept.noise * (1 + 2 / double(kept.pictures)) +
                                        kept.forecast().bias +
                                        2 * kept.forecast().unsure},
                       {0, std::numeric_limits<double>::infinity()}};
    kept.rendered.image = ljus::mean_image<T>(state);
    return kept;
}

} // namespace examples
