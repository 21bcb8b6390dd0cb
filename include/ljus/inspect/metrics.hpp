#pragma once

/// \file ljus/inspect/metrics.hpp
/// \brief How wrong a picture is: error metrics against a reference.

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "ljus/image/image.hpp"
#include "ljus/math/sum.hpp"

namespace ljus {

/// \defgroup metrics Error metrics
/// \brief Means over pixels and channels, in double, on linear radiance, not on bytes.
///
/// x is the picture and r the reference. Every metric is 0 for equal pictures and at
/// least 0; NaN in a picture makes it NaN, it is not hidden. The reference should come
/// from another algorithm and seed, with an error of its own of at most a tenth of what
/// is measured. No metric is enough alone: give relMSE with the block error (bias) and
/// the trimmed error (fireflies).
/// \{

/// The epsilon of the relative metrics: made for scenes whose mean radiance is near 1;
/// elsewhere (0.1 times the mean radiance)^2.
inline constexpr double default_epsilon = 0.01;

namespace detail {

inline void require_epsilon(double epsilon) {
    if (std::isfinite(epsilon) && epsilon > 0.0) return;
    throw std::invalid_argument("The epsilon of a relative error is " +
                                std::to_string(epsilon) +
                                "; it must be finite and above 0.");
}

// The errors of all pixels in order, each the mean of error(x, r) over three channels.
template <std::floating_point T, std::floating_point U, typename Error>
std::vector<double> pixel_errors(const ImageT<T>& image, const ImageT<U>& reference,
                                 Error error) {
    require_same_size(image, reference);
    std::vector<double> errors(image.pixels.size());
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const Vec3T<double> x(image.pixels[i]);
        const Vec3T<double> r(reference.pixels[i]);
        errors[i] = (error(x.x, r.x) + error(x.y, r.y) + error(x.z, r.z)) / 3.0;
    }
    return errors;
}

inline double mean(const std::vector<double>& values) {
    return ljus::detail::pairwise_sum(values) / static_cast<double>(values.size());
}

// The squared relative error of one channel.
struct RelativeSquare {
    double epsilon;
    double operator()(double x, double r) const noexcept {
        return (x - r) * (x - r) / (r * r + epsilon);
    }
};

} // namespace detail

/// The root mean square error, sqrt(mean (x - r)^2).
///
/// The metric of theory: for an unbiased method it falls as 1/sqrt(n).
/// *Trap*: a few highlights decide it; it says nothing of the dark parts.
/// \param image      The picture.
/// \param reference  The truth, of the same size.
/// \return In units of radiance.
/// \throws std::invalid_argument  as require_same_size().
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double rmse(const ImageT<T>& image, const ImageT<U>& reference) {
    const auto square = [](double x, double r) { return (x - r) * (x - r); };
    return std::sqrt(detail::mean(detail::pixel_errors(image, reference, square)));
}

/// The relative mean square error, mean (x - r)^2 / (r^2 + epsilon)
/// \cite rousselle2011.
///
/// Relative, as the eye is, and the default here.
/// *Trap*: figures with different epsilons, or divided by (r + epsilon)^2 as some tools
/// do, do not compare; state it.
/// \param image      The picture.
/// \param reference  The truth, of the same size.
/// \param epsilon    Radiance squared, above 0: what counts as dark.
/// \return Without unit; 1 for a black picture of a scene that is bright throughout.
/// \throws std::invalid_argument  as require_same_size(), or for the epsilon.
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double rel_mse(const ImageT<T>& image, const ImageT<U>& reference,
                             double epsilon = default_epsilon) {
    detail::require_epsilon(epsilon);
    return detail::mean(
        detail::pixel_errors(image, reference, detail::RelativeSquare{epsilon}));
}

/// The relative mean square error of the best pixels.
///
/// Dropping the worst 1 % takes the fireflies out, and shows what the rest is like.
/// *Trap*: it is kind to a method that puts its energy into fireflies; beside
/// rel_mse(), never instead of it.
/// \param image  The picture.
/// \param reference  The truth, of the same size.
/// \param dropped  The part of all pixels that is dropped, in [0, 1): the worst
///          floor(dropped * pixels) of them, by their mean over the channels; none of
///          less than 100 pixels at 1 %.
/// \param epsilon  As for rel_mse().
/// \return Without unit, at most rel_mse().
/// \throws std::invalid_argument  as rel_mse(), or for `dropped`.
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double trimmed_rel_mse(const ImageT<T>& image, const ImageT<U>& reference,
                                     double dropped = 0.01,
                                     double epsilon = default_epsilon) {
    detail::require_epsilon(epsilon);
    if (!(dropped >= 0.0 && dropped < 1.0))
        throw std::invalid_argument("The part of the pixels to drop is " +
                                    std::to_string(dropped) +
                                    "; it must be within [0, 1).");
    std::vector<double> errors =
        detail::pixel_errors(image, reference, detail::RelativeSquare{epsilon});
    // NaN has no place in an order: let the mean show it.
    for (const double error : errors)
        if (std::isnan(error)) return error;
    // A little more than the product, which may have been rounded down below a whole.
    const double count = static_cast<double>(errors.size());
    const auto worst = static_cast<std::ptrdiff_t>(dropped * count * (1.0 + 1e-12));
    const auto end = errors.end() - worst;
    if (worst > 0) std::nth_element(errors.begin(), end, errors.end());
    errors.erase(end, errors.end());
    return detail::mean(errors);
}

/// The image of block means: each pixel is the mean of size x size pixels.
///
/// Where the width or height is no multiple of the block's, the last column or row of
/// blocks is narrower and takes the mean of the pixels it has.
/// \param image  The picture.
/// \param size   Side of a block in pixels, at least 1.
/// \return An image of ceil(width/size) x ceil(height/size), in double.
/// \throws std::invalid_argument  for an image as check(), or a size below 1.
template <std::floating_point T>
[[nodiscard]] ImageT<double> block_means(const ImageT<T>& image, int size = 10) {
    check(image);
    if (size < 1)
        throw std::invalid_argument("The side of a block is " + std::to_string(size) +
                                    " pixels; it must be at least 1.");
    const auto blocks = [size](int n) { return n / size + (n % size != 0 ? 1 : 0); };
    auto means = make_image<double>(blocks(image.width), blocks(image.height));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            pixel(means, x / size, y / size) += RgbT<double>(pixel(image, x, y));
    for (int y = 0; y < means.height; ++y)
        for (int x = 0; x < means.width; ++x) {
            const int columns = std::min(size, image.width - x * size);
            const int rows = std::min(size, image.height - y * size);
            pixel(means, x, y) /= static_cast<double>(columns) * rows;
        }
    return means;
}

/// The relMSE of the means of 10 x 10 blocks: what noise leaves, that is bias.
///
/// Noise that is independent from pixel to pixel is 100 times weaker in a block's mean
/// squared; an error that neighbours share stays. A blur within a block does not show.
/// *Trap*: photons are shared by neighbouring pixels, so that their noise survives too;
/// with it, use several seeds and bias_variance(). Narrow blocks at the right and lower
/// edge (see block_means()) weigh as much as whole ones.
/// \param image      The picture.
/// \param reference  The truth, of the same size.
/// \param size       Side of a block in pixels, at least 1.
/// \param epsilon    As for rel_mse().
/// \return Without unit.
/// \throws std::invalid_argument  as rel_mse() and block_means().
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double block_error(const ImageT<T>& image, const ImageT<U>& reference,
                                 int size = 10, double epsilon = default_epsilon) {
    detail::require_same_size(image, reference);
    return rel_mse(block_means(image, size), block_means(reference, size), epsilon);
}

/// \}

} // namespace ljus
