#pragma once

/// \file examples/common/drawing.hpp
/// \brief Draws diagrams for the book from results of the library.
///
/// Lines in the SVG have the text colour of the page that contains it (currentColor). A
/// diagram that a page includes by \\htmlinclude is therefore readable in dark mode as
/// well.

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
    double x = 0; ///< Increases to the right.
    double y = 0; ///< Increases upwards.
};

/// Projects a point of space onto the x-y plane.
/// \param v  A vector of the library.
/// \return The point with its x and y.
template <typename V>
[[nodiscard]] Point flat(const V& v) {
    return {double(v.x), double(v.y)};
}

/// How a line is drawn.
struct Pen {
    std::string color = "currentColor"; ///< A colour of CSS.
    double width = 1.5;                 ///< Width in pixels.
    bool dashed = false;                ///< Whether the line is dashed.
};

/// The colours that a diagram shares with the plots.
namespace colors {
inline constexpr const char* blue = "#3b8ed0";   ///< The first curve.
inline constexpr const char* orange = "#e0752d"; ///< The second curve.
inline constexpr const char* green = "#2fa36b";  ///< The third curve.
inline constexpr const char* violet = "#a06cd5"; ///< The fourth curve.
inline constexpr const char* red = "#d64550";    ///< The fifth curve.
} // namespace colors

/// A diagram: a window of the plane, and the shapes that have been drawn in it.
struct Drawing {
    std::string name;        ///< Name of the file, such as "fig-9".
    std::string description; ///< A description for readers who cannot see the diagram.
    Point low;               ///< Lower left corner of the window.
    Point high;              ///< Upper right corner of the window.
    double scale = 100;      ///< Pixels per unit.
    std::string body = {};   ///< SVG elements so far.
};

/// A point in pixels of the drawing, as the text "x,y".
[[nodiscard]] inline std::string pixels(const Drawing& drawing, const Point& p) {
    return text((p.x - drawing.low.x) * drawing.scale, "%.1f") + "," +
           text((drawing.high.y - p.y) * drawing.scale, "%.1f");
}

/// The SVG attributes of a line.
[[nodiscard]] inline std::string stroke(const Pen& pen) {
    return "fill=\"none\" stroke=\"" + pen.color + "\" stroke-width=\"" +
           text(pen.width) + "\"" +
           (pen.dashed ? " stroke-dasharray=\"5 4\"" : std::string());
}

/// Draws straight lines from point to point.
/// \param drawing  Receives the line.
/// \param points   At least two.
/// \param pen      The look of the line.
inline void draw_line(Drawing& drawing, const std::vector<Point>& points,
                      const Pen& pen = {}) {
    std::string path = "<polyline points=\"";
    for (const Point& point : points) path += pixels(drawing, point) + " ";
    drawing.body += path + "\" " + stroke(pen) + "/>\n";
}

/// Fills a polygon with a colour, at an opacity of 15 %.
/// \param drawing  Receives the polygon.
/// \param points   The corners of the polygon.
/// \param color    A colour of CSS.
inline void draw_area(Drawing& drawing, const std::vector<Point>& points,
                      const std::string& color) {
    std::string path = "<polygon points=\"";
    for (const Point& point : points) path += pixels(drawing, point) + " ";
    drawing.body += path + "\" fill=\"" + color + "\" fill-opacity=\"0.15\"/>\n";
}

/// Draws an arrow.
/// \param drawing  Receives the arrow.
/// \param from     The tail of the arrow.
/// \param to       The tip of the arrow; must differ from `from`.
/// \param pen      The look of the line.
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

/// Draws an arc of a circle.
/// \param drawing  Receives the arc.
/// \param center   The centre of the circle.
/// \param radius   The radius of the circle.
/// \param first    The angle of the first point, in radians, counter-clockwise from the
///                 right.
/// \param last     The angle of the last point, above `first`.
/// \param pen      The look of the line.
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
/// \param center  The centre of the circle.
/// \param radius  The radius of the circle.
/// \return The corners; the last one is the first one again.
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
/// \param drawing  Receives the dot.
/// \param at       The middle of the dot.
/// \param radius   The radius of the dot, in pixels.
/// \param color    A colour of CSS.
inline void draw_dot(Drawing& drawing, const Point& at, double radius,
                     const std::string& color) {
    const std::string place = pixels(drawing, at);
    const std::size_t comma = place.find(',');
    drawing.body += "<circle cx=\"" + place.substr(0, comma) + "\" cy=\"" +
                    place.substr(comma + 1) + "\" r=\"" + text(radius) + "\" fill=\"" +
                    color + "\"/>\n";
}

/// Writes a name. Letters and digits after an underscore become subscripts, as in "n_1
/// = 1".
/// \param drawing  Receives the text.
/// \param at       The middle of the text.
/// \param name     The text.
/// \param color    A colour of CSS.
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
/// \param folder   The folder for the file, which exists.
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
