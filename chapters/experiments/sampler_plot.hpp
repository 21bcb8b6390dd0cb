#pragma once

/// \file chapters/experiments/sampler_plot.hpp
/// \brief Does a sampler do what its pdf says? Points, a histogram, and a number.
///
///     examples::plot_sampler(folder, "mine", sample_mine, pdf_mine);
///
/// writes mine-points.svg, mine-histogram.gp, and returns the p of a chi-square test:
/// how likely a sampler with just this pdf is to look as bad. Below 0.001, look again.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "common/drawing.hpp"
#include "experiments/hemisphere_cells.hpp"
#include "ljus/math/random.hpp"

namespace examples {

/// What plot_sampler() found.
struct SamplerCheck {
    double p = 1;        ///< Of the chi-square test; uniform in [0, 1] if all is well.
    double integral = 0; ///< Of the pdf over the hemisphere; 1, or it is none.
};

/// Draws the first thousand directions, seen from above, and the fraction in each belt
/// of the hemisphere beside what the pdf says.
/// \param folder  Where to; it exists.
/// \param name    Of the files.
/// \param sample  Called with a point of the unit square; returns a unit vector, z > 0.
/// \param pdf     Called with a unit vector; returns a density per steradian.
/// \param count   How many directions the test takes.
/// \param seed    Of the random numbers.
/// \return p, and the integral of the pdf.
template <typename Sample, typename Pdf>
SamplerCheck plot_sampler(const std::string& folder, const std::string& name,
                          const Sample& sample, const Pdf& pdf, int count = 100000,
                          std::uint64_t seed = 1) {
    Drawing points{.name = name + "-points",
                   .description = "1000 directions of " + name + ", seen from above",
                   .low{-1.1, -1.1},
                   .high{1.1, 1.1},
                   .scale = 110};
    draw_arc(points, {}, 1, 0, 2 * std::numbers::pi, {.width = 1});

    std::vector<double> counts(HemisphereCells::rows * HemisphereCells::columns);
    ljus::RandomStream stream = ljus::random_stream(seed, ljus::Pass::user, 0, 0);
    for (int i = 0; i < count; ++i) {
        const ljus::Vec3T<double> d = sample(next_2d<double>(stream));
        if (i < 1000) draw_dot(points, {d.x, d.y}, 1.3, colors::blue);
        counts[HemisphereCells::of(d)] += 1;
    }
    save_drawing(folder, points);

    const std::vector<double> expected = HemisphereCells::integrals(pdf);
    SamplerCheck check;
    double sum = 0;
    Plot plot{.name = name + "-histogram",
              .columns = {"cosine of the belt", "share of the directions",
                          "what the pdf says"},
              .y_label = "share",
              .more = "set yrange [0:]\n"};
    for (int row = 0; row < HemisphereCells::rows; ++row) {
        double found = 0, said = 0;
        for (int column = 0; column < HemisphereCells::columns; ++column) {
            const auto cell =
                static_cast<std::size_t>(row * HemisphereCells::columns + column);
            const double expect = count * expected[cell];
            sum += (counts[cell] - expect) * (counts[cell] - expect) / expect;
            found += counts[cell] / count;
            said += expected[cell];
        }
        plot.rows.push_back({(row + 0.5) / HemisphereCells::rows, found, said});
        check.integral += said;
    }
    save_plot(folder, plot);
    check.p = chi_square_p(sum, double(counts.size() - 1));
    return check;
}

} // namespace examples
