// smoke: --quality draft
/// \file chapters/drawings/03_drawings.cpp
/// \brief Chapter 3: a mean of eight values, inversion, and strata.

#include <cmath>
#include <string>
#include <vector>

#include <ljus/inspect/estimate.hpp>
#include <ljus/math/random.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"
#include "experiments/glass_integral.hpp"

namespace {

using namespace examples::glass; // f, its truth, the ways to draw
using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

ljus::RandomStream stream_of(int seed) {
    return ljus::random_stream(std::uint64_t(seed), ljus::Pass::user, 0, 0);
}

/// The axes of a drawing over [0, 1].
void draw_axes(Drawing& d, double top, const std::string& x, const std::string& y) {
    draw_arrow(d, {0, 0}, {1.08, 0});
    draw_arrow(d, {0, 0}, {0, top});
    draw_label(d, {1.12, 0}, x);
    draw_label(d, {-0.04, top - 0.01}, y);
    draw_label(d, {0, -0.05}, "0");
    draw_label(d, {1, -0.05}, "1");
}

/// A curve over [0, 1], stretched by a factor.
template <typename Curve>
std::vector<Point> curve_of(Curve curve, double scale) {
    std::vector<Point> points;
    for (int i = 0; i <= 200; ++i) {
        const double x = i / 200.0;
        points.push_back({x, scale * curve(x)});
    }
    return points;
}

/// The area below f, and the rectangle of the same area that a mean finds.
void draw_mean(const std::string& folder) {
    constexpr double scale = 3.2;
    Drawing d{.name = "monte_carlo-mean",
              .description = "A curve, its values at eight random places, and their "
                             "mean as a rectangle of nearly the same area",
              .low{-0.12, -0.12},
              .high{1.24, 0.62},
              .scale = 480};
    auto line = curve_of(f, scale);
    draw_line(d, line, {.color = colors::blue, .width = 2.5});
    auto stream = stream_of(23);
    ljus::Estimate mean;
    for (int i = 0; i < 8; ++i) {
        const double c = next_1d<double>(stream);
        add(mean, f(c));
        draw_line(d, {{c, 0}, {c, scale * f(c)}}, {.color = colors::orange});
        draw_dot(d, {c, scale * f(c)}, 4, colors::orange);
    }
    const double h = scale * mean.mean;
    draw_area(d, {{0, 0}, {1, 0}, {1, h}, {0, h}}, colors::orange);
    draw_line(d, {{0, h}, {1, h}}, {.color = colors::orange, .width = 2});
    draw_line(d, {{0, scale * truth}, {1, scale * truth}},
              {.color = colors::blue, .dashed = true});
    draw_axes(d, 0.58, "c", "f");
    draw_label(d, {1.11, h - 0.035}, "mean of 8", colors::orange);
    draw_label(d, {1.06, scale * truth + 0.02}, "I", colors::blue);
    save_drawing(folder, d);
}

/// The cumulative curve of the grazing density, read from the side.
void draw_inversion(const std::string& folder) {
    Drawing d{.name = "monte_carlo-inversion",
              .description = "Evenly spaced numbers u on the vertical axis go right to "
                             "the cumulative curve and down to x, where they crowd "
                             "below its steep part",
              .low{-0.14, -0.14},
              .high{1.24, 1.14},
              .scale = 360};
    draw_axes(d, 1.1, "x", "u");
    const auto cdf = [](double x) { return 1 - std::pow(1 - x, 6); };
    draw_line(d, curve_of(cdf, 1), {.color = colors::blue, .width = 2.5});
    for (int i = 0; i < 10; ++i) {
        const double u = (i + 0.5) / 10, x = Grazing::sample(u);
        draw_line(d, {{0, u}, {x, u}}, {.color = "#80808090", .width = 1});
        draw_arrow(d, {x, u}, {x, 0}, {.color = colors::orange, .width = 1.2});
        draw_dot(d, {0, u}, 3, "currentColor");
    }
    draw_line(d, {{0, 1}, {1, 1}}, {.color = "#80808080", .width = 1, .dashed = true});
    draw_label(d, {0.76, 0.92}, "F", colors::blue);
    draw_label(d, {-0.05, 1}, "1");
    save_drawing(folder, d);
}

/// Random numbers, one in each cell, and Owen's, below each other.
void draw_strata(const std::string& folder) {
    Drawing d{.name = "monte_carlo-strata",
              .description = "16 numbers on a line: random ones in heaps and gaps, one "
                             "in each of 16 cells, and scrambled Sobol",
              .low{-0.28, -0.14},
              .high{1.06, 0.5},
              .scale = 500};
    constexpr const char* names[] = {"random", "strata", "Owen"};
    constexpr const char* pens[] = {colors::blue, colors::orange, colors::green};
    for (std::size_t row = 0; row < 3; ++row) {
        const double y = 0.4 - 0.2 * double(row);
        draw_line(d, {{0, y}, {1, y}});
        for (int i = 0; i <= 16; ++i)
            draw_line(d, {{i / 16.0, y - 0.03}, {i / 16.0, y + 0.03}},
                      {.color = "#80808080", .width = 1});
        auto stream = stream_of(4);
        for (int i = 0; i < 16; ++i)
            draw_dot(d, {number(static_cast<Points>(row), i, 16, 99, stream), y}, 5,
                     pens[row]);
        draw_label(d, {-0.14, y}, names[row], pens[row]);
    }
    save_drawing(folder, d);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 3, Monte Carlo: drawings.");
        const std::string folder = line.parse({}).path("");
        draw_mean(folder);
        draw_inversion(folder);
        draw_strata(folder);
    });
}
