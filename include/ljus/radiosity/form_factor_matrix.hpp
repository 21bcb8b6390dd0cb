#pragma once

/// \file ljus/radiosity/form_factor_matrix.hpp
/// \brief The form factors between all patches of a scene.

#include "ljus/math/sum.hpp"
#include "ljus/parallel.hpp"
#include "ljus/radiosity/exchange_area.hpp"
#include "ljus/radiosity/patch_rays.hpp"

namespace ljus {

/// \defgroup form_factors The matrix of form factors
/// \brief Section 2.2 of the report: "a form factor, which describes patch visibility,
/// is calculated for each pair of patches". Chapter: \ref ch_radiosity.
/// \{

/// The form factors F_ij of a scene, stored as exchange areas
/// \f$ A_i F_{ij} = A_j F_{ji} \f$, where A_i is the area of patch i. The matrix of
/// exchange areas is exactly symmetric.
struct FormFactors {
    std::vector<double> area{}; ///< Area of each patch, in squared scene units.
    /// Exchange areas, in squared scene units: a symmetric matrix, row by row.
    std::vector<double> exchange{};

    /// The number of patches.
    [[nodiscard]] std::size_t size() const noexcept { return area.size(); }
    /// The exchange areas of patch i with all patches.
    [[nodiscard]] std::span<const double> row(std::size_t i) const noexcept {
        return {exchange.data() + i * size(), size()};
    }
    /// The form factor: the fraction of the flux of patch i that arrives at patch j.
    [[nodiscard]] double operator()(std::size_t i, std::size_t j) const noexcept {
        return row(i)[j] / area[i];
    }
    /// The fraction of the flux of patch i that arrives at any patch. In a closed room
    /// it is 1, but for the noise of rays; see FormFactorSettings::closed.
    [[nodiscard]] double row_sum(std::size_t i) const noexcept {
        return detail::pairwise_sum(row(i)) / area[i];
    }
};

/// How form factors are computed.
struct FormFactorSettings {
    /// Whether form factors between flat patches are computed by exchange_area().
    bool analytic = true;
    /// Number of rays from each patch whose form factors have no closed form.
    int rays = 256;
    /// Number of rays between two flat patches, to find the visible fraction. In a
    /// convex scene no rays are cast, see Patches::convex.
    int shadow_rays = 16;
    /// Whether to make each row sum exactly 1, for a room without openings.
    bool closed = false;
    std::uint64_t seed = 1; ///< Seed of the random streams.
    int threads = 0;        ///< Number of threads, as in ParallelSettings.
    /// Called with (done, total); returns false to stop.
    Progress progress = no_progress;
};

namespace detail {

/// Scales the form factors of a closed room until each row sum is 1, and keeps the
/// exchange areas symmetric \cite sinkhorn1967. The noise of rays then neither adds nor
/// removes light, which matters for an albedo near 1.
/// \return False if a patch exchanges light with no patch, or if the row sums do not
///         converge.
inline bool close_rows(FormFactors& factors) {
    const std::size_t n = factors.size();
    std::vector<double> scale(n, 1.0);
    double worst = 1;
    for (int round = 0; round < 1000 && worst > 1e-14; ++round) {
        worst = 0;
        for (std::size_t i = 0; i < n; ++i) {
            double sum = 0;
            for (std::size_t j = 0; j < n; ++j) sum += factors.row(i)[j] * scale[j];
            if (!(sum > 0)) return false;
            const double ratio = factors.area[i] / (sum * scale[i]);
            worst = std::max(worst, std::abs(ratio - 1));
            scale[i] *= std::sqrt(ratio);
        }
    }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            factors.exchange[i * n + j] *= scale[i] * scale[j];
    return worst <= 1e-10;
}

} // namespace detail

/// Computes the form factors between all patches. Between two flat patches, the form
/// factor is the closed form times the visible fraction. For any other pair, rays are
/// cast from each patch that is not flat. If both patches cast rays, the two results
/// are averaged with the weights that give the least noise. Without settings.analytic,
/// all patches cast rays.
/// \return The form factors, the same for any number of threads. Nothing if the
///         progress callback stopped the computation.
/// \throws std::invalid_argument  if a number of rays is below 1, or if settings.closed
///         is set and the row sums cannot be made 1.
/// \cost 8 n^2 bytes for n patches.
/// \report{Section 2.2}
template <AnyWorld W>
[[nodiscard]] std::optional<FormFactors>
make_form_factors(const W& world, const Patches& all,
                  const FormFactorSettings& settings = {}) {
    require_at_least("rays", settings.rays, 1);
    require_at_least("shadow_rays", settings.shadow_rays, 1);
    const std::size_t n = all.patches.size();
    FormFactors factors{.area = std::vector<double>(n),
                        .exchange = std::vector<double>(n * n)};
    for (std::size_t i = 0; i < n; ++i) factors.area[i] = all.patches[i].area;
    const auto closed_form = [&](std::size_t i) {
        return settings.analytic && all.patches[i].facet.count > 0;
    };
    const auto fill = [&](long long block) {
        const auto i = static_cast<std::size_t>(block);
        double* const row = factors.exchange.data() + i * n;
        const auto number = static_cast<std::uint32_t>(i);
        if (!closed_form(i)) {
            shoot_rays(world, all, number, settings.rays, settings.seed, {row, n});
            return;
        }
        for (std::size_t j = i + 1; j < n; ++j) {
            if (!closed_form(j)) continue;
            row[j] = exchange_area(all.patches[i].facet, all.patches[j].facet);
            if (row[j] > 0 && !all.convex)
                row[j] *= detail::visible_fraction(world, all, number,
                                                   static_cast<std::uint32_t>(j),
                                                   settings.shadow_rays, settings.seed);
        }
    };
    if (!parallel_blocks(static_cast<long long>(n), fill,
                         {.threads = settings.threads, .progress = settings.progress}))
        return std::nullopt;

    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 1; j < n; ++j) {
            double& there = factors.exchange[i * n + j];
            double& back = factors.exchange[j * n + i];
            const double ai = factors.area[i], aj = factors.area[j];
            if (!closed_form(i) && !closed_form(j))
                there = (there * aj + back * ai) / (ai + aj);
            else if (!closed_form(j))
                there = back;
            back = there;
        }
    if (settings.closed)
        require(detail::close_rows(factors), "closed", 1LL,
                "false: a patch sees no other, or the row sums do not converge");
    return factors;
}

/// \}

} // namespace ljus
