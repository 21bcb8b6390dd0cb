#pragma once

/// \file given.hpp
/// \brief Given in assignment 5: a photon, and a map that finds photons around a point.

#include <span>
#include <utility>
#include <vector>

#include "course/room.hpp"
#include "ljus/accel/kd_tree.hpp"

namespace answer {

using course::Object, course::Room, course::Surface;
using ljus::Ray, ljus::Rgb, ljus::SurfacePoint, ljus::Vec3;

/// A photon where it has met a surface.
struct Photon {
    Vec3 position{0};
    Vec3 direction{0}; ///< Direction of travel, of length 1.
    Rgb flux{0};       ///< Flux, W.
};

/// A photon on its way: its ray, and its flux in W.
struct Flight {
    Ray ray{};
    Rgb flux{0};
};

/// Photons in a k-d tree.
class PhotonMap {
public:
    explicit PhotonMap(std::vector<Photon> photons) : photons_(std::move(photons)) {
        std::vector<Vec3> places;
        for (const Photon& photon : photons_) places.push_back(photon.position);
        tree_ = ljus::KdTreeT<float>(std::span<const Vec3>(places));
    }
    /// Calls visit(photon, distance2) for each photon within a ball.
    template <typename Visit>
    void visit_within(const Vec3& center, float radius, Visit&& visit) const {
        tree_.visit_within(center, radius, [&](std::uint32_t i, double distance2) {
            visit(photons_[tree_.point_ids()[i]], float(distance2));
        });
    }

private:
    std::vector<Photon> photons_;
    ljus::KdTreeT<float> tree_;
};

} // namespace answer
