#pragma once

/// \file ljus/accel/bvh8.hpp
/// \brief A tree of boxes with up to eight children per node, whose boxes are tested
/// together.

#include "ljus/accel/bvh.hpp"
#include "ljus/accel/detail/bvh8_walk.hpp"

namespace ljus {

/// \defgroup bvh8 Wide trees
/// \brief A wide tree offers the searches of BvhT, gives the same results and is faster
/// \cite wald2008. Chapter: \ref ch_bvh.
/// \{

/// A tree with up to eight children per node, made from a binary tree
/// \cite ylitie2017.
class Bvh8 {
public:
    /// An empty tree.
    Bvh8() = default;

    /// Builds the tree.
    /// \param boxes     The boxes of the primitives, as for BvhT, but fewer than 2^27.
    /// \param settings  As for BvhT, but at most 16 primitives per leaf.
    /// \param multiple  The first slot of each leaf is a multiple of this number, which
    ///                  is at least 1. Unused slots between leaves are padding.
    /// \throws std::invalid_argument  as the constructor of BvhT.
    explicit Bvh8(std::span<const Box> boxes, const BvhSettings& settings = {},
                  std::uint32_t multiple = 1)
        : wide_(detail::make_bvh8(detail::build_bvh(boxes, checked(settings)),
                                  multiple)) {}
    /// Builds the same tree from a vector, which is freed before the nodes are made.
    explicit Bvh8(std::vector<Box>&& boxes, const BvhSettings& settings = {},
                  std::uint32_t multiple = 1)
        : wide_(detail::make_bvh8(
              detail::build_bvh(std::move(boxes), checked(settings)), multiple)) {}

    /// The entry of primitive_ids() for an unused slot between leaves.
    static constexpr std::uint32_t padding = detail::Bvh8Nodes::padding;

    /// The index of the primitive at each slot, or padding.
    [[nodiscard]] const std::vector<std::uint32_t>& primitive_ids() const noexcept {
        return wide_.primitive_ids;
    }
    /// The nodes, the root first.
    [[nodiscard]] const detail::GrowingArray<detail::Bvh8Node>& nodes() const noexcept {
        return wide_.nodes;
    }
    /// The data of the tree, for detail::walk().
    [[nodiscard]] const detail::Bvh8Nodes& wide() const noexcept { return wide_; }
    /// The box around all primitives.
    [[nodiscard]] const Box& box() const noexcept { return wide_.box; }
    /// The size of the tree in bytes.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return wide_.nodes.capacity() * sizeof(detail::Bvh8Node) +
               wide_.primitive_ids.capacity() * 4;
    }

    /// See BvhT::closest().
    template <typename Test, typename Watch = NoTrace>
    void closest(Ray ray, Test&& test, Watch&& watch = {}) const {
        const auto ask = [&](std::uint32_t slot) {
            test(slot, ray);
            return false;
        };
        detail::walk<false>(wide_, ray, each_slot(ask), watch);
    }

    /// See BvhT::any().
    template <typename Test, typename Watch = NoTrace>
    [[nodiscard]] bool any(const Ray& ray, Test&& test, Watch&& watch = {}) const {
        return detail::walk<true>(wide_, ray, each_slot(test), watch);
    }

    /// A leaf function for detail::walk(). It calls `ask(slot)` for each primitive of
    /// the leaf, until a call returns true.
    template <typename Ask>
    [[nodiscard]] auto each_slot(Ask& ask) const {
        return [this, &ask](std::uint32_t first, std::uint32_t count,
                            const detail::Bvh8Ray*) {
            for (std::uint32_t slot = first; slot < first + count; ++slot)
                if (wide_.primitive_ids[slot] != padding && ask(slot)) return true;
            return false;
        };
    }

private:
    static const BvhSettings& checked(const BvhSettings& settings) {
        require(settings.leaf_size <= 16, "leaf_size",
                static_cast<long long>(settings.leaf_size), "at most 16");
        return settings;
    }

    detail::Bvh8Nodes wide_;
};

/// \}

} // namespace ljus
