#pragma once

/// \file ljus/path/light_transport.hpp
/// \brief Renderers that carry a subset of all light paths, and the g of Eq. 1.

#include <span>
#include <vector>

#include "ljus/path/light_path_expression.hpp"
#include "ljus/path/renderer.hpp"
#include "ljus/ref.hpp"
#include "ljus/scene/world.hpp"

namespace ljus {

/// \defgroup light_transport Light transport
/// \brief Section 2, Eq. 1: the rendering equation, and renderers that leave out some
/// of its terms. Chapter: \ref ch_light_transport.
/// \{

/// The factor g of Eq. 1: visibility over squared distance, between two points on
/// surfaces. It is 0 if anything occludes one from the other, even glass, or if they
/// coincide; otherwise 1/r^2, per squared scene unit. It is symmetric.
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

/// A log that sums the terms of one class of paths.
template <std::floating_point T>
struct ExpressionLog {
    const LightPathExpression& wanted; ///< The class.
    RgbT<T> sum{T(0)};                 ///< Sum of its terms.
    std::uint64_t states = 0;          ///< States of the current path.

    /// Starts a path at the eye.
    void begin() noexcept { states = wanted.step(1, 'E'); }

    void vertex(char letter, const Vec3T<T>&, const RgbT<T>&, T) noexcept {
        states = wanted.step(states, letter);
    }

    /// Whether the path is of the class if it goes on to a light.
    /// \param letters  From here to the light. If a photon map stands for a whole
    ///                 class, as "DS+L", its shortest path decides.
    [[nodiscard]] bool takes(std::string_view letters) const noexcept {
        std::uint64_t here = states;
        for (const char letter : letters) {
            if (letter == '|') break;
            if (letter != '+' && letter != '.') here = wanted.step(here, letter);
        }
        return (here & wanted.last) != 0;
    }

    /// Adds radiance, if the path is of the class.
    void term(std::string_view, std::string_view letters,
              const RgbT<T>& value) noexcept {
        if (takes(letters)) sum += value;
    }
};

/// Several ExpressionLogs that record the same path.
template <std::floating_point T>
struct ClassesLog {
    std::vector<ExpressionLog<T>> logs{};  ///< One per class.
    std::vector<std::uint64_t> takers{};   ///< Of each delayed term: a bit per class.
    std::uint32_t* next_delayed = nullptr; ///< Receives takers.size() after delay().

    /// \param classes  Must outlive the log.
    explicit ClassesLog(std::span<const LightPathExpression> classes) {
        for (const LightPathExpression& wanted : classes) logs.push_back({wanted});
    }
    void begin() noexcept {
        for (auto& log : logs) log.begin();
    }
    void vertex(char letter, const Vec3T<T>& at, const RgbT<T>& share, T pdf) noexcept {
        for (auto& log : logs) log.vertex(letter, at, share, pdf);
    }
    void term(std::string_view owner, std::string_view letters,
              const RgbT<T>& value) noexcept {
        for (auto& log : logs) log.term(owner, letters, value);
    }
    /// A batch will find the radiance of at most 64 classes.
    void delay(std::string_view letters) {
        std::uint64_t bits = 0;
        for (std::size_t k = 0; k < logs.size(); ++k)
            bits |= std::uint64_t(logs[k].takes(letters)) << k;
        takers.push_back(bits);
        *next_delayed = static_cast<std::uint32_t>(takers.size());
    }
};

} // namespace detail

/// A renderer that carries only some of the paths of another renderer, which must
/// outlive it. Pictures of disjoint classes that together contain all paths add up to
/// the whole picture: the random paths are the same, and only the sums differ.
///
///     render(OnlyPaths(tracer, "ES*DS+L"), camera, picture)
template <typename R>
class OnlyPaths {
public:
    using Stream = typename R::Stream; ///< Same numbers, so the same paths.

    /// \param whole    The renderer that traces the paths.
    /// \param carried  The class of paths, as for light_path_expression().
    /// \throws std::invalid_argument  as light_path_expression().
    OnlyPaths(Ref<R> whole, std::string_view carried)
        : whole_(whole), carried_(light_path_expression(carried)) {}
    /// The renderer that traces the paths.
    [[nodiscard]] const R& whole() const noexcept { return whole_.get(); }
    /// The class of paths.
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

/// The radiance of one camera path, restricted to the class.
/// \cost That of the whole renderer.
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
