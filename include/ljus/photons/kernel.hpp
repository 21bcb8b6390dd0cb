#pragma once

/// \file ljus/photons/kernel.hpp
/// \brief Kernels: the weight of a photon by its distance.

#include <cmath>
#include <concepts>
#include <cstdint>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup kernel Kernels
/// \brief Section 3.2.6 of the report: how the flux of a photon is spread over a disc.
///
/// A kernel has one function, kernel_weight(kernel, x). It returns the weight of a
/// photon, where x is the photon's squared distance over the squared radius of the
/// disc. The mean of the weight over the disc must be 1, so that an estimate conserves
/// flux; check() of DensityEstimateOf refuses other kernels. A kernel of your own is a
/// type with this function:
///
///     struct Triweight {};
///     float kernel_weight(Triweight, float x) {
///         return 4 * (1 - x) * (1 - x) * (1 - x);
///     }
///     const DensityEstimateOf<Triweight> gather{.radius = 0.2f};
/// \{

/// The library's kernels, up to a factor, with the distance d and the radius r.
enum class Kernel : std::uint8_t {
    box,  ///< The constant 1, as in the report.
    cone, ///< 1 - d/r: Jensen's cone filter with the constant k = 1 \cite jensen2001.
    gaussian, ///< exp(-2 d^2 / r^2), up to d = r.
    /// 1 - d^2/r^2, which has the least variance at equal bias \cite silverman1986.
    epanechnikov,
    biweight ///< (1 - d^2/r^2)^2, which is smooth at the border.
};

/// The weight of a photon, relative to that of a constant kernel.
/// \param kernel  The kernel.
/// \param x       Squared distance over squared radius, in [0, 1].
/// \return At least 0. The mean over the disc is 1.
/// \report{Section 3.2.6}
/// \erratum{The report's program multiplies by 1 - d/r without the factor 3 that
/// conserves the flux, and corrects the brightness by hand.}
// [kernel]
template <std::floating_point T>
[[nodiscard]] T kernel_weight(Kernel kernel, T x) noexcept {
    switch (kernel) {
    case Kernel::box:
        return T(1);
    case Kernel::cone:
        return T(3) * (T(1) - std::sqrt(x));
    case Kernel::gaussian:
        // 2/(1 - e^-2) is one over the mean of the Gaussian over the disc.
        return T(2.3130352854993312) * std::exp(T(-2) * x);
    case Kernel::epanechnikov:
        return T(2) * (T(1) - x);
    case Kernel::biweight:
        return T(3) * (T(1) - x) * (T(1) - x);
    }
    return T(0);
}
// [kernel]

/// A type with the function of a kernel; see \ref kernel.
template <typename K, typename T = float>
concept KernelLike = requires(const K& kernel, T x) {
    { kernel_weight(kernel, x) } -> std::same_as<T>;
};

/// \}

} // namespace ljus
