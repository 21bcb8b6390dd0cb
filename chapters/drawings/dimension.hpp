#pragma once

/// \file chapters/drawings/dimension.hpp
/// \brief A length in a drawing: an arrow with two heads, and its letter.

#include <cmath>
#include <string>

#include "common/drawing.hpp"

namespace examples {

/// Draws an arrow with two heads between two points, and the name of its length.
/// \param drawing  Where to.
/// \param from     One end.
/// \param to       The other end.
/// \param name     The letter, as draw_label() writes it.
/// \param color    As CSS has it.
/// \param aside    The letter's distance from the arrow in pixels; above 0 it stands to
///                 the left when going from `from` to `to`.
inline void draw_dimension(Drawing& drawing, const Point& from, const Point& to,
                           const std::string& name,
                           const std::string& color = "currentColor",
                           double aside = 12) {
    const Point middle{(from.x + to.x) / 2, (from.y + to.y) / 2};
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const double left = aside / drawing.scale / length;
    draw_arrow(drawing, middle, from, {.color = color, .width = 1});
    draw_arrow(drawing, middle, to, {.color = color, .width = 1});
    draw_label(drawing,
               {middle.x - left * (to.y - from.y), middle.y + left * (to.x - from.x)},
               name, color);
}

} // namespace examples
