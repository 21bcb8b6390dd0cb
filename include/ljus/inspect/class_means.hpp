#pragma once

/// \file ljus/inspect/class_means.hpp
/// \brief How much light of a picture each class of paths brings, in one pass.

#include <span>
#include <vector>

#include "ljus/path/light_transport.hpp"
#include "ljus/render/render.hpp"

namespace ljus {

/// \addtogroup light_path_expression
/// \{

namespace detail {

/// Several ExpressionLogs that listen to the same path.
template <std::floating_point T>
struct ClassesLog {
    std::vector<detail::ExpressionLog<T>> logs{}; ///< One a class.

    /// A path begins, at the eye.
    void begin() noexcept {
        for (auto& log : logs) log.begin();
    }
    /// The path was scattered.
    void vertex(char letter, const Vec3T<T>& at, const RgbT<T>& share, T pdf) noexcept {
        for (auto& log : logs) log.vertex(letter, at, share, pdf);
    }
    /// Radiance was added.
    void term(std::string_view owner, std::string_view letters,
              const RgbT<T>& value) noexcept {
        for (auto& log : logs) log.term(owner, letters, value);
    }
};

} // namespace detail

/// What a renderer really carries: the mean radiance of a picture, class by class.
///
/// It is measured, by the letters that the renderer itself reports, so that a table of
/// renderers cannot promise what the code does not keep. All classes see the same
/// random paths; those that share no path and together hold all add up to the picture.
/// \param renderer  Any Renderer.
/// \param camera    As for render().
/// \param picture   As for render(); it is not stopped, and progress is not called.
/// \param classes   From light_path_expression(). Of a photon map's answer for a whole
///                  class, as "DS+L", the shortest path decides; see ExpressionLog.
/// \return W/(m^2 sr), one a class, the same for any number of threads.
/// \throws std::invalid_argument  if the size or the number of rays is below 1.
/// \cost One picture, and a few bit operations per letter and class.
/// \report{Section 2}
// [class_means]
template <typename R, CameraLike C>
[[nodiscard]] std::vector<RgbT<double>>
class_means(const R& renderer, const C& camera, const RenderSettings& picture,
            std::span<const LightPathExpression> classes) {
    require_at_least("width", picture.width, 1);
    require_at_least("height", picture.height, 1);
    require_at_least("samples", picture.samples, 1);
    using T = typename C::Scalar;
    using Sums = std::vector<RgbT<double>>;
    const PictureRays rays(picture);
    std::vector<Sums> rows(std::size_t(picture.height),
                           Sums(classes.size(), RgbT<double>(0)));
    const auto row = [&](long long y) {
        Sums& sums = rows[std::size_t(y)];
        Counts counts;
        for (int x = 0; x < picture.width; ++x)
            for (int i = 0; i < picture.samples; ++i) {
                detail::ClassesLog<T> log; // knows nothing of the pixel's filter
                for (const LightPathExpression& wanted : classes)
                    log.logs.push_back({wanted});
                const auto found =
                    trace_pixel(renderer, camera, rays, {x, int(y), i}, counts, log);
                for (std::size_t k = 0; k < classes.size(); ++k)
                    sums[k] += double(found.weight) * RgbT<double>(log.logs[k].sum);
            }
    };
    parallel_blocks(picture.height, row, {.threads = picture.threads});
    Sums mean(classes.size(), RgbT<double>(0));
    const double all = double(picture.width) * picture.height * picture.samples;
    for (const Sums& sums : rows)
        for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += sums[k] / all;
    return mean;
}
// [class_means]

/// \}

} // namespace ljus
