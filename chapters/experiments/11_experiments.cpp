// smoke: --quality draft --width 24 --height 16 --rays 1 --calls 1000
/// \file chapters/experiments/11_experiments.cpp
/// \brief Chapter 11: the experiments behind its plot and pictures: how well
/// Snell's law is kept, and two mistakes.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <ljus/ljus.hpp>

#include "common/example.hpp"

namespace {

using ljus::Quad;
using ljus::Rgb;
using ljus::Sphere;
using ljus::Triangle;
using ljus::Vec3;
using ljus::Vec3T;

/// What can be wrong with glass.
enum class Error { none, total_reflection_ignored, index_swapped };

/// Glass with a mistake that is easy to make.
struct MistakenGlass {
    using Scalar = float; ///< The precision.
    ljus::Glass glass;    ///< The glass as it should be.
    Error error = Error::none;
};
ljus::Lobes lobes(const MistakenGlass&) {
    return ljus::Lobes::specular;
}
Rgb evaluate(const MistakenGlass&, const Vec3&, const Vec3&) {
    return Rgb{0};
}
float pdf(const MistakenGlass&, const Vec3&, const Vec3&,
          ljus::Lobes = ljus::Lobes::all) {
    return 0;
}
void check(const MistakenGlass& mistaken) {
    check(mistaken.glass);
}
/// The sample of the right glass, except where the mistake shows.
std::optional<ljus::BsdfSample> sample(const MistakenGlass& mistaken, const Vec3& wo,
                                       const Vec3& u, ljus::Transport transport,
                                       ljus::Lobes which = ljus::Lobes::all) {
    const bool inside = wo.z < 0;
    ljus::Glass glass = mistaken.glass;
    const float index = glass.index;
    if (mistaken.error == Error::index_swapped) glass.index = 1 / index;
    const bool total = inside && !ljus::refract(wo, index);
    if (mistaken.error == Error::total_reflection_ignored && total)
        return std::nullopt; // no refracted ray: black
    return sample(glass, wo, u, transport, which);
}
/// A tetrahedron and a ball of glass in a room with coloured walls.
void picture(const examples::Options& options, const std::string& name, Error error) {
    const MistakenGlass glass{.glass{.index = 1.5f}, .error = error};
    const auto matt = [](float r, float g, float b) {
        return ljus::Lambertian{.albedo{r, g, b}};
    };
    // Sides of 2, on the floor.
    const Vec3 a{-1.9f, 0.01f, 0.6f}, b{0.1f, 0.01f, 0.9f}, c{-0.75f, 0.01f, -1.0f},
        top{-0.85f, 1.7f, 0.2f};
    const ljus::World world(ljus::make_scene(
        placed(Quad{{-3, 0, 3}, {6, 0, 0}, {0, 0, -6}}, matt(0.7f, 0.7f, 0.7f)),
        placed(Quad{{-3, 4, -3}, {6, 0, 0}, {0, 0, 6}}, matt(0.7f, 0.7f, 0.7f)),
        placed(Quad{{-3, 0, -3}, {6, 0, 0}, {0, 4, 0}}, matt(0.75f, 0.7f, 0.45f)),
        placed(Quad{{-3, 0, 3}, {0, 0, -6}, {0, 4, 0}}, matt(0.75f, 0.3f, 0.2f)),
        placed(Quad{{3, 0, 3}, {0, 4, 0}, {0, 0, -6}}, matt(0.2f, 0.4f, 0.75f)),
        placed(Quad{{-3, 0, 3}, {0, 4, 0}, {6, 0, 0}}, matt(0.5f, 0.5f, 0.5f)),
        placed(Quad{{-1, 3.99f, -1}, {2, 0, 0}, {0, 0, 2}}, matt(0.5f, 0.5f, 0.5f),
               Rgb{7}),
        placed(Sphere{.center{1.25f, 0.81f, 0.3f}, .radius = 0.8f}, glass),
        placed(Triangle{a, b, top}, glass), placed(Triangle{b, c, top}, glass),
        placed(Triangle{c, a, top}, glass), placed(Triangle{a, c, b}, glass)));
    const auto camera = ljus::look_at(
        {.position{0.1f, 1.9f, 2.9f}, .target{0.05f, 0.75f, 0}, .vfov_degrees = 62});
    ljus::PhotonMappingSettings settings{
        .max_depth = 12,
        .caustics{.photons = options.pick(100000, 1000000, 10000000)},
        .caustics_estimate{.radius = options.pick(0.1f, 0.05f, 0.02f)}};
    settings.caustics.threads = options.threads;
    const ljus::PhotonMapper mapper(world, settings);
    const auto result = examples::rendered(name, mapper, camera, options);
    save_png(result.image, options.path(name + ".png"));
}

/// Snell's law in angles, as the report prints it. D travels towards the surface; z is
/// the normal.
template <typename T>
std::optional<Vec3T<T>> refract_by_angles(const Vec3T<T>& d, T eta) {
    const T theta_1 = std::acos(-d.z);
    const T sin_2 = eta * std::sin(theta_1);
    if (!(sin_2 <= T(1))) return std::nullopt;
    const T theta_2 = std::asin(sin_2);
    const T phi = std::atan2(d.y, d.x);
    return Vec3T<T>{std::sin(theta_2) * std::cos(phi),
                    std::sin(theta_2) * std::sin(phi), -std::cos(theta_2)};
}
/// The ways that are compared; each takes D towards the surface, whose normal is z.
constexpr auto by_angles = [](const Vec3& d, float eta) {
    return refract_by_angles(d, eta);
};
constexpr auto by_glm = [](const Vec3& d, float eta) -> std::optional<Vec3> {
    const Vec3 t = glm::refract(d, Vec3{0, 0, 1}, eta);
    if (t == Vec3{0}) return std::nullopt;
    return t;
};
constexpr auto in_world = [](const Vec3& d, float eta) {
    return ljus::refract(d, Vec3{0, 0, 1}, eta);
};
constexpr auto in_frame = [](const Vec3& d, float eta) {
    return ljus::refract(-d, eta);
};

/// Directions that pass a boundary of index ratio eta: a third of them within a
/// thousandth of the critical angle, a third close to the normal.
std::vector<Vec3> passing(double eta, int count) {
    std::vector<Vec3> result;
    ljus::RandomStream stream = ljus::random_stream(9, ljus::Pass::camera, 0, 0);
    const double most = std::min(1.0, 1 / eta);
    for (int i = 0; i < count; ++i) {
        const auto u = next_2d<double>(stream);
        const double sine = most * (i % 3 == 0   ? u.x
                                    : i % 3 == 1 ? 1 - std::pow(10, -3 - 4 * u.x)
                                                 : std::pow(10, -6 * u.x));
        const double phi = 2 * std::numbers::pi * u.y;
        result.emplace_back(sine * std::cos(phi), sine * std::sin(phi),
                            -std::sqrt((1 - sine) * (1 + sine)));
    }
    return result;
}

/// The larger of | |T| - 1 | and the residual of Snell's law, over all directions, in
/// units of roundoff.
template <typename Refract>
double largest_error(double eta, int count, Refract refract) {
    double largest = 0;
    for (const Vec3& d : passing(eta, count)) {
        const auto t = refract(d, float(eta));
        if (!t) continue;
        const Vec3T<double> exact(d), found(*t);
        const double sine = std::hypot(exact.x, exact.y) / glm::length(exact);
        const double sine_t = std::hypot(found.x, found.y) / glm::length(found);
        const double snell = std::abs(sine_t - double(float(eta)) * sine);
        largest = std::max({largest, std::abs(glm::length(found) - 1), snell});
    }
    return largest / std::ldexp(1.0, -24);
}

/// Plot: the error of each way against the ratio of the indices.
void plot_errors(const std::string& folder, int calls) {
    examples::Plot plot{.name = "refraction-error",
                        .columns = {"n_1 / n_2", "by angles", "glm::refract",
                                    "ljus::refract", "ljus::refract in the frame"},
                        .y_label = "largest error in units of roundoff",
                        .log_x = true,
                        .log_y = true};
    for (int i = -12; i <= 12; ++i) {
        const double eta = std::pow(10, i / 4.0);
        plot.rows.push_back({eta, largest_error(eta, calls, by_angles),
                             largest_error(eta, calls, by_glm),
                             largest_error(eta, calls, in_world),
                             largest_error(eta, calls, in_frame)});
    }
    save_plot(folder, plot);
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        int calls = 100000;
        line.about("Chapter 11, refraction: Snell's law, and two mistakes.");
        line.add("--calls", calls, "Rays for each error of the plot", 3, 10000000);
        const examples::Options options =
            line.parse({.draft{.width = 270, .height = 180, .samples = 32},
                        .report{.width = 600, .height = 400, .samples = 64},
                        .reference{.width = 900, .height = 600, .samples = 4096}});
        plot_errors(options.path(""), calls);
        picture(options, "refraction", Error::none);
        picture(options, "refraction-no-total", Error::total_reflection_ignored);
        picture(options, "refraction-swapped", Error::index_swapped);
    });
}
