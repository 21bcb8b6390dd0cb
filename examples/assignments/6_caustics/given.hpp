#pragma once

/// \file given.hpp
/// \brief Given in assignment 6: photons, and the k-d tree of assignment 5.

#include <span>
#include <utility>
#include <vector>

#include "course/room.hpp"
#include "ljus/accel/kd_tree.hpp"

namespace answer {

using course::Kind, course::Object, course::PointLamp, course::Room, course::Surface;
using ljus::Ray, ljus::Rgb, ljus::Sphere, ljus::Vec2, ljus::Vec3;

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

/// A photon map that estimates the radiance of a diffuse surface, as in assignment 5.
class PhotonMap {
public:
    explicit PhotonMap(std::vector<Photon> photons) : photons_(std::move(photons)) {
        std::vector<Vec3> places;
        for (const Photon& photon : photons_) places.push_back(photon.position);
        tree_ = ljus::KdTreeT<float>(std::span<const Vec3>(places));
    }
    Rgb estimate(const Surface& surface, const Ray& ray, float radius) const {
        const Vec3 n = course::facing(surface.point.normal, ray.direction);
        Rgb sum{0};
        const auto add = [&](std::uint32_t i, double distance2) {
            const Photon& photon = photons_[tree_.point_ids()[i]];
            const float height = dot(photon.position - surface.point.position, n);
            if (dot(photon.direction, n) < 0 && 2 * height < radius &&
                -2 * height < radius)
                sum += 2 * (1 - float(distance2) / (radius * radius)) * photon.flux;
        };
        tree_.visit_within(surface.point.position, radius, add);
        constexpr float pi = 3.14159265f;
        return surface.object->matter.color * sum / (pi * pi * radius * radius);
    }

private:
    std::vector<Photon> photons_;
    ljus::KdTreeT<float> tree_;
};

} // namespace answer
