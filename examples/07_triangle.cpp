// smoke: --quality draft --width 24
/// \file 07_triangle.cpp
/// \brief Shows a tetrahedron by the report's formula, which does not test the edges of
/// a triangle, and by the full test with conditions on u and v.

#include <array>
#include <cmath>
#include <optional>

#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;
using Point = Vec3T<double>;

namespace {

/// The formula of Section 3.1.5 as printed: t, if t >= 0. It intersects a plane.
std::optional<float> as_printed(const Ray& ray, const Triangle& triangle) {
    const Vec3 e1 = triangle.v2 - triangle.v1, e2 = triangle.v3 - triangle.v1;
    const Vec3 p = glm::cross(ray.direction, e2);
    const Vec3 q = glm::cross(ray.origin - triangle.v1, e1);
    const float t = glm::dot(q, e2) / glm::dot(p, e1);
    if (!(t >= 0)) return std::nullopt; // NaN is a miss
    return t;
}

/// The library's test, in float.
std::optional<float> with_conditions(const Ray& ray, const Triangle& triangle) {
    const auto hit = intersect<float>(ray, triangle);
    if (!hit) return std::nullopt;
    return hit->t;
}

/// A picture of a tetrahedron, each face in its own colour.
/// \param meet  Returns the distance t at which a ray meets a triangle, or nothing.
template <typename Meet>
Image tetrahedron(int size, Meet meet) {
    const Vec3 a{-1, -0.6f, -0.3f}, b{0.1f, -0.6f, 0.9f}, c{1, -0.6f, -0.5f},
        d{0, 0.9f, 0};
    const std::array<Triangle, 4> faces{Triangle{a, b, d}, Triangle{b, c, d},
                                        Triangle{c, a, d}, Triangle{a, c, b}};
    const std::array<Rgb, 4> colors{Rgb{0.85f, 0.45f, 0.2f}, Rgb{0.25f, 0.55f, 0.8f},
                                    Rgb{0.4f, 0.7f, 0.35f}, Rgb{0.6f, 0.6f, 0.6f}};
    Image image = make_image(size, size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double across = 2.6 * ((x + 0.5) / size - 0.5);
            const double along = 2.6 * (0.5 - (y + 0.5) / size);
            const Point way{across - 0.6, along - 0.5, -4.0};
            Ray ray{.origin{0.6f, 0.5f, 4}, .direction = Vec3(glm::normalize(way))};
            pixel(image, x, y) = {0.05f, 0.06f, 0.08f};
            for (std::size_t k = 0; k < faces.size(); ++k) {
                const auto t = meet(ray, faces[k]);
                if (!t || *t >= ray.t_max) continue;
                ray.t_max = *t; // only nearer hits count now
                const float facing =
                    std::abs(glm::dot(normal(faces[k]), ray.direction));
                pixel(image, x, y) = (0.3f + 0.7f * facing) * colors[k];
            }
        }
    return image;
}

} // namespace

/// Makes the two pictures.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about(
            "Chapter 7, the triangle: a tetrahedron with and without its edges.");
        line.without({"--height", "--rays", "--seed", "--threads"});
        const examples::Options options = line.parse(
            {.draft{.width = 480}, .report{.width = 480}, .reference{.width = 960}});
        save_png(tetrahedron(options.width, as_printed),
                 options.path("triangle-printed.png"));
        save_png(tetrahedron(options.width, with_conditions),
                 options.path("triangle-conditions.png"));
    });
}
