#pragma once

/// \file ljus/geometry/detail/polygon.hpp
/// \brief Triangulation of a polygon.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/common.hpp>

#include "ljus/math/vector.hpp"

namespace ljus::detail {

// The triangles of a polygon, as three indices of corners each.
struct CutPolygon {
    std::vector<std::array<std::uint32_t, 3>> triangles{};
    bool crossed = false; // the polygon crosses itself, so its triangles overlap
};

// The corners of a polygon along two axes across its area vector, and boxes of a few
// that follow each other. Most boxes lie outside an ear, and their corners with them.
class FlatCorners {
public:
    static constexpr std::uint32_t group = 16; // corners in a box
    // Those of an ear: x u + y v + w is at least 0 within it, and wherever rounding
    // could put a corner into it.
    struct Sides {
        std::array<double, 3> u, v, w;
    };

    FlatCorners(std::span<const glm::dvec3> corners, const glm::dvec3& across) {
        const glm::dvec3 normal = across / max_component(glm::abs(across));
        const glm::dvec3 axis = std::abs(normal.x) < 0.5   ? glm::dvec3(1, 0, 0)
                                : std::abs(normal.y) < 0.5 ? glm::dvec3(0, 1, 0)
                                                           : glm::dvec3(0, 0, 1);
        const glm::dvec3 right = glm::normalize(glm::cross(axis, normal));
        const glm::dvec3 up = glm::normalize(glm::cross(normal, right));
        double most = 0;
        for (const glm::dvec3& corner : corners) {
            const glm::dvec3 from_first = corner - corners[0];
            const glm::dvec2 at(glm::dot(from_first, right), glm::dot(from_first, up));
            most = std::max(most, glm::dot(from_first, from_first));
            if (flat_.size() % group == 0) boxes_.push_back({at, at});
            boxes_.back().low = glm::min(boxes_.back().low, at);
            boxes_.back().high = glm::max(boxes_.back().high, at);
            flat_.push_back(at);
        }
        rounding_ = 1e-12 * most;
    }
    [[nodiscard]] Sides sides_of(const std::array<std::uint32_t, 3>& ear) const {
        Sides sides{};
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec2 from = flat_[ear[k]], to = flat_[ear[(k + 1) % 3]];
            sides.u[k] = from.y - to.y;
            sides.v[k] = to.x - from.x;
            sides.w[k] = rounding_ - (sides.u[k] * from.x + sides.v[k] * from.y);
        }
        return sides;
    }
    // Whether the box of the group that begins with a corner is outside one side.
    [[nodiscard]] bool outside(const Sides& sides, std::uint32_t first) const {
        const auto& [low, high] = boxes_[first / group];
        for (std::size_t k = 0; k < 3; ++k)
            if (sides.u[k] * (sides.u[k] > 0 ? high.x : low.x) +
                    sides.v[k] * (sides.v[k] > 0 ? high.y : low.y) + sides.w[k] <
                0)
                return true;
        return false;
    }

private:
    struct Box {
        glm::dvec2 low, high;
    };
    std::vector<glm::dvec2> flat_;
    std::vector<Box> boxes_;
    double rounding_ = 0; // of twice the area of three corners
};

// Triangulates a polygon by cutting off ears: corners whose triangle contains no other
// corner \cite meisters1975. A polygon that is not flat is projected along its area
// vector. A polygon that crosses itself is cut arbitrarily, and `crossed` is set.
//
// The corners are given counter-clockwise; n of them give n - 2 triangles. Fewer than
// three corners, or no area, give none. Corners may coincide, as where a bridge
// connects a hole. The cost is O(n^2), because cutting an ear only affects its two
// neighbours.
[[nodiscard]] inline CutPolygon cut_polygon(std::span<const glm::dvec3> corners) {
    CutPolygon result;
    auto& triangles = result.triangles;
    const auto count = static_cast<std::uint32_t>(corners.size());
    constexpr std::uint32_t gone = 0xffffffffu; // in `after`, of a corner cut off
    if (count < 3) return result;
    glm::dvec3 across(0);
    for (std::uint32_t i = 1; i + 1 < count; ++i)
        across += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    if (!(glm::dot(across, across) > 0)) return result;
    if (count == 3) return {.triangles = {{0, 1, 2}}};

    // Twice the signed area of three corners, as seen along `across`.
    const auto turn = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        return glm::dot(across,
                        glm::cross(corners[b] - corners[a], corners[c] - corners[a]));
    };
    std::vector<std::uint32_t> left(count), before(count), after(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        left[i] = i;
        before[i] = (i + count - 1) % count;
        after[i] = (i + 1) % count;
    }
    const bool many = count > 2 * FlatCorners::group;
    const FlatCorners flat(many ? corners : std::span<const glm::dvec3>(), across);
    const auto is_ear = [&](std::uint32_t corner) {
        const std::array<std::uint32_t, 3> ear{before[corner], corner, after[corner]};
        const auto [a, b, c] = ear;
        if (!(turn(a, b, c) > 0)) return false;
        const auto sides = many ? flat.sides_of(ear) : FlatCorners::Sides{};
        for (std::uint32_t p = 0; p < count; ++p) {
            if (many && p % FlatCorners::group == 0 && flat.outside(sides, p)) {
                p += FlatCorners::group - 1;
                continue;
            }
            if (after[p] == gone) continue;
            if (corners[p] == corners[a] || corners[p] == corners[b] ||
                corners[p] == corners[c])
                continue; // it shares a corner of a bridge; its edges are not within
            if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0)
                return false;
        }
        return true;
    };
    std::vector<char> ears(count); // of the corners in `left`
    for (std::uint32_t i = 0; i < count; ++i) ears[i] = is_ear(i) ? 1 : 0;
    while (left.size() > 3) {
        const std::size_t n = left.size();
        // The first one from 1 on; if there is none, the polygon crosses itself.
        const auto found = std::find(ears.begin() + 1, ears.end(), 1);
        const auto ear = found != ears.end() ? std::size_t(found - ears.begin())
                                             : std::size_t(ears[0] == 0 ? 1 : 0);
        const std::uint32_t corner = left[ear];
        triangles.push_back({before[corner], corner, after[corner]});
        after[before[corner]] = after[corner];
        before[after[corner]] = before[corner];
        after[corner] = gone;
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
        ears.erase(ears.begin() + static_cast<std::ptrdiff_t>(ear));
        for (const std::size_t beside : {(ear + n - 2) % (n - 1), ear % (n - 1)})
            ears[beside] = is_ear(left[beside]) ? 1 : 0;
    }
    triangles.push_back({left[0], left[1], left[2]});
    // The areas add up to that of the polygon; those of flipped triangles are negative.
    const double most = 1e-9 * glm::dot(across, across);
    for (const auto& [a, b, c] : triangles)
        result.crossed = result.crossed || turn(a, b, c) < -most;
    return result;
}

} // namespace ljus::detail
