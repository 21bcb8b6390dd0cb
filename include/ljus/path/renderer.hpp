#pragma once

/// \file ljus/path/renderer.hpp
/// \brief What a renderer is: the radiance of one camera ray.

#include <concepts>

#include "ljus/math/random.hpp"
#include "ljus/path/counts.hpp"
#include "ljus/path/path_log.hpp"

namespace ljus {

/// \defgroup renderer What a renderer is
/// \brief One function, called for each primary ray.
/// \{

/// A renderer in the precision of a camera: a struct that names the random stream that
/// it draws from,
///
///     using Stream = RandomStream; // or StratifiedStream
///
/// and, beside it, a function that returns W/(m^2 sr) and tells a log what it adds:
///
///     Rgb radiance(const MyRenderer&, const Ray&, Stream&, Counts&, Log&&);
template <typename R, typename T = float>
concept Renderer = requires(const R& renderer, const RayT<T>& ray,
                            typename R::Stream& stream, Counts& counts, NoLog log) {
    { radiance(renderer, ray, stream, counts, log) } -> std::same_as<RgbT<T>>;
};

/// \}

} // namespace ljus
