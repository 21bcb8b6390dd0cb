#pragma once

/// \file ljus/photons/kernel.hpp
/// \brief The weight of a photon by its distance.

#include <cmath>
#include <concepts>
#include <cstdint>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup kernel Kernels
/// \brief Section 3.2.6: the area over which a photon's flux is spread.
///
/// A kernel has one function, kernel_weight(kernel, x): the weight of a photon at the
/// squared distance x, in units of the squared radius, relative to a constant kernel.
/// Its mean over the disc must be 1, otherwise the estimate does not conserve flux;
/// check() of DensityEstimateOf refuses other kernels. A kernel of your own is a type
/// with this function:
///
///     struct Triweight {};
///     float kernel_weight(Triweight, float x) {
///         return 4 * (1 - x) * (1 - x) * (1 - x);
///     }
///     const DensityEstimateOf<Triweight> gather{.radius = 0.2f};
/// \{

/// The library's kernels; each has the mean 1 over the disc.
enum class Kernel : std::uint8_t {
    box,          ///< Constant, as in the report.
    cone,         ///< 1 - d/r: Jensen's cone filter with k = 1 \cite jensen2001.
    gaussian,     ///< exp(-2 d^2 / r^2), cut at r.
    epanechnikov, ///< 1 - d^2/r^2: least variance at equal bias \cite silverman1986.
    biweight      ///< (1 - d^2/r^2)^2: smooth at the border.
};

/// The weight of a photon, relative to 1/(pi r^2).
/// \param kernel  The kernel.
/// \param x       Squared distance over squared radius, in [0, 1].
/// \return At least 0; the mean over the disc is 1.
/// \report{Section 3.2.6}
/// \erratum{The report's program multiplies by 1 - d/r without the factor 3 that
///          conserves the flux, and compensates by hand.}
// [kernel]
template <std::floating_point T>
[[nodiscard]] T kernel_weight(Kernel kernel, T x) noexcept {
    switch (kernel) {
    case Kernel::box:
        return T(1);
    case Kernel::cone:
        return T(3) * (T(1) - std::sqrt(x));
    case Kernel::gaussian:
        // 2 / (1 - e^-2): the reciprocal of the Gaussian's mean over the disc.
        return T(2.3130352854993312) * std::exp(T(-2) * x);
    case Kernel::epanechnikov:
        return T(2) * (T(1) - x);
    case Kernel::biweight:
        return T(3) * (T(1) - x) * (T(1) - x);
    }
    return T(0);
}
// [kernel]

/// The function that a kernel needs; see the group \ref kernel.
template <typename K, typename T = float>
concept KernelLike = requires(const K& kernel, T x) {
    { kernel_weight(kernel, x) } -> std::same_as<T>;
};

/// \}

} // namespace ljus
