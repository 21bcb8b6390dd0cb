#pragma once

/// \file ljus/render/detail/later_caustics.hpp
/// \brief Caustics that are asked for together: of 64 samples at a time.

#include "ljus/path/counts.hpp"
#include "ljus/path/path_log.hpp"
#include "ljus/photons/detail/estimates_together.hpp"

namespace ljus::detail {

/// \addtogroup photon_mapping
/// \{

/// Adds terms to the radiance of a path, and tells a log of them.
template <std::floating_point T, typename Log>
struct AddTerm {
    RgbT<T>& sum;              ///< Of the sample.
    const RgbT<T>& throughput; ///< Of the path.
    Log& log;                  ///< Told of each term.

    /// Adds a term.
    /// \param owner    Who carries it.
    /// \param letters  From here to the light.
    /// \param light    Radiance, before the throughput.
    void operator()(const char* owner, const char* letters, const RgbT<T>& light) {
        log.term(owner, letters, throughput * light);
        sum += throughput * light;
    }
};
/// Deduces the types from the values.
template <std::floating_point T, typename Log>
AddTerm(RgbT<T>&, RgbT<T>&, Log&) -> AddTerm<T, Log>;

/// The log of samples whose caustics are asked for together.
template <std::floating_point T>
struct LaterCaustics {
    std::uint32_t item = 0;                  ///< Which of the samples is being traced.
    std::vector<EstimatePlaceT<T>> places{}; ///< In the order of the samples.
    BallBlocks found{};                      ///< Room for the search.

    /// A path begins.
    constexpr void begin() const noexcept {}
    /// The path was scattered at a vertex.
    constexpr void vertex(char, const Vec3T<T>&, const RgbT<T>&, T) const noexcept {}
    /// Radiance was added.
    constexpr void term(std::string_view, std::string_view,
                        const RgbT<T>&) const noexcept {}

    /// Asks, and adds what comes to the samples.
    /// \param mapper   The maps, and how to ask.
    /// \param counts   Counts queries and photons.
    /// \param samples  By their items.
    template <typename Mapper>
    void finish(const Mapper& mapper, Counts& counts, std::span<RgbT<T>> samples) {
        if (places.empty()) return;
        counts.map_queries += places.size();
        estimates_together<T>(
            mapper.maps.caustics, places, mapper.settings.caustics_estimate,
            light_kinds, counts.map_photons, found,
            [&](const EstimatePlaceT<T>& place, const RgbT<T>& light) {
                samples[place.item] += place.throughput * light;
            });
        places.clear();
    }
};

/// Puts off the caustics of a vertex, if its samples are finished together and it is
/// one whose estimates can be.
/// \param add       What adds the terms of its path. Only an AddTerm whose log has a
///                  list of places puts anything off.
/// \param vertex    The surface.
/// \param material  What it is made of.
/// \param how       The estimate.
/// \return Whether they come later.
template <typename Add, std::floating_point T, typename M, typename K>
[[nodiscard]] bool put_off(Add& add, const VertexT<T>& vertex, const M& material,
                           const DensityEstimateOf<K>& how) {
    if constexpr (std::same_as<M, LambertianT<T>> && requires { add.log.places; })
        if (how.nearest == 0 && in_lanes<M>(how)) {
            set_place(add.log.places.emplace_back(), vertex, material, add.throughput,
                      add.log.item);
            return true;
        }
    return false;
}

/// \}

} // namespace ljus::detail
