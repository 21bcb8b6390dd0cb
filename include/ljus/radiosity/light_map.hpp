#pragma once

/// \file ljus/radiosity/light_map.hpp
/// \brief The irradiance of all surfaces, and a renderer that draws them for any
/// camera.

#include <span>
#include <vector>

#include "ljus/math/field_hash.hpp"
#include "ljus/math/random.hpp"
#include "ljus/path/direct_light.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/path/path_log.hpp"
#include "ljus/radiosity/patches.hpp"

namespace ljus {

/// \defgroup light_map Light maps
/// \brief Section 2.2 of the report: "the precomputed radiosity can then be reused as
/// light maps in real-time applications such as games". Chapter: \ref ch_radiosity.
/// \{

/// Identifies the scene and the settings of a light map; see light_map_key(). A saved
/// map can only be loaded for the same key.
struct LightMapKey {
    std::uint64_t scene = 0;    ///< Hash of shapes, materials and lights.
    std::uint64_t settings = 0; ///< Hash of the settings that change the map.
    /// True if both hashes are equal.
    friend bool operator==(const LightMapKey&, const LightMapKey&) = default;
};

/// The irradiance of all patches of a scene. The albedo of a surface is applied when
/// the map is drawn.
struct LightMap {
    LightMapKey key{};                      ///< The scene and settings of the map.
    std::vector<PatchGrid> grids{};         ///< One grid per side of an object.
    std::vector<RgbT<double>> irradiance{}; ///< Irradiance of each patch, in W/m^2.
};

namespace detail {

// A hash of the scene without its camera.
template <AnyWorld W>
[[nodiscard]] std::uint64_t scene_hash(const W& world) {
    FieldHash hash;
    const auto lists = [&](const auto&... list) {
        (hash.template add_name_of<
             typename std::remove_cvref_t<decltype(list)>::value_type>(),
         ...);
        hash.add(list...);
    };
    std::apply(lists, world.shapes());
    std::apply(lists, world.materials());
    hash.add(world.objects());
    for (std::uint32_t i = 0; i < world.light_count(); ++i)
        if (!world.can_be_met(i)) // lamps are among the shapes and objects
            world.visit_light(i, [&]<typename L>(const L& light) {
                hash.template add_name_of<L>();
                hash.add(light);
            });
    return hash.value;
}

/// The indices of a cell's vertices in its grid. A cell on a quad or a ball has four
/// vertices; a cell on a triangle has three, and the fourth index is no_grid. A column
/// on a ball is a ring of cells at one height. The first and the last ring end at a
/// pole, which is a single vertex.
[[nodiscard]] constexpr std::array<std::uint32_t, 4>
cell_vertices(const PatchGrid& grid, const CellPlace& place) noexcept {
    const auto vertex = [&](std::uint32_t right, std::uint32_t up) {
        const std::uint32_t column = place.column + right;
        const std::uint32_t row = place.row + up;
        if (grid.kind == GridKind::triangle) // each row is one vertex shorter
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

/// The irradiance at the vertices of a grid, in W/m^2: the mean over the adjacent cells
/// \cite gouraud1971.
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

/// How a light map is drawn.
struct LightMapSettings {
    bool smooth = true; ///< Whether irradiance is interpolated between vertices.
};

/// A renderer that draws a light map, by `render(view, camera, picture)`.
template <typename W>
class LightMapView {
public:
    using Stream = RandomStream; ///< Required of a renderer, but not used.

    /// Makes the renderer. The world must outlive it.
    /// \throws std::invalid_argument  if the map was made for another world.
    LightMapView(WorldRef<W> of, LightMap map, const LightMapSettings& look = {})
        : world_(of), map_(std::move(map)), look_(look) {
        const W& world = of.get();
        if (map_.key.scene != detail::scene_hash(world))
            throw std::invalid_argument(
                "The light map was made for another scene, with other shapes, "
                "materials or lights; make it again for this scene.");
        for (const auto& list : world.objects())
            grid_of_.emplace_back(list.size(), std::array{no_grid, no_grid});
        std::size_t next = 0;
        for (std::uint32_t number = 0; number < map_.grids.size(); ++number) {
            const PatchGrid& grid = map_.grids[number];
            const bool known = grid.object.type < grid_of_.size() &&
                               grid.object.index < grid_of_[grid.object.type].size();
            const bool same =
                known && world.visit_shape(grid.object, [&](const auto& s) {
                    if constexpr (detail::Cuttable<std::remove_cvref_t<decltype(s)>>)
                        return patch_grid(s, 1.0).kind == grid.kind;
                    else
                        return false;
                });
            require(same && grid.first == next &&
                        map_.irradiance.size() - next >= grid.size(),
                    "a grid of the light map", static_cast<long long>(number),
                    "the grid of an object of the scene");
            grid_of_[grid.object.type][grid.object.index][grid.back] = number;
            vertices_.push_back(
                vertex_light(grid, std::span<const RgbT<double>>(map_.irradiance)
                                       .subspan(next, grid.size())));
            next += grid.size();
        }
    }
    /// The world.
    [[nodiscard]] const W& world() const noexcept { return world_.get(); }
    /// The light map.
    [[nodiscard]] const LightMap& map() const noexcept { return map_; }
    /// How the map is drawn.
    [[nodiscard]] const LightMapSettings& look() const noexcept { return look_; }
    /// The indices of the grids of each object, as in Patches::grid_of.
    [[nodiscard]] const auto& grid_of() const noexcept { return grid_of_; }
    /// The result of vertex_light() for each grid.
    [[nodiscard]] const auto& vertices() const noexcept { return vertices_; }

private:
    WorldRef<W> world_;
    LightMap map_;
    LightMapSettings look_;
    std::vector<std::vector<std::array<std::uint32_t, 2>>> grid_of_{};
    std::vector<std::vector<RgbT<double>>> vertices_{};
};
/// Deduces the type of the world.
template <typename W>
LightMapView(const W&, LightMap, const LightMapSettings& = {}) -> LightMapView<W>;

/// The irradiance at a point of a grid, in W/m^2, interpolated between the vertices of
/// its cell.
/// \param grid      The grid.
/// \param at        The point in the coordinates of the shape, in [0, 1]^2.
/// \param vertices  The result of vertex_light().
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

/// The radiance along a ray, by one intersection and one look-up in the map.
/// \return Emitted radiance plus albedo/pi times irradiance, in W/(m^2 sr). Surfaces
///         without patches reflect nothing.
/// \report{Section 2.2}
// [radiance]
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] RgbT<T> radiance(const LightMapView<W>& view, const RayT<T>& ray,
                               Context& context) {
    const W& world = view.world();
    context.log.begin();
    const auto hit = closest_hit(world, ray);
    if (!hit) {
        const RgbT<T> sky = sky_radiance(world, ray.direction);
        context.log.term("sky", "L", sky);
        return sky;
    }
    const auto& object = world.object(hit->object);
    const detail::HitSideT<T> side = detail::side_of(world, ray, *hit);
    RgbT<T> sum = side.back ? RgbT<T>(0) : object.emission;
    if constexpr (W::lists_pictures) // a textured lamp varies from point to point
        if (!side.back) sum = vertex_at(world, ray, *hit).object.emission;
    context.log.term("emission", "L", sum);
    const std::uint32_t number =
        view.grid_of()[hit->object.type][hit->object.index][side.back];
    if (number == no_grid) return sum;

    const PatchGrid& grid = view.map().grids[number];
    const glm::dvec2 at = detail::place_on(grid.kind, hit->at, side.outer);
    const RgbT<double> irradiance =
        view.look().smooth ? blended_light(grid, at, view.vertices()[number])
                           : view.map().irradiance[grid.first + cell_of(grid, at)];
    const auto reflected = world.visit_material(object.material, [&](const auto& m) {
        if constexpr (Matt<std::remove_cvref_t<decltype(m)>>)
            return RgbT<T>(diffuse_albedo(m) * std::numbers::inv_pi * irradiance);
        else
            return RgbT<T>(0);
    });
    context.log.term("light map", "D..L", reflected);
    return sum + reflected;
}
// [radiance]

/// \}

} // namespace ljus
