#pragma once

/// \file examples/common/picture_check.hpp
/// \brief Measures the error of a picture by a few hundred path-traced pixels.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "ljus/inspect/scene_remarks.hpp"
#include "ljus/parallel.hpp"
#include "ljus/render/path_tracing.hpp"
#include "promise.hpp"

namespace examples {

/// A pixel of a check. Its path-traced rays form two independent halves, whose radiance
/// is summed.
struct CheckedPixel {
    int x = 0; ///< Column.
    int y = 0; ///< Row.
    std::array<ljus::RgbT<double>, 2> halves{ljus::RgbT<double>{0},
                                             ljus::RgbT<double>{0}};
};

/// Path-traced pixels of a picture, in squares that are spread over the whole picture.
struct PictureCheck {
    static constexpr int side = 8;         ///< Side of a square, in pixels.
    static constexpr int rays_a_round = 8; ///< Rays per round in each half of a pixel.
    std::vector<std::vector<CheckedPixel>> blocks{}; ///< The pixels of each square.
    int rounds = 0;     ///< Number of rounds of rays so far.
    double seconds = 0; ///< Time that all rounds took.

    /// Number of rays so far in each half of a pixel.
    [[nodiscard]] double rays() const noexcept { return rounds * rays_a_round; }
};

/// Chooses about 400 pixels: at most 100 squares, one at random from each stratum of
/// the picture, and at least four random pixels in each.
/// \param width   Width of the picture, in pixels.
/// \param height  Height of the picture, in pixels.
/// \param seed    Seed of the choice.
[[nodiscard]] inline PictureCheck choose_pixels(int width, int height,
                                                std::uint64_t seed) {
    constexpr int side = PictureCheck::side;
    const int columns = (width - 1) / side + 1, rows = (height - 1) / side + 1;
    const double all = double(columns) * rows;
    const int count = int(std::min(all, 100.0));
    auto stream = ljus::random_stream(seed, ljus::Pass::user, 0, 0);
    PictureCheck check;
    int last = -1;
    for (int i = 0; i < count; ++i) {
        const int number = int((i + next_1d<double>(stream)) * all / count);
        if (number == std::exchange(last, number)) continue; // chosen already
        const int left = number % columns * side, top = number / columns * side;
        std::vector<CheckedPixel> pixels;
        for (int y = top; y < std::min(top + side, height); ++y)
            for (int x = left; x < std::min(left + side, width); ++x)
                pixels.push_back({.x = x, .y = y});
        const std::size_t wanted = std::min(pixels.size(), std::size_t(400 / count));
        for (std::size_t k = 0; k < wanted; ++k) { // the beginning of a shuffle
            const double rest = double(pixels.size() - k);
            std::swap(pixels[k],
                      pixels[k + std::size_t(next_1d<double>(stream) * rest)]);
        }
        pixels.resize(wanted);
        check.blocks.push_back(std::move(pixels));
    }
    return check;
}

/// Path traces one more round of rays in each pixel of a check.
/// \param check    The pixels.
/// \param world    The closed scene.
/// \param camera   Any camera.
/// \param picture  Size, seed, threads.
/// \param now      A clock, in seconds.
template <ljus::AnyWorld W, ljus::CameraLike C, typename Clock>
void trace_round(PictureCheck& check, const W& world, const C& camera,
                 ljus::RenderSettings picture, Clock&& now) {
    const double begin = now();
    const ljus::PathTracer tracer(world);
    picture.samples = PictureCheck::rays_a_round;
    for (std::size_t half = 0; half < 2; ++half) {
        const auto number = 2 * std::uint64_t(check.rounds) + half;
        picture.seed = ljus::mix_bits(picture.seed + ljus::mix_bits(~number));
        const ljus::PictureRays rays(picture);
        const auto some = [&](long long block) {
            ljus::Counts counts;
            for (CheckedPixel& pixel : check.blocks[std::size_t(block)])
                for (int i = 0; i < picture.samples; ++i) {
                    const auto light =
                        trace_pixel(tracer, camera, rays, {pixel.x, pixel.y, i}, counts)
                            .radiance;
                    if (ljus::is_finite(light))
                        pixel.halves[half] += ljus::RgbT<double>(light);
                }
        };
        (void)ljus::parallel_blocks(static_cast<long long>(check.blocks.size()), some,
                                    {.threads = picture.threads});
    }
    ++check.rounds;
    check.seconds += now() - begin;
}

/// Whether paths carry all light of a scene. Only then can they check a picture.
template <ljus::AnyWorld W>
[[nodiscard]] bool paths_carry_all(const W& world) {
    return path_remarks(world).size() ==
           scene_remarks(world, {.direct = ljus::DirectLight::mis}).size();
}

/// A mean and its standard error.
struct Estimate {
    double value = 0; ///< The mean.
    double error = 0; ///< Standard error of the mean.

    /// The mean of some values, and its standard error from their scatter, but at least
    /// from their own errors. For a single value it is at least the value itself.
    /// \param values    The values.
    /// \param variance  The sum of their variances.
    [[nodiscard]] static Estimate of(const std::vector<double>& values,
                                     double variance) {
        const double n = double(values.size());
        Estimate found;
        for (const double value : values) found.value += value / n;
        double squares = 0;
        for (const double value : values)
            squares += (value - found.value) * (value - found.value);
        found.error =
            n > 1 ? std::sqrt(squares / (n * (n - 1))) : std::abs(found.value);
        found.error = std::max(found.error, std::sqrt(variance) / n);
        return found;
    }
    /// Three standard errors below the mean, at least 0. Three are taken because the
    /// values often contain rare large ones.
    [[nodiscard]] double low() const { return std::max(value - 3 * error, 0.0); }
    /// Three standard errors above the mean, at least 0.
    [[nodiscard]] double high() const { return std::max(value + 3 * error, 0.0); }
};

/// The result of a check of the mean of some pictures, in relMSE.
struct CheckedError {
    Estimate bias{};   ///< Squared bias of a pixel, which does not include noise.
    Estimate blocks{}; ///< Error of the mean of a square of pixels.
};

/// Measures the bias and the error of a picture at the pixels of a check.
///
/// Let P be the mean of the pictures in a pixel, and A and B the means of its two
/// halves. All three are independent, so that the expected value of (P - A)(P - B) is
/// the squared error of P. The variance of P is known from the scatter of the pictures,
/// and is subtracted. This leaves the squared bias. The squared error of the mean of a
/// square is estimated by the products of the errors of two different pixels, over all
/// such pairs. A small picture has few squares, whose scatter tells little; the scatter
/// of the pixels within a square then gives the standard error.
/// \param check  A check with at least one round.
/// \param state  The pictures, added by ljus::add_pass() with alpha 1.
/// \return Means over the squares and their standard errors.
// [check]
[[nodiscard]] inline CheckedError check_picture(const PictureCheck& check,
                                                const ljus::ProgressiveState& state) {
    using Color = ljus::RgbT<double>;
    const auto mean = ljus::mean_image<double>(state);
    const auto level = state.passes > 1 ? levels(state) : mean;
    const double n = double(state.passes);
    const auto relative = [](const Color& squared, const Color& light) {
        const Color part = squared / (light * light + ljus::default_epsilon);
        return (part.x + part.y + part.z) / 3;
    };
    std::vector<double> bias, blocks;
    double bias_variance = 0, blocks_variance = 0; // of the values, summed
    for (const auto& pixels : check.blocks) {
        const double count = double(pixels.size());
        double of_pixels = 0, of_squares = 0;
        Color sum{0}, squares{0}, light{0};
        for (const CheckedPixel& at : pixels) {
            const Color p = pixel(mean, at.x, at.y);
            const Color a = at.halves[0] / check.rays(),
                        b = at.halves[1] / check.rays();
            const Color truth = (a + b) / 2.0, away = p - truth;
            Color squared = (p - a) * (p - b);
            if (n > 1) squared -= pixel(state.squares, at.x, at.y) / (n * (n - 1));
            const double part =
                relative(squared, (pixel(level, at.x, at.y) + truth) / 2.0);
            of_pixels += part / count;
            of_squares += part * part / count;
            sum += away;
            squares += away * away;
            light += (p + truth) / (2 * count);
        }
        bias.push_back(of_pixels);
        if (count == 1) continue;
        bias_variance +=
            std::max(of_squares - of_pixels * of_pixels, 0.0) / (count - 1);
        const Color product = (sum * sum - squares) / (count * (count - 1));
        blocks.push_back(relative(product, light));
        // With the variance v of the mean, a product of two has 4 v m^2 + 2 v^2.
        const Color v =
            glm::max(squares - sum * sum / count, Color{0}) / (count * (count - 1));
        const Color spread = 4.0 * v * glm::max(product, Color{0}) + 2.0 * v * v;
        const double error = relative(glm::sqrt(spread), light);
        blocks_variance += error * error;
    }
    return {Estimate::of(bias, bias_variance), Estimate::of(blocks, blocks_variance)};
}
// [check]

/// An interval for an error in relMSE, of three standard errors to each side.
struct ErrorInterval {
    double low = 0;  ///< Lower end.
    double high = 0; ///< Upper end.
};

/// The intervals that a program states for the mean of some pictures.
struct StatedError {
    ErrorInterval pixels{}; ///< relMSE of a pixel.
    ErrorInterval blocks{}; ///< relMSE of the mean of a square of 8 x 8 pixels.
};

/// The error of the mean of some pictures. The noise comes from the scatter of the
/// pictures, and the bias from a check.
/// \param state  The pictures, added by ljus::add_pass() with alpha 1.
/// \param found  The result of check_picture(). For a single picture, the noise is part
///               of the bias.
[[nodiscard]] inline StatedError stated_error(const ljus::ProgressiveState& state,
                                              const CheckedError& found) {
    const double n = double(state.passes);
    if (n < 2)
        return {{found.bias.low(), found.bias.high()},
                {found.blocks.low(), found.blocks.high()}};
    const double margin = 1 + 2 / n;
    const auto means =
        ljus::block_means(ljus::mean_image<double>(state), state.block_side);
    double of_blocks = 0;
    for (std::size_t i = 0; i < means.pixels.size(); ++i) {
        // The standard error is subtracted from the mean, because both may come from
        // one bright ray.
        const auto variance = state.block_squares.pixels[i] / (n * (n - 1));
        const auto light = means.pixels[i] - glm::sqrt(variance);
        const auto part = variance / (light * light + ljus::default_epsilon);
        of_blocks += (part.x + part.y + part.z) / 3;
    }
    of_blocks *= margin / double(means.pixels.size());
    return {{relative_noise(state) / margin + found.bias.low(),
             relative_noise(state, false) * margin + found.bias.high()},
            {found.blocks.low(), std::max(of_blocks, found.blocks.high())}};
}

} // namespace examples
