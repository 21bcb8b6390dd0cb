// smoke: --quality draft
/// \file chapters/experiments/43_experiments.cpp
/// \brief Chapter 43: indices, responses, and one wavelength against three indices.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include <ljus/math/random.hpp>
#include <ljus/optics/dispersion.hpp>

#include "common/example.hpp"

namespace {

using Rgb = ljus::RgbT<double>;
using Law = ljus::SellmeierT<double>;

/// The dominant wavelengths of a screen's red, green and blue, in nm.
constexpr Rgb three_wavelengths{611.4, 549.1, 464.3};

/// Plot: the index over the wavelength.
void plot_indices(const examples::Options& options) {
    examples::Plot plot{.name = "dispersion-indices",
                        .columns = {"wavelength in nm", "water", "crown N-BK7",
                                    "flint SF10", "heavy flint N-SF66", "diamond"},
                        .y_label = "index of refraction",
                        .more = "set yrange [1.2:2.6]\nset xrange [380:740]\n"
                                "set key outside right\n"};
    for (int nm = 380; nm <= 740; nm += 10) {
        plot.rows.push_back({double(nm)});
        for (const Law& law :
             {ljus::water<double>, ljus::bk7<double>, ljus::sf10<double>,
              ljus::sf66<double>, ljus::diamond<double>})
            plot.rows.back().push_back(ljus::refractive_index(law, double(nm)));
    }
    save_plot(options.path(""), plot);
}

/// Plot: the responses of the three channels, with a mean of 1 over [360, 830] nm.
void plot_responses(const examples::Options& options) {
    examples::Plot plot{
        .name = "dispersion-responses",
        .columns = {"wavelength in nm", "red", "green", "blue", "density of sampling"},
        .y_label = "relative to the mean",
        .more = "set xrange [380:740]\n"};
    for (double nm = 382.5; nm <= 740; nm += 5) {
        const double density = 470 * ljus::pdf_wavelength(nm);
        const Rgb response = density * ljus::wavelength_color(nm);
        plot.rows.push_back({nm, response.x, response.y, response.z, density});
    }
    save_plot(options.path(""), plot);
}

/// The angle by which a prism of 60 degrees deviates light that meets it as yellow
/// light does at its least deviation; in degrees.
double deviation(const Law& law, double nm) {
    constexpr double apex = std::numbers::pi / 3;
    const double n = ljus::refractive_index(law, nm);
    const double in = std::asin(ljus::refractive_index(law, ljus::line_d<double>) *
                                std::sin(apex / 2));
    const double within = std::asin(std::sin(in) / n);
    return (in + std::asin(n * std::sin(apex - within)) - apex) * 180 /
           std::numbers::pi;
}

/// The part of the light that lands elsewhere if a prism has three indices, one for
/// each channel, behind a lamp of an angular width.
double misplaced(const Law& law, double width) {
    constexpr int bins = 4000;
    constexpr double range = 40; // degrees
    const double middle = deviation(law, ljus::line_d<double>);
    std::vector<Rgb> right(bins, Rgb{0}), three(bins, Rgb{0});
    const auto spread = [&](std::vector<Rgb>& screen, double at, const Rgb& light) {
        const double low = (at - middle - width / 2 + range / 2) * bins / range;
        const double high = low + width * bins / range;
        for (int i = std::max(0, int(low)); i < std::min(bins, int(high) + 1); ++i)
            screen[std::size_t(i)] +=
                light * (std::min(high, i + 1.0) - std::max(low, double(i))) /
                (high - low);
    };
    constexpr int count = 4000;
    for (int i = 0; i < count; ++i) {
        const double nm = ljus::sample_wavelength((i + 0.5) / count);
        spread(right, deviation(law, nm), ljus::wavelength_color(nm) / double(count));
    }
    for (int c = 0; c < 3; ++c) {
        Rgb one{0};
        one[c] = 1;
        spread(three, deviation(law, three_wavelengths[c]), one);
    }
    double sum = 0;
    for (std::size_t i = 0; i < right.size(); ++i)
        for (int c = 0; c < 3; ++c) sum += std::abs(right[i][c] - three[i][c]) / 6;
    return sum;
}

/// Plot: what three indices misplace, over the width of the lamp.
void plot_three(const examples::Options& options) {
    examples::Plot plot{.name = "dispersion-three",
                        .columns = {"angular width of the lamp in degrees",
                                    "crown N-BK7", "flint SF10"},
                        .y_label = "misplaced part of the light",
                        .log_x = true,
                        .more = "set yrange [0:1]\n"};
    for (double width = 0.1; width < 12; width *= std::pow(10, 0.125))
        plot.rows.push_back({width, misplaced(ljus::bk7<double>, width),
                             misplaced(ljus::sf10<double>, width)});
    save_plot(options.path(""), plot);
}

/// The mean over the channels of the variance of a pixel, times its rays.
/// \param rays    Per pixel.
/// \param colors  Called with the pixel's stream and the ray; returns its colour.
template <typename Colors>
double noise(int pixels, int rays, const Colors& colors) {
    Rgb squares{0};
    for (int pixel = 0; pixel < pixels; ++pixel) {
        auto stream =
            ljus::random_stream(43, ljus::Pass::user, 0, std::uint64_t(pixel));
        Rgb sum{0};
        for (int ray = 0; ray < rays; ++ray) sum += colors(stream, ray) / double(rays);
        squares += (sum - Rgb{1}) * (sum - Rgb{1}) / double(pixels);
    }
    return rays * (squares.x + squares.y + squares.z) / 3;
}

/// Table: how the wavelength of a path is chosen.
void tabulate_trade(const examples::Options& options) {
    const int pixels = options.pick(2000, 200000, 1000000);
    const auto by_response = [](auto& stream, int) {
        return ljus::wavelength_color(ljus::sample_wavelength(next_1d<double>(stream)));
    };
    const auto evenly = [](auto& stream, int) {
        const double nm = 360 + 470 * next_1d<double>(stream);
        return ljus::wavelength_color(nm) * (470 * ljus::pdf_wavelength(nm));
    };
    const auto in_strata = [](int strata) {
        return [strata](auto& stream, int ray) {
            return ljus::wavelength_color(ljus::sample_wavelength(
                (ray + next_1d<double>(stream)) / double(strata)));
        };
    };
    const auto of_three = [](auto& stream, int) {
        Rgb color{0};
        color[int(3 * next_1d<double>(stream))] = 3;
        return color;
    };
    const auto text = [](double x, const char* format) {
        return examples::text(x, format);
    };
    examples::Table table{.name = "dispersion-trade",
                          .columns = {"wavelength of a path", "rays", "variance x rays",
                                      "misplaced at 0.5°"}};
    const auto add = [&](const char* name, int rays, const auto& colors, double wrong) {
        table.rows.push_back({name, text(rays, "%.0f"),
                              text(noise(pixels, rays, colors), "%.3f"),
                              text(wrong, "%.2f")});
    };
    const double three = misplaced(ljus::sf10<double>, 0.5);
    add("evenly", 1, evenly, 0);
    add("by response", 1, by_response, 0);
    add("by response in 4 strata", 4, in_strata(4), 0);
    add("by response in 16 strata", 16, in_strata(16), 0);
    add("one of three", 1, of_three, three);
    table.rows.push_back({"each of three", "3", "0.000", text(three, "%.2f")});
    examples::print_table(table);
    examples::save_table(options.path(""), table);
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 43, dispersion: indices, responses, one wavelength or "
                   "three indices.");
        const examples::Options options = line.parse({});
        plot_indices(options);
        plot_responses(options);
        plot_three(options);
        tabulate_trade(options);
    });
}
