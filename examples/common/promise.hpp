#pragma once

/// \file examples/common/promise.hpp
/// \brief A picture within some seconds, or with some error: which settings, and how
/// many pictures to take the mean of.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "ljus/inspect/metrics.hpp"
#include "ljus/render/photon_mapping_settings.hpp"
#include "ljus/render/progressive.hpp"

namespace examples {

/// One way to make a picture; seeds and threads are the caller's.
struct Recipe {
    std::string name{};                     ///< As it is told to the user.
    ljus::PhotonMappingSettings settings{}; ///< Photons and all else of one picture.
    int rays = 1;                           ///< In each pixel.
    int more = 0;                           ///< Further ones where the first disagree.
    double bias = 0; ///< Its square, in relMSE, in the rooms of chapter 35.
};

/// The ways that a promise is kept by, the quickest first: the presets, with photons in
/// proportion to the pixels and few rays, since the mean of several pictures is shown.
/// \param width   Of the picture, in pixels.
/// \param height  Of the picture, in pixels.
/// \return draft, fast and exact.
[[nodiscard]] inline std::vector<Recipe> recipes(int width, int height) {
    using enum ljus::Preset;
    std::vector<Recipe> all{
        {"draft", preset_settings(draft, width, height), 1, 0, 0.005},
        {"fast", preset_settings(fast, width, height), 2, 8, 0.003},
        {"exact", preset_settings(exact, width, height), 4, 0}};
    const long long pixels = static_cast<long long>(width) * height;
    const long long photons = std::clamp(2 * pixels, 20'000LL, 2'000'000LL);
    all[2].settings.caustics.photons = photons;
    all[2].bias = 3e-4 * std::sqrt(1e5 / double(photons));
    return all;
}

/// What a pilot has found of one recipe. Errors are parts of relMSE.
struct Forecast {
    double seconds = 0; ///< Of one picture.
    double noise = 0;   ///< Of one picture: the mean of n pictures has noise / n.
    double bias = 0;    ///< Its square: what the mean of any number of pictures keeps.
};

/// What the user has been promised: seconds, or else an error.
struct Promise {
    double seconds = 0; ///< For the whole picture; 0: as long as it takes.
    double error = 0;   ///< relMSE; 0: as small as the seconds allow.
};

/// By how many pictures an error is reached.
///
/// n pictures have the noise v / n, and know it badly if they are few: 2/n of it is
/// added, so that v (1 + 2/n) / n must fall to what the bias leaves.
/// \param noise  v, of one picture.
/// \param spare  The error less the bias, above 0.
/// \return A whole number, at least 2.
[[nodiscard]] inline double pictures_for(double noise, double spare) {
    const double a = noise / spare;
    return std::max(2.0, std::ceil((a + std::sqrt(a * a + 8 * a)) / 2));
}

/// What is to be done for a promise.
struct Choice {
    std::size_t recipe = 0; ///< Its number.
    long long pictures = 1; ///< How many to take the mean of.
    double seconds = 0;     ///< Of all of them, as far as is known.
    double error = 0;       ///< relMSE of their mean, as far as is known.
    bool possible = true;   ///< Whether the promise can be kept.
};

/// The recipe that keeps a promise best.
///
/// *Seconds*: of all recipes that come within a tenth of them by a whole number of
/// pictures, at least 2 so that their scatter tells the error, the one with the least
/// error. *Error*: of all recipes whose bias is at most half of it, because a bias is
/// only guessed from the pilot, the one that takes the least time.
/// \param found     One for each recipe.
/// \param promise   Seconds, or an error.
/// \param left      Seconds that are left of those promised, the pilot's taken off.
/// \return If no recipe can: the quickest, or the one with the least bias.
// [choose]
[[nodiscard]] inline Choice choose(const std::vector<Forecast>& found,
                                   const Promise& promise, double left = 0) {
    Choice best{.possible = false};
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto& [seconds, noise, bias] = found[i];
        double n = 2, worth = 0, of_best = 0; // less is better
        bool possible = true;
        if (promise.error > 0) {
            possible = bias <= promise.error / 2;
            if (bias < promise.error) n = pictures_for(noise, promise.error - bias);
            worth = possible ? n * seconds : bias;
            of_best = best.possible ? best.seconds : found[best.recipe].bias;
        } else {
            n = std::max(1.0, std::round(left / seconds));
            possible = n >= 2 && std::abs(n * seconds - left) <= 0.1 * promise.seconds;
            worth = possible ? bias + noise / n : seconds;
            of_best = best.possible ? best.error : found[best.recipe].seconds;
        }
        const bool better = possible == best.possible ? worth < of_best : possible;
        if (i > 0 && !better) continue;
        n = std::min(n, 1e12); // "for ever" is a whole number, too
        best = {i, static_cast<long long>(n), n * seconds, bias + noise / n, possible};
    }
    return best;
}
// [choose]

/// A number as people tell it: "0.012".
[[nodiscard]] inline std::string two_digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", value);
    return text;
}

/// What was chosen and why, in two sentences.
/// \param found    As for choose().
/// \param names    Of the recipes.
/// \param promise  Seconds, or an error.
/// \param choice   Of choose().
[[nodiscard]] inline std::string reason(const std::vector<Forecast>& found,
                                        const std::vector<Recipe>& names,
                                        const Promise& promise, const Choice& choice) {
    const bool timed = promise.seconds > 0;
    const auto& [seconds, noise, bias] = found[choice.recipe];
    std::string text = "The mean of " + std::to_string(choice.pictures) +
                       " pictures by " + names[choice.recipe].name + ", " +
                       two_digits(seconds) + " s each, is expected to have relMSE " +
                       two_digits(choice.error) + ", of which " + two_digits(bias) +
                       " is bias: ";
    text += !choice.possible ? timed ? "nothing fits the seconds better. "
                                     : "nothing else has less bias. "
            : timed          ? "the least error for these seconds. "
                             : "the quickest way to this error. ";
    std::string others;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (i == choice.recipe) continue;
        const auto& other = found[i];
        const double n = std::max(1.0, std::round(choice.seconds / other.seconds));
        const double spare = promise.error - other.bias;
        others += others.empty() ? "" : ", ";
        others += names[i].name;
        if (timed)
            others += " relMSE " + two_digits(other.bias + other.noise / n) + " in " +
                      two_digits(n * other.seconds) + " s";
        else if (spare <= 0)
            others += " never gets there";
        else
            others += " " +
                      two_digits(pictures_for(other.noise, spare) * other.seconds) +
                      " s, with a bias of " + two_digits(other.bias);
    }
    if (others.empty()) return text + "There was no time to try another.";
    return text + "The others: " + others + ".";
}

/// The mean of some squares over those of a picture, as relMSE has it.
///
/// A pixel's own square is taken from the mean of it and its neighbours: by itself, one
/// that happens to be bright would count as less noisy than it is.
/// \param squares  Of whatever is wrong with the picture.
/// \param picture  Of the same size.
[[nodiscard]] inline double relative(const ljus::ImageT<double>& squares,
                                     const ljus::ImageT<double>& picture) {
    double sum = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            ljus::RgbT<double> around{0};
            const int right = std::min(x + 1, picture.width - 1);
            const int below = std::min(y + 1, picture.height - 1);
            const int left = std::max(x - 1, 0), above = std::max(y - 1, 0);
            for (int v = above; v <= below; ++v)
                for (int u = left; u <= right; ++u) around += pixel(picture, u, v);
            around /= double((right - left + 1) * (below - above + 1));
            const auto share =
                pixel(squares, x, y) / (around * around + ljus::default_epsilon);
            sum += (share.x + share.y + share.z) / 3;
        }
    return sum / double(picture.pixels.size());
}

/// The noise of the mean of some pictures, by their scatter, as part of relMSE.
/// \param state  The pictures, of different seeds, by ljus::add_pass() with alpha 1.
/// \return Infinity for less than two.
[[nodiscard]] inline double relative_noise(const ljus::ProgressiveState& state) {
    if (state.passes < 2) return std::numeric_limits<double>::infinity();
    const double n = double(state.passes);
    return relative(state.squares, ljus::mean_image<double>(state)) / (n * (n - 1));
}

} // namespace examples
