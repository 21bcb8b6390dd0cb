#pragma once

/// \file ljus/io/detail/vertex_colors.hpp
/// \brief The colours of a mesh's vertices become a picture.

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/common.hpp>

#include "ljus/accel/mesh_data.hpp"
#include "ljus/image/image.hpp"

namespace ljus::detail {

// The pixels of a triangle: two by two.
inline constexpr std::size_t painted_pixels = 4;

// Paints each triangle into a square of four pixels, and makes the texture coordinates
// of its corners the centres of three of them. Between pixel centres a picture is
// interpolated bilinearly; with c1 + c2 - c0 in the fourth pixel that is the linear
// interpolation between the corners. The corner c0 is the one with which the fourth
// pixel needs the least clamping to [0, 1].
template <std::floating_point T>
ImageT<T> paint_vertices(MeshDataT<T>& data, const std::vector<RgbT<T>>& colors) {
    const std::size_t count = data.triangles.size();
    const auto columns =
        static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    const std::size_t rows = (count + columns - 1) / columns;
    const std::size_t width = 2 * columns, height = 2 * rows;
    ImageT<T> image = make_image<T>(static_cast<int>(width), static_cast<int>(height));
    MeshDataT<T> painted;
    for (std::size_t i = 0; i < count; ++i) {
        std::array<std::uint32_t, 3> corner = data.triangles[i];
        const auto fourth = [&] {
            return colors[corner[1]] + colors[corner[2]] - colors[corner[0]];
        };
        const auto clamped = [&] {
            return glm::clamp(fourth(), RgbT<T>{0}, RgbT<T>{1});
        };
        std::array<std::uint32_t, 3> best = corner;
        T least = std::numeric_limits<T>::infinity();
        for (int turn = 0; turn < 3; ++turn) {
            const T off = glm::distance(fourth(), clamped());
            if (off < least) best = corner;
            least = std::min(least, off);
            std::rotate(corner.begin(), corner.begin() + 1, corner.end());
        }
        corner = best;
        const std::size_t left = 2 * (i % columns), top = 2 * (i / columns);
        const auto vertex = static_cast<std::uint32_t>(painted.positions.size());
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t x = left + k % 2, y = top + k / 2;
            pixel(image, static_cast<int>(x), static_cast<int>(y)) =
                k < 3 ? colors[corner[k]] : clamped();
            if (k == 3) continue;
            painted.positions.push_back(data.positions[corner[k]]);
            if (!data.normals.empty())
                painted.normals.push_back(data.normals[corner[k]]);
            painted.uv.emplace_back(T((double(x) + 0.5) / double(width)),
                                    T(1 - (double(y) + 0.5) / double(height)));
        }
        painted.triangles.push_back({vertex, vertex + 1, vertex + 2});
    }
    data = std::move(painted);
    return image;
}

} // namespace ljus::detail
