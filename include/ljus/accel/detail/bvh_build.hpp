#pragma once

/// \file ljus/accel/detail/bvh_build.hpp
/// \brief How a tree of boxes is built: from the top, each range split where that is
/// cheapest.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ljus/accel/detail/bvh_bins.hpp"
#include "ljus/accel/detail/bvh_nodes.hpp"
#include "ljus/math/require.hpp"
#include "ljus/parallel.hpp"

namespace ljus::detail {

/// \defgroup bvh_build Building trees of boxes
/// \brief Where to split a range in two. Chapter: \ref ch_bvh.
/// \{

template <std::floating_point T>
class BvhBuilder {
public:
    BvhBuilder(std::span<const BoxT<T>> boxes, const BvhSettings& settings)
        : settings_(settings), refs_(boxes.size()) {
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            const BoxT<T>& box = boxes[i];
            require_finite("a box's low corner", box.low);
            require_finite("a box's high corner", box.high);
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
        // The upper part by one thread; what lies below a node of `alone` primitives is
        // built on its own, and put behind it in order: the same for any threads.
        std::vector<Job> jobs;
        tree.nodes.reserve(refs_.size());
        tree.nodes.push_back({all.bounds.box(), 0, 0});
        grow(tree.nodes, 0, all, &jobs);
        std::vector<std::vector<BvhNodeT<T>>> parts(jobs.size());
        parallel_blocks(static_cast<long long>(jobs.size()),
                        [&](long long number) {
                            const auto i = static_cast<std::size_t>(number);
                            parts[i].push_back({jobs[i].range.bounds.box(), 0, 0});
                            grow(parts[i], 0, jobs[i].range, nullptr);
                        },
                        {.threads = settings_.threads});
        for (std::size_t i = 0; i < jobs.size(); ++i)
            append(tree.nodes, jobs[i].node, parts[i]);
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
    void grow(std::vector<BvhNodeT<T>>& nodes, std::size_t node,
              const PrimitiveRangeT<T>& range, std::vector<Job>* jobs) {
        if (jobs && range.size() <= alone) {
            jobs->push_back({node, range});
            return;
        }
        const std::uint32_t count = range.size();
        const bool deep = range.depth >= bvh_depth / 2; // then halves, to an end
        const Split split = count == 1 || deep
                                ? Split{}
                                : best_split(refs_, range, settings_.at_a_time);
        const double area = range.bounds.half_area();
        const bool divided_is_better = split.cost + double(settings_.node_cost) * area <
                                       tests_of(count, settings_.at_a_time) * area;
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
    // Puts a tree that was built on its own in the slot of its root.
    static void append(std::vector<BvhNodeT<T>>& nodes, std::size_t root,
                       const std::vector<BvhNodeT<T>>& part) {
        const auto shift = static_cast<std::uint32_t>(nodes.size()) - 1;
        const auto shifted = [&](BvhNodeT<T> node) {
            if (node.count == 0) node.first += shift;
            return node;
        };
        nodes[root] = shifted(part[0]);
        for (std::size_t i = 1; i < part.size(); ++i) nodes.push_back(shifted(part[i]));
    }

    BvhSettings settings_;
    std::vector<PrimitiveRefT<T>> refs_;
};

/// Builds a tree over boxes: top down, each range split where that is cheapest for
/// rays, of 16 slots along each axis \cite wald2007.
/// \param boxes     Any boxes, equal and flat ones too; below 2^31.
/// \param settings  Leaves and threads.
/// \return The tree, the same for any number of threads; no deeper than bvh_depth.
/// \throws std::invalid_argument  if a box is not finite, or there are too many.
/// \cost O(n log n); at most 68 bytes a box for the tree in float, and 36 more while it
///       is built.
template <std::floating_point T>
[[nodiscard]] BvhNodesT<T> build_bvh(std::span<const BoxT<T>> boxes,
                                     const BvhSettings& settings = {}) {
    require(boxes.size() < (std::size_t{1} << 31), "the number of boxes in a tree",
            static_cast<long long>(boxes.size()), "below 2^31");
    require_at_least("leaf_size", settings.leaf_size, 1);
    require_at_least("at_a_time", settings.at_a_time, 1);
    return BvhBuilder<T>(boxes, settings).build();
}

/// \}

} // namespace ljus::detail
