#pragma once

/// \file ljus/path/light_transport.hpp
/// \brief Renderers that carry some of all light paths, and the g of Eq. 1.

#include "ljus/path/light_path_expression.hpp"
#include "ljus/path/renderer.hpp"
#include "ljus/ref.hpp"
#include "ljus/scene/world.hpp"

namespace ljus {

/// \defgroup light_transport Light transport
/// \brief Section 2, Eq. 1: the rendering equation, and renderers that leave something
/// of it out. Chapter: \ref ch_light_transport.
/// \{

/// The factor g of Eq. 1: what distance and other things leave of the light between two
/// points.
/// \param world  The closed scene.
/// \param x      One point of a surface.
/// \param other  Another one.
/// \return 0 if something stands between them, glass too, or if they are the same
///         point; else 1/r^2, per square of scene units. The same if they are
///         exchanged.
/// \report{Eq. (1)}
/// \erratum{The report has 1/r^2 only, so that no surface casts a shadow.}
// [transport_factor]
template <AnyWorld W, std::floating_point T>
[[nodiscard]] T transport_factor(const W& world, const SurfacePointT<T>& x,
                                 const SurfacePointT<T>& other) {
    const Vec3T<T> way = other.position - x.position;
    const T squared = glm::dot(way, way);
    if (!(squared > T(0)) || occluded(world, spawn_ray_to(x, other))) return T(0);
    return T(1) / squared;
}
// [transport_factor]

namespace detail {

/// A log that adds up the terms of one class of paths and forgets all others.
template <std::floating_point T>
struct ExpressionLog {
    const LightPathExpression& wanted; ///< Which paths.
    RgbT<T> sum{T(0)};                 ///< Of their terms.
    std::uint64_t states = 0;          ///< Where the path is in the expression.

    /// A path begins, at the eye.
    void begin() noexcept { states = wanted.step(1, 'E'); }

    /// The path was scattered.
    void vertex(char letter, const Vec3T<T>&, const RgbT<T>&, T) noexcept {
        states = wanted.step(states, letter);
    }

    /// Radiance was added.
    /// \param letters  From here to the light. Where a photon map answers for a whole
    ///                 class at once, as "DS+L", its shortest path decides.
    /// \param value    The radiance.
    void term(std::string_view, std::string_view letters,
              const RgbT<T>& value) noexcept {
        std::uint64_t here = states;
        for (const char letter : letters) {
            if (letter == '|') break;
            if (letter != '+' && letter != '.') here = wanted.step(here, letter);
        }
        if ((here & wanted.last) != 0) sum += value;
    }
};

} // namespace detail

/// A renderer that carries only some of the paths of another one, which must outlive
/// it. Expressions that share no path and together hold all of them give pictures that
/// add up to the whole one: the random paths are the same, only what is added differs.
///
///     render(OnlyPaths(tracer, "ES*DS+L"), camera, picture)
template <typename R>
class OnlyPaths {
public:
    using Stream = typename R::Stream; ///< The same numbers, so the same paths.

    /// \param whole    The renderer that does the work.
    /// \param carried  Which of its paths count, as light_path_expression() takes it.
    /// \throws std::invalid_argument  as light_path_expression().
    OnlyPaths(Ref<R> whole, std::string_view carried)
        : whole_(whole), carried_(light_path_expression(carried)) {}
    /// The renderer that does the work.
    [[nodiscard]] const R& whole() const noexcept { return whole_.get(); }
    /// Which of its paths count.
    [[nodiscard]] const LightPathExpression& carried() const noexcept {
        return carried_;
    }

private:
    Ref<R> whole_;
    LightPathExpression carried_;
};
/// Deduces the renderer.
template <typename R>
OnlyPaths(const R&, std::string_view) -> OnlyPaths<R>;

/// The radiance of one camera path, as far as the filter lets it through.
/// \param renderer  The renderer and its filter.
/// \param ray       A primary ray.
/// \param context   The numbers of this path; counts its rays.
/// \return Radiance, W/(m^2 sr).
/// \cost As much as the whole renderer: nothing is left out but the sums.
template <typename R, std::floating_point T, typename Context>
[[nodiscard]] RgbT<T> radiance(const OnlyPaths<R>& renderer, const RayT<T>& ray,
                               Context& context) {
    detail::ExpressionLog<T> log{.wanted = renderer.carried()};
    auto own = context_of(context.stream, context.counts, log);
    (void)radiance(renderer.whole(), ray, own);
    return log.sum;
}

/// \}

} // namespace ljus
