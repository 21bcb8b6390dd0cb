#pragma once

/// \file ljus/geometry/detail/metaball_line.hpp
/// \brief The field of metaballs along a ray: a function of t with its bounds.

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "ljus/geometry/detail/field_on_ray.hpp"
#include "ljus/geometry/ray.hpp"

namespace ljus {

/// \defgroup metaballs Metaballs
/// \brief Section 2.1, footnote 2: "organic-looking n-dimensional objects". Chapter:
/// \ref ch_metaballs.
/// \{

/// A source of a field: \f$ w (1 - r^2/R^2)^2 \f$ within R, and 0 beyond.
template <std::floating_point T>
struct BlobT {
    Vec3T<T> center{T(0)}; ///< C, in scene units.
    T radius = T(1);       ///< R, above 0: extent of its field, in scene units.
    T weight = T(1);       ///< w; negative carves.
};

using Blob = BlobT<float>; ///< BlobT in float.

namespace detail {

/// The largest slope of \f$ (1 - q^2)^2 \f$, at \f$ q = 1/\sqrt 3 \f$.
template <std::floating_point T>
inline constexpr T steepest_blob = T(8) / (T(3) * std::numbers::sqrt3_v<T>);

/// A blob along a ray: its field is w s^2 where \f$ s(t) = h - k (t - m)^2 \f$ is
/// positive.
template <std::floating_point C>
struct StrandT {
    C enter = C(0);  ///< Where s becomes positive.
    C leave = C(0);  ///< Where s becomes negative again.
    C middle = C(0); ///< m, nearest to the centre.
    C height = C(0); ///< h = 1 - p^2/R^2; p is the distance at m.
    C bend = C(0);   ///< k = D.D / R^2.
    C weight = C(1); ///< w.
};

/// A blob along a ray. As in chord(), the vectors are subtracted before they are
/// squared.
/// \param ray   The ray; its range is ignored.
/// \return In double; nothing for a miss, for non-finite data, a zero direction, or a
///         radius not above 0.
template <std::floating_point T>
[[nodiscard]] std::optional<StrandT<WideT<T>>> strand(const RayT<T>& ray,
                                                      const BlobT<T>& blob) noexcept {
    using C = WideT<T>;
    const Vec3T<C> d{ray.direction};
    const Vec3T<C> oc = Vec3T<C>{ray.origin} - Vec3T<C>{blob.center};
    const C r{blob.radius}, inverse_r = C(1) / r;
    const C a = glm::dot(d, d);
    const C middle = -glm::dot(oc, d) / a;
    const Vec3T<C> p = (oc + middle * d) * inverse_r;
    const C height = C(1) - glm::dot(p, p);
    const C bend = a * inverse_r * inverse_r;
    const C half = std::sqrt(height / bend);
    constexpr C max = std::numeric_limits<C>::max();
    const bool met = height > C(0) && half <= max && half > C(0) && r > C(0) &&
                     std::abs(middle) <= max && std::isfinite(C(blob.weight));
    if (!met) return std::nullopt;
    return StrandT<C>{middle - half, middle + half, middle,
                      height,        bend,          C(blob.weight)};
}

/// The strands of a ray. Up to 16 need no heap memory.
template <std::floating_point C>
struct StrandsT {
    std::array<StrandT<C>, 16> few; ///< Used for up to 16.
    std::vector<StrandT<C>> many{}; ///< Holds all strands if there are more.
    std::size_t count = 0;          ///< Number of strands.
    /// Appends a strand.
    void add(const StrandT<C>& strand) {
        if (count < few.size())
            few[count] = strand;
        else {
            if (many.empty()) many.assign(few.begin(), few.end());
            many.push_back(strand);
        }
        ++count;
    }
    /// All strands.
    [[nodiscard]] std::span<const StrandT<C>> all() const noexcept {
        return {many.empty() ? few.data() : many.data(), count};
    }
};

/// The field of metaballs along a ray: value, slope and their bounds, as the solvers
/// for isosurfaces require.
template <std::floating_point C>
struct MetaballLineT {
    std::span<const StrandT<C>> strands{}; ///< Blobs that the ray meets.
    C level = C(0);                        ///< L.
    C enter = C(0);                        ///< Where the first strand begins.
    C leave = C(-1);                       ///< Where the last strand ends.

    /// f(O + tD).
    [[nodiscard]] C value(C t) const noexcept {
        C sum = -level;
        for (const auto& b : strands) {
            const C s = b.height - b.bend * (t - b.middle) * (t - b.middle);
            if (s > C(0)) sum += b.weight * s * s;
        }
        return sum;
    }
    /// Bound of |df/dt| on this ray: each strand is a one-dimensional blob.
    [[nodiscard]] C steepest() const noexcept {
        C sum = C(0);
        for (const auto& b : strands)
            sum += std::abs(b.weight) * b.height * std::sqrt(b.height * b.bend);
        return sum * steepest_blob<C>;
    }
    /// Bound of the rounding error of value().
    [[nodiscard]] C rounding() const noexcept {
        C sum = level;
        for (const auto& b : strands) sum += std::abs(b.weight);
        return C(8) * std::numeric_limits<C>::epsilon() * sum;
    }
    /// An interval that contains all values in [from, to]; tight for a single strand.
    [[nodiscard]] IntervalT<C> range(C from, C to) const noexcept {
        const C doubt = rounding();
        IntervalT<C> sum{-level - doubt, -level + doubt};
        for (const auto& b : strands) {
            const auto s = height_in(b, from, to);
            const C low = b.weight * s.low * s.low, high = b.weight * s.high * s.high;
            sum.low += glm::min(low, high);
            sum.high += glm::max(low, high);
        }
        return sum;
    }
    /// An interval that contains all slopes df/dt = -4 w k (t - m) s in [from, to].
    [[nodiscard]] IntervalT<C> slope(C from, C to) const noexcept {
        IntervalT<C> sum;
        for (const auto& b : strands) {
            const auto s = height_in(b, from, to);
            const C x = C(-4) * b.weight * b.bend * (from - b.middle);
            const C y = C(-4) * b.weight * b.bend * (to - b.middle);
            const C least = glm::min(x, y), most = glm::max(x, y);
            const C doubt = rounding() * glm::max(std::abs(x), std::abs(y));
            sum.low += glm::min(least * s.low, least * s.high) - doubt;
            sum.high += glm::max(most * s.low, most * s.high) + doubt;
        }
        return sum;
    }

private:
    // The range of max(s, 0) in [from, to].
    static IntervalT<C> height_in(const StrandT<C>& b, C from, C to) noexcept {
        const C near = glm::clamp(b.middle, from, to) - b.middle;
        const C far = glm::max(std::abs(from - b.middle), std::abs(to - b.middle));
        return {glm::max(C(0), b.height - b.bend * far * far),
                glm::max(C(0), b.height - b.bend * near * near)};
    }
};

/// The field along a ray; it refers to `strands`.
/// \return The field; without strands `leave` lies before `enter`.
template <std::floating_point C>
[[nodiscard]] MetaballLineT<C> line_of(const StrandsT<C>& strands, C level) noexcept {
    constexpr C far = std::numeric_limits<C>::infinity();
    MetaballLineT<C> line{strands.all(), level, far, -far};
    for (const auto& b : line.strands) {
        line.enter = glm::min(line.enter, b.enter);
        line.leave = glm::max(line.leave, b.leave);
    }
    return line;
}

} // namespace detail

/// \}

} // namespace ljus
