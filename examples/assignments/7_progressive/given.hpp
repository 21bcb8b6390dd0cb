#pragma once

/// \file given.hpp
/// \brief Assignment 7, given: light that lands on a floor, and its estimate.

#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ljus/accel/kd_tree.hpp"
#include "ljus/math/random.hpp"
#include "ljus/math/vector.hpp"

namespace answer {

using ljus::RandomStream, ljus::next_1d; // uniform in [0, 1)
using ljus::Vec2, ljus::Vec3;

/// Where a photon lands on the floor, by chance; nowhere if it misses the floor.
using Landing = std::optional<Vec2> (*)(RandomStream& stream);

/// Light: the flux of all photons that are sent out, in W, and where one of them lands.
struct Light {
    double flux = 1;
    Landing land = nullptr;
};

/// The square [-1/2, 1/2]^2 with the irradiance 1. A third of the photons miss it.
inline Light square_of_light() {
    return {1.5, [](RandomStream& stream) -> std::optional<Vec2> {
                const float x = 1.5f * next_1d(stream) - 0.5f;
                const float y = next_1d(stream) - 0.5f;
                if (x > 0.5f) return std::nullopt;
                return Vec2{x, y};
            }};
}

/// Low sun in a cup of radius 1 whose inside is a mirror: what the wall reflects onto
/// the floor. What meets the wall a second time is left out.
inline Light cup_of_light() {
    return {4, [](RandomStream& stream) -> std::optional<Vec2> {
                const float y = 2 * next_1d(stream) - 1, x = std::sqrt(1 - y * y);
                const float way = 2 * next_1d(stream); // from the wall to the floor
                const Vec2 at = Vec2{x, y} + way * Vec2{1 - 2 * x * x, -2 * x * y};
                if (dot(at, at) > 1) return std::nullopt;
                return at;
            }};
}

/// A packet of flux on the floor.
struct Photon {
    Vec2 position{0};
    double flux = 0; ///< W
};

/// The photons of one pass in a k-d tree.
class PhotonMap {
public:
    explicit PhotonMap(std::vector<Photon> photons) : photons_(std::move(photons)) {
        std::vector<Vec3> places;
        for (const Photon& photon : photons_)
            places.emplace_back(photon.position.x, photon.position.y, 0.0f);
        tree_ = ljus::KdTreeT<float>(std::span<const Vec3>(places));
    }
    /// The irradiance at a point of the floor, in W per unit of area, from the photons
    /// within a radius: the estimate of assignment 5.
    double irradiance(const Vec2& point, float radius) const {
        double sum = 0;
        const double r2 = double(radius) * double(radius);
        const auto add = [&](std::uint32_t i, double distance2) {
            sum += 2 * (1 - distance2 / r2) * photons_[tree_.point_ids()[i]].flux;
        };
        tree_.visit_within(Vec3{point, 0}, radius, add);
        return sum / (3.14159265358979 * r2);
    }

private:
    std::vector<Photon> photons_;
    ljus::KdTreeT<float> tree_;
};

/// The irradiance at each of some points.
using Picture = std::vector<double>;

/// All that is kept between two passes.
struct Progress {
    float alpha = 2.0f / 3; ///< How fast the radius shrinks: 1 is not at all.
    float radius = 1;       ///< Of the next pass.
    int passes = 0;         ///< That have been added.
    Picture mean{};         ///< Of these passes.
    Picture squares{};      ///< The sum of the squared differences to this mean.
};

} // namespace answer
