#pragma once

/// \file ljus/radiosity/radiosity_solve.hpp
/// \brief The linear equations of radiosity, solved in four ways.

#include <vector>

#include "ljus/radiosity/radiosity_lu.hpp"

namespace ljus {

/// \defgroup radiosity_solve The equations of radiosity
/// \brief Section 2.2: "the radiosity of each patch is then given by solving the
/// equation system". Chapter: \ref ch_radiosity.
///
/// \f[ B_i = E_i + \rho_i \sum_j F_{ij} B_j \f]
/// \{

/// How the equations are solved.
enum class RadiositySolver : std::uint8_t {
    lu,           ///< Elimination: exact, in n^3/3 steps \cite goral1984.
    jacobi,       ///< All patches at once from the values before: one bounce of light.
    gauss_seidel, ///< One patch after the other, from the newest values.
    shooting,     ///< The patch with the most flux to send first \cite cohen1988.
};

/// How far it goes.
struct SolveSettings {
    RadiositySolver solver = RadiositySolver::shooting; ///< Which way.
    double tolerance = 1e-12; ///< Flux not yet sent on, as a share of what is emitted.
    int max_sweeps = 10000;   ///< As many steps as there are patches are a sweep.
    int threads = 0;          ///< For jacobi; 0: all that there are.
};

/// The radiosity of all patches.
struct RadiositySolution {
    std::vector<RgbT<double>> radiosity{}; ///< B, in W/m^2: emitted and reflected.
    std::vector<double> residual{};        ///< Flux not yet sent on, sweep by sweep.
    bool converged = true;                 ///< Whether the tolerance was reached.
};

namespace detail {

/// The irradiance of all patches.
/// \param factors    The form factors.
/// \param radiosity  Of each patch, W/m^2.
/// \param threads    As in ParallelSettings.
/// \return \f$ H_i = \sum_j F_{ij} B_j \f$, in W/m^2.
/// \cost n^2 multiplications for each channel.
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

// The flux of a residual as a share of the emitted flux, in the channel where it is
// the largest.
[[nodiscard]] inline double unsent_share(const FormFactors& factors,
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

// Refuses patches of which one gets all its light back: its radiosity has no end.
inline void require_loss(const FormFactors& factors,
                         const std::vector<Patch>& patches) {
    double most = 0;
    for (std::size_t i = 0; i < patches.size(); ++i)
        most = std::max(most, max_component(patches[i].albedo) * factors.row_sum(i));
    require(most < 1 - 1e-12, "the largest share of its light that a patch gets back",
            most, "below 1: take smaller albedos, more rays, or `closed` factors");
}

/// Sends the waiting light of all patches at once: one bounce.
/// \param factors  The form factors.
/// \param patches  Albedo.
/// \param threads  As in ParallelSettings.
/// \param solution The radiosity grows by what is sent.
/// \param unsent   Radiosity that waits on each patch: what the others have sent.
/// \cost n^2 multiplications for each channel.
inline void relax_all(const FormFactors& factors, const std::vector<Patch>& patches,
                      int threads, std::vector<RgbT<double>>& solution,
                      std::vector<RgbT<double>>& unsent) {
    for (std::size_t i = 0; i < unsent.size(); ++i) solution[i] += unsent[i];
    const auto arrives = multiply(factors, unsent, threads);
    for (std::size_t i = 0; i < unsent.size(); ++i)
        unsent[i] = patches[i].albedo * arrives[i];
}

} // namespace detail

/// Sends the waiting light of one patch to all others. Gauss-Seidel and shooting are
/// this step, in different orders.
/// \param factors  The form factors.
/// \param patches  Albedo.
/// \param i        The patch.
/// \param solution Its radiosity grows by what it sends.
/// \param unsent   Radiosity that waits on each patch: of this one it becomes 0.
/// \cost n multiplications for each channel.
// [relax]
inline void relax_patch(const FormFactors& factors, const std::vector<Patch>& patches,
                        std::size_t i, std::vector<RgbT<double>>& solution,
                        std::vector<RgbT<double>>& unsent) {
    // A hollow patch sends some of it to itself: a geometric series.
    const RgbT<double> sent = unsent[i] / (1.0 - factors(i, i) * patches[i].albedo);
    solution[i] += sent;
    const auto row = factors.row(i);
    for (std::size_t j = 0; j < unsent.size(); ++j)
        unsent[j] += row[j] / factors.area[j] * patches[j].albedo * sent;
    unsent[i] = RgbT<double>(0);
}
// [relax]

/// The patch with the most flux to send: Southwell's choice.
/// \param factors  The form factors.
/// \param unsent   Radiosity that waits on each patch.
/// \return Its number; the first one of equals.
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
/// All ways but `lu` begin in the dark: B = 0, and all light waits to be sent. What
/// waits falls, in a sweep of jacobi or gauss_seidel, at least by the largest albedo,
/// so that \f$ \log\varepsilon / \log\rho_{max} \f$ sweeps are enough.
/// \param factors   The form factors.
/// \param patches   Albedo and emission.
/// \param settings  Which way, and how far.
/// \return The radiosity, and what was left after each sweep.
/// \throws std::invalid_argument  if a patch sends back as much as it gets, or more: an
///         albedo of 1 in a closed room, or a row sum above 1 by the noise of few rays.
/// \cost n^2 multiplications per sweep and channel.
/// \report{Section 2.2}
[[nodiscard]] inline RadiositySolution
solve_radiosity(const FormFactors& factors, const std::vector<Patch>& patches,
                const SolveSettings& settings = {}) {
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
        solution.residual.push_back(detail::unsent_share(factors, unsent, flux));
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
        if (settings.solver == RadiositySolver::jacobi)
            return detail::relax_all(factors, patches, settings.threads,
                                     solution.radiosity, unsent);
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
