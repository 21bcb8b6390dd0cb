#pragma once

/// \file ljus/inspect/explain.hpp
/// \brief Explains the colour of a pixel by its paths, in Heckbert's letters.

#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

#include "ljus/render/path_tracing.hpp"
#include "ljus/render/render.hpp"

namespace ljus {

/// \defgroup explain One pixel explained
/// \brief The vertices of a pixel's paths, the technique that finds each contribution,
/// and the sum of each kind of path. Paths are written in Heckbert's letters
/// \cite heckbert1990; see \ref light_path_expression.
/// \{

namespace detail {

/// The contribution of one kind of path to a pixel.
struct PathSum {
    std::string path;    ///< Heckbert's letters, such as "EDSL".
    std::string owner;   ///< The technique: "emission", "shadow ray", ...
    glm::dvec3 value{0}; ///< Contribution to the pixel's radiance.
    long long terms = 0; ///< The number of terms in the sum.
};

} // namespace detail

/// The contributions to a pixel.
template <std::floating_point T>
struct ExplainedPixelT {
    /// The radiance of the pixel, the same as in render() to the last bit.
    RgbT<T> radiance{T(0)};
    /// Contributions, brightest first; their sum is the radiance.
    std::vector<detail::PathSum> sums{};
    std::vector<PathLog> first_rays{}; ///< The first few rays, vertex by vertex.
    int samples = 0;                   ///< The number of rays.
    int rejected = 0; ///< Rays that are left out because their radiance is not finite.
};

namespace detail {

/// Renders one pixel again and logs its terms. `keep` is the number of rays that are
/// kept in full. The other parameters are those of explain().
template <typename R, CameraLike C>
[[nodiscard]] ExplainedPixelT<typename C::Scalar>
take_apart(const R& renderer, const C& camera, const RenderSettings& picture, int x,
           int y, int keep = 4) {
    using T = typename C::Scalar;
    require_fog_carried(renderer);
    require_image_size(picture.width, picture.height);
    require_at_least("samples", picture.samples, 1);
    require(x >= 0 && x < picture.width, "the pixel's column",
            static_cast<long long>(x), "at least 0 and below the picture's width");
    require(y >= 0 && y < picture.height, "the pixel's row", static_cast<long long>(y),
            "at least 0 and below the picture's height");

    ExplainedPixelT<T> pixel{.samples = picture.samples};
    const PictureRays rays(picture);
    std::map<std::pair<std::string, std::string>, PathSum> sums;
    Counts counts;
    RgbT<double> radiance{0};
    for (int i = 0; i < picture.samples; ++i) {
        PathLog log; // without the pixel filter
        const auto found = trace_pixel(renderer, camera, rays, {x, y, i}, counts, log);
        const RgbT<T> sample = found.weight * found.radiance;
        if (i < keep) pixel.first_rays.push_back(log);
        if (!is_finite(sample)) {
            ++pixel.rejected;
            continue;
        }
        radiance += RgbT<double>(sample);
        for (const PathLogLine& line : log.lines) {
            if (line.what == "vertex") continue;
            PathSum& sum = sums[{line.path, line.what}];
            sum.value += double(found.weight) * line.value / double(picture.samples);
            ++sum.terms;
        }
    }
    pixel.radiance = RgbT<T>(radiance / double(picture.samples));

    for (auto& [key, sum] : sums) {
        sum.path = key.first;
        sum.owner = key.second;
        pixel.sums.push_back(std::move(sum));
    }
    std::stable_sort(pixel.sums.begin(), pixel.sums.end(),
                     [](const PathSum& a, const PathSum& b) {
                         return max_component(a.value) > max_component(b.value);
                     });
    return pixel;
}

// Spaces the letters of a path: "EDSL" becomes "E D S L".
inline std::string spaced(const std::string& letters) {
    std::string text;
    for (const char c : letters) {
        if (!text.empty() && c != '+' && c != '.' && text.back() != '.') text += ' ';
        text += c;
    }
    return text;
}

inline std::string padded(std::string text, std::size_t width) {
    if (text.size() < width) text.append(width - text.size(), ' ');
    return text;
}

// A line such as "  E D L    shadow ray    0.31 0.30 0.28", without a line feed.
inline std::string line_of(const std::string& letters, const std::string& what,
                           const glm::dvec3& value) {
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, "%9.4g %9.4g %9.4g", value.x, value.y,
                  value.z);
    return "  " + padded(spaced(letters), 26) + " " + padded(what, 14) + numbers;
}

// The line of one vertex or one term of a path.
inline std::string line_of(const PathLogLine& step) {
    if (step.what != "vertex") return line_of(step.path, step.what, step.value);
    char place[96];
    std::snprintf(place, sizeof place, "   at (%.4g, %.4g, %.4g)", step.position.x,
                  step.position.y, step.position.z);
    char density[32];
    std::snprintf(density, sizeof density, ", pdf %.4g", step.pdf);
    return line_of(step.path, "throughput", step.value) + place +
           (step.pdf > 0 ? density : ", delta");
}

/// The contributions to a pixel as text. At most `most` sums, the brightest ones, are
/// printed line by line, and all others as one sum.
template <std::floating_point T>
[[nodiscard]] std::string describe(const ExplainedPixelT<T>& pixel,
                                   std::size_t most = 16) {
    std::string text;
    for (std::size_t i = 0; i < pixel.first_rays.size(); ++i) {
        const auto& steps = pixel.first_rays[i].lines;
        text += "ray " + std::to_string(i + 1) + "\n";
        for (const PathLogLine& step : steps) text += line_of(step) + "\n";
        if (steps.empty()) text += "  no light\n";
    }
    text += "means over " + std::to_string(pixel.samples) + " rays\n";
    glm::dvec3 rest{0};
    for (std::size_t i = 0; i < pixel.sums.size(); ++i) {
        const PathSum& sum = pixel.sums[i];
        if (i < most)
            text += line_of(sum.path, sum.owner, sum.value) + "\n";
        else
            rest += sum.value;
    }
    if (pixel.sums.size() > most)
        text += line_of("", std::to_string(pixel.sums.size() - most) + " more", rest) +
                "\n";
    text += line_of("", "the pixel", glm::dvec3(pixel.radiance)) + "\n";
    if (pixel.rejected > 0)
        text +=
            std::to_string(pixel.rejected) + " rays were not finite and are left out\n";
    return text;
}

} // namespace detail

/// Explains the pixel in column x from the left and row y from the top, for any
/// Renderer and the settings of render().
/// \return A text: the first rays with each vertex and each term, then the mean over
///         all rays for each kind of path, such as "E D L shadow ray 0.31 0.30 0.28".
/// \throws std::invalid_argument  as render(), or if the pixel lies outside the
///         picture.
template <typename R, CameraLike C>
[[nodiscard]] std::string explain(const R& renderer, const C& camera,
                                  const RenderSettings& picture, int x, int y) {
    return detail::describe(detail::take_apart(renderer, camera, picture, x, y));
}

/// Explains one pixel of a scene, rendered by path tracing with default settings.
/// \throws std::invalid_argument  if the pixel lies outside the picture.
template <AnyWorld W, CameraLike C>
[[nodiscard]] std::string explain(const W& world, const C& camera, int x, int y) {
    return explain(PathTracer(world), camera, RenderSettings{}, x, y);
}

/// \}

} // namespace ljus
