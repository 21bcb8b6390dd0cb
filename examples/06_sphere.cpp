// smoke: --quality draft --width 32
/// \file 06_sphere.cpp
/// \brief Shows a ball through a telescope from larger and larger distances, by the
/// report's formula and by a robust one.

#include <algorithm>
#include <string>

#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;
using Point = Vec3T<double>;

namespace {

/// A picture of the unit sphere from a distance in radii. The sphere always fills the
/// picture.
/// \param meet  Returns the distance t at which a ray meets the sphere, or nothing.
template <typename Meet>
Image telescope(int size, double distance, Meet meet) {
    const Point eye = distance * glm::normalize(Point{1, 0.7, 0.8});
    const Sphere ball{.center{0, 0, 0}, .radius = 1};
    const Vec3 sun(glm::normalize(Point{1, -0.2, 1.2}));
    const Point forward = glm::normalize(-eye);
    const Point right = glm::normalize(glm::cross(forward, Point{0, 0, 1}));
    const Point up = glm::cross(right, forward);
    Image image = make_image(size, size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double across = 2.4 * ((x + 0.5) / size - 0.5);
            const double along = 2.4 * (0.5 - (y + 0.5) / size);
            const Point aim = across * right + along * up; // in the plane of the centre
            // Computed in double, so that only the ray itself is rounded to float.
            const Ray ray{.origin = Vec3(eye),
                          .direction = Vec3(glm::normalize(aim - eye))};
            pixel(image, x, y) = {0.05f, 0.06f, 0.08f};
            if (const auto t = meet(ray, ball)) {
                const float cosine = glm::dot(normal(ball, point_at(ray, *t)), sun);
                pixel(image, x, y) =
                    (0.06f + 0.9f * std::max(0.0f, cosine)) * Rgb{0.95f, 0.75f, 0.4f};
            }
        }
    return image;
}

} // namespace

/// Makes the pictures of the chapter.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 6, the sphere: one ball from further and further away.");
        line.without({"--height", "--rays", "--seed", "--threads"});
        const examples::Options options = line.parse(
            {.draft{.width = 400}, .report{.width = 400}, .reference{.width = 800}});
        const auto as_printed = [](const Ray& ray, const Sphere& ball) {
            return intersect_as_printed(ray, ball);
        };
        const auto robust = [](const Ray& ray, const Sphere& ball) {
            return intersect(ray, ball);
        };
        for (const int radii : {100, 300, 1000, 3000, 10000})
            save_png(telescope(options.width, radii, as_printed),
                     options.path("sphere-printed-" + std::to_string(radii) + ".png"));
        save_png(telescope(options.width, 10000, robust),
                 options.path("sphere-robust-10000.png"));
    });
}
