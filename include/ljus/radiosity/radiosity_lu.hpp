#pragma once

/// \file ljus/radiosity/radiosity_lu.hpp
/// \brief The linear equations of radiosity, solved by Gaussian elimination.

#include <vector>

#include "ljus/radiosity/form_factor_matrix.hpp"

namespace ljus {

/// \defgroup radiosity_lu Radiosity by elimination
/// \brief Section 2.2: "the radiosity of each patch is then given by solving the
/// equation system"; as Goral et al. did. Chapter: \ref ch_radiosity.
/// \{

namespace detail {

// Solves a x = b in place by elimination with row pivoting.
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

/// Solves by elimination: all channels at once if every patch is grey, otherwise one by
/// one.
/// \return Radiosity, W/m^2.
/// \cost Memory for n^2 numbers, n^3/3 multiplications: 10 s for 3000 patches.
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

} // namespace detail

/// \}

} // namespace ljus
