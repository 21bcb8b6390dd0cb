// smoke: --quality draft
/// \file chapters/drawings/25_drawings.cpp
/// \brief Chapter 25: discs in the light, in the penumbra and in the shadow.

#include <cmath>
#include <string>
#include <vector>

#include <ljus/math/random.hpp>

#include "common/command_line.hpp"
#include "drawings/drawing.hpp"

namespace {

using examples::Drawing;
using examples::Point;
namespace colors = examples::colors;

/// A floor with direct and shadow photons below an object, and three verdicts.
void draw_verdicts(const std::string& folder) {
    Drawing drawing{.name = "shadow-verdicts",
                    .description =
                        "A floor with direct and shadow photons. A disc with "
                        "direct ones only is lit, one with shadow photons "
                        "only is in shadow, one with both is unknown",
                    .low{-0.2, -0.75},
                    .high{7.2, 2.7},
                    .scale = 90};
    // How much of the lamp a place sees: from 0 at x = 2.6 to 1 at x = 4.4.
    const auto seen = [](double x) {
        return std::min(1.0, std::max(0.0, (x - 2.6) / 1.8));
    };
    auto stream = ljus::random_stream(7, ljus::Pass::user, 0, 0);
    const Point centers[] = {{1.2, 1.2}, {3.5, 1.2}, {5.8, 1.2}};
    const char* names[] = {"shadow: skip", "unknown: cast rays", "lit: skip"};
    const double radius = 0.75;
    for (int i = 0; i < 260; ++i) {
        const ljus::Vec2 u = next_2d(stream);
        const Point at{7 * double(u.x), 2.5 * double(u.y)};
        const bool direct = double(next_1d(stream)) < seen(at.x);
        draw_dot(drawing, at, 2.8, direct ? colors::blue : colors::orange);
    }
    for (int k = 0; k < 3; ++k) {
        draw_line(drawing, examples::circle(centers[k], radius), {.width = 2});
        draw_label(drawing, {centers[k].x, -0.4}, names[k]);
    }
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawings.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 25, shadow photons: drawings.");
        const examples::Options options = line.parse({});
        draw_verdicts(options.path(""));
    });
}
