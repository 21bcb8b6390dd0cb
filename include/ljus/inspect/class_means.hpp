#pragma once

/// \file ljus/inspect/class_means.hpp
/// \brief The mean radiance that each class of paths adds to a picture.

#include <span>
#include <vector>

#include "ljus/path/light_transport.hpp"
#include "ljus/render/render.hpp"

namespace ljus {

/// \addtogroup light_path_expression
/// \{

/// For each class of paths, the radiance that it adds to a picture, as a mean over all
/// pixels. RenderSettings::progress is not called. A sample that is not finite is left
/// out.
///
/// All classes are measured on the same random paths. The means of disjoint classes
/// that cover all paths add up to the mean of the picture. The light of a photon map is
/// one number for paths of many lengths, such as "DS+L". All of it counts as light of
/// the shortest of these paths, DSL.
/// \return One mean per class, in W/(m^2 sr), the same for any number of threads.
/// \throws std::invalid_argument  if the size or the number of rays is below 1, or if
///         the renderer does not support the fog of its scene.
/// \cost One picture, and a few bit operations per letter of a path and class.
/// \report{Section 2}
template <typename R, CameraLike C>
[[nodiscard]] std::vector<RgbT<double>>
class_means(const R& renderer, const C& camera, const RenderSettings& picture,
            std::span<const LightPathExpression> classes) {
    detail::require_fog_carried(renderer);
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
                detail::ClassesLog<T> log(classes); // without the pixel filter
                const auto found =
                    trace_pixel(renderer, camera, rays, {x, int(y), i}, counts, log);
                if (!is_finite(found.radiance)) continue; // as in render()
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

/// \}

} // namespace ljus
