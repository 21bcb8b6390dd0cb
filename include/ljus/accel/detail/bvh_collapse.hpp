#pragma once

/// \file ljus/accel/detail/bvh_collapse.hpp
/// \brief Which nodes of the plain tree become the children of a wide one.

#include <array>
#include <cstddef>
#include <vector>

#include "ljus/accel/detail/bvh_nodes.hpp"

namespace ljus::detail {

/// \defgroup bvh_collapse Collapsing a tree
/// \brief From two children a node to eight, so that rays meet as few nodes as can be.
/// Chapter: \ref ch_bvh.
/// \{

/// The children of wide nodes, chosen so that the surfaces of all wide nodes have the
/// least sum: a ray visits a node in proportion to its surface \cite ylitie2017.
///
/// What lies below a plain node can be shown as one wide node, or opened to a row of
/// at most i nodes side by side, for which its two children share the i slots. From
/// the leaves up, the least cost of each is known from those below.
template <std::floating_point T>
class BvhCollapse {
public:
    static constexpr int width = 8; ///< Children of a wide node.

    /// The children of one wide node: nodes of the plain tree.
    struct Children {
        std::array<std::uint32_t, width> node{}; ///< Which ones.
        std::size_t count = 0;                   ///< How many.
    };

    /// Finds the costs.
    /// \param tree  Must outlive it.
    /// \cost O(n), 56 bytes a node.
    explicit BvhCollapse(const BvhNodesT<T>& tree)
        : tree_(tree), cost_(tree.nodes.size()) {
        // Children stand behind their parents.
        for (std::size_t i = tree.nodes.size(); i-- > 0;) {
            const BvhNodeT<T>& node = tree.nodes[i];
            if (node.count != 0) continue; // leaves are what they are
            const Vec3T<double> size{node.box.high - node.box.low};
            cost_[i][0] = size.x * size.y + size.y * size.z + size.z * size.x +
                          share(node, width).cost;
            for (int slots = 2; slots < width; ++slots)
                cost_[i][std::size_t(slots) - 1] =
                    glm::min(cost_[i][0], share(node, slots).cost);
        }
    }

    /// The children of a wide node.
    /// \param from  The plain node that becomes one, no leaf but for the root; a root
    ///              that is a leaf becomes its only child.
    [[nodiscard]] Children children(std::uint32_t from) const {
        Children result;
        const BvhNodeT<T>& node = tree_.nodes[from];
        if (node.count != 0)
            open(from, 1, result);
        else
            open_both(node, width, result);
        return result;
    }

private:
    struct Share {
        int low = 1; // slots of the first child
        double cost = 0;
    };

    double cost(std::uint32_t node, int slots) const noexcept {
        return cost_[node][std::size_t(slots) - 1];
    }

    // The best way for two children to share slots.
    // [share]
    Share share(const BvhNodeT<T>& parent, int slots) const noexcept {
        Share best;
        for (int low = 1; low < slots; ++low) {
            const double sum =
                cost(parent.first, low) + cost(parent.first + 1, slots - low);
            if (low == 1 || sum < best.cost) best = {low, sum};
        }
        return best;
    }
    // [share]

    void open_both(const BvhNodeT<T>& parent, int slots, Children& result) const {
        const int low = share(parent, slots).low;
        open(parent.first, low, result);
        open(parent.first + 1, slots - low, result);
    }
    void open(std::uint32_t i, int slots, Children& result) const {
        const BvhNodeT<T>& node = tree_.nodes[i];
        if (node.count == 0 && slots > 1 && share(node, slots).cost < cost_[i][0])
            open_both(node, slots, result);
        else
            result.node[result.count++] = i;
    }

    const BvhNodesT<T>& tree_;
    std::vector<std::array<double, width - 1>> cost_; // with 1, 2, ... slots
};

/// \}

} // namespace ljus::detail
