#pragma once

/// \file ljus/accel/few_shapes.hpp
/// \brief A few shapes without a tree: eight of them asked at once.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <tuple>
#include <vector>

#include "ljus/geometry/detail/shape_lanes.hpp"

namespace ljus {

/// \defgroup few_shapes A few shapes
/// \brief In a room of a dozen walls and balls a tree leaves out little, and its boxes
/// let through what the shapes would not. Chapter: \ref ch_bvh.
///
/// Here the shapes themselves are asked, eight at a time and in float: which of them
/// may a ray meet, and from which t on? The answer errs on one side only. Each bound of
/// rounding is one for any order of the sums, with and without fused products; what
/// passes is asked once more, by the shape's own intersect().
/// \{

/// Up to 32 quads, triangles and spheres. closest() and any() ask as those of a tree
/// do, but by the numbers that add() was given: each shape that a ray may meet, and few
/// that it does not.
class FewShapes {
public:
    static constexpr std::size_t most = 32; ///< The most shapes that it holds.

    /// Adds a shape.
    /// \param quad    The shape; one without an area is never asked.
    /// \param number  What closest() and any() call it.
    /// \return False, and then the whole is of no use, if there is no room, or if the
    ///         shape is so large, small or thin that no bound of rounding holds.
    [[nodiscard]] bool add(const Quad& quad, std::uint32_t number) {
        if (!detail::has_area(quad)) return true;
        return put(flats_, flat_numbers_, detail::no_flats(), number,
                   glm::dvec3(quad.corner), glm::dvec3(quad.edge_u),
                   glm::dvec3(quad.edge_v), 0.0f);
    }
    /// As add() for a quad.
    [[nodiscard]] bool add(const Triangle& triangle, std::uint32_t number) {
        if (!detail::has_area(triangle)) return true;
        const glm::dvec3 v1(triangle.v1);
        return put(flats_, flat_numbers_, detail::no_flats(), number, v1,
                   glm::dvec3(triangle.v2) - v1, glm::dvec3(triangle.v3) - v1, 1.0f);
    }
    /// As add() for a quad.
    [[nodiscard]] bool add(const Sphere& ball, std::uint32_t number) {
        return put(balls_, ball_numbers_, detail::no_balls(), number, ball);
    }

    /// Whether nothing was added.
    [[nodiscard]] bool empty() const noexcept {
        return flats_.empty() && balls_.empty();
    }

    /// Asks the shapes that a ray may meet, the nearer ones first: test(number, ray)
    /// may shorten the ray, as for BvhT::closest().
    template <typename Test>
    void closest(const Ray& whole, Test&& test) const {
        // Numbers from 0 on have the order of their bits: the nearest is the least.
        std::array<std::uint64_t, most> waiting;
        std::size_t count = 0;
        each(whole, [&](float entry, std::uint32_t number) {
            waiting[count++] =
                std::uint64_t{std::bit_cast<std::uint32_t>(entry)} << 32 | number;
            return false;
        });
        Ray ray = whole;
        for (; count > 0; --count) {
            const auto nearest =
                std::min_element(waiting.begin(), waiting.begin() + count);
            const auto entry =
                std::bit_cast<float>(static_cast<std::uint32_t>(*nearest >> 32));
            if (entry > ray.t_max) return;
            test(static_cast<std::uint32_t>(*nearest), ray);
            *nearest = waiting[count - 1];
        }
    }
    /// Whether test(number) says true for any of the shapes that a ray may meet.
    template <typename Test>
    [[nodiscard]] bool any(const Ray& ray, Test&& test) const {
        return each(ray, [&](float, std::uint32_t number) { return test(number); });
    }

private:
    // Calls found(entry, number) for what a ray may meet, until that says true; for a
    // ray of another size, or that is none, with every shape.
    template <typename Found>
    bool each(const Ray& ray, Found&& found) const {
        const Vec3 o = detail::sizes(ray.origin), d = detail::sizes(ray.direction);
        const detail::LaneRay r{
            .origin = ray.origin,
            .direction = ray.direction,
            .t_min = std::max(0.0f, ray.t_min), // no -0: its bits are large
            .t_max = ray.t_max,
            .reach = max_component(o),
            .length = max_component(d),
            .inverse_d = 1 / std::sqrt(glm::dot(d, d))};
        // By their sums, for these are NaN if one of them is.
        const bool holds = o.x + o.y + o.z < detail::largest_size &&
                           d.x + d.y + d.z < detail::largest_size &&
                           r.length > detail::least_length && ray.t_min >= 0;
        return each_of(flats_, flat_numbers_, holds, r, found) ||
               each_of(balls_, ball_numbers_, holds, r, found);
    }
    template <typename Block, typename Found>
    static bool each_of(const std::vector<Block>& blocks,
                        const std::vector<std::uint32_t>& numbers, bool holds,
                        const detail::LaneRay& r, Found& found) {
        if (!holds) {
            for (const std::uint32_t number : numbers)
                if (found(0.0f, number)) return true;
            return false;
        }
        for (std::size_t block = 0; block < blocks.size(); ++block) {
            detail::Lanes entry;
            std::uint32_t met = detail::may_meet(blocks[block], r, entry);
            for (; met != 0; met &= met - 1) {
                const auto lane = static_cast<std::size_t>(std::countr_zero(met));
                if (found(entry.lane[lane], numbers[8 * block + lane])) return true;
            }
        }
        return false;
    }

    // Puts a shape into the next lane, of a new block if the last one is full.
    template <typename Block, typename... Shape>
    bool put(std::vector<Block>& blocks, std::vector<std::uint32_t>& numbers,
             const Block& none, std::uint32_t number, const Shape&... shape) {
        if (flat_numbers_.size() + ball_numbers_.size() == most) return false;
        if (numbers.size() == 8 * blocks.size()) blocks.push_back(none);
        const std::size_t lane = numbers.size() % 8;
        numbers.push_back(number);
        return detail::set_lane(blocks.back(), lane, shape...);
    }

    std::vector<detail::FlatLanes> flats_;
    std::vector<detail::BallLanes> balls_;
    std::vector<std::uint32_t> flat_numbers_, ball_numbers_;
};

/// The shapes of a scene, if they are few.
/// \param lists  The scene's lists, one a type. Numbers go on from one to the next.
/// \return Empty if there are too many, or one of them has no place there.
template <typename... List>
[[nodiscard]] FewShapes make_few_shapes(const std::tuple<List...>& lists) {
    FewShapes few;
    bool fit = true;
    std::uint32_t number = 0;
    const auto add = [&](const auto& list) {
        for (const auto& shape : list) {
            if constexpr (requires { few.add(shape, number); })
                fit = fit && few.add(shape, number++);
            else
                fit = false;
        }
    };
    std::apply([&](const auto&... list) { (add(list), ...); }, lists);
    return fit ? few : FewShapes{};
}

/// \}

} // namespace ljus
