#pragma once

/// \file ljus/geometry/bvh_build.hpp
/// \brief How a tree of boxes is built: by the surface area heuristic, in bins.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ljus/geometry/box.hpp"
#include "ljus/math/require.hpp"
#include "ljus/parallel.hpp"

namespace ljus {

/// \defgroup bvh_build Building trees of boxes
/// \brief Where to cut a crowd in two. Chapter: \ref ch_bvh.
/// \{

/// A node: its box, and either two children or some of the things themselves. 32 bytes
/// in float, so that two children share a cache line.
// [tree node]
template <std::floating_point T>
struct BvhNodeT {
    BoxT<T> box{};           ///< Around all that is below.
    std::uint32_t first = 0; ///< Its first child, the other follows; or first thing.
    std::uint32_t count = 0; ///< How many things; 0 for a node with children.
};
// [tree node]
static_assert(sizeof(BvhNodeT<float>) == 32);

/// A tree of boxes: nodes, the root first, and the order in which leaves have things.
template <std::floating_point T>
struct BvhNodesT {
    std::vector<BvhNodeT<T>> nodes{};   ///< Empty if there is nothing.
    std::vector<std::uint32_t> order{}; ///< order[place] is a thing's number.
};

/// How a tree is built.
struct BvhBuild {
    std::uint32_t leaf_size = 4; ///< No leaf has more, at least 1.
    std::uint32_t at_a_time = 1; ///< How many things one test asks, side by side.
    float node_cost = 1;         ///< Of a step down, in tests.
    int threads = 0;             ///< 0: all that there are.
};

/// The deepest that a tree may be; what a search keeps in mind is no more.
inline constexpr int bvh_depth = 64;

namespace detail {

// A box as a builder likes it: the lower sides, and the upper ones with their signs
// changed, so that to grow is eight times the same, which compilers do at once.
template <std::floating_point T>
struct SidesT {
    T side[8];

    static constexpr SidesT none() noexcept {
        SidesT result{};
        for (T& x : result.side) x = std::numeric_limits<T>::infinity();
        return result;
    }
    void grow(const SidesT& other) noexcept {
        for (int i = 0; i < 8; ++i)
            side[i] = side[i] < other.side[i] ? side[i] : other.side[i];
    }
    [[nodiscard]] T size(int axis) const noexcept {
        return -side[axis + 4] - side[axis];
    }
    [[nodiscard]] BoxT<T> box() const noexcept {
        return {{side[0], side[1], side[2]}, {-side[4], -side[5], -side[6]}};
    }
    // In double: the square of a float's largest size has room.
    [[nodiscard]] double half_area() const noexcept {
        const double x{size(0)}, y{size(1)}, z{size(2)};
        return x * y + y * z + z * x;
    }
};

// A thing on its way into the tree.
template <std::floating_point T>
struct CandidateT {
    SidesT<T> sides;
    std::uint32_t number;
    // Half of twice the centre: the sum of two large numbers would be infinite.
    [[nodiscard]] T center(int axis) const noexcept {
        return T(0.5) * sides.side[axis] - T(0.5) * sides.side[axis + 4];
    }
    [[nodiscard]] SidesT<T> centers() const noexcept {
        SidesT<T> result{};
        for (int i = 0; i < 4; ++i) {
            const T middle = T(0.5) * sides.side[i] - T(0.5) * sides.side[i + 4];
            result.side[i] = middle;
            result.side[i + 4] = -middle;
        }
        return result;
    }
};

template <std::floating_point T>
class BvhBuilder {
public:
    BvhBuilder(std::span<const BoxT<T>> boxes, const BvhBuild& settings)
        : settings_(settings) {
        things_.reserve(boxes.size());
        for (const BoxT<T>& box : boxes) {
            require_finite("a box's low corner", box.low);
            require_finite("a box's high corner", box.high);
            things_.push_back({{{box.low.x, box.low.y, box.low.z, T(0), -box.high.x,
                                 -box.high.y, -box.high.z, T(0)}},
                               static_cast<std::uint32_t>(things_.size())});
        }
    }

    [[nodiscard]] BvhNodesT<T> build() {
        BvhNodesT<T> tree;
        if (things_.empty()) return tree;
        Range all{.last = static_cast<std::uint32_t>(things_.size())};
        for (const CandidateT<T>& thing : things_) {
            all.sides.grow(thing.sides);
            all.centers.grow(thing.centers());
        }
        // The upper part by one thread; what lies below a node of `alone` things is
        // built on its own, and put behind it in order: the same for any threads.
        std::vector<Job> jobs;
        tree.nodes.reserve(things_.size());
        tree.nodes.push_back({all.sides.box(), 0, 0});
        grow(tree.nodes, 0, all, &jobs);
        std::vector<std::vector<BvhNodeT<T>>> parts(jobs.size());
        parallel_blocks(static_cast<long long>(jobs.size()),
                        [&](long long number) {
                            const auto i = static_cast<std::size_t>(number);
                            parts[i].push_back({jobs[i].range.sides.box(), 0, 0});
                            grow(parts[i], 0, jobs[i].range, nullptr);
                        },
                        {.threads = settings_.threads});
        for (std::size_t i = 0; i < jobs.size(); ++i)
            append(tree.nodes, jobs[i].node, parts[i]);
        tree.order.reserve(things_.size());
        for (const CandidateT<T>& thing : things_) tree.order.push_back(thing.number);
        return tree;
    }

private:
    static constexpr int bins = 16;
    static constexpr std::uint32_t alone = 4096;

    struct Range {
        std::uint32_t first = 0;
        std::uint32_t last = 0;
        int depth = 0;
        SidesT<T> sides = SidesT<T>::none();   // of the things
        SidesT<T> centers = SidesT<T>::none(); // of their centres
        [[nodiscard]] std::uint32_t size() const noexcept { return last - first; }
    };
    struct Job {
        std::size_t node;
        Range range;
    };
    struct Bin {
        SidesT<T> sides = SidesT<T>::none();
        std::uint32_t count = 0;
    };
    struct Cut {
        int axis = -1; // none
        int bin = 0;   // the first of the upper half
        double cost = std::numeric_limits<double>::infinity();
    };

    // From a centre to its bin.
    struct Scale {
        T low, factor;
        Scale(const Range& range, int axis) noexcept
            : low(range.centers.side[axis]),
              factor(T(bins) * (T(1) - std::numeric_limits<T>::epsilon() * 4) /
                     range.centers.size(axis)) {}
        // Written so that it is within the bins for any number.
        [[nodiscard]] int operator()(T center) const noexcept {
            const T place = (center - low) * factor;
            return place < T(bins) ? static_cast<int>(place) : bins - 1;
        }
    };

    [[nodiscard]] double tests(std::uint32_t count) const noexcept {
        return (count + settings_.at_a_time - 1) / settings_.at_a_time;
    }

    // The cut that makes the expected cost of a ray least \cite macdonald1990: a ray
    // that meets a box meets one within it with the ratio of their surfaces.
    // [best_cut]
    [[nodiscard]] Cut best_cut(const Range& range) const {
        Cut best;
        for (int axis = 0; axis < 3; ++axis) {
            const T size = range.centers.size(axis);
            if (!(size > std::numeric_limits<T>::min() &&
                  size < std::numeric_limits<T>::max()))
                continue; // all in one plane
            Bin all[bins];
            const Scale bin_of(range, axis);
            for (std::uint32_t i = range.first; i < range.last; ++i) {
                Bin& bin = all[bin_of(things_[i].center(axis))];
                bin.sides.grow(things_[i].sides);
                ++bin.count;
            }
            // Once from above, for the costs of the upper halves; once from below.
            double above[bins] = {};
            Bin upper, lower;
            for (int i = bins - 1; i > 0; --i) {
                upper.sides.grow(all[i].sides);
                upper.count += all[i].count;
                above[i] =
                    upper.count == 0 ? 0 : upper.sides.half_area() * tests(upper.count);
            }
            for (int i = 1; i < bins; ++i) {
                lower.sides.grow(all[i - 1].sides);
                lower.count += all[i - 1].count;
                if (lower.count == 0 || lower.count == range.size()) continue;
                const double cost =
                    lower.sides.half_area() * tests(lower.count) + above[i];
                if (cost < best.cost) best = {axis, i, cost};
            }
        }
        return best;
    }
    // [best_cut]

    // Sorts a range into its two halves.
    std::pair<Range, Range> divide(const Range& range, const Cut& cut) {
        Range low{.first = range.first, .last = range.first, .depth = range.depth + 1};
        Range high{.first = range.last, .last = range.last, .depth = range.depth + 1};
        const auto take = [](Range& half, const CandidateT<T>& thing) {
            half.sides.grow(thing.sides);
            half.centers.grow(thing.centers());
        };
        if (cut.axis < 0) { // by number
            low.last = high.first = range.first + range.size() / 2;
            for (std::uint32_t i = range.first; i < range.last; ++i)
                take(i < low.last ? low : high, things_[i]);
            return {low, high};
        }
        const Scale bin_of(range, cut.axis);
        while (low.last < high.first) {
            const CandidateT<T>& thing = things_[low.last];
            if (bin_of(thing.center(cut.axis)) < cut.bin) {
                take(low, thing);
                ++low.last;
            } else {
                take(high, thing);
                std::swap(things_[low.last], things_[--high.first]);
            }
        }
        return {low, high};
    }

    // [grow]
    void grow(std::vector<BvhNodeT<T>>& nodes, std::size_t node, const Range& range,
              std::vector<Job>* jobs) {
        if (jobs && range.size() <= alone) {
            jobs->push_back({node, range});
            return;
        }
        const std::uint32_t count = range.size();
        const bool deep = range.depth >= bvh_depth / 2; // then halves, to an end
        const Cut cut = count == 1 || deep ? Cut{} : best_cut(range);
        const double area = range.sides.half_area();
        const bool divided_is_better =
            cut.cost + double(settings_.node_cost) * area < tests(count) * area;
        if (count == 1 || (count <= settings_.leaf_size && !divided_is_better)) {
            nodes[node].first = range.first;
            nodes[node].count = count;
            return;
        }
        const auto [low, high] = divide(range, cut);
        const std::size_t children = nodes.size();
        nodes[node].first = static_cast<std::uint32_t>(children);
        nodes.push_back({low.sides.box(), 0, 0});
        nodes.push_back({high.sides.box(), 0, 0});
        grow(nodes, children, low, jobs);
        grow(nodes, children + 1, high, jobs);
    }
    // [grow]

    // Puts a tree that was built on its own in the place of its root.
    static void append(std::vector<BvhNodeT<T>>& nodes, std::size_t root,
                       const std::vector<BvhNodeT<T>>& part) {
        const auto shift = static_cast<std::uint32_t>(nodes.size()) - 1;
        for (std::size_t i = 0; i < part.size(); ++i) {
            BvhNodeT<T> node = part[i];
            if (node.count == 0) node.first += shift;
            if (i == 0)
                nodes[root] = node;
            else
                nodes.push_back(node);
        }
    }

    BvhBuild settings_;
    std::vector<CandidateT<T>> things_;
};

} // namespace detail

/// Builds a tree over boxes: top down, each crowd cut where that is cheapest for rays,
/// of 16 places along each axis \cite wald2007.
/// \param boxes     Any boxes, equal and flat ones too; below 2^31.
/// \param settings  Leaves and threads.
/// \return The tree, the same for any number of threads; no deeper than bvh_depth.
/// \throws std::invalid_argument  if a box is not finite, or there are too many.
/// \cost O(n log n); at most 68 bytes a box for the tree in float, and 36 more while it
///       is built.
template <std::floating_point T>
[[nodiscard]] BvhNodesT<T> build_bvh(std::span<const BoxT<T>> boxes,
                                     const BvhBuild& settings = {}) {
    require(boxes.size() < (std::size_t{1} << 31), "the number of boxes in a tree",
            static_cast<long long>(boxes.size()), "below 2^31");
    require(settings.leaf_size >= 1, "leaf_size",
            static_cast<long long>(settings.leaf_size), "at least 1");
    require(settings.at_a_time >= 1, "at_a_time",
            static_cast<long long>(settings.at_a_time), "at least 1");
    return detail::BvhBuilder<T>(boxes, settings).build();
}

/// \}

} // namespace ljus
