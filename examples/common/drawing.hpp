#pragma once

/// \file examples/common/drawing.hpp
/// \brief Diagrams of the book, drawn from what the library computes.
///
/// The SVG takes the colour of the surrounding page (currentColor), so that a page that
/// includes it by \\htmlinclude is readable in dark mode as well.

#include <cctype>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "common/plot.hpp"

namespace examples {

/// A point of a drawing; y points up.
struct Point {
    double x = 0; ///< To the right.
    double y = 0; ///< Up.
};

/// Projects a point of space onto the x-y plane.
/// \param v  A vector of the library.
/// \return Its x and y.
template <typename V>
[[nodiscard]] Point flat(const V& v) {
    return {double(v.x), double(v.y)};
}

/// How a line is drawn.
struct Pen {
    std::string color = "currentColor"; ///< As CSS has it.
    double width = 1.5;                 ///< In pixels.
    bool dashed = false;                ///< Whether it has gaps.
};

/// The colours that a diagram shares with the plots.
namespace colors {
inline constexpr const char* blue = "#3b8ed0";   ///< Of the first curve.
inline constexpr const char* orange = "#e0752d"; ///< Of the second.
inline constexpr const char* green = "#2fa36b";  ///< Of the third.
inline constexpr const char* violet = "#a06cd5"; ///< Of the fourth.
inline constexpr const char* red = "#d64550";    ///< Of the fifth.
} // namespace colors

/// A diagram: a window of the plane, and the shapes in it, in the order of drawing.
struct Drawing {
    std::string name;        ///< Of the file, e.g. "fig-9".
    std::string description; ///< What it shows, for those who cannot see it.
    Point low;               ///< The window's lower left corner.
    Point high;              ///< Its upper right corner.
    double scale = 100;      ///< Pixels per unit.
    std::string body = {};   ///< SVG elements so far.
};

/// A point in the drawing's pixels, as "x,y".
[[nodiscard]] inline std::string pixels(const Drawing& drawing, const Point& p) {
    return text((p.x - drawing.low.x) * drawing.scale, "%.1f") + "," +
           text((drawing.high.y - p.y) * drawing.scale, "%.1f");
}

/// The attributes of a line.
[[nodiscard]] inline std::string stroke(const Pen& pen) {
    return "fill=\"none\" stroke=\"" + pen.color + "\" stroke-width=\"" +
           text(pen.width) + "\"" +
           (pen.dashed ? " stroke-dasharray=\"5 4\"" : std::string());
}

/// Draws straight lines from point to point.
/// \param drawing  Where to.
/// \param points   At least two.
/// \param pen      How.
inline void draw_line(Drawing& drawing, const std::vector<Point>& points,
                      const Pen& pen = {}) {
    std::string path = "<polyline points=\"";
    for (const Point& point : points) path += pixels(drawing, point) + " ";
    drawing.body += path + "\" " + stroke(pen) + "/>\n";
}

/// Fills a polygon with a colour, half transparent.
/// \param drawing  Where to.
/// \param points   Its corners.
/// \param color    As CSS has it.
inline void draw_area(Drawing& drawing, const std::vector<Point>& points,
                      const std::string& color) {
    std::string path = "<polygon points=\"";
    for (const Point& point : points) path += pixels(drawing, point) + " ";
    drawing.body += path + "\" fill=\"" + color + "\" fill-opacity=\"0.15\"/>\n";
}

/// Draws an arrow whose head has its tip in `to`.
/// \param drawing  Where to.
/// \param from     Its tail.
/// \param to       Its tip; another point than `from`.
/// \param pen      How.
inline void draw_arrow(Drawing& drawing, const Point& from, const Point& to,
                       const Pen& pen = {}) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const Point along{(to.x - from.x) / length, (to.y - from.y) / length};
    const double head = 11 / drawing.scale;
    const Point neck{to.x - head * along.x, to.y - head * along.y};
    const Point side{-0.36 * head * along.y, 0.36 * head * along.x};
    draw_line(drawing, {from, neck}, pen);
    drawing.body += "<polygon points=\"" + pixels(drawing, to) + " " +
                    pixels(drawing, {neck.x + side.x, neck.y + side.y}) + " " +
                    pixels(drawing, {neck.x - side.x, neck.y - side.y}) + "\" fill=\"" +
                    pen.color + "\"/>\n";
}

/// Draws an arc.
/// \param drawing  Where to.
/// \param center   The circle's centre.
/// \param radius   Its radius.
/// \param first    Where it begins: radians, counter-clockwise from the right.
/// \param last     Where it ends, above `first`.
/// \param pen      How.
inline void draw_arc(Drawing& drawing, const Point& center, double radius, double first,
                     double last, const Pen& pen = {}) {
    constexpr int steps = 48;
    std::vector<Point> points;
    for (int i = 0; i <= steps; ++i) {
        const double angle = first + (last - first) * i / steps;
        points.push_back(
            {center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)});
    }
    draw_line(drawing, points, pen);
}

/// A polygon that approximates a circle, for draw_line() and draw_area().
/// \param center  The circle's centre.
/// \param radius  Its radius.
/// \return Points, the first one again at the end.
[[nodiscard]] inline std::vector<Point> circle(const Point& center, double radius) {
    constexpr int steps = 72;
    std::vector<Point> points;
    for (int i = 0; i <= steps; ++i) {
        const double angle = 2 * std::numbers::pi * i / steps;
        points.push_back(
            {center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)});
    }
    return points;
}

/// Draws a dot.
/// \param drawing  Where to.
/// \param at       Its middle.
/// \param radius   In pixels.
/// \param color    As CSS has it.
inline void draw_dot(Drawing& drawing, const Point& at, double radius,
                     const std::string& color) {
    const std::string place = pixels(drawing, at);
    const std::size_t comma = place.find(',');
    drawing.body += "<circle cx=\"" + place.substr(0, comma) + "\" cy=\"" +
                    place.substr(comma + 1) + "\" r=\"" + text(radius) + "\" fill=\"" +
                    color + "\"/>\n";
}

/// Writes a name; letters and digits after an underscore are subscripts, as in "n_1 =
/// 1".
/// \param drawing  Where to.
/// \param at       The middle of the text.
/// \param name     The text.
/// \param color    As CSS has it.
inline void draw_label(Drawing& drawing, const Point& at, const std::string& name,
                       const std::string& color = "currentColor") {
    const std::string place = pixels(drawing, at);
    const std::size_t comma = place.find(',');
    std::string body;
    for (std::size_t i = 0; i < name.size();) {
        if (name[i] != '_') {
            body += escaped({name[i++]});
            continue;
        }
        body += "<tspan dy=\"4\" font-size=\"70%\">";
        while (++i < name.size() && std::isalnum(static_cast<unsigned char>(name[i])))
            body += name[i];
        body += "</tspan><tspan dy=\"-4\">\u200b</tspan>";
    }
    drawing.body += "<text x=\"" + place.substr(0, comma) + "\" y=\"" +
                    place.substr(comma + 1) +
                    "\" text-anchor=\"middle\" dominant-baseline=\"middle\" fill=\"" +
                    color + "\">" + body + "</text>\n";
}

/// Saves a drawing as NAME.svg.
/// \param folder   Where to; it exists.
/// \param drawing  The drawing.
inline void save_drawing(const std::string& folder, const Drawing& drawing) {
    const std::string size =
        text((drawing.high.x - drawing.low.x) * drawing.scale, "%.0f") + " " +
        text((drawing.high.y - drawing.low.y) * drawing.scale, "%.0f");
    const std::size_t space = size.find(' ');
    save_text(folder + "/" + drawing.name + ".svg",
              "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"ljus-plot\" "
              "role=\"img\" aria-label=\"" +
                  drawing.description + "\" viewBox=\"0 0 " + size + "\" width=\"" +
                  size.substr(0, space) + "\" height=\"" + size.substr(space + 1) +
                  "\" font-family=\"serif\" font-style=\"italic\" "
                  "font-size=\"18\">\n" +
                  drawing.body + "</svg>\n");
}

} // namespace examples
