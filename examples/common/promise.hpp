#pragma once

/// \file examples/common/promise.hpp
/// \brief Chooses the settings for a picture within a given time, or with a given
/// error, and how many such pictures to average.

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

/// One way to make a picture. The caller sets seeds and threads.
struct Recipe {
    std::string name{};                     ///< The name that the user sees.
    ljus::PhotonMappingSettings settings{}; ///< The settings of one picture.
    int rays = 1;                           ///< Rays per pixel.
    double bias = 0; ///< Squared bias in relMSE, as measured in the rooms of the
                     ///< chapter Trades.
};

/// The recipes from which a promise chooses, the quickest first. They are the presets,
/// with few rays per pixel, because several pictures are averaged. The number of
/// photons is proportional to the number of pixels.
/// \param width   Width of the picture, in pixels.
/// \param height  Height of the picture, in pixels.
/// \return The recipes draft, fast and exact.
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

/// The forecast of a pilot for one recipe. Errors are in relMSE.
struct Forecast {
    double seconds = 0; ///< Time of one picture, in seconds.
    double noise = 0;   ///< Variance of one picture; noise / n for the mean of n.
    double bias = 0;    ///< Squared bias, which averaging does not reduce.
    double unsure = 0;  ///< Standard error of the squared bias.
};

/// The promise to the user: a time or an error.
struct Promise {
    double seconds = 0; ///< Time for the whole picture; 0: no limit.
    double error = 0;   ///< relMSE; 0: as small as the time allows.
};

/// Whether anything is promised.
[[nodiscard]] constexpr bool promised(const Promise& promise) noexcept {
    return promise.seconds > 0 || promise.error > 0;
}

/// Combines two estimates of a squared bias: the measurement of a pilot, and the value
/// that was measured in the rooms of the book.
///
/// A short pilot measures mostly its own noise. The value of the book is then the
/// better guess. Both are weighted by their inverse variances, where the standard error
/// of the book's value is taken to be the value itself.
/// \param measured  The value of the pilot; may be negative.
/// \param error     The standard error of that value; infinity if there was no pilot.
/// \param expected  The value of the book.
/// \return A forecast of the bias and its standard error; its other members are 0.
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

/// The variance that a mean of pictures may have without exceeding an error. It is the
/// error minus the squared bias and its standard error, but at least half of the error
/// minus the squared bias.
/// \param found  The forecast.
/// \param error  The error, in relMSE.
/// \return The variance in relMSE; 0 or negative if the squared bias alone exceeds the
///         error.
[[nodiscard]] inline double room_for_noise(const Forecast& found, double error) {
    const double left = error - found.bias;
    return std::max(left - found.unsure, left / 2);
}

/// The number of pictures whose mean reaches an error.
///
/// The mean of n pictures has variance v / n. From few pictures this is estimated
/// badly. As a margin, the smallest n is taken for which v (1 + 2/n) / n is at most
/// `spare`.
/// \param noise  v, the variance of one picture.
/// \param spare  The allowed variance, from room_for_noise(); above 0.
/// \return A whole number, at least 2.
[[nodiscard]] inline double pictures_for(double noise, double spare) {
    const double a = noise / spare;
    return std::max(2.0, std::ceil((a + std::sqrt(a * a + 8 * a)) / 2));
}

/// The choice of a recipe that keeps a promise.
struct Choice {
    std::size_t recipe = 0; ///< Index of the recipe.
    long long pictures = 1; ///< Number of pictures to average.
    double seconds = 0;     ///< Expected time of all pictures, in seconds.
    double error = 0;       ///< Expected relMSE of their mean.
    bool possible = true;   ///< Whether the promise can be kept.
};

/// Chooses the recipe that keeps a promise best.
///
/// If a time is promised, a recipe is possible if at least 2 whole pictures take that
/// time, within a tenth. At least 2 are needed because their scatter gives the error.
/// Of the possible recipes the one with the least error is chosen. If an error is
/// promised, a recipe is possible if its squared bias plus the standard error of that
/// bias is at most half of the error. Of the possible recipes the one that takes the
/// least time is chosen.
/// \param found     One forecast for each recipe.
/// \param promise   Seconds, or an error.
/// \param left      The promised seconds minus those of the pilot.
/// \return The choice. If no recipe is possible, the quickest is chosen for a promised
///         time, and the one with the least bias for a promised error.
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
        n = std::min(n, 1e12); // because infinity does not fit into an integer
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

/// The noise of a promised picture as text. A single picture does not show its noise.
[[nodiscard]] inline std::string noise_text(double noise) {
    return std::isinf(noise) ? "not measured" : two_digits(noise);
}

/// A squared bias as text, with its standard error if that is not 0.
[[nodiscard]] inline std::string bias_text(const Forecast& found) {
    const std::string text = two_digits(found.bias);
    return found.unsure > 0 ? text + " ± " + two_digits(found.unsure) : text;
}

/// Two sentences that say what was chosen and why.
/// \param found    The forecasts, as in choose().
/// \param names    The recipes.
/// \param promise  Seconds, or an error.
/// \param choice   The result of choose().
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

/// The brightness of each pixel in the mean of some pictures, by which errors are
/// divided to make them relative.
///
/// A pixel with a large error may be much too bright. Divided by its own brightness,
/// that error would seem small. The brightness of a pixel is therefore blended with the
/// mean of its neighbourhood, in proportion to its squared relative standard error, and
/// replaced by that mean if the relative standard error is a half or more.
/// \param state  At least 2 pictures, added by ljus::add_pass() with alpha 1.
/// \param own    Whether the neighbourhood of a pixel includes the pixel itself. If so,
///               a single bright ray makes the neighbourhood bright too, and the error
///               of that ray seems small. If not, the error of a real highlight seems
///               large.
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
/// \param state  Pictures with different seeds, added by ljus::add_pass() with alpha 1.
/// \param own    As in levels().
/// \return The variance; infinity for fewer than two pictures.
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
