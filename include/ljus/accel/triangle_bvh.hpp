#pragma once

/// \file ljus/accel/triangle_bvh.hpp
/// \brief A wide tree over triangles, which tests eight triangles together.

#include "ljus/accel/bvh8.hpp"
#include "ljus/geometry/triangle.hpp"

namespace ljus {

/// \defgroup triangle_bvh Trees of triangles
/// \brief A wide tree over the triangles of a mesh. Chapter: \ref ch_bvh.
/// \{

namespace detail {

/// Up to eight triangles, stored coordinate by coordinate.
struct alignas(64) TriangleLanes {
    Lanes3 v1{}; ///< The first corners of the triangles.
    Lanes3 v2{}; ///< The second corners of the triangles.
    Lanes3 v3{}; ///< The third corners of the triangles.
    /// The largest absolute component of the edges from v1 to v2 and from v1 to v3;
    /// negative in an unused lane.
    Lanes size{};
};

/// The result of the conservative filter for eight triangles: two sets of triangles, in
/// the form of yes_lanes().
struct FilteredTriangles {
    std::uint64_t possible = 0; ///< The triangles that the ray may hit.
    std::uint64_t definite = 0; ///< The triangles that the ray certainly hits.
};

/// A conservative filter for eight triangles. It computes the test of Moeller and
/// Trumbore \cite moller1997 in float, without the division, and bounds the rounding
/// error of each number. If the error could change a sign, the triangle is possible but
/// not definite.
/// \cost Some 90 operations for all eight together.
// [conservative_filter]
template <typename Caller>
[[nodiscard]] inline FilteredTriangles conservative_filter(const TriangleLanes& block,
                                                           const Bvh8Ray& ready,
                                                           const Ray& ray) noexcept {
    constexpr float min = std::numeric_limits<float>::min();
    // Each number is a sum of six products with at most 8 roundings.
    constexpr float rounding = 64 * std::numeric_limits<float>::epsilon() / 2;
    const float across = rounding * ready.length;
    const Vec3 o = ray.origin, d = ray.direction;
    const float t_min = ray.t_min;
    const float t_max = ray.t_max < ready.last ? ray.t_max : ready.last;
    const auto size_of = [](float x) { return x < 0 ? -x : x; };
    LaneMask possible, definite;
    for (int i = 0; i < lane_count; ++i) {
        const float x = block.v1.x[i], y = block.v1.y[i];
        const float z = block.v1.z[i];
        const float e1x = block.v2.x[i] - x, e2x = block.v3.x[i] - x;
        const float e1y = block.v2.y[i] - y, e2y = block.v3.y[i] - y;
        const float e1z = block.v2.z[i] - z, e2z = block.v3.z[i] - z;
        const float tx = o.x - x, ty = o.y - y, tz = o.z - z;
        const float px = d.y * e2z - d.z * e2y;
        const float py = d.z * e2x - d.x * e2z;
        const float pz = d.x * e2y - d.y * e2x;
        const float qx = ty * e1z - tz * e1y;
        const float qy = tz * e1x - tx * e1z;
        const float qz = tx * e1y - ty * e1x;

        // All numbers are scaled by the absolute determinant.
        const float signed_area = px * e1x + py * e1y + pz * e1z;
        const float sign = signed_area < 0 ? -1.0f : 1.0f;
        const float area = sign * signed_area;
        const float u = sign * (px * tx + py * ty + pz * tz);
        const float v = sign * (qx * d.x + qy * d.y + qz * d.z);
        const float t = sign * (qx * e2x + qy * e2y + qz * e2z);
        const float w = area - u - v;
        const float before = t - t_min * area;
        const float behind = t_max * area - t;

        const float size = block.size.lane[i];
        const float scale = size * (size_of(tx) + size_of(ty) + size_of(tz) + size);
        const float wide = across * scale + min;
        const float deep = rounding * size * scale + min;
        const float near = deep + across * t_min * size * size;
        const float far = deep + across * t_max * size * size;
        // An overflow gives NaN, which makes the triangle possible but not definite. If
        // u or v is NaN, then w is NaN, and so is `inner`.
        const float uv = u < v ? u : v;
        const float inner = uv < w ? uv : w;
        const bool out =
            (inner < -wide) | (before < -near) | (behind < -far) | (size < 0);
        const bool in = (inner > wide) & (before > near) & (behind > far) & (size > 0);
        possible.lane[i] = out ? 0 : -1;
        definite.lane[i] = in ? -1 : 0;
    }
    return {yes_lanes(possible), yes_lanes(definite)};
}
// [conservative_filter]

} // namespace detail

/// A wide tree over triangles, with the searches and results of BvhT. It stores the
/// triangles in its own order, so that a test reads what the filter has loaded.
/// \cost About 55 bytes per triangle.
class TriangleBvh {
public:
    /// An empty tree.
    TriangleBvh() = default;

    /// Builds the tree.
    /// \param count     The number of triangles, below 2^26.
    /// \param triangle  Called as triangle(i); returns a Triangle.
    /// \param threads   The number of threads that build the tree; 0 for all
    ///                  processors.
    /// \throws std::invalid_argument  as the constructor of BvhT.
    template <typename TriangleOf>
    TriangleBvh(std::uint32_t count, TriangleOf&& triangle, int threads = 0) {
        std::vector<Box> boxes;
        boxes.reserve(count);
        for (std::uint32_t i = 0; i < count; ++i) boxes.push_back(bounds(triangle(i)));
        const BvhSettings settings{.leaf_size = detail::lane_count,
                                   .at_a_time = detail::lane_count,
                                   .threads = threads};
        tree_ = Bvh8(std::move(boxes), settings, detail::lane_count);
        detail::TriangleLanes empty;
        for (float& size : empty.size.lane) size = -1; // no triangle
        blocks_.resize(primitive_ids().size() / detail::lane_count, empty);
        for (std::size_t slot = 0; slot < primitive_ids().size(); ++slot)
            if (primitive_ids()[slot] != Bvh8::padding)
                put(blocks_[slot / detail::lane_count], slot % detail::lane_count,
                    triangle(primitive_ids()[slot]));
    }

    /// The index of the triangle at each slot, or Bvh8::padding.
    [[nodiscard]] const std::vector<std::uint32_t>& primitive_ids() const noexcept {
        return tree_.primitive_ids();
    }
    /// The triangle at a slot that is not padding.
    [[nodiscard]] Triangle triangle(std::uint32_t slot) const noexcept {
        const detail::TriangleLanes& block = blocks_[slot / detail::lane_count];
        const std::size_t lane = slot % detail::lane_count;
        return {block.v1[lane], block.v2[lane], block.v3[lane]};
    }
    /// The tree of boxes.
    [[nodiscard]] const Bvh8& tree() const noexcept { return tree_; }
    /// The box around all triangles.
    [[nodiscard]] const Box& box() const noexcept { return tree_.box(); }
    /// The size in bytes, including the triangles.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return tree_.bytes() + blocks_.capacity() * sizeof(detail::TriangleLanes);
    }

    /// See BvhT::closest(). Only triangles that pass the filter are tested.
    template <typename Test, typename Watch = NoTrace>
    void closest(Ray ray, Test&& test, Watch&& watch = {}) const {
        const auto ask = [&](std::uint32_t slot) {
            test(slot, ray);
            return false;
        };
        detail::walk<false>(tree_.wide(), ray, filtered_leaf<false>(ray, ask), watch);
    }

    /// See BvhT::any(). A triangle that is certainly hit ends the search without a
    /// test.
    template <typename Test, typename Watch = NoTrace>
    [[nodiscard]] bool any(const Ray& ray, Test&& test, Watch&& watch = {}) const {
        return detail::walk<true>(tree_.wide(), ray, filtered_leaf<true>(ray, test),
                                  watch);
    }

private:
    // A leaf function for detail::walk() that tests the triangles that pass the filter.
    template <bool definite_ends, typename Ask>
    auto filtered_leaf(const Ray& ray, Ask& ask) const {
        return [this, &ray, &ask](std::uint32_t first, std::uint32_t count,
                                  const detail::Bvh8Ray* ready) {
            if (ready == nullptr || !ready->moderate)
                return tree_.each_slot(ask)(first, count, ready);
            detail::FilteredTriangles found = detail::conservative_filter<Ask>(
                blocks_[first / detail::lane_count], *ready, ray);
            if (definite_ends && found.definite != 0) return true;
            while (found.possible != 0)
                if (ask(first +
                        static_cast<std::uint32_t>(detail::take_lane(found.possible))))
                    return true;
            return false;
        };
    }

    static void put(detail::TriangleLanes& block, std::size_t lane,
                    const Triangle& triangle) {
        const Vec3 e1 = triangle.v2 - triangle.v1;
        const Vec3 e2 = triangle.v3 - triangle.v1;
        block.v1.set(lane, triangle.v1);
        block.v2.set(lane, triangle.v2);
        block.v3.set(lane, triangle.v3);
        block.size.lane[lane] = max_component(glm::max(glm::abs(e1), glm::abs(e2)));
    }

    Bvh8 tree_;
    std::vector<detail::TriangleLanes> blocks_;
};

/// \}

} // namespace ljus
