#pragma once

/// \file ljus/accel/detail/bvh_build.hpp
/// \brief The construction of a tree of boxes: from the top, by the binned surface area
/// heuristic.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "ljus/accel/bvh_nodes.hpp"
#include "ljus/math/lanes.hpp"
#include "ljus/math/require.hpp"
#include "ljus/parallel.hpp"

namespace ljus::detail {

// A box during construction, stored as the lower bounds and the negated upper bounds.
// Growing the box is then the same operation in all lanes, which compilers vectorise.
template <std::floating_point T>
struct BoundsT {
    T side[8];

    static constexpr BoundsT none() noexcept {
        BoundsT result{};
        for (T& x : result.side) x = std::numeric_limits<T>::infinity();
        return result;
    }
    void grow(const BoundsT& other) noexcept {
        for_lanes([&](int i) {
            side[i] = side[i] < other.side[i] ? side[i] : other.side[i];
        });
    }
    [[nodiscard]] T size(int axis) const noexcept {
        return -side[axis + 4] - side[axis];
    }
    [[nodiscard]] BoxT<T> box() const noexcept {
        return {{side[0], side[1], side[2]}, {-side[4], -side[5], -side[6]}};
    }
    // In double, because the square of the largest float would overflow.
    [[nodiscard]] double half_area() const noexcept {
        const double x{size(0)}, y{size(1)}, z{size(2)};
        return x * y + y * z + z * x;
    }
};

// A reference to a primitive: its bounds and its index.
template <std::floating_point T>
struct PrimitiveRefT {
    BoundsT<T> bounds;
    std::uint32_t id;
    // The bounds are halved before they are added, because their sum could overflow.
    [[nodiscard]] T center(int axis) const noexcept {
        return T(0.5) * bounds.side[axis] - T(0.5) * bounds.side[axis + 4];
    }
    [[nodiscard]] BoundsT<T> centers() const noexcept {
        BoundsT<T> result{};
        for (int i = 0; i < 4; ++i) {
            result.side[i] = center(i);
            result.side[i + 4] = -center(i);
        }
        return result;
    }
};

// The range of references of a subtree.
template <std::floating_point T>
struct PrimitiveRangeT {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    int depth = 0;
    BoundsT<T> bounds = BoundsT<T>::none();  // of the primitives
    BoundsT<T> centers = BoundsT<T>::none(); // of their centres

    [[nodiscard]] std::uint32_t size() const noexcept { return last - first; }
    void take(const PrimitiveRefT<T>& ref) noexcept {
        bounds.grow(ref.bounds);
        centers.grow(ref.centers());
    }
};

// The number of tests for `count` primitives, if one test covers `at_a_time` of them.
[[nodiscard]] constexpr double tests_of(std::uint32_t count,
                                        std::uint32_t at_a_time) noexcept {
    return (count + at_a_time - 1) / at_a_time;
}

// A split between two bins along an axis, and its cost.
struct Split {
    int axis = -1; // -1 for no split
    int bin = 0;   // first bin of the upper half
    double cost = std::numeric_limits<double>::infinity();
};

inline constexpr int bin_count = 16;

// Maps a centre to its bin.
template <std::floating_point T>
struct ToBinT {
    T low, factor;
    ToBinT(const PrimitiveRangeT<T>& range, int axis) noexcept
        : low(range.centers.side[axis]),
          factor(T(bin_count) * (T(1) - std::numeric_limits<T>::epsilon() * 4) /
                 range.centers.size(axis)) {}
    // The result is a valid bin for every number, even NaN.
    [[nodiscard]] int operator()(T center) const noexcept {
        const T bin = (center - low) * factor;
        return bin < T(bin_count) ? static_cast<int>(bin) : bin_count - 1;
    }
};

// The split with the least expected cost \cite macdonald1990. A ray that hits a box
// hits a smaller box inside it with a probability equal to the ratio of the surface
// areas. The candidates are the 15 planes per axis between 16 bins \cite wald2007.
// [best_split]
template <std::floating_point T>
[[nodiscard]] Split best_split(const GrowingArray<PrimitiveRefT<T>>& refs,
                               const PrimitiveRangeT<T>& range,
                               std::uint32_t at_a_time) {
    struct Bin {
        BoundsT<T> bounds = BoundsT<T>::none();
        std::uint32_t count = 0;
    };
    // One loop for all axes is faster, because the bins of different axes do not wait
    // for each other.
    const std::array<ToBinT<T>, 3> bin_of{
        {ToBinT<T>(range, 0), ToBinT<T>(range, 1), ToBinT<T>(range, 2)}};
    Bin bins[3][bin_count];
    for (std::uint32_t i = range.first; i < range.last; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            Bin& bin = bins[axis][bin_of[std::size_t(axis)](refs[i].center(axis))];
            bin.bounds.grow(refs[i].bounds);
            ++bin.count;
        }
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
        const T size = range.centers.size(axis);
        if (!(size > std::numeric_limits<T>::min() &&
              size < std::numeric_limits<T>::max()))
            continue; // all centres in one plane
        const Bin* const all = bins[axis];
        // A sweep from above computes the costs of the upper halves. A sweep from below
        // adds the costs of the lower halves.
        double above[bin_count] = {};
        Bin upper, lower;
        for (int i = bin_count - 1; i > 0; --i) {
            upper.bounds.grow(all[i].bounds);
            upper.count += all[i].count;
            above[i] = upper.count == 0 ? 0
                                        : upper.bounds.half_area() *
                                              tests_of(upper.count, at_a_time);
        }
        for (int i = 1; i < bin_count; ++i) {
            lower.bounds.grow(all[i - 1].bounds);
            lower.count += all[i - 1].count;
            if (lower.count == 0 || lower.count == range.size()) continue;
            const double cost =
                lower.bounds.half_area() * tests_of(lower.count, at_a_time) + above[i];
            if (cost < best.cost) best = {axis, i, cost};
        }
    }
    return best;
}
// [best_split]

// Partitions a range at a split. Without a split, the range is halved by index.
template <std::floating_point T>
[[nodiscard]] std::array<PrimitiveRangeT<T>, 2>
divide(GrowingArray<PrimitiveRefT<T>>& refs, const PrimitiveRangeT<T>& range,
       const Split& split) {
    PrimitiveRangeT<T> low{
        .first = range.first, .last = range.first, .depth = range.depth + 1};
    PrimitiveRangeT<T> high{
        .first = range.last, .last = range.last, .depth = range.depth + 1};
    if (split.axis < 0) {
        low.last = high.first = range.first + range.size() / 2;
        for (std::uint32_t i = range.first; i < range.last; ++i)
            (i < low.last ? low : high).take(refs[i]);
        return {low, high};
    }
    const ToBinT<T> bin_of(range, split.axis);
    while (low.last < high.first) {
        PrimitiveRefT<T>& ref = refs[low.last];
        if (bin_of(ref.center(split.axis)) < split.bin) {
            low.take(ref);
            ++low.last;
        } else {
            high.take(ref);
            std::swap(ref, refs[--high.first]);
        }
    }
    return {low, high};
}

// Builds the tree: the top on one thread, the subtrees on several.
template <std::floating_point T>
class BvhBuilder {
public:
    BvhBuilder(std::span<const BoxT<T>> boxes, const BvhSettings& settings)
        : settings_(settings), refs_(boxes.size()) {
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const BoxT<T>& box = boxes[i];
            require_finite("a box's low corner", box.low);
            require_finite("a box's high corner", box.high);
            require(glm::all(glm::lessThanEqual(box.low, box.high)),
                    "a box's low corner", box.low, "at most its high corner");
            refs_[i] = {{{box.low.x, box.low.y, box.low.z, T(0), -box.high.x,
                          -box.high.y, -box.high.z, T(0)}},
                        static_cast<std::uint32_t>(i)};
        }
    }

    [[nodiscard]] BvhNodesT<T> build() {
        BvhNodesT<T> tree;
        if (refs_.empty()) return tree;
        PrimitiveRangeT<T> all{.last = static_cast<std::uint32_t>(refs_.size())};
        for (const PrimitiveRefT<T>& ref : refs_) all.take(ref);
        // One thread builds the top. Subtrees of at most `alone` primitives are built
        // separately and appended in order, so that the tree does not depend on the
        // number of threads.
        GrowingArray<Job> jobs;
        tree.nodes.reserve(refs_.size());
        tree.nodes.push_back({all.bounds.box(), 0, 0});
        grow(tree.nodes, 0, all, &jobs);
        std::vector<GrowingArray<BvhNodeT<T>>> parts(jobs.size());
        parallel_blocks(static_cast<long long>(jobs.size()),
                        [&](long long number) {
                            const auto i = static_cast<std::size_t>(number);
                            parts[i].push_back({jobs[i].range.bounds.box(), 0, 0});
                            grow(parts[i], 0, jobs[i].range, nullptr);
                        },
                        {.threads = settings_.threads});
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            append(tree.nodes, jobs[i].node, parts[i]);
            parts[i] = {}; // or all nodes would be in memory twice
        }
        tree.primitive_ids = std::vector<std::uint32_t>(refs_.size());
        for (std::size_t i = 0; i < refs_.size(); ++i)
            tree.primitive_ids[i] = refs_[i].id;
        return tree;
    }

private:
    static constexpr std::uint32_t alone = 4096;

    struct Job {
        std::size_t node;
        PrimitiveRangeT<T> range;
    };
    void grow(GrowingArray<BvhNodeT<T>>& nodes, std::size_t node,
              const PrimitiveRangeT<T>& range, GrowingArray<Job>* jobs) {
        if (jobs && range.size() <= alone) {
            jobs->push_back({node, range});
            return;
        }
        const std::uint32_t count = range.size();
        const bool deep = range.depth >= bvh_depth / 2; // then halve by index
        const Split split = count == 1 || deep
                                ? Split{}
                                : best_split(refs_, range, settings_.at_a_time);
        const double area = range.bounds.half_area();
        // To visit a node costs as much as one test.
        const bool divided_is_better =
            split.cost + area < tests_of(count, settings_.at_a_time) * area;
        if (count == 1 || (count <= settings_.leaf_size && !divided_is_better)) {
            nodes[node].first = range.first;
            nodes[node].count = count;
            return;
        }
        const auto [low, high] = divide(refs_, range, split);
        const std::size_t children = nodes.size();
        nodes[node].first = static_cast<std::uint32_t>(children);
        nodes.push_back({low.bounds.box(), 0, 0});
        nodes.push_back({high.bounds.box(), 0, 0});
        grow(nodes, children, low, jobs);
        grow(nodes, children + 1, high, jobs);
    }
    // Appends a subtree that was built separately. The root of the subtree replaces the
    // node `root`.
    static void append(GrowingArray<BvhNodeT<T>>& nodes, std::size_t root,
                       const GrowingArray<BvhNodeT<T>>& part) {
        const auto shift = static_cast<std::uint32_t>(nodes.size()) - 1;
        const auto shifted = [&](BvhNodeT<T> node) {
            if (node.count == 0) node.first += shift;
            return node;
        };
        nodes[root] = shifted(part[0]);
        for (std::size_t i = 1; i < part.size(); ++i) nodes.push_back(shifted(part[i]));
    }

    BvhSettings settings_;
    GrowingArray<PrimitiveRefT<T>> refs_;
};

/// Refuses arguments from which no tree can be built; see BvhT's constructor.
inline void require_buildable(std::size_t boxes, const BvhSettings& settings) {
    require(boxes < (std::size_t{1} << 31), "the number of boxes in a tree",
            static_cast<long long>(boxes), "below 2^31");
    require_at_least("leaf_size", settings.leaf_size, 1);
    require_at_least("at_a_time", settings.at_a_time, 1);
}

/// Builds a tree over boxes. BvhT's constructor documents the arguments and the cost.
/// \return The tree. It is the same for any number of threads, and at most bvh_depth
///         deep.
template <std::floating_point T>
[[nodiscard]] BvhNodesT<T> build_bvh(std::span<const BoxT<T>> boxes,
                                     const BvhSettings& settings = {}) {
    require_buildable(boxes.size(), settings);
    return BvhBuilder<T>(boxes, settings).build();
}

/// Builds the same tree from a vector, which is freed before the nodes are made.
template <std::floating_point T>
[[nodiscard]] BvhNodesT<T> build_bvh(std::vector<BoxT<T>>&& boxes,
                                     const BvhSettings& settings) {
    require_buildable(boxes.size(), settings);
    BvhBuilder<T> builder(boxes, settings);
    std::vector<BoxT<T>>().swap(boxes);
    return builder.build();
}

} // namespace ljus::detail
