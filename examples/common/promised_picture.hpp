#pragma once

/// \file examples/common/promised_picture.hpp
/// \brief The picture that a promise of seconds or of error is kept by.

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "pilot.hpp"

namespace examples {

/// A picture as it was promised.
template <std::floating_point T>
struct Kept {
    ljus::RenderedT<T> rendered{}; ///< The mean of all pictures, and what all cost.
    Recipe recipe{};               ///< By which each was made.
    std::vector<Forecast> found{}; ///< What the pilot said.
    Choice choice{};               ///< What was chosen then,
    std::string why{};             ///< and why, in sentences.
    long long pictures = 0;        ///< How many there are.
    double seconds = 0;            ///< Since the clock began, the pilot's included.
    double noise = 0;              ///< Of the mean, by the scatter of the pictures.

    /// What the pilot said of the recipe that was chosen.
    [[nodiscard]] const Forecast& forecast() const { return found[choice.recipe]; }
    /// relMSE as far as is known.
    [[nodiscard]] double error() const { return noise + forecast().bias; }
};

/// Keeps a promise: a pilot, a choice, and pictures until it is kept.
/// \param world    The closed scene.
/// \param camera   Any camera.
/// \param picture  Size, seed, threads.
/// \param promise  Seconds, or an error.
/// \param now      A clock, in seconds; it began at 0 when the promise was given.
/// \param quiet    Draw no progress bar.
/// \param tell     Called with a Kept of which the choice is known, and all before it.
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
        auto shot = shoot(world, camera, kept.recipe, picture, now);
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
