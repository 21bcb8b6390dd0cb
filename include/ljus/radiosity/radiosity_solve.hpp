#pragma once

/// \file ljus/radiosity/radiosity_solve.hpp
/// \brief The linear equations of radiosity, and four solvers.

#include <vector>

#include "ljus/radiosity/form_factor_matrix.hpp"

namespace ljus {

/// \defgroup radiosity_solve The equations of radiosity
/// \brief Section 2.2 of the report: "the radiosity of each patch is then given by
/// solving the equation system". Chapter: \ref ch_radiosity.
///
/// \f[ B_i = E_i + \rho_i \sum_j F_{ij} B_j \f]
///
/// Here B_i is the radiosity of patch i, E_i its emitted radiosity, \f$ \rho_i \f$ its
/// albedo, and F_ij the form factor from patch i to patch j. The *unshot* light of a
/// patch is the part of its radiosity that has not yet been sent to the other patches.
/// \{

/// A method to solve the equations for n patches.
enum class RadiositySolver : std::uint8_t {
    lu,           ///< Elimination: exact, in n^3/3 steps \cite goral1984.
    jacobi,       ///< Shoots the light of all patches at once: one bounce per sweep.
    gauss_seidel, ///< Shoots the light of one patch after the other, in order.
    shooting,     ///< Shoots the patch with the most unshot flux first \cite cohen1988.
};

/// The solver, and when it stops.
struct SolveSettings {
    RadiositySolver solver = RadiositySolver::shooting; ///< The solver.
    /// The solver stops when the unshot flux is at most this fraction of the emitted
    /// flux, in every channel. At least 0.
    double tolerance = 1e-12;
    int max_sweeps = 10000; ///< The largest number of sweeps, at least 0.
    /// Number of threads, as in ParallelSettings, for `jacobi`, and for the residual
    /// that is computed after `lu`. The other solvers use one thread.
    int threads = 0;
};

/// The radiosity of all patches.
struct RadiositySolution {
    std::vector<RgbT<double>> radiosity{}; ///< Emitted plus reflected light, in W/m^2.
    /// The ratio of unshot to emitted flux, in the channel where the ratio is largest:
    /// at the start, and after each sweep.
    std::vector<double> residual{};
    bool converged = true; ///< True if the tolerance was reached.
};

namespace detail {

// Solves a x = b by elimination with row pivoting. x replaces b.
inline void eliminate(std::vector<double>& a, std::vector<RgbT<double>>& b) {
    const std::size_t n = b.size();
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t best = k;
        for (std::size_t i = k + 1; i < n; ++i)
            if (std::abs(a[i * n + k]) > std::abs(a[best * n + k])) best = i;
        if (best != k) {
            std::swap_ranges(a.begin() + static_cast<std::ptrdiff_t>(k * n),
                             a.begin() + static_cast<std::ptrdiff_t>(k * n + n),
                             a.begin() + static_cast<std::ptrdiff_t>(best * n));
            std::swap(b[k], b[best]);
        }
        const double* const top = a.data() + k * n;
        for (std::size_t i = k + 1; i < n; ++i) {
            double* const row = a.data() + i * n;
            const double factor = row[k] / top[k];
            if (factor == 0) continue;
            for (std::size_t j = k + 1; j < n; ++j) row[j] -= factor * top[j];
            b[i] -= factor * b[k];
        }
    }
    for (std::size_t k = n; k-- > 0;) {
        for (std::size_t j = k + 1; j < n; ++j) b[k] -= a[k * n + j] * b[j];
        b[k] /= a[k * n + k];
    }
}

/// The radiosity, in W/m^2, by elimination. If the albedo of every patch is grey, all
/// channels are solved at once, otherwise one after the other.
/// \cost Memory for n^2 numbers, and n^3/3 multiplications per solution, for n patches:
///       10 s for 3000 patches.
[[nodiscard]] inline std::vector<RgbT<double>>
solve_lu(const FormFactors& factors, const std::vector<Patch>& patches) {
    const std::size_t n = patches.size();
    bool grey = true;
    for (const Patch& patch : patches)
        grey = grey && patch.albedo == RgbT<double>(patch.albedo.x);
    std::vector<RgbT<double>> radiosity(n);
    for (int channel = 0; channel < (grey ? 1 : 3); ++channel) {
        std::vector<double> matrix(n * n);
        std::vector<RgbT<double>> right(n);
        for (std::size_t i = 0; i < n; ++i) {
            const double scale = patches[i].albedo[channel] / factors.area[i];
            for (std::size_t j = 0; j < n; ++j)
                matrix[i * n + j] = (i == j ? 1.0 : 0.0) - scale * factors.row(i)[j];
            right[i] = patches[i].emitted;
        }
        detail::eliminate(matrix, right);
        for (std::size_t i = 0; i < n; ++i)
            if (grey)
                radiosity[i] = right[i];
            else
                radiosity[i][channel] = right[i][channel];
    }
    return radiosity;
}

/// The irradiance of all patches, \f$H_i=\sum_j F_{ij}B_j\f$, from their radiosity B_j;
/// both in W/m^2.
/// \cost n^2 multiplications per channel, for n patches.
[[nodiscard]] inline std::vector<RgbT<double>>
multiply(const FormFactors& factors, const std::vector<RgbT<double>>& radiosity,
         int threads = 0) {
    const std::size_t n = factors.size();
    std::vector<RgbT<double>> irradiance(n);
    const auto body = [&](long long block) {
        const auto i = static_cast<std::size_t>(block);
        const auto row = factors.row(i);
        RgbT<double> sum(0);
        for (std::size_t j = 0; j < n; ++j) sum += row[j] * radiosity[j];
        irradiance[i] = sum / factors.area[i];
    };
    parallel_blocks(static_cast<long long>(n), body, {.threads = threads});
    return irradiance;
}

// The unshot flux over the emitted flux, in the channel for which this is largest.
[[nodiscard]] inline double unshot_fraction(const FormFactors& factors,
                                            const std::vector<RgbT<double>>& unsent,
                                            const RgbT<double>& emitted) {
    RgbT<double> sum(0);
    for (std::size_t i = 0; i < unsent.size(); ++i)
        sum += factors.area[i] * glm::abs(unsent[i]);
    double share = 0;
    for (int c = 0; c < 3; ++c)
        if (emitted[c] > 0) share = std::max(share, sum[c] / emitted[c]);
    return share;
}

// Refuses a patch whose albedo times row sum is 1 or more, because the radiosity could
// be infinite.
inline void require_loss(const FormFactors& factors,
                         const std::vector<Patch>& patches) {
    double most = 0;
    for (std::size_t i = 0; i < patches.size(); ++i)
        most = std::max(most, max_component(patches[i].albedo) * factors.row_sum(i));
    require(most < 1 - 1e-12, "the largest fraction of its light that a patch regains",
            most, "below 1: take smaller albedos, more rays, or `closed` factors");
}

} // namespace detail

/// Shoots the unshot light of patch i to all others. The solvers gauss_seidel and
/// shooting repeat this step in different orders. Element i of `solution`, the
/// radiosity in W/m^2, grows by the shot light. Element i of `unsent`, the unshot light
/// in W/m^2, becomes 0; the others grow by the light that their patches reflect.
/// \cost n multiplications per channel, for n patches.
// [relax]
inline void relax_patch(const FormFactors& factors, const std::vector<Patch>& patches,
                        std::size_t i, std::vector<RgbT<double>>& solution,
                        std::vector<RgbT<double>>& unsent) {
    // A concave patch shoots light to itself. The sum is a geometric series.
    const RgbT<double> sent = unsent[i] / (1.0 - factors(i, i) * patches[i].albedo);
    solution[i] += sent;
    const auto row = factors.row(i);
    for (std::size_t j = 0; j < unsent.size(); ++j)
        unsent[j] += row[j] / factors.area[j] * patches[j].albedo * sent;
    unsent[i] = RgbT<double>(0);
}
// [relax]

/// The index of the patch with the most unshot flux; the first if several have the
/// most. `unsent` is the unshot light of each patch, in W/m^2.
[[nodiscard]] inline std::size_t
brightest_patch(const FormFactors& factors, const std::vector<RgbT<double>>& unsent) {
    std::size_t best = 0;
    double most = -1;
    for (std::size_t i = 0; i < unsent.size(); ++i) {
        const double waits =
            factors.area[i] * (unsent[i].x + unsent[i].y + unsent[i].z);
        if (waits > most) best = i, most = waits;
    }
    return best;
}

/// Solves the equations of radiosity.
///
/// All solvers except `lu` start with a radiosity of 0 and with all emitted light
/// unshot. A sweep of jacobi or gauss_seidel multiplies the unshot light by at most the
/// largest albedo rho, so that log(epsilon)/log(rho) sweeps are enough for a tolerance
/// epsilon.
/// \return The radiosity, and the unshot flux after each sweep.
/// \throws std::invalid_argument  if a setting is out of range, or if the albedo of a
///         patch times its row sum is not below 1. This happens for an albedo of 1 in a
///         closed room, or if the noise of rays makes a row sum larger than 1.
/// \cost For n patches, n^2 multiplications per sweep and channel; n^3/3 for `lu`.
/// \report{Section 2.2}
[[nodiscard]] inline RadiositySolution
solve_radiosity(const FormFactors& factors, const std::vector<Patch>& patches,
                const SolveSettings& settings = {}) {
    require(settings.tolerance >= 0, "tolerance", settings.tolerance, "at least 0");
    require_at_least("max_sweeps", settings.max_sweeps, 0);
    detail::require_loss(factors, patches);
    const std::size_t n = patches.size();
    RadiositySolution solution{.radiosity = std::vector<RgbT<double>>(n)};
    std::vector<RgbT<double>> unsent(n);
    RgbT<double> flux(0);
    for (std::size_t i = 0; i < n; ++i) {
        unsent[i] = patches[i].emitted;
        flux += factors.area[i] * unsent[i];
    }
    const auto keep_residual = [&] {
        solution.residual.push_back(detail::unshot_fraction(factors, unsent, flux));
    };
    if (settings.solver == RadiositySolver::lu) {
        solution.radiosity = detail::solve_lu(factors, patches);
        const auto irradiance =
            detail::multiply(factors, solution.radiosity, settings.threads);
        for (std::size_t i = 0; i < n; ++i)
            unsent[i] += patches[i].albedo * irradiance[i] - solution.radiosity[i];
        keep_residual();
        return solution;
    }
    const auto sweep = [&] {
        if (settings.solver == RadiositySolver::jacobi) {
            const auto arrives = detail::multiply(factors, unsent, settings.threads);
            for (std::size_t i = 0; i < n; ++i) {
                solution.radiosity[i] += unsent[i];
                unsent[i] = patches[i].albedo * arrives[i];
            }
            return;
        }
        const bool shoot = settings.solver == RadiositySolver::shooting;
        for (std::size_t step = 0; step < n; ++step)
            relax_patch(factors, patches,
                        shoot ? brightest_patch(factors, unsent) : step,
                        solution.radiosity, unsent);
    };
    keep_residual();
    for (int sweeps = 0; solution.residual.back() > settings.tolerance; ++sweeps) {
        if (sweeps == settings.max_sweeps) {
            solution.converged = false;
            break;
        }
        sweep();
        keep_residual();
    }
    return solution;
}

/// \}

} // namespace ljus
