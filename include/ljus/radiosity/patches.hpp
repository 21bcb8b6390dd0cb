#pragma once

/// \file ljus/radiosity/patches.hpp
/// \brief The surfaces of a scene, divided into patches.

#include <span>
#include <string>
#include <vector>

#include "ljus/materials/lambertian.hpp"
#include "ljus/radiosity/patch_grid.hpp"

namespace ljus {

/// \defgroup patches Patches
/// \brief Section 2.2 of the report: "radiosity works by subdividing the scene into
/// smaller surface areas called patches". Chapter: \ref ch_radiosity.
/// \{

/// A patch: a cell of one side of an object, with constant radiosity.
// [patch]
struct Patch {
    std::uint32_t grid = 0;  ///< Index of the grid in Patches::grids.
    double area = 0;         ///< The area, in squared scene units.
    RgbT<double> albedo{0};  ///< Reflected fraction of the light.
    RgbT<double> emitted{0}; ///< Emitted radiosity, in W/m^2: pi times the radiance.
    Facet facet{};           ///< The corners of a flat patch; empty on a ball.
};
// [patch]

/// The index of a grid that does not exist.
inline constexpr std::uint32_t no_grid = 0xffffffffu;

/// The patches of a scene.
struct Patches {
    std::vector<PatchGrid> grids; ///< One grid per side of an object.
    std::vector<Patch> patches;   ///< The patches, grid by grid.
    bool convex = true;           ///< True if nothing can lie between two patches.
    /// Sentences about objects and lights that radiosity leaves out.
    std::vector<std::string> left_out;
    /// For each object, by its type and its index: the indices of the grids of its
    /// front and its back. A side without patches has no_grid.
    std::vector<std::vector<std::array<std::uint32_t, 2>>> grid_of;
};

/// How a scene is divided.
struct PatchSettings {
    /// The largest edge length of a patch, in scene units; towards the poles of a ball
    /// some are longer.
    double size = 0.25;
    /// The largest number of patches, at most 65536. n patches take 8 n^2 bytes.
    std::uint32_t most = 8192;
};

/// The albedo of a material for radiosity. A material of your own may provide this
/// function if it reflects the same radiance in all directions.
template <std::floating_point T>
[[nodiscard]] constexpr RgbT<double> diffuse_albedo(const LambertianT<T>& m) noexcept {
    return RgbT<double>(m.albedo);
}

/// A material with a diffuse_albedo().
template <typename M>
concept Matt = requires(const M& m) {
    diffuse_albedo(m);
};

/// A flat shape. Its form factors have a closed form.
template <typename S>
concept Flat = requires(const S& shape) {
    facet_of(shape);
};

namespace detail {

// An upper bound of the dot product of a unit normal with any point of a shape.
template <typename S>
double extent_along(const S& shape, const glm::dvec3& normal) {
    if constexpr (Flat<S>) {
        const Facet facet = facet_of(shape);
        double most = glm::dot(facet.corners[0], normal);
        for (const auto& corner :
             std::span(facet.corners).first(static_cast<std::size_t>(facet.count)))
            most = std::max(most, glm::dot(corner, normal));
        return most;
    } else {
        const auto bound = bounding_sphere(shape);
        return glm::dot(glm::dvec3(bound.center), normal) + double(bound.radius);
    }
}

// Whether a side of a shape needs patches. A side of a flat shape does if anything in
// the scene may lie in front of it. A ball has patches outside, or inside if the object
// is inside out.
template <AnyWorld W, typename G>
bool faces_anything(const W& world, const G& shape, bool inward, bool inside_out) {
    if constexpr (Flat<G>) {
        const Facet side = inward ? turned(facet_of(shape)) : facet_of(shape);
        const glm::dvec3 normal = glm::normalize(area_vector(side));
        const double plane = glm::dot(side.corners[0], normal);
        const double unit = std::numeric_limits<typename W::Scalar>::epsilon();
        const double rounding = 64 * unit *
                                glm::length(glm::dvec3(glm::abs(world.box().low) +
                                                       glm::abs(world.box().high)));
        bool any = false;
        world.each_object([&](ObjectId id, const auto&) {
            any = any || world.visit_shape(id, [&](const auto& other) {
                return extent_along(other, normal) > plane + rounding;
            });
        });
        return any;
    } else {
        return inward == inside_out;
    }
}

// Divides the sides of a matt object for which `open` is true. Returns the indices of
// the grids of its front and its back.
template <typename S, std::floating_point T>
std::array<std::uint32_t, 2>
cut_sides(Patches& all, const S& shape, ObjectId id, const ObjectT<T>& object,
          const RgbT<double>& albedo, const std::array<bool, 2>& open,
          const PatchSettings& settings) {
    std::array<std::uint32_t, 2> sides{no_grid, no_grid};
    for (const bool back : {false, true}) {
        if (!open[back]) continue;
        PatchGrid grid = patch_grid(shape, settings.size);
        const double total =
            double(all.patches.size()) + double(grid.columns) * double(grid.rows);
        require(total <= double(settings.most), "the number of patches", total,
                "at most " + std::to_string(settings.most) +
                    " (each pair has a form factor): choose larger patches");
        grid.object = id;
        grid.back = back;
        grid.inward = back != object.inside_out;
        grid.first = static_cast<std::uint32_t>(all.patches.size());
        sides[back] = static_cast<std::uint32_t>(all.grids.size());
        const double shine = back ? 0 : std::numbers::pi;
        Patch patch{.grid = sides[back],
                    .area = double(area(shape)) / double(grid.size()),
                    .albedo = albedo,
                    .emitted = shine * RgbT<double>(object.emission)};
        for (std::uint32_t cell = 0; cell < grid.size(); ++cell) {
            if constexpr (Flat<S>) {
                patch.facet = cell_facet(grid, facet_of(shape), cell);
                patch.area = glm::length(area_vector(patch.facet));
            }
            all.patches.push_back(patch);
        }
        all.grids.push_back(grid);
    }
    return sides;
}

inline void say(Patches& all, long long count, const char* one, const char* many) {
    if (count > 0)
        all.left_out.push_back(std::to_string(count).append(count == 1 ? one : many));
}

} // namespace detail

/// Divides the quads, triangles and balls of a scene that have a Matt material into
/// patches. A flat shape has patches on each side in front of which something lies. A
/// ball has patches on its outer side, or on its inner side if it was added inside out.
/// All other objects occlude, but reflect no light; Patches::left_out counts them.
/// \throws std::invalid_argument  if a setting is out of range, if there are no patches
///         or too many, or if the scene has fog.
/// \cost One test per pair of objects.
/// \report{Section 2.2}
template <AnyWorld W>
[[nodiscard]] Patches make_patches(const W& world, const PatchSettings& settings = {}) {
    require_no_fog(world, "radiosity");
    require_positive("patch size", settings.size);
    require(settings.most <= 65536, "most", static_cast<long long>(settings.most),
            "at most 65536: their form factors take 34 GB");
    Patches all;
    all.grid_of.resize(world.objects().size());
    long long unknown = 0, shiny = 0, lamps = 0;
    const auto cut = [&]<typename G>(const G& shape, ObjectId id, const auto& object) {
        std::array<bool, 2> open{};
        for (const bool back : {false, true})
            open[back] = detail::faces_anything(world, shape, back != object.inside_out,
                                                object.inside_out);
        // A wall that has objects on one side only occludes nothing.
        all.convex =
            all.convex && (Flat<G> ? !(open[0] && open[1]) : object.inside_out);
        std::array<std::uint32_t, 2> sides{no_grid, no_grid};
        world.visit_material(object.material, [&](const auto& m) {
            if constexpr (!Matt<std::remove_cvref_t<decltype(m)>>) {
                ++shiny;
            } else if constexpr (detail::Cuttable<G>) {
                sides = detail::cut_sides(all, shape, id, object, diffuse_albedo(m),
                                          open, settings);
                lamps += !is_black(object.emission);
            } else {
                ++unknown;
            }
        });
        all.grid_of[id.type].push_back(sides);
    };
    world.each_object([&](ObjectId id, const auto& object) {
        world.visit_shape(id, [&](const auto& shape) { cut(shape, id, object); });
    });
    detail::say(all, shiny, " object is not Lambertian and reflects no light",
                " objects are not Lambertian and reflect no light");
    detail::say(all, unknown, " object is of a shape that is not divided into patches",
                " objects are of a shape that is not divided into patches");
    detail::say(all, static_cast<long long>(world.light_count()) - lamps,
                " light has no patches and lights no surface",
                " lights have no patches and light no surface");
    require(!all.patches.empty(), "the number of patches", 0LL,
            "at least 1: add a Lambertian quad, triangle or ball that sees another");
    return all;
}

/// \}

} // namespace ljus
