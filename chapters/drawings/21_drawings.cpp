// smoke: --quality draft
/// \file chapters/drawings/21_drawings.cpp
/// \brief Chapter 21: the form factor of two patches, and a room of patches.

#include <cmath>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/drawing.hpp"
#include "common/plot.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// Two patches with an area element on each, and the angles at both.
void draw_form_factor(const std::string& folder) {
    Drawing drawing{.name = "radiosity-form-factor",
                    .description =
                        "Two patches: a small part of each, the line between "
                        "them of length r, and its angles from both normals",
                    .low{-1.2, -0.8},
                    .high{5.6, 3.5},
                    .scale = 105};
    const std::vector<Point> first{{-0.9, -0.4}, {1.6, -0.6}, {2.3, 0.5}, {-0.1, 0.7}};
    const std::vector<Point> second{{4.1, 1.5}, {5.2, 2.0}, {4.9, 3.3}, {3.9, 2.7}};
    const auto patch = [&](std::vector<Point> corners, const char* color) {
        corners.push_back(corners.front());
        draw_area(drawing, corners, color);
        draw_line(drawing, corners, {color, 2});
    };
    patch(first, colors::blue);
    patch(second, colors::orange);
    const Point x{0.7, 0.05}, y{4.5, 2.4};
    for (const Point& at : {x, y})
        draw_area(drawing,
                  {{at.x - 0.16, at.y - 0.09},
                   {at.x + 0.12, at.y - 0.11},
                   {at.x + 0.17, at.y + 0.09},
                   {at.x - 0.11, at.y + 0.11}},
                  "currentColor");
    draw_line(drawing, {x, y}, {.width = 1.5, .dashed = true});
    draw_arrow(drawing, x, {0.85, 1.75}, {.width = 2});
    draw_arrow(drawing, y, {3.1, 2.85}, {.width = 2});
    const double up = std::atan2(1.7, 0.15), way = std::atan2(y.y - x.y, y.x - x.x);
    draw_arc(drawing, x, 0.75, way, up);
    draw_arc(drawing, y, 0.6, std::atan2(0.45, -1.4), way + 3.14159265);
    draw_label(drawing, {1.3, 0.95}, "θ");
    draw_label(drawing, {3.62, 2.35}, "θ′");
    draw_label(drawing, {2.6, 0.95}, "r");
    draw_label(drawing, {-0.35, 0.1}, "A_i", colors::blue);
    draw_label(drawing, {5.2, 2.75}, "A_j", colors::orange);
    draw_label(drawing, {1.0, -0.25}, "dA_i");
    draw_label(drawing, {4.75, 2.15}, "dA_j");
    save_drawing(folder, drawing);
}

/// A room of patches in section: what one of them sends to all others.
void draw_exchange(const std::string& folder) {
    Drawing drawing{.name = "radiosity-exchange",
                    .description = "A room in section, divided into patches; the lines "
                                   "from one patch are as thick as its form factors",
                    .low{-0.5, -0.55},
                    .high{5.0, 3.6},
                    .scale = 105};
    const double w = 4.5, h = 3;
    // Patches in section: their ends, once around the room.
    std::vector<Point> ends;
    for (int i = 0; i < 6; ++i) ends.push_back({w * i / 6, 0});
    for (int i = 0; i < 4; ++i) ends.push_back({w, h * i / 4});
    for (int i = 0; i < 6; ++i) ends.push_back({w - w * i / 6, h});
    for (int i = 0; i < 5; ++i) ends.push_back({0, h - h * i / 4});
    const Point from[] = {{w * 1 / 6, 0}, {w * 2 / 6, 0}};
    const auto length = [](const Point& a, const Point& b) {
        return std::hypot(b.x - a.x, b.y - a.y);
    };
    const Point middle{(from[0].x + from[1].x) / 2, 0};
    for (std::size_t i = 6; i + 1 < ends.size(); ++i) {
        const Point& a = ends[i];
        const Point& b = ends[i + 1];
        // In two dimensions: crossed strings minus uncrossed ones (Hottel).
        const double factor = (length(from[0], a) + length(from[1], b) -
                               length(from[0], b) - length(from[1], a)) /
                              (2 * length(from[0], from[1]));
        draw_line(drawing, {middle, {(a.x + b.x) / 2, (a.y + b.y) / 2}},
                  {colors::orange, 60 * std::abs(factor)});
    }
    draw_line(drawing, {{0, 0}, {w, 0}, {w, h}, {0, h}, {0, 0}}, {.width = 2});
    draw_line(drawing, {from[0], from[1]}, {colors::blue, 7});
    for (const Point& end : ends) draw_dot(drawing, end, 3.5, "currentColor");
    draw_label(drawing, {middle.x, -0.3}, "patch i", colors::blue);
    draw_label(drawing, {w / 2 + 0.35, h + 0.3}, "F_ij for all patches j",
               colors::orange);
    save_drawing(folder, drawing);
}

/// The error against time, from the table radiosity-trade.csv of 21_experiments.cpp:
/// for gnuplot, which reads the table when all programs have run.
void plot_trade(const std::string& folder) {
    examples::save_text(
        folder + "/radiosity-trade.gp",
        "# gnuplot radiosity-trade.gp; scripts/plot does it for a folder.\n"
        "set terminal svg size 720,400 dynamic font 'sans-serif,14' linewidth 1.6\n"
        "set output 'radiosity-trade.svg'\n"
        "set datafile separator ','\n"
        "set datafile missing NaN\n"
        "set border 3\nset tics nomirror out\nset grid lc rgb '#80808080' lw 0.4\n"
        "set key outside top horizontal center noenhanced\n"
        "set linetype 1 lc rgb '#3b8ed0'\nset linetype 2 lc rgb '#e0752d'\n"
        "set linetype 3 lc rgb '#2fa36b'\n"
        "set xlabel 'seconds of processor time'\nset ylabel 'error, %'\n"
        "set logscale xy\nset format x '10^{%L}'\nset yrange [0.5:30]\n"
        "is(way) = substr(strcol(1), 1, strlen(way)) eq way\n"
        "table = 'radiosity-trade.csv'\n"
        "# Without the table: an empty plot.\n"
        "if (system('test -f '.table.' && echo yes') ne 'yes') {\n"
        "    plot [0.01:10] 1 notitle\n"
        "    exit\n"
        "}\n"
        "plot table every ::1 using (is('closed') ? $3 + $4 + $5 : NaN):6 \\\n"
        "        with linespoints lt 1 pt 7 ps 0.5 title 'closed forms', \\\n"
        "    '' every ::1 using (is('1024') ? $3 + $4 + $5 : NaN):6 \\\n"
        "        with linespoints lt 2 pt 7 ps 0.5 title '1024 rays per patch', \\\n"
        "    '' every ::1 using (is('1024') ? $5 : NaN):6 \\\n"
        "        with linespoints lt 2 dt 2 pt 6 ps 0.5 title 'its next view', \\\n"
        "    '' every ::1 using (is('path') ? $5 : NaN):6 \\\n"
        "        with linespoints lt 3 pt 7 ps 0.5 title 'path tracing'\n");
}

} // namespace

/// Makes the chapter's drawings, and the instructions for one of its plots.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 21, radiosity: drawings.");
        const examples::Options options = line.parse({});
        draw_form_factor(options.path(""));
        draw_exchange(options.path(""));
        plot_trade(options.path(""));
    });
}
