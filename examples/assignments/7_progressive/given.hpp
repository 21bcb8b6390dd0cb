#pragma once

/// \file given.hpp
/// \brief Given in assignment 7: light that lands on a floor, and an estimate of its
/// irradiance.

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

/// Returns the random point at which a photon lands on the floor; nothing if it misses
/// the floor.
using Landing = std::optional<Vec2> (*)(RandomStream& stream);

/// Light: the flux of all emitted photons, W, and a function that returns where one of
/// them lands.
struct Light {
    double flux = 1;
    Landing land = nullptr;
};

/// Light with irradiance 1 on the square [-1/2, 1/2]^2. A third of the photons miss it.
inline Light square_of_light() {
    return {1.5, [](RandomStream& stream) -> std::optional<Vec2> {
                const float x = 1.5f * next_1d(stream) - 0.5f;
                const float y = next_1d(stream) - 0.5f;
                if (x > 0.5f) return std::nullopt;
                return Vec2{x, y};
            }};
}

/// The light of a low sun that the inside of a cup of radius 1, a mirror, reflects onto
/// the floor. Light that meets the wall a second time is left out.
inline Light cup_of_light() {
    return {4, [](RandomStream& stream) -> std::optional<Vec2> {
                const float y = 2 * next_1d(stream) - 1, x = std::sqrt(1 - y * y);
                const float way = 2 * next_1d(stream); // from the wall to the floor
                const Vec2 at = Vec2{x, y} + way * Vec2{1 - 2 * x * x, -2 * x * y};
                if (dot(at, at) > 1) return std::nullopt;
                return at;
            }};
}

/// A photon on the floor.
struct Photon {
    Vec2 position{0};
    double flux = 0; ///< Flux, W.
};

/// The photons of one pass, in a k-d tree.
class PhotonMap {
public:
    explicit PhotonMap(std::vector<Photon> photons) : photons_(std::move(photons)) {
        std::vector<Vec3> places;
        for (const Photon& photon : photons_)
            places.emplace_back(photon.position.x, photon.position.y, 0.0f);
        tree_ = ljus::KdTreeT<float>(std::span<const Vec3>(places));
    }
    /// The irradiance at a point of the floor, W per unit of area, estimated from the
    /// photons within a radius as in assignment 5.
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

/// The irradiance at some points.
using Picture = std::vector<double>;

/// The data that are kept from pass to pass.
struct Progress {
    float alpha = 2.0f / 3; ///< How slowly the radius shrinks; with 1 it is constant.
    float radius = 1;       ///< Radius of the next pass.
    int passes = 0;         ///< Number of passes added so far.
    Picture mean{};         ///< Mean of these passes.
    Picture squares{};      ///< Sums of the squared differences to this mean.
};

} // namespace answer
