#pragma once

/// \file plain_room.hpp
/// \brief The camera pass of the four-glass room, by a program that knows no other room.
///
/// It is the floor under the library's time for the same estimate: per matt surface one
/// shadow ray, the caustics within a fixed radius and one indirect ray; four surfaces per
/// path. It has two kinds of shape, computes in float only, files photons in cells, and
/// has no tree, no bounds of errors and no choices.

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <ljus/photons/photon_map.hpp>

namespace plain {

using ljus::Vec3;

inline constexpr float pi = 3.14159265f;

/// A permuted congruential generator.
struct Random {
    std::uint64_t state;
    float operator()() {
        state = state * 6364136223846793005u + 1442695040888963407u;
        const auto mixed = static_cast<std::uint32_t>(((state >> 18) ^ state) >> 27);
        const auto turn = static_cast<std::uint32_t>(state >> 59);
        return float(((mixed >> turn) | (mixed << (-turn & 31))) >> 8) * 0x1p-24f;
    }
};

/// A parallelogram, or the half of one: u = dot(to_u, p) - u0 grows along one edge, v
/// along the other, and u + v is at most `sum`.
struct Flat {
    Vec3 normal, to_u, to_v;
    float d, u0, v0, sum;
    Vec3 albedo;
};

/// A ball of glass; `mirror` is the reflected fraction, negative for Fresnel's.
struct Ball {
    Vec3 center;
    float radius, index, mirror;
    Vec3 absorption;
};

struct Photon {
    Vec3 position, flux, direction;
};

class Room {
public:
    static constexpr float radius = 0.05f; ///< Of the estimate.

    /// \param map  The library's caustic photons, so that both look up the same ones.
    explicit Room(const ljus::PhotonMap& map) {
        constexpr float xy[5][2] = {{0, 6}, {10, 6}, {13, 0}, {10, -6}, {0, -6}};
        const auto at = [&](int i, float z) { return Vec3{xy[i][0], xy[i][1], z}; };
        for (const float z : {-5.f, 5.f}) {
            add_flat(at(0, z), at(4, z), at(1, z), Vec3{1}, 2);
            add_flat(at(1, z), at(3, z), at(2, z), Vec3{1}, 1);
        }
        constexpr Vec3 walls[4] = {
            {0.05f, 1, 0.05f}, {0.05f, 0.05f, 1}, {1, 0.05f, 0.05f}, {1, 0.25f, 0.05f}};
        for (int i = 0; i < 4; ++i)
            add_flat(at(i, -5), at(i + 1, -5), at(i, 5), walls[i], 2);
        add_flat(lamp_corner, lamp_corner + Vec3{0, lamp_side, 0},
                 lamp_corner + Vec3{lamp_side, 0, 0}, Vec3{0}, 2);
        const Vec3 violet = -glm::log(Vec3{0.5f, 0.5f, 1}) / 1.15f;
        const Vec3 yellow = -glm::log(Vec3{1, 1, 0.2f}) / 1.15f;
        balls_ = {Ball{{6, -4, 1.75f}, 1.5f, 1.97f, -1, Vec3{0}},
                  Ball{{6, -3.5f, -3.5f}, 1.15f, 1, 0.6f / 1.6f, violet},
                  Ball{{8, 0.5f, -2.5f}, 1.5f, 1.6f, 0.5f / 1.5f, Vec3{0}},
                  Ball{{7, 4.5f, -3}, 1.15f, 1.7f, -1, yellow}};
        file(map);
    }

    /// The radiance of one camera path; `w` is a unit vector.
    [[nodiscard]] Vec3 radiance(Vec3 o, Vec3 w, Random& random) const {
        Vec3 sum{0}, throughput{1};
        bool met_matt = false;
        int from = none;
        for (int depth = 1;; ++depth) {
            const auto [t, object] = first_hit(o, w, from);
            if (object == none) return sum;
            o += t * w;
            from = object;
            if (object == lamp) {
                if (!met_matt && w.z > 0) sum += throughput * lamp_radiance;
                return sum;
            }
            if (object > lamp) {
                if (depth == 4) return sum;
                scatter(balls_[std::size_t(object - first_ball)], o, t, w, throughput,
                        random);
                continue;
            }
            const Flat& flat = flats_[std::size_t(object)];
            const Vec3 n = glm::dot(flat.normal, w) < 0 ? flat.normal : -flat.normal;
            throughput *= flat.albedo / pi;
            sum += throughput * (direct(o, n, object, random) + caustics(o, n));
            if (depth == 4) return sum;
            throughput *= pi; // cosine over pdf
            w = cosine_direction(n, random);
            met_matt = true;
        }
    }

private:
    // Objects: flat ones, the last of which is the lamp; then balls.
    static constexpr int none = -1, lamp = 8, first_ball = 9;
    static constexpr Vec3 lamp_corner{5, -1, 4.999f};
    static constexpr float lamp_side = 2, lamp_radiance = 30;

    struct Hit {
        float t;
        int object;
    };

    void add_flat(Vec3 corner, Vec3 a, Vec3 b, Vec3 color, float sum) {
        a -= corner;
        b -= corner;
        const Vec3 c = glm::cross(a, b), n = glm::normalize(c);
        const Vec3 u = glm::cross(b, c) / glm::dot(c, c);
        const Vec3 v = glm::cross(c, a) / glm::dot(c, c);
        flats_[flat_count_++] = {n,
                                 u,
                                 v,
                                 glm::dot(n, corner),
                                 glm::dot(u, corner),
                                 glm::dot(v, corner),
                                 sum,
                                 0.75f * color};
    }

    static bool meets(const Flat& flat, Vec3 o, Vec3 w, float most, float& t) {
        t = (flat.d - glm::dot(flat.normal, o)) / glm::dot(flat.normal, w);
        if (!(t > 0 && t < most)) return false;
        const Vec3 p = o + t * w;
        const float u = glm::dot(flat.to_u, p) - flat.u0;
        const float v = glm::dot(flat.to_v, p) - flat.v0;
        return u >= 0 && v >= 0 && u <= 1 && v <= 1 && u + v <= flat.sum;
    }

    // Where a line enters and leaves a ball, in this order.
    static bool meets(const Ball& ball, Vec3 o, Vec3 w, float& in, float& out) {
        const Vec3 to_center = ball.center - o;
        const float middle = glm::dot(to_center, w);
        const Vec3 across = to_center - middle * w;
        const float squared = ball.radius * ball.radius - glm::dot(across, across);
        if (squared < 0) return false;
        const float half = std::sqrt(squared);
        in = middle - half;
        out = middle + half;
        return true;
    }

    Hit first_hit(Vec3 o, Vec3 w, int from) const {
        Hit best{1e30f, none};
        float t = 0, in = 0, out = 0;
        for (int i = 0; i <= lamp; ++i)
            if (i != from && meets(flats_[std::size_t(i)], o, w, best.t, t))
                best = {t, i};
        for (int i = 0; i < 4; ++i) {
            if (!meets(balls_[std::size_t(i)], o, w, in, out)) continue;
            const bool on = from == first_ball + i;
            t = on || in <= 0 ? out : in;
            if (t > (on ? 1e-3f : 0.f) && t < best.t) best = {t, first_ball + i};
        }
        return best;
    }

    bool occluded(Vec3 o, Vec3 w, float most, int from) const {
        float t = 0, in = 0, out = 0;
        for (const Ball& ball : balls_)
            if (meets(ball, o, w, in, out) && out > 0 && in < most) return true;
        for (int i = 0; i < lamp; ++i)
            if (i != from && meets(flats_[std::size_t(i)], o, w, most, t)) return true;
        return false;
    }

    // Irradiance by one shadow ray.
    float direct(Vec3 o, Vec3 n, int from, Random& random) const {
        const Vec3 q =
            lamp_corner + Vec3{lamp_side * random(), lamp_side * random(), 0};
        const float distance2 = glm::dot(q - o, q - o), distance = std::sqrt(distance2);
        const Vec3 wi = (q - o) / distance;
        const float cosines = glm::dot(wi, n) * wi.z;
        if (!(glm::dot(wi, n) > 0 && wi.z > 0) || occluded(o, wi, distance, from))
            return 0;
        return lamp_radiance * lamp_side * lamp_side * cosines / distance2;
    }

    static Vec3 cosine_direction(Vec3 n, Random& random) {
        const float u = random(), phi = 2 * pi * random(), r = std::sqrt(u);
        const float sign = std::copysign(1.f, n.z), a = -1 / (sign + n.z);
        const float b = n.x * n.y * a;
        const Vec3 s{1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
        const Vec3 t{b, sign + n.y * n.y * a, -n.y};
        return r * std::cos(phi) * s + r * std::sin(phi) * t + std::sqrt(1 - u) * n;
    }

    static void scatter(const Ball& ball, Vec3 p, float t, Vec3& w, Vec3& throughput,
                        Random& random) {
        Vec3 n = (p - ball.center) / ball.radius;
        const bool inside = glm::dot(n, w) > 0;
        if (inside) {
            n = -n;
            throughput *= glm::exp(-ball.absorption * t);
        }
        const float cos_i = -glm::dot(n, w), eta = inside ? ball.index : 1 / ball.index;
        const float sin2 = eta * eta * (1 - cos_i * cos_i);
        const float cos_t = std::sqrt(std::fmax(0.f, 1 - sin2));
        float reflected = ball.mirror;
        if (sin2 >= 1) {
            reflected = 1;
        } else if (reflected < 0) {
            const float s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
            const float q = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
            reflected = (s * s + q * q) / 2;
        }
        w = random() < reflected ? w + 2 * cos_i * n
                                 : eta * w + (eta * cos_i - cos_t) * n;
    }

    // Cells as wide as the disc: a ball touches two of them along each axis.
    static constexpr float cell = 2 * radius;
    static constexpr Vec3 low{-0.2f, -6.2f, -5.2f};
    static constexpr int nx = 136, ny = 126, nz = 106;

    static std::size_t cell_of(Vec3 p) {
        const Vec3 q = (p - low) / cell;
        return std::size_t((int(q.z) * ny + int(q.y)) * nx + int(q.x));
    }

    void file(const ljus::PhotonMap& map) {
        begins_.assign(std::size_t(nx * ny * nz) + 1, 0);
        for (std::size_t i = 0; i < map.records.size(); ++i)
            ++begins_[cell_of(map.tree.point(i)) + 1];
        for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
        photons_.resize(map.records.size());
        std::vector<std::uint32_t> next = begins_;
        for (std::size_t i = 0; i < map.records.size(); ++i) {
            const Vec3 p = map.tree.point(i);
            photons_[next[cell_of(p)]++] = {p, map.records[i].flux,
                                            map.records[i].direction};
        }
    }

    // Irradiance by Epanechnikov's kernel.
    Vec3 caustics(Vec3 p, Vec3 n) const {
        const Vec3 q = (p - low) / cell - 0.5f;
        const int x = int(q.x), y = int(q.y), z = int(q.z);
        Vec3 sum{0};
        for (int k = z; k < z + 2; ++k)
            for (int j = y; j < y + 2; ++j) {
                const auto row = std::size_t((k * ny + j) * nx + x);
                for (std::uint32_t i = begins_[row]; i < begins_[row + 2]; ++i) {
                    const Vec3 d = photons_[i].position - p;
                    const float d2 = glm::dot(d, d);
                    if (d2 < radius * radius &&
                        glm::dot(photons_[i].direction, n) < 0 &&
                        std::abs(glm::dot(d, n)) < radius / 2)
                        sum += (2 - 2 * d2 / (radius * radius)) * photons_[i].flux;
                }
            }
        return sum / (pi * radius * radius);
    }

    std::array<Flat, 9> flats_{};
    std::size_t flat_count_ = 0;
    std::array<Ball, 4> balls_{};
    std::vector<std::uint32_t> begins_{};
    std::vector<Photon> photons_{};
};

} // namespace plain
