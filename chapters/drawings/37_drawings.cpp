// smoke: --quality draft
/// \file chapters/drawings/37_drawings.cpp
/// \brief Chapter 37: floating-point numbers that are scaled and shifted, and a ball
/// far from the origin.

#include <cmath>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// The nearest number that has so few bits.
/// \param x     Any number.
/// \param bits  Of the integer m in m 2^e; float has 24.
double rounded(double x, int bits) {
    int exponent = 0;
    const double part = std::frexp(x, &exponent);
    return std::ldexp(std::nearbyint(std::ldexp(part, bits)), exponent - bits);
}

/// All numbers of three bits from 1 to 16, in their order.
std::vector<double> small_numbers() {
    std::vector<double> numbers;
    for (int e = -2; e <= 1; ++e)
        for (int m = 4; m < 8; ++m) numbers.push_back(std::ldexp(m, e));
    numbers.push_back(16);
    return numbers;
}

/// A line with a tick at each number.
void draw_number_line(Drawing& drawing, double height,
                      const std::vector<double>& numbers) {
    draw_line(drawing, {{0.5, height}, {16.5, height}}, {.width = 1.5});
    for (const double x : numbers)
        draw_line(drawing, {{x, height - 0.22}, {x, height + 0.22}}, {.width = 1.5});
}

/// Where the numbers from 1 to 4 go by a map; red where they must be rounded.
template <typename Map>
void draw_map(Drawing& drawing, double height, const char* name, const Map& map) {
    const std::vector<double> numbers = small_numbers();
    draw_number_line(drawing, height, numbers);
    draw_number_line(drawing, height - 2.6, numbers);
    for (const double x : numbers) {
        if (x > 4) continue;
        const double y = map(x);
        const bool exact = rounded(y, 3) == y;
        draw_arrow(drawing, {x, height - 0.3}, {y, height - 2.3},
                   {.color = exact ? colors::blue : colors::red, .width = 1.2});
    }
    draw_label(drawing, {13, height - 1.2}, name);
    for (const double x : {1.0, 2.0, 4.0, 8.0, 16.0})
        draw_label(drawing, {x, height + 0.55}, examples::text(x, "%g"));
}

/// Numbers of three bits times two and plus eight.
void draw_scaled_and_shifted(const std::string& folder) {
    Drawing drawing{.name = "extremes-floats",
                    .description =
                        "Numbers of three bits are denser near 0. Times two, "
                        "each is such a number again; plus eight, some fall "
                        "between two of them",
                    .low{0, -6.6},
                    .high{17, 1.1},
                    .scale = 43};
    draw_map(drawing, 0.2, "times 2: exact", [](double x) { return 2 * x; });
    draw_map(drawing, -3.7, "plus 8: red is rounded", [](double x) { return x + 8; });
    save_drawing(folder, drawing);
}

/// Balls at several distances from the origin, their points rounded.
void draw_displaced_balls(const std::string& folder) {
    Drawing drawing{.name = "extremes-balls",
                    .description = "The outline of a ball of radius 1, with its points "
                                   "rounded to numbers of seven bits: smooth near the "
                                   "origin, and in steps far away",
                    .low{-1.5, -1.95},
                    .high{7.5, 1.3},
                    .scale = 80};
    constexpr int bits = 7;
    const double u = std::ldexp(1.0, -bits);
    double x = 0;
    for (const double c : {1.0, 10.0, 50.0}) {
        std::vector<Point> outline;
        for (const Point& point : examples::circle({c, c}, 1))
            outline.push_back(
                {x + rounded(point.x, bits) - c, rounded(point.y, bits) - c});
        draw_line(drawing, examples::circle({x, 0}, 1), {.width = 0.8, .dashed = true});
        draw_area(drawing, outline, colors::orange);
        draw_line(drawing, outline, {.color = colors::orange, .width = 2});
        draw_label(drawing, {x, -1.35}, "c = " + examples::text(c, "%g"));
        draw_label(drawing, {x, -1.7}, "δ = " + examples::text(u * c, "%.2g"),
                   colors::orange);
        x += 3;
    }
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 37, extremes: drawings.");
        const examples::Options options = line.parse({});
        draw_scaled_and_shifted(options.path(""));
        draw_displaced_balls(options.path(""));
    });
}
