#pragma once

/// \file ljus/path/light_transport.hpp
/// \brief Renderers that carry a subset of all light paths, and the factor g of Eq. 1.

#include <span>
#include <vector>

#include "ljus/path/light_path_expression.hpp"
#include "ljus/path/renderer.hpp"
#include "ljus/ref.hpp"
#include "ljus/scene/world.hpp"

namespace ljus {

/// \defgroup light_transport Light transport
/// \brief Section 2 of the report, Eq. 1: the rendering equation, and renderers that
/// leave out some light paths. Chapter: \ref ch_light_transport.
/// \{

/// The factor g of Eq. 1 for two points on surfaces: visibility over squared distance.
/// \return 1/r^2 for points at a distance r, per squared scene unit. 0 if any surface,
///         even of glass, lies between the points, or if the points coincide.
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
    const LightPathExpression& wanted; ///< The class of paths.
    RgbT<T> sum{T(0)};        ///< Sum of the terms, which contain the throughput.
    std::uint64_t states = 0; ///< The automaton's states for the path so far.

    /// Starts a path at the eye.
    void begin() noexcept { states = wanted.step(1, 'E'); }

    void vertex(char letter, const Vec3T<T>&, const RgbT<T>&, T) noexcept {
        states = wanted.step(states, letter);
    }

    /// Whether the path belongs to the class if it continues to a light.
    /// \param letters  The letters from the last vertex to the light. The letters of a
    ///                 term from a photon map, such as "DS+L", stand for several paths.
    ///                 The shortest of these paths then decides.
    [[nodiscard]] bool takes(std::string_view letters) const noexcept {
        std::uint64_t here = states;
        for (const char letter : letters) {
            if (letter == '|') break;
            if (letter != '+' && letter != '.') here = wanted.step(here, letter);
        }
        return (here & wanted.last) != 0;
    }

    /// Adds radiance if the path belongs to the class.
    void term(std::string_view, std::string_view letters,
              const RgbT<T>& value) noexcept {
        if (takes(letters)) sum += value;
    }
};

/// A log that sums the terms of several classes of paths separately.
template <std::floating_point T>
struct ClassesLog {
    std::vector<ExpressionLog<T>> logs{}; ///< One log for each class.
    /// One bit per class for each delayed term: whether the term belongs to the class.
    /// A delayed term is one whose value is found later; see LogLike.
    std::vector<std::uint64_t> takers{};
    /// Where delay() writes the new size of `takers`.
    std::uint32_t* next_delayed = nullptr;

    /// Makes a log for at most 64 classes of paths, which must outlive the log.
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
    /// Records the classes of a delayed term.
    void delay(std::string_view letters) {
        std::uint64_t bits = 0;
        for (std::size_t k = 0; k < logs.size(); ++k)
            bits |= std::uint64_t(logs[k].takes(letters)) << k;
        takers.push_back(bits);
        *next_delayed = static_cast<std::uint32_t>(takers.size());
    }
};

} // namespace detail

/// A renderer that carries only one class of the paths of another renderer. Both
/// renderers trace the same random paths. If the classes of several such renderers are
/// disjoint and together contain all paths, their pictures add up to that of the other
/// renderer.
///
///     render(OnlyPaths(tracer, "ES*DS+L"), camera, picture)
template <typename R>
class OnlyPaths {
public:
    using Stream = typename R::Stream; ///< The random stream of the other renderer.

    /// Makes the renderer. The other renderer, `whole`, must outlive it. `carried` is
    /// the class of paths, as for light_path_expression().
    /// \throws std::invalid_argument  if `carried` is not a valid expression.
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
/// Deduces the type of the other renderer.
template <typename R>
OnlyPaths(const R&, std::string_view) -> OnlyPaths<R>;

/// The radiance that a camera ray receives by the paths of the renderer's class, in
/// W/(m^2 sr).
/// \cost That of the other renderer.
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
