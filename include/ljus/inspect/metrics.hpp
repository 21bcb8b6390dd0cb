#pragma once

/// \file ljus/inspect/metrics.hpp
/// \brief Error metrics of a picture against a reference.

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
/// \brief Means over pixels and channels of linear radiance, computed in double.
///
/// x is the picture and r the reference. Every metric is at least 0, and 0 for equal
/// pictures; NaN in a picture makes it NaN. The reference should come from another
/// algorithm and seed, with an error of at most a tenth of the measured one. No metric
/// is enough alone: state relMSE with the block error (bias) and the trimmed error
/// (fireflies).
/// \{

/// The epsilon of the relative metrics, for scenes of mean radiance near 1; for others
/// use (0.1 times the mean radiance)^2.
inline constexpr double default_epsilon = 0.01;

namespace detail {

inline void require_epsilon(double epsilon) {
    if (std::isfinite(epsilon) && epsilon > 0.0) return;
    throw std::invalid_argument("The epsilon of a relative error is " +
                                std::to_string(epsilon) +
                                "; it must be finite and above 0.");
}

// The errors of all pixels in order, each the mean of error(x, r) over the channels.
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
/// It is the metric of theory: for an unbiased method it falls as 1/sqrt(n).
/// *Trap*: a few highlights dominate it; it says nothing of the dark regions.
/// \param image      The picture.
/// \param reference  The reference, of the same size.
/// \return In units of radiance.
/// \throws std::invalid_argument  as require_same_size().
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double rmse(const ImageT<T>& image, const ImageT<U>& reference) {
    const auto square = [](double x, double r) { return (x - r) * (x - r); };
    return std::sqrt(detail::mean(detail::pixel_errors(image, reference, square)));
}

/// The relative mean square error, mean (x - r)^2 / (r^2 + epsilon)
/// \cite rousselle2011.
/// It is relative, like the eye, and the default here.
/// *Trap*: values with different epsilons, or with the divisor (r + epsilon)^2 of some
/// tools, are not comparable; state the epsilon.
/// \param image, reference  The picture and the reference, of the same size.
/// \param epsilon    Radiance squared, above 0: the scale of darkness.
/// \return Dimensionless; 1 for a black picture of a scene that is bright throughout.
/// \throws std::invalid_argument  as require_same_size(), or for the epsilon.
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double rel_mse(const ImageT<T>& image, const ImageT<U>& reference,
                             double epsilon = default_epsilon) {
    detail::require_epsilon(epsilon);
    return detail::mean(
        detail::pixel_errors(image, reference, detail::RelativeSquare{epsilon}));
}

/// The relative mean square error without the worst pixels.
/// Dropping the worst 1 % removes fireflies, and measures the rest of the picture.
/// *Trap*: it favours a method that puts its energy into fireflies; state it beside
/// rel_mse(), never instead of it.
/// \param image  The picture.
/// \param reference  The reference, of the same size.
/// \param dropped  The fraction of pixels to drop, in [0, 1): the worst
///          floor(dropped * pixels), by their mean over the channels; at 1 %, none of
///          fewer than 100 pixels.
/// \param epsilon  As for rel_mse().
/// \return Dimensionless, at most rel_mse().
/// \throws std::invalid_argument  as rel_mse(), or for `dropped`.
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double trimmed_rel_mse(const ImageT<T>& image, const ImageT<U>& reference,
                                     double dropped = 0.01,
                                     double epsilon = default_epsilon) {
    detail::require_epsilon(epsilon);
    if (!(dropped >= 0.0 && dropped < 1.0))
        throw std::invalid_argument("The fraction of pixels to drop is " +
                                    std::to_string(dropped) +
                                    "; it must be within [0, 1).");
    std::vector<double> errors =
        detail::pixel_errors(image, reference, detail::RelativeSquare{epsilon});
    // NaN cannot be ordered: return it.
    for (const double error : errors)
        if (std::isnan(error)) return error;
    // The factor covers a product that was rounded down below an integer.
    const double count = static_cast<double>(errors.size());
    const auto worst = static_cast<std::ptrdiff_t>(dropped * count * (1.0 + 1e-12));
    const auto end = errors.end() - worst;
    if (worst > 0) std::nth_element(errors.begin(), end, errors.end());
    errors.erase(end, errors.end());
    return detail::mean(errors);
}

/// The image of block means: each pixel is the mean of size x size pixels.
/// If the width or height is no multiple of the block's side, the last column or row of
/// blocks is narrower and takes the mean of its pixels.
/// \param image  The picture.
/// \param size   Side of a block in pixels, at least 1.
/// \return An image of ceil(width/size) x ceil(height/size), in double.
/// \throws std::invalid_argument  as check(image), or for a size below 1.
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

/// The relMSE of the means of 10 x 10 blocks, which measures bias.
/// Noise that is independent between pixels is 100 times weaker in a squared block
/// mean; an error that neighbours share stays. A blur within a block does not show.
/// *Trap*: neighbouring pixels share photons, so that the noise of photon maps survives
/// too; use several seeds and bias_variance() for them. Narrow blocks at the right and
/// lower edge (see block_means()) have the weight of whole ones.
/// \param image      The picture.
/// \param reference  The reference, of the same size.
/// \param size       Side of a block in pixels, at least 1.
/// \param epsilon    As for rel_mse().
/// \return Dimensionless.
/// \throws std::invalid_argument  as rel_mse() and block_means().
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double block_error(const ImageT<T>& image, const ImageT<U>& reference,
                                 int size = 10, double epsilon = default_epsilon) {
    detail::require_same_size(image, reference);
    return rel_mse(block_means(image, size), block_means(reference, size), epsilon);
}

/// \}

} // namespace ljus
