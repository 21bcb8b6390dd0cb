// smoke: --quality draft --width 24 --height 24 --rays 1
/// \file chapters/experiments/17_experiments.cpp
/// \brief Chapter 17: the experiments behind its table, plots and pictures: the colours
/// of thin films by a spectrum, a table, three wavelengths, and in closed form.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>

#include "common/example.hpp"

namespace {

using ljus::Image;
using ljus::Rgb;
using ljus::Vec3;

constexpr double water = 1.33;

// The colours of a film, by the cosine outside and the thickness in nm.

glm::dvec3 spectrum(double c, double d) {
    return ljus::into_gamut(ljus::film_spectral(c, water, d));
}
glm::dvec3 three(double c, double d) {
    return ljus::film_three(c, water, d);
}
glm::dvec3 beforehand(double c, double d) {
    return ljus::into_gamut(ljus::film_preintegrated(c, water, d));
}

/// The mistake: no wave changes its sign, and the sine becomes a cosine.
glm::dvec3 not_turned(double c, double d) {
    const double g = std::sqrt(ljus::film_cosine2(c, water));
    return ljus::into_gamut(ljus::spectrum_color<double>([&](double wavelength) {
        const double phase = 2 * std::numbers::pi * d * g / wavelength;
        const double beat = (water * water - 1) * std::cos(phase) / g;
        return ljus::film_shares(c, water, beat).reflected;
    }));
}

/// A wedge: the thickness grows to the right, the angle downwards.
template <typename Color>
void strip(const examples::Options& options, const std::string& file, Color color) {
    const int width = options.width * 2, height = options.width / 2;
    Image image = ljus::make_image(width, height);
    ljus::parallel_blocks(height, [&](long long y) {
        for (int x = 0; x < width; ++x) {
            const double d = 1500.0 * (x + 0.5) / width;
            const double angle = 80.0 * (double(y) + 0.5) / height;
            const double c = std::cos(angle * std::numbers::pi / 180);
            // Divided by the film's mean reflectance, so that colours are left.
            pixel(image, x, static_cast<int>(y)) =
                Rgb(color(c, d) * (0.35 / ljus::thick_film(c, water)));
        }
    });
    save_png(image, options.path(file + ".png"));
}

/// CIE 1976 L*a*b* of a reflectance. White is twice what thick films reflect at the
/// same angle, about the brightest that a thin one can be.
glm::dvec3 lab(const glm::dvec3& rgb, double cosine) {
    const glm::dvec3 c = rgb / (2 * ljus::thick_film(cosine, water));
    const glm::dvec3 xyz{(0.4124 * c.x + 0.3576 * c.y + 0.1805 * c.z) / 0.9505,
                         0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z,
                         (0.0193 * c.x + 0.1192 * c.y + 0.9505 * c.z) / 1.089};
    const auto f = [](double t) {
        return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116;
    };
    return {116 * f(xyz.y) - 16, 500 * (f(xyz.x) - f(xyz.y)),
            200 * (f(xyz.y) - f(xyz.z))};
}

/// Nanoseconds per call, over thicknesses and angles; the best of five.
template <typename Color>
double nanoseconds(Color color, int calls) {
    return examples::nanoseconds_a_call(
        calls,
        [&] {
            float sum = 0;
            for (int i = 0; i < calls; ++i) {
                const float c = 0.3f + 0.7f * float(i % 97) / 97;
                sum += color(c, 1500 * float(i % 1009) / 1009).y;
            }
            return sum;
        },
        5);
}

/// A bubble before a black background, among four windows. Each ray is split at the
/// film, so that the picture has no noise.
struct Studio {
    using Room = ljus::Scene<ljus::Shapes<ljus::Sphere, ljus::Quad>,
                             ljus::Materials<ljus::Lambertian, ljus::SoapFilm>>;
    ljus::SoapFilm film{
        .thickness = 900, .scale = 0.75f, .level{0, -1, 0}, .up{0, 1, 0}};
    ljus::World<Room> world{room(film)};

    static Room room(const ljus::SoapFilm& film) {
        Room scene;
        const auto black = scene.add(ljus::Lambertian{.albedo = Rgb{0}});
        scene.add(ljus::Sphere{}, scene.add(film));
        const auto window = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
            scene.add(ljus::Quad{corner, u, v}, black, Rgb{8});
        };
        window({-7, -3, -2}, {0, 8, 0}, {3, 0, 10}); // left
        window({7, -1, -2}, {-3, 0, 10}, {0, 5, 0}); // right
        window({-4, 7, -3}, {8, 0, 0}, {0, 0, 8});   // above
        window({-6, -4, 12}, {0, 9, 0}, {12, 0, 0}); // behind the camera
        return scene;
    }

    /// The light along a ray, with the film's colour by any method.
    template <typename Color>
    glm::dvec3 light(const ljus::Ray& ray, Color color, int depth) const {
        const auto hit = closest_hit(world, ray);
        if (!hit) return glm::dvec3(0);
        const auto at = vertex_at(world, ray, *hit);
        const Vec3 wo = to_local(at.frame, -ray.direction);
        if (hit->object.type == 1) return wo.z > 0 ? glm::dvec3(8) : glm::dvec3(0);
        if (depth == 0) return glm::dvec3(0);
        const glm::dvec3 r = color(std::min(1.0, std::abs(double(wo.z))),
                                   double(thickness_at(film, at.point.position)));
        const Vec3 back = to_world(at.frame, ljus::reflect(wo));
        return r * light(spawn_ray(at.point, back), color, depth - 1) +
               (1.0 - r) * light(spawn_ray(at.point, ray.direction), color, depth - 1);
    }
};

/// The bubble as seen from the front, with side x side rays per pixel.
template <typename Color>
Image bubble(int size, int side, Color color) {
    const Studio studio;
    const auto camera =
        ljus::look_at({.position{0, 0, 6}, .target{0, 0, 0}, .vfov_degrees = 22});
    Image image = ljus::make_image(size, size);
    ljus::parallel_blocks(size, [&](long long y) {
        for (int x = 0; x < size; ++x) {
            glm::dvec3 sum{0};
            for (int i = 0; i < side * side; ++i)
                sum += studio.light(
                    primary_ray(camera,
                                {(float(x) + (float(i % side) + 0.5f) / float(side)),
                                 (float(y) + (float(i / side) + 0.5f) / float(side))},
                                size, size),
                    color, 5);
            pixel(image, x, static_cast<int>(y)) = Rgb(sum / double(side * side));
        }
    });
    return image;
}

/// The colour by the renderer's table, with the arguments of the other methods.
auto by_table(const ljus::FilmTable& table) {
    return [&table](double c, double d) {
        return glm::dvec3(ljus::look_up(table, float(c), float(d)));
    };
}

constexpr std::array method_names{"three wavelengths", "integrated beforehand",
                                  "table"};

/// How far each method is from the spectrum, as ΔE*ab over angles and thicknesses.
struct Differences {
    std::array<double, 3> mean{}, largest{};
};

/// Plot: how far each method is from the spectrum at each thickness.
Differences plot_differences(const examples::Options& options,
                             const ljus::FilmTable& table) {
    const auto look = by_table(table);
    const int step = options.pick(20, 5, 2);
    examples::Plot plot{.name = "soap_film-error",
                        .columns = {"thickness in nm", "three wavelengths",
                                    "integrated beforehand", "table"},
                        .y_label = "difference of colour, ΔE*ab",
                        .log_y = true};
    Differences found;
    int count = 0;
    for (int d = step; d <= 1500; d += step) {
        examples::Row row{double(d), 0, 0, 0};
        for (int angle = 0; angle <= 70; angle += 10) {
            const double c = std::cos(angle * std::numbers::pi / 180);
            const glm::dvec3 right = lab(spectrum(c, d), c);
            const glm::dvec3 colors[] = {three(c, d), beforehand(c, d), look(c, d)};
            for (std::size_t i = 0; i < 3; ++i) {
                const double error = glm::distance(lab(colors[i], c), right);
                row[i + 1] += error / 8;
                found.mean[i] += error;
                found.largest[i] = std::max(found.largest[i], error);
            }
            ++count;
        }
        plot.rows.push_back(row);
    }
    save_plot(options.path(""), plot);
    for (double& mean : found.mean) mean /= count;
    return found;
}

/// Nanoseconds per colour, by each method.
std::array<double, 3> times_of(const ljus::FilmTable& table, int calls) {
    constexpr float n = 1.33f;
    return {
        nanoseconds([](float c, float d) { return ljus::film_three(c, n, d); }, calls),
        nanoseconds(
            [](float c, float d) {
                return ljus::into_gamut(ljus::film_preintegrated(c, n, d));
            },
            calls),
        nanoseconds([&](float c, float d) { return ljus::look_up(table, c, d); },
                    calls)};
}

/// The error of the picture of the bubble by each method; there is no noise in it.
std::array<double, 3> errors_of_bubble(const ljus::FilmTable& table, int size) {
    const Image right = bubble(size, 1, spectrum);
    return {ljus::rel_mse(bubble(size, 1, three), right),
            ljus::rel_mse(bubble(size, 1, beforehand), right),
            ljus::rel_mse(bubble(size, 1, by_table(table)), right)};
}

/// Table and plot: how far each method is from the spectrum, and what it costs.
void trade(const examples::Options& options, const ljus::FilmTable& table) {
    const Differences found = plot_differences(options, table);
    const auto times = times_of(table, options.pick(20000, 200000, 1000000));
    const double slow = nanoseconds(
        [](float c, float d) { return ljus::film_spectral(c, 1.33f, d); }, 200);
    const auto pictures = errors_of_bubble(table, options.pick(60, 150, 300));
    examples::Table numbers{
        .name = "soap_film-trade",
        .columns = {"colours by", "mean ΔE*ab", "largest ΔE*ab", "relMSE of the bubble",
                    "ns"},
        .rows = {{"spectrum", "0", "0", "0", examples::text(slow, "%.0f")}}};
    for (std::size_t i = 0; i < 3; ++i)
        numbers.rows.push_back({method_names[i], examples::text(found.mean[i], "%.1f"),
                                examples::text(found.largest[i], "%.1f"),
                                examples::text(pictures[i], "%.1e"),
                                examples::text(times[i], "%.0f")});
    examples::print_rows(numbers, 24);
    std::printf("table: %zu colours, %d mixed with grey, the worst had %.3f\n",
                table.cells.size(), table.greyed, double(table.worst));
    examples::save_table(options.path(""), numbers);
}

/// Plot: the reflectance of three wavelengths against the thickness.
void plot_reflectance(const std::string& folder) {
    examples::Plot plot{.name = "soap_film-waves",
                        .columns = {"thickness in nm", "611 nm", "464 nm", "549 nm"},
                        .y_label = "share that is reflected"};
    for (int d = 0; d <= 700; d += 5) {
        const auto at = [&](double wavelength) {
            return ljus::thin_film(1.0, water, double(d), wavelength).reflected;
        };
        plot.rows.push_back({double(d), at(611.4), at(464.3), at(549.1)});
    }
    save_plot(folder, plot);
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 17, the soap bubble: thin films and their colours.");
        const examples::Options options =
            line.parse({.draft{.width = 200, .height = 200, .samples = 4},
                        .report{.width = 400, .height = 400, .samples = 36},
                        .reference{.width = 500, .height = 500, .samples = 1000}});
        const auto table = ljus::bake_film_table(1.33f);
        const auto look = by_table(table);
        plot_reflectance(options.path(""));
        trade(options, table);
        strip(options, "soap_film-spectrum", spectrum);
        strip(options, "soap_film-three", three);
        strip(options, "soap_film-beforehand", beforehand);
        strip(options, "soap_film-table", look);
        strip(options, "soap_film-not-turned", not_turned);
        const auto save = [&](const std::string& name, auto color) {
            save_png(bubble(options.width, options.pick(2, 3, 4), color),
                     options.path(name + ".png"));
        };
        save("soap_film-bubble", look);
        save("soap_film-bubble-three", three);
        save("soap_film-bubble-beforehand", beforehand);
    });
}
