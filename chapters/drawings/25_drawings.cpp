// smoke: --quality draft
/// \file chapters/drawings/25_drawings.cpp
/// \brief Chapter 25: the disc of a density estimate, and three kernels.

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/drawing.hpp"
#include "drawings/dimension.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A disc around a point of a floor, and the photons on it and beside it.
void draw_disc(Drawing& drawing) {
    const auto seen = [](double x, double y) { return Point{x, 0.42 * y + 0.55}; };
    std::vector<Point> disc;
    for (int i = 0; i <= 72; ++i)
        disc.push_back(
            seen(1.6 * std::cos(i * 0.0872665), 1.6 * std::sin(i * 0.0872665)));
    draw_area(drawing, disc, colors::blue);
    draw_line(drawing, disc, {colors::blue, 2});
    for (int i = 0; i < 40; ++i) { // a spiral that fills a square evenly enough
        const double radius = 2.3 * std::sqrt((i + 0.5) / 40), turn = 2.399963 * i;
        const double x = radius * std::cos(turn), y = radius * std::sin(turn);
        if (std::abs(x) > 2 || std::abs(y) > 2.2) continue;
        const bool is_in = std::hypot(x, y) < 1.6;
        const Point at = seen(x, y);
        draw_dot(drawing, at, 3.2, is_in ? colors::red : "#808080");
        if (is_in)
            draw_line(drawing, {{at.x - 0.12, at.y + 0.42}, at}, {colors::red, 0.9});
    }
    draw_arrow(drawing, seen(0, 0), {0, 2.3}, {.width = 2});
    draw_line(drawing, {seen(0, 0), seen(1.6, 0)}, {.width = 1.5});
    draw_label(drawing, {0.8, 0.72}, "r");
    draw_label(drawing, {0.2, 2.3}, "n");
    draw_label(drawing, {-0.18, 0.38}, "x");
}

/// Three kernels over the distance, each with the same volume over the disc.
void draw_kernels(Drawing& drawing) {
    const Point o{4.6, 0};
    draw_arrow(drawing, {o.x - 1.9, 0}, {o.x + 1.95, 0}, {.width = 1});
    const struct {
        const char* name;
        const char* color;
        double top;
    } kernels[] = {
        {"box", colors::blue, 1}, {"cone", colors::orange, 3}, {"", colors::green, 2}};
    for (const auto& kernel : kernels) {
        std::vector<Point> curve;
        for (int i = -60; i <= 60; ++i) {
            const double s = i / 60.0, size = std::abs(s);
            const double shape = kernel.top == 1   ? 1
                                 : kernel.top == 3 ? 1 - size
                                                   : 1 - size * size;
            curve.push_back({o.x + 1.6 * s, 0.68 * kernel.top * shape});
        }
        if (kernel.top == 1) {
            curve.insert(curve.begin(), {o.x - 1.6, 0});
            curve.push_back({o.x + 1.6, 0});
        }
        draw_line(drawing, curve, {kernel.color, 2});
    }
    draw_label(drawing, {o.x - 1.35, 0.88}, "box", colors::blue);
    draw_label(drawing, {o.x + 0.75, 1.85}, "cone", colors::orange);
    draw_label(drawing, {o.x + 1.65, 1.3}, "Epanechnikov", colors::green);
    draw_label(drawing, {o.x + 1.6, -0.28}, "r");
    draw_label(drawing, {o.x, -0.28}, "0");
}

/// The estimate: the flux of the photons in a disc over its area, with a kernel.
void draw_estimate(const std::string& folder) {
    Drawing drawing{.name = "density-disc",
                    .description =
                        "Photons in a disc around a point, and three kernels "
                        "that weight them by their distance",
                    .low{-2.1, -0.75},
                    .high{7.0, 2.5},
                    .scale = 95};
    draw_disc(drawing);
    draw_kernels(drawing);
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 25, the density estimate: drawings.");
        const examples::Options options = line.parse({});
        draw_estimate(options.path(""));
    });
}
