#pragma once

/// \file gather_rays.hpp
/// \brief What the live figures of chapters 30 and 31 share: gather rays from the floor
/// of Flatland, and numbers for the page.

#include <utility>
#include <vector>

#include "flatland/scene.hpp"

namespace live {

/// A ray from a place of the floor, in proportion to the cosine if u is uniform.
inline flatland::Ray gather_ray(double x, double u) {
    return {.origin{x, 0}, .direction = flatland::sample_cosine_half_circle(u)};
}

/// Where the page finds numbers until the next call.
inline const double* for_page(std::vector<double> numbers) {
    static std::vector<double> kept;
    kept = std::move(numbers);
    return kept.data();
}

/// The same for f(0), f(1), ...
template <class F>
const double* for_page(int count, F f) {
    std::vector<double> numbers;
    for (int i = 0; i < count; ++i) numbers.push_back(f(i));
    return for_page(std::move(numbers));
}

} // namespace live
