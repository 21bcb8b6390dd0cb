#pragma once

/// \file ljus/photons/detail/aim_by_share.hpp
/// \brief Photons that are aimed at objects with given shares.

#include <cmath>
#include <span>

#include "ljus/photons/aiming.hpp"

namespace ljus::detail {

/// Refuses numbers that are no shares of a whole.
/// \param shares   A number for each target, or none at all.
/// \param targets  How many.
/// \throws std::invalid_argument  with the number that is wrong.
inline void check_shares(std::span<const double> shares, std::size_t targets) {
    if (shares.empty()) return;
    require(shares.size() == targets, "the number of shares",
            static_cast<long long>(shares.size()),
            "that of the objects that mirror or refract");
    double sum = 0;
    for (const double share : shares) {
        require(share >= 0 && share <= 1, "a share of the photons", share,
                "within [0, 1]");
        sum += share;
    }
    require(std::abs(sum - 1) < 1e-6, "the sum of all shares", sum, "1");
}

/// A photon aimed at one of several objects, each chosen with its share; its flux is
/// divided by that share, so that any shares above 0 give the same mean.
/// \param scene    The scene.
/// \param choice   Of the scene's lights.
/// \param targets  The objects.
/// \param shares   As check_shares() lets pass; none: aim().
/// \param stream   One number more is drawn than by aim().
/// \return As aim().
// [aim_by_share]
template <SceneLike S, typename Stream>
[[nodiscard]] std::optional<AimedPhotonT<typename S::Scalar>>
aim_by_share(const S& scene, const LightChoice& choice,
             std::span<const ObjectId> targets, std::span<const double> shares,
             Stream& stream) {
    using T = typename S::Scalar;
    if (shares.empty()) return aim(scene, choice, targets, stream);
    double left = double(next_1d<T>(stream));
    std::size_t chosen = 0;
    for (std::size_t k = 0; k < shares.size(); ++k) {
        if (!(shares[k] > 0)) continue; // not even if rounding leaves something over
        chosen = k;
        if (left < shares[k]) break;
        left -= shares[k];
    }
    auto aimed = aim(scene, choice, targets.subspan(chosen, 1), stream);
    if (aimed) aimed->photon.flux /= static_cast<T>(shares[chosen]);
    return aimed;
}
// [aim_by_share]

} // namespace ljus::detail
