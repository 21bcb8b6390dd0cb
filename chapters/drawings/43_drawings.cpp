// smoke: --quality draft
/// \file chapters/drawings/43_drawings.cpp
/// \brief Chapter 43: light through a prism, and through a drop of water.

#include <cmath>
#include <numbers>
#include <string>

#include <ljus/optics/dispersion.hpp>
#include <ljus/optics/refraction.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
using Vec3 = ljus::Vec3T<double>;
namespace colors = examples::colors;

constexpr double pi = std::numbers::pi;

struct Ray {
    double nm;
    const char* color;
};
constexpr Ray red{700, colors::red}, green{540, colors::green},
    violet{420, colors::violet};

Point flat(const Vec3& v) {
    return {v.x, v.y};
}

/// Three colours through a prism of a glass with four times the dispersion of flint.
void draw_prism(const std::string& folder) {
    Drawing drawing{.name = "dispersion-prism-rays",
                    .description =
                        "White light enters a prism from the left; red light "
                        "is deviated least, violet light most",
                    .low{-3.1, -1.5},
                    .high{3.4, 1.7},
                    .scale = 90};
    const double s = 0.5, c = std::sqrt(0.75);
    draw_area(drawing, {{0, 1.4}, {-2.2 * s, 1.4 - 2.2 * c}, {2.2 * s, 1.4 - 2.2 * c}},
              colors::blue);
    const auto index = [](double nm) {
        return ljus::refractive_index(ljus::cauchy_from_abbe(1.6, 9.0), nm);
    };
    const double up = std::asin(index(560) * s) - pi / 6;
    const Vec3 in{std::cos(up), std::sin(up), 0}, at{-1.1 * s, 1.4 - 1.1 * c, 0};
    draw_arrow(drawing, flat(at - 2.4 * in), flat(at), {.width = 3});
    for (const Ray& ray : {red, green, violet}) {
        const Vec3 within = *ljus::refract(in, Vec3{-c, s, 0}, 1 / index(ray.nm));
        // The right face: c x + s y = 1.4 s.
        const double way =
            (1.4 * s - c * at.x - s * at.y) / (c * within.x + s * within.y);
        const Vec3 exit = at + way * within;
        const auto out = ljus::refract(within, Vec3{c, s, 0}, index(ray.nm));
        draw_line(drawing, {flat(at), flat(exit)}, {ray.color, 2});
        if (out)
            draw_arrow(drawing, flat(exit), flat(exit + 2.2 * *out), {ray.color, 2});
    }
    const Vec3 straight = at + 2.6 * in;
    draw_line(drawing, {flat(at), flat(straight)}, {.width = 1, .dashed = true});
    draw_label(drawing, {0, 1.0}, "A");
    save_drawing(folder, drawing);
}

/// The paths of red and violet light that make the rainbow.
void draw_drop(const std::string& folder) {
    Drawing drawing{.name = "dispersion-drop",
                    .description =
                        "Sunlight is refracted into a drop of water, reflected "
                        "at its back, and refracted out again: red light "
                        "leaves it at 42 degrees, violet light at 41 degrees",
                    .low{-3.2, -3.2},
                    .high{1.5, 1.4},
                    .scale = 90};
    draw_arc(drawing, {0, 0}, 1, 0, 2 * pi, {colors::blue, 2});
    for (const Ray& ray : {red, violet}) {
        const double n = ljus::refractive_index(ljus::water<double>, ray.nm);
        const double b = std::sqrt((4 - n * n) / 3); // of the least deviation
        Vec3 at{-std::sqrt(1 - b * b), b, 0}, way{1, 0, 0};
        draw_arrow(drawing, {-3.2, b}, flat(at), {.width = 2});
        way = *ljus::refract(way, at, 1 / n);
        for (int i = 0; i < 2; ++i) {
            const Vec3 next = at - 2 * glm::dot(at, way) * way;
            draw_line(drawing, {flat(at), flat(next)}, {ray.color, 2});
            at = next;
            if (i == 0) way -= 2 * glm::dot(at, way) * at;
        }
        way = *ljus::refract(way, at, n);
        draw_arrow(drawing, flat(at), flat(at + 3.2 * way), {ray.color, 2});
    }
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 43, dispersion: drawings.");
        const examples::Options options = line.parse({});
        draw_prism(options.path(""));
        draw_drop(options.path(""));
    });
}
