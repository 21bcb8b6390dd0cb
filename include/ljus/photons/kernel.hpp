#pragma once

/// \file ljus/photons/kernel.hpp
/// \brief How much a photon counts at a distance.

#include <cmath>
#include <concepts>
#include <cstdint>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup kernel Kernels
/// \brief Section 3.2.6: the area over which a photon's flux is spread.
///
/// A density estimate asks one thing of a kernel, kernel_weight(kernel, x): how much a
/// photon counts whose squared distance is x times the squared radius, where 1 is what
/// it counts in an even disc. The mean over the disc must be 1, or light is made or
/// lost; check() of DensityEstimateOf refuses a kernel for which it is not. Those of
/// the list below are here; one of your own is a type with this function beside it:
///
///     struct Triweight {};
///     float kernel_weight(Triweight, float x) {
///         return 4 * (1 - x) * (1 - x) * (1 - x);
///     }
///     const DensityEstimateOf<Triweight> gather{.radius = 0.2f};
/// \{

/// The shape of the hill that stands for a photon; each holds the volume 1.
enum class Kernel : std::uint8_t {
    box,          ///< The report's: the same weight in the whole disc.
    cone,         ///< 1 - d/r: Jensen's cone filter with k = 1 \cite jensen2001.
    gaussian,     ///< exp(-2 d^2 / r^2), cut at r.
    epanechnikov, ///< 1 - d^2/r^2: least variance, equal bias \cite silverman1986.
    biweight      ///< (1 - d^2/r^2)^2: smooth at its edge.
};

/// The weight of a photon, relative to 1/(pi r^2).
/// \param kernel  The shape.
/// \param x       Squared distance over squared radius, in [0, 1].
/// \return At least 0; the mean over the disc is 1.
/// \report{Section 3.2.6}
/// \erratum{The report's program multiplied by 1 - d/r without the factor 3 that keeps
///          the flux, and made up for it by hand.}
// [kernel]
template <std::floating_point T>
[[nodiscard]] T kernel_weight(Kernel kernel, T x) noexcept {
    switch (kernel) {
    case Kernel::box:
        return T(1);
    case Kernel::cone:
        return T(3) * (T(1) - std::sqrt(x));
    case Kernel::gaussian:
        // 2 / (1 - e^-2): one over the mean of the Gaussian over the disc.
        return T(2.3130352854993312) * std::exp(T(-2) * x);
    case Kernel::epanechnikov:
        return T(2) * (T(1) - x);
    case Kernel::biweight:
        return T(3) * (T(1) - x) * (T(1) - x);
    }
    return T(0);
}
// [kernel]

/// What a density estimate asks of a kernel: see the head of this page.
template <typename K, typename T = float>
concept KernelLike = requires(const K& kernel, T x) {
    { kernel_weight(kernel, x) } -> std::same_as<T>;
};

/// \}

} // namespace ljus
