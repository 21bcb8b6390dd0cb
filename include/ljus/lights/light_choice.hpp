#pragma once

/// \file ljus/lights/light_choice.hpp
/// \brief One light of many, chosen in proportion to its power.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup light_choice Choosing a light
/// \brief Photons, and the path tracer's shadow rays, start at one light of all: a
/// bright one more often.
/// \{

/// The lights of a scene, by power.
struct LightChoice {
    std::vector<double> cumulative; ///< Sums of the powers up to each light, in W.
};

/// One chosen light.
template <std::floating_point T>
struct ChosenLightT {
    std::uint32_t light = 0; ///< Its number.
    T probability = T(0);    ///< Of choosing this one.
};

/// The sums that choose_light() needs; a light's power is the sum of its channels.
/// \param powers  The flux of each light, in W.
/// \return One sum per light.
template <std::floating_point T>
[[nodiscard]] LightChoice light_choice(const std::vector<RgbT<T>>& powers) {
    LightChoice choice{std::vector<double>(powers.size())};
    double sum = 0;
    for (std::size_t i = 0; i < powers.size(); ++i) {
        const RgbT<double> flux{powers[i]};
        choice.cumulative[i] = sum += flux.x + flux.y + flux.z;
    }
    return choice;
}

/// The probability with which choose_light() returns a light.
/// \param choice  Of the scene's lights.
/// \param light   Its number.
/// \return Its share of the power.
template <std::floating_point T>
[[nodiscard]] T probability_of(const LightChoice& choice,
                               std::uint32_t light) noexcept {
    const double before = light == 0 ? 0.0 : choice.cumulative[light - 1];
    return static_cast<T>((choice.cumulative[light] - before) /
                          choice.cumulative.back());
}

/// A light, with a probability in proportion to its power.
/// \param choice  Of the scene's lights; at least one.
/// \param u       In [0, 1).
/// \return Its number and the probability, which is never 0.
/// \cost A binary search.
template <std::floating_point T>
[[nodiscard]] ChosenLightT<T> choose_light(const LightChoice& choice, T u) noexcept {
    const double power = double(u) * choice.cumulative.back();
    const auto place =
        std::upper_bound(choice.cumulative.begin(), choice.cumulative.end() - 1, power);
    const auto light = static_cast<std::uint32_t>(place - choice.cumulative.begin());
    // Beside one 1e38 times as strong, a light's share may be too small for T, but the
    // light's flux is divided by it.
    return {light,
            std::max(probability_of<T>(choice, light), std::numeric_limits<T>::min())};
}

/// \}

} // namespace ljus
