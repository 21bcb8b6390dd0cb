// smoke: --quality draft
/// \file chapters/drawings/01_drawings.cpp
/// \brief Chapter 1: four patterns of rays in a pixel.

#include <ljus/math/random.hpp>
#include <ljus/math/sampling_pattern.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
using ljus::Sampling;
using ljus::Vec2;

constexpr Sampling patterns[] = {Sampling::random, Sampling::jittered,
                                 Sampling::multi_jittered, Sampling::sobol};
constexpr const char* names[] = {"random", "jittered", "multi-jittered", "Sobol"};

/// The four patterns, for 64 rays and for a prime.
void draw_patterns(const std::string& folder) {
    Drawing drawing{.name = "patterns",
                    .description = "Four patterns of 64 and of 61 points",
                    .low{-0.05, -0.1},
                    .high{4.55, 2.35},
                    .scale = 155};
    for (int row = 0; row < 2; ++row)
        for (int column = 0; column < 4; ++column) {
            const int count = row == 0 ? 64 : 61;
            const Point low{1.15 * column, 1.15 * (1 - row)};
            const auto at = [&](double x, double y) {
                return Point{low.x + x, low.y + 1 - y};
            };
            const auto pattern = make_pattern(patterns[column], count);
            const examples::Pen thin{.color = "#80808060", .width = 0.8};
            const bool cells = column == 1 ? row == 0 : column == 2;
            const int columns = pattern.strata.columns;
            // With a broken row the columns are of two widths, and begin anywhere.
            const bool whole = columns * pattern.strata.rows == count;
            for (int i = 1; cells && whole && i < columns; ++i)
                draw_line(drawing,
                          {at(double(i) / columns, 0), at(double(i) / columns, 1)},
                          thin);
            // The rows of a multi-jittered pattern have `columns` points each.
            for (int i = columns; cells && i < count; i += columns)
                draw_line(drawing, {at(0, double(i) / count), at(1, double(i) / count)},
                          thin);
            draw_line(drawing, {at(0, 0), at(1, 0), at(1, 1), at(0, 1), at(0, 0)},
                      {.width = 1});
            auto stream = ljus::random_stream(4, ljus::Pass::user, 0, 0);
            for (int i = 0; i < count; ++i) {
                const Vec2 p = ljus::spread(pattern, i, 5, next_2d(stream));
                draw_dot(drawing, at(double(p.x), double(p.y)), 2.4,
                         examples::colors::blue);
            }
            if (row == 0)
                draw_label(drawing, {low.x + 0.5, low.y + 1.08}, names[column]);
        }
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawing.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 1, first picture: a drawing.");
        const examples::Options options = line.parse({});
        draw_patterns(options.path(""));
    });
}
