#pragma once

/// \file ljus/accel/bvh8.hpp
/// \brief The fast tree of boxes: eight children a node, asked at once.

#include "ljus/accel/bvh.hpp"
#include "ljus/accel/detail/bvh8_walk.hpp"

namespace ljus {

/// \defgroup bvh8 Wide trees
/// \brief The twin of the plain tree for speed \cite wald2008 : the same searches, the
/// same answers. Chapter: \ref ch_bvh.
/// \{

/// The plain tree, made wide: nodes of up to eight children, chosen by
/// \ref bvh_collapse.
class Bvh8 {
public:
    /// A tree over nothing.
    Bvh8() = default;

    /// Builds the tree.
    /// \param boxes     As for BvhT, but below 2^27.
    /// \param settings  As for BvhT; leaves of at most 16.
    /// \param multiple  Leaves start at multiples of so many slots, with padding
    ///                  between them.
    /// \throws std::invalid_argument  as BvhT.
    template <typename Boxes>
    requires std::convertible_to<const Boxes&, std::span<const Box>>
    explicit Bvh8(const Boxes& boxes, const BvhSettings& settings = {},
                  std::uint32_t multiple = 1) {
        require(settings.leaf_size <= 16, "leaf_size",
                static_cast<long long>(settings.leaf_size), "at most 16");
        wide_ = detail::make_bvh8(
            detail::build_bvh(std::span<const Box>(boxes), settings), multiple);
    }

    /// A slot between leaves that nothing has.
    static constexpr std::uint32_t padding = detail::Bvh8Nodes::padding;

    /// primitive_ids()[slot] is a primitive's number, or padding.
    [[nodiscard]] const std::vector<std::uint32_t>& primitive_ids() const noexcept {
        return wide_.primitive_ids;
    }
    /// The nodes, the root first.
    [[nodiscard]] const std::vector<detail::Bvh8Node>& nodes() const noexcept {
        return wide_.nodes;
    }
    /// The tree itself, for detail::walk().
    [[nodiscard]] const detail::Bvh8Nodes& wide() const noexcept { return wide_; }
    /// A box around everything.
    [[nodiscard]] const Box& box() const noexcept { return wide_.box; }
    /// The memory that the tree takes.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return wide_.nodes.capacity() * sizeof(detail::Bvh8Node) +
               wide_.primitive_ids.capacity() * 4;
    }

    /// Asks the primitives that a ray may meet, the nearer ones first: as
    /// BvhT::closest().
    template <typename Test, typename Watch = NoTrace>
    void closest(Ray ray, Test&& test, Watch&& watch = {}) const {
        const auto ask = [&](std::uint32_t slot) {
            test(slot, ray);
            return false;
        };
        detail::walk<false>(wide_, ray, each_slot(ask), watch);
    }

    /// Whether any of the primitives that a ray may meet says yes: as BvhT::any().
    template <typename Test, typename Watch = NoTrace>
    [[nodiscard]] bool any(const Ray& ray, Test&& test, Watch&& watch = {}) const {
        return detail::walk<true>(wide_, ray, each_slot(test), watch);
    }

    /// A leaf for detail::walk() that asks slot by slot.
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
    detail::Bvh8Nodes wide_;
};

/// \}

} // namespace ljus
