#pragma once

/// \file examples/common/promise.hpp
/// \brief A picture within a given time, or with a given error: chooses the settings,
/// and the number of pictures to average.

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
    std::string name{};                     ///< Its name for the user.
    ljus::PhotonMappingSettings settings{}; ///< The settings of one picture.
    int rays = 1;                           ///< Rays per pixel.
    double bias = 0; ///< Squared bias in relMSE, as in the rooms of Trades.
};

/// The recipes that a promise chooses from, the quickest first: the presets, with
/// photons in proportion to the pixels, and few rays, since several pictures are
/// averaged. Each pixel gets the same number of rays.
/// \param width   Of the picture, in pixels.
/// \param height  Of the picture, in pixels.
/// \return draft, fast and exact.
[[nodiscard]] inline std::vector<Recipe> recipes(int width, int height) {
    using enum ljus::Preset;
    std::vector<Recipe> all{{"draft", preset_settings(draft, width, height), 1, 0.003},
                            {"fast", preset_settings(fast, width, height), 4, 0.002},
                            {"exact", preset_settings(exact, width, height), 4}};
    const long long pixels = static_cast<long long>(width) * height;
    const long long photons = std::clamp(2 * pixels, 20'000LL, 2'000'000LL);
    all[2].settings.caustics.photons = photons;
    all[2].bias = 1e-4 * std::sqrt(1e5 / double(photons));
    return all;
}

/// What a pilot has found out about one recipe. Errors are in relMSE.
struct Forecast {
    double seconds = 0; ///< Time of one picture.
    double noise = 0;   ///< Variance of one picture; the mean of n has noise / n.
    double bias = 0;    ///< Squared bias, which averaging does not reduce.
    double unsure = 0;  ///< Standard error of the squared bias.
};

/// What the user has been promised: a time or an error.
struct Promise {
    double seconds = 0; ///< Time for the whole picture; 0: as long as it takes.
    double error = 0;   ///< relMSE; 0: as small as the seconds allow.
};

/// Whether anything is promised.
[[nodiscard]] constexpr bool promised(const Promise& promise) noexcept {
    return promise.seconds > 0 || promise.error > 0;
}

/// Combines two estimates of a squared bias: the pilot's measurement, and the value of
/// the book's rooms.
///
/// A short pilot measures mostly its own noise, and then the book's value is the better
/// guess. The two are weighted by their inverse variances; the standard error of the
/// book's value is taken to be the value itself.
/// \param measured  The pilot's value; it may be negative.
/// \param error     Its standard error; infinity: there was no pilot.
/// \param expected  The book's value.
/// \return A forecast with the bias and its standard error; the rest is 0.
// [weigh]
[[nodiscard]] inline Forecast weigh(double measured, double error, double expected) {
    if (std::isinf(error)) return {.bias = expected, .unsure = expected};
    if (error == 0) return {.bias = std::max(measured, 0.0)};
    const double book = expected * expected, pilot = error * error;
    const double weight = book / (book + pilot); // weight of the pilot
    return {.bias = weight * std::max(measured, 0.0) + (1 - weight) * expected,
            .unsure = std::sqrt(weight) * error};
}
// [weigh]

/// The variance that may be added to an uncertain squared bias without exceeding an
/// error: the error minus the bias and its standard error, but at least half of the
/// error minus the bias.
/// \param found  The forecast.
/// \param error  relMSE.
/// \return At most 0 if the bias alone is larger than the error.
[[nodiscard]] inline double room_for_noise(const Forecast& found, double error) {
    const double left = error - found.bias;
    return std::max(left - found.unsure, left / 2);
}

/// The number of pictures that reach an error.
///
/// The mean of n pictures has variance v / n, which few pictures estimate badly. As a
/// margin, v (1 + 2/n) / n must fall to what the bias leaves.
/// \param noise  v, the variance of one picture.
/// \param spare  The result of room_for_noise(), above 0.
/// \return A whole number, at least 2.
[[nodiscard]] inline double pictures_for(double noise, double spare) {
    const double a = noise / spare;
    return std::max(2.0, std::ceil((a + std::sqrt(a * a + 8 * a)) / 2));
}

/// How to keep a promise.
struct Choice {
    std::size_t recipe = 0; ///< Index of the recipe.
    long long pictures = 1; ///< Number of pictures to average.
    double seconds = 0;     ///< Expected time of all of them.
    double error = 0;       ///< Expected relMSE of their mean.
    bool possible = true;   ///< Whether the promise can be kept.
};

/// The recipe that keeps a promise best.
///
/// *Seconds*: the recipe with the least error among those that meet the time within a
/// tenth by a whole number of pictures, at least 2 so that their scatter gives the
/// error. *Error*: the recipe that takes the least time among those whose bias plus its
/// standard error is at most half of the error.
/// \param found     One forecast for each recipe.
/// \param promise   Seconds, or an error.
/// \param left      The promised seconds minus those of the pilot.
/// \return If no recipe can keep it: the quickest, or the one with the least bias.
[[nodiscard]] inline Choice choose(const std::vector<Forecast>& found,
                                   const Promise& promise, double left = 0) {
    Choice best{.possible = false};
    for (std::size_t i = 0; i < found.size(); ++i) {
        const auto& [seconds, noise, bias, unsure] = found[i];
        double n = 2, worth = 0, of_best = 0; // a smaller worth is better
        bool possible = true;
        if (promise.error > 0) {
            possible = bias + unsure <= promise.error / 2;
            if (bias < promise.error)
                n = pictures_for(noise, room_for_noise(found[i], promise.error));
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
        n = std::min(n, 1e12); // infinity has no whole number
        best = {i, static_cast<long long>(n), n * seconds, bias + noise / n, possible};
    }
    return best;
}

/// A number with two significant digits: "0.012".
[[nodiscard]] inline std::string two_digits(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g", value);
    return text;
}

/// A squared bias, with its standard error if it has one.
[[nodiscard]] inline std::string bias_text(const Forecast& found) {
    const std::string text = two_digits(found.bias);
    return found.unsure > 0 ? text + " ± " + two_digits(found.unsure) : text;
}

/// Says in two sentences what was chosen and why.
/// \param found    As for choose().
/// \param names    Of the recipes.
/// \param promise  Seconds, or an error.
/// \param choice   Of choose().
[[nodiscard]] inline std::string reason(const std::vector<Forecast>& found,
                                        const std::vector<Recipe>& names,
                                        const Promise& promise, const Choice& choice) {
    const bool timed = promise.seconds > 0;
    const Forecast& chosen = found[choice.recipe];
    std::string text =
        "The mean of " + std::to_string(choice.pictures) + " pictures by " +
        names[choice.recipe].name + ", " + two_digits(chosen.seconds) +
        " s each, is expected to have relMSE " + two_digits(choice.error) +
        ", of which " + bias_text(chosen) + " is bias: ";
    text += !choice.possible ? timed ? "nothing fits the seconds better. "
                                     : "nothing else has less bias. "
            : timed          ? "the least error for these seconds. "
                             : "the quickest way to this error. ";
    std::string others;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (i == choice.recipe) continue;
        const auto& other = found[i];
        const double n = std::max(1.0, std::round(choice.seconds / other.seconds));
        const double spare = room_for_noise(other, promise.error);
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
                      " s, with a bias of " + bias_text(other);
    }
    if (others.empty()) return text + "There was no time to try another.";
    return text + "The others: " + others + ".";
}

/// The brightness of each pixel of the mean of some pictures, as the divisor of
/// relative errors.
///
/// An exact mean could be used as it is. Dividing the noise of a noisy pixel by the
/// square of its own value would hide that noise. Therefore, as the relative standard
/// error of a pixel rises from 0 to a half, its value is blended into the mean of its
/// neighbourhood.
/// \param state  The pictures, by ljus::add_pass() with alpha 1, at least 2.
/// \param own    Whether a pixel belongs to its neighbourhood. A single bright ray
///               makes that bright as well, and its own error small; without it, the
///               error of a highlight that is really there is large.
[[nodiscard]] inline ljus::ImageT<double> levels(const ljus::ProgressiveState& state,
                                                 bool own = true) {
    const auto mean = ljus::mean_image<double>(state);
    const double n = double(state.passes);
    auto result = mean;
    for (int y = 0; y < mean.height; ++y)
        for (int x = 0; x < mean.width; ++x) {
            ljus::RgbT<double> around{0};
            int pixels = 0;
            for (int v = std::max(y - 1, 0); v <= std::min(y + 1, mean.height - 1); ++v)
                for (int u = std::max(x - 1, 0); u <= std::min(x + 1, mean.width - 1);
                     ++u)
                    if (own || u != x || v != y) {
                        around += pixel(mean, u, v);
                        ++pixels;
                    }
            around /= std::max(double(pixels), 1.0);
            const auto& here = pixel(mean, x, y);
            const auto error = pixel(state.squares, x, y) / (n * (n - 1)); // squared
            for (int c = 0; c < 3; ++c) {
                const double known =
                    here[c] == 0
                        ? 0.0
                        : std::max(0.0, 1 - 4 * error[c] / (here[c] * here[c]));
                pixel(result, x, y)[c] = std::sqrt(known * here[c] * here[c] +
                                                   (1 - known) * around[c] * around[c]);
            }
        }
    return result;
}

/// The variance of the mean of some pictures, from their scatter, in relMSE.
/// \param state  The pictures, of different seeds, by ljus::add_pass() with alpha 1.
/// \param own    As for levels().
/// \return Infinity for fewer than two.
[[nodiscard]] inline double relative_noise(const ljus::ProgressiveState& state,
                                           bool own = true) {
    if (state.passes < 2) return std::numeric_limits<double>::infinity();
    const auto level = levels(state, own);
    const double n = double(state.passes);
    double sum = 0;
    for (std::size_t p = 0; p < level.pixels.size(); ++p) {
        const auto& r = level.pixels[p];
        const auto share = state.squares.pixels[p] / (r * r + ljus::default_epsilon);
        sum += (share.x + share.y + share.z) / 3;
    }
    return sum / double(level.pixels.size()) / (n * (n - 1));
}

} // namespace examples
