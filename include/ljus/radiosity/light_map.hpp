#pragma once

/// \file ljus/radiosity/light_map.hpp
/// \brief The irradiance of all surfaces, and pictures of it from anywhere.

#include <span>
#include <vector>

#include "ljus/math/random.hpp"
#include "ljus/path/counts.hpp"
#include "ljus/path/path_log.hpp"
#include "ljus/radiosity/patches.hpp"
#include "ljus/scene/index.hpp"

namespace ljus {

/// \defgroup light_map Light maps
/// \brief Section 2.2: "the precomputed radiosity can then be reused as light maps in
/// real-time applications such as games". Chapter: \ref ch_radiosity.
/// \{

/// The light on the surfaces of a scene, whoever looks at it.
///
/// It holds irradiance, not radiosity: what a surface makes of it, the surface knows.
struct LightMap {
    std::uint64_t objects = 0;              ///< Of the scene that it was made for.
    std::vector<PatchGrid> grids{};         ///< One a side of an object.
    std::vector<RgbT<double>> irradiance{}; ///< Of each patch, W/m^2.
};

namespace detail {

/// The vertices of a cell, by their numbers within the grid: four of a quad, three of a
/// triangle. On a ball the first column has one vertex, the pole, and so has the last.
/// \param grid   The grid.
/// \param place  Of the cell.
[[nodiscard]] constexpr std::array<std::uint32_t, 4>
cell_vertices(const PatchGrid& grid, const CellPlace& place) noexcept {
    const auto vertex = [&](std::uint32_t right, std::uint32_t up) {
        const std::uint32_t column = place.column + right;
        const std::uint32_t row = place.row + up;
        if (grid.kind == GridKind::triangle) // rows get shorter by one vertex each
            return row * (grid.columns + 2) - row * (row + 1) / 2 + column;
        if (grid.kind == GridKind::quad) return row * (grid.columns + 1) + column;
        if (column == 0) return 0u;
        if (column == grid.columns) return 1u;
        return 2 + row % grid.rows * (grid.columns - 1) + column - 1;
    };
    if (grid.kind != GridKind::triangle)
        return {vertex(0, 0), vertex(1, 0), vertex(0, 1), vertex(1, 1)};
    if (place.upper) return {vertex(1, 1), vertex(0, 1), vertex(1, 0), no_grid};
    return {vertex(0, 0), vertex(1, 0), vertex(0, 1), no_grid};
}

} // namespace detail

/// The light at the vertices of a grid: the mean of the patches that meet there, after
/// Gouraud \cite gouraud1971.
/// \param grid        The grid.
/// \param irradiance  Of its cells.
/// \return Of its vertices.
[[nodiscard]] inline std::vector<RgbT<double>>
vertex_light(const PatchGrid& grid, std::span<const RgbT<double>> irradiance) {
    std::vector<RgbT<double>> sum(grid.vertices(), RgbT<double>(0));
    std::vector<double> count(grid.vertices(), 0.0);
    for (std::uint32_t cell = 0; cell < grid.size(); ++cell)
        for (const std::uint32_t vertex :
             detail::cell_vertices(grid, place_of(grid, cell))) {
            if (vertex == no_grid) continue;
            sum[vertex] += irradiance[cell];
            count[vertex] += 1;
        }
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= count[i];
    return sum;
}

/// What a picture of a light map looks like.
struct LightMapSettings {
    bool smooth = true; ///< Blended between vertices; false: each patch by itself.
};

/// A light map with its scene, ready to be rendered: `render(view, camera, picture)`.
template <SceneLike S>
struct LightMapView {
    using Stream = RandomStream; ///< It draws nothing.
    detail::IndexedT<S> scene;   ///< Which scene; it must outlive the view.
    LightMap map;                ///< Its light.
    LightMapSettings look{};     ///< How it is drawn.
    std::vector<std::vector<std::array<std::uint32_t, 2>>> grid_of; ///< As in Patches.
    std::vector<std::vector<RgbT<double>>> vertices; ///< vertex_light() of each grid.
};

/// Makes a light map ready to be rendered.
/// \param scene  The scene that it was made for; must outlive the view.
/// \param map    The light map.
/// \param look   How it is drawn.
/// \return The view.
/// \throws std::invalid_argument  if the map does not go with the scene.
template <SceneLike S>
[[nodiscard]] LightMapView<S> make_light_map_view(const S& scene, LightMap map,
                                                  const LightMapSettings& look = {}) {
    require(map.objects == scene.size(), "the number of objects of the light map",
            static_cast<long long>(map.objects),
            std::to_string(scene.size()) + ", as in the scene");
    LightMapView<S> view{detail::IndexedT<S>(scene), std::move(map), look, {}, {}};
    for (const auto& list : scene.objects)
        view.grid_of.emplace_back(list.size(), std::array{no_grid, no_grid});
    std::size_t next = 0;
    for (std::uint32_t number = 0; number < view.map.grids.size(); ++number) {
        const PatchGrid& grid = view.map.grids[number];
        const bool known = grid.object.type < view.grid_of.size() &&
                           grid.object.index < view.grid_of[grid.object.type].size();
        const bool same = known && scene.visit_shape(grid.object, [&](const auto& s) {
            if constexpr (detail::Cuttable<std::remove_cvref_t<decltype(s)>>)
                return patch_grid(s, 1.0).kind == grid.kind;
            else
                return false;
        });
        require(same && grid.first == next &&
                    view.map.irradiance.size() - next >= grid.size(),
                "a grid of the light map", static_cast<long long>(number),
                "one of an object of the scene");
        view.grid_of[grid.object.type][grid.object.index][grid.back] = number;
        view.vertices.push_back(vertex_light(
            grid, std::span(view.map.irradiance).subspan(next, grid.size())));
        next += grid.size();
    }
    return view;
}

/// The irradiance at a place of a grid, blended between its cell's vertices.
/// \param grid      The grid.
/// \param at        The place, see place_on().
/// \param vertices  vertex_light() of the grid.
/// \return W/m^2.
[[nodiscard]] inline RgbT<double>
blended_light(const PatchGrid& grid, const glm::dvec2& at,
              std::span<const RgbT<double>> vertices) noexcept {
    glm::dvec2 t;
    const CellPlace place = place_of(grid, cell_of(grid, at, &t));
    const auto v = detail::cell_vertices(grid, place);
    if (grid.kind != detail::GridKind::triangle)
        return (1 - t.y) * ((1 - t.x) * vertices[v[0]] + t.x * vertices[v[1]]) +
               t.y * ((1 - t.x) * vertices[v[2]] + t.x * vertices[v[3]]);
    if (place.upper) t = 1.0 - t;
    return (1 - t.x - t.y) * vertices[v[0]] + t.x * vertices[v[1]] +
           t.y * vertices[v[2]];
}

/// The radiance that a ray finds: one intersection and one look into the map.
/// \param view    The scene and its light map.
/// \param ray     A primary ray.
/// \param log     Told of each term.
/// \return Emitted radiance, and albedo / pi of the irradiance, W/(m^2 sr); what is no
///         patch is black.
/// \report{Section 2.2}
// [radiance]
template <SceneLike S, std::floating_point T, typename Log = NoLog>
[[nodiscard]] RgbT<T> radiance(const LightMapView<S>& view, const RayT<T>& ray,
                               RandomStream& /*stream*/, Counts& /*counts*/,
                               Log&& log = {}) {
    log.begin();
    const auto hit = closest_hit(view.scene, ray);
    if (!hit) return RgbT<T>(0);
    const auto& object = view.scene.object(hit->object);
    const detail::HitSideT<T> side = detail::side_of(view.scene, ray, *hit);
    RgbT<T> sum = side.back ? RgbT<T>(0) : object.emission;
    log.term("emission", "L", sum);
    const std::uint32_t number =
        view.grid_of[hit->object.type][hit->object.index][side.back];
    if (number == no_grid) return sum;

    const PatchGrid& grid = view.map.grids[number];
    const glm::dvec2 at = detail::place_on(grid.kind, hit->at, side.outer);
    const RgbT<double> irradiance =
        view.look.smooth ? blended_light(grid, at, view.vertices[number])
                         : view.map.irradiance[grid.first + cell_of(grid, at)];
    const auto reflected =
        view.scene.visit_material(object.material, [&](const auto& m) {
            if constexpr (Matt<std::remove_cvref_t<decltype(m)>>)
                return RgbT<T>(diffuse_albedo(m) * std::numbers::inv_pi * irradiance);
            else
                return RgbT<T>(0);
        });
    log.term("light map", "D..L", reflected);
    return sum + reflected;
}
// [radiance]

/// \}

} // namespace ljus
