// smoke: --quality draft --width 24 --height 16 --rays 1 --directions 20000
/// \file chapters/experiments/13_experiments.cpp
/// \brief Chapter 13: the experiments behind its tables and plots: three ways to draw a
/// direction, what each costs, and what a forgotten pdf does.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>

#include "common/example.hpp"
#include "experiments/sampler_plot.hpp"

namespace {

using ljus::Rgb;
using ljus::Sphere;
using ljus::Vec2T;
using ljus::Vec3T;
using Direction = Vec3T<double>;

constexpr double pi = std::numbers::pi;

/// The samplers that are compared. A sampler of your own goes here: `sample` turns a
/// point of the unit square into a unit vector with z > 0, `pdf` is its density.
struct Cosine {
    static constexpr const char* name = "cosine";
    template <typename T>
    static Vec3T<T> sample(const Vec2T<T>& u) {
        return ljus::sample_cosine_hemisphere(u);
    }
    template <typename T>
    static T pdf(const Vec3T<T>& d) {
        return ljus::pdf_cosine_hemisphere(d);
    }
};
struct Uniform {
    static constexpr const char* name = "uniform";
    template <typename T>
    static Vec3T<T> sample(const Vec2T<T>& u) {
        return ljus::sample_uniform_hemisphere(u);
    }
    template <typename T>
    static T pdf(const Vec3T<T>& d) {
        return ljus::pdf_uniform_hemisphere(d);
    }
};
struct Naive {
    static constexpr const char* name = "naive";
    template <typename T>
    static Vec3T<T> sample(const Vec2T<T>& u) {
        return ljus::sample_naive_hemisphere(u);
    }
    template <typename T>
    static T pdf(const Vec3T<T>& d) {
        return ljus::pdf_naive_hemisphere(d);
    }
};
/// Naive directions that are counted as if they were cosine-weighted.
struct Forgotten : Naive {
    static constexpr const char* name = "naive, pdf forgotten";
    template <typename T>
    static T pdf(const Vec3T<T>& d) {
        return ljus::pdf_cosine_hemisphere(d);
    }
};

/// Light from above: everywhere the same, or a bright lobe of 10 degrees.
struct Sky {
    double tilt = -1; ///< Of the lobe, degrees from the normal; -1: no lobe.

    /// The radiance from a direction.
    [[nodiscard]] double operator()(const Direction& d) const {
        if (tilt < 0) return 1;
        const double angle = tilt * pi / 180;
        const Direction axis{std::sin(angle), 0, std::cos(angle)};
        return glm::dot(d, axis) > std::cos(10 * pi / 180) ? 10.0 : 0.0;
    }
};

/// The mean of an estimator of the irradiance over u, and its variance.
struct Moments {
    double mean = 0;     ///< W/m^2.
    double variance = 0; ///< Of one sample.
};

/// Both by a grid over the unit square, without random numbers: the lobe covers about a
/// hundred of its rows.
template <typename Way>
Moments moments(const Sky& sky, int size) {
    double sum = 0, squares = 0;
    for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) {
            const Direction d =
                Way::sample(Vec2T<double>{(i + 0.5) / size, (j + 0.5) / size});
            const double value = sky(d) * d.z / Way::pdf(d);
            sum += value;
            squares += value * value;
        }
    const double count = double(size) * size;
    return {sum / count, squares / count - (sum / count) * (sum / count)};
}
/// Table: the variance of each way under four skies.
template <typename... Way>
void tabulate_variance(const std::string& folder, int size) {
    const Sky skies[] = {{}, {0}, {45}, {80}};
    examples::Table table{.name = "hemisphere-variance",
                          .columns = {"variance of one sample", "constant sky",
                                      "lobe at 0°", "at 45°", "at 80°", "means"}};
    const auto add = [&](auto way) {
        std::vector<std::string> row{decltype(way)::name};
        std::string means;
        for (const Sky& sky : skies) {
            const Moments found = moments<decltype(way)>(sky, size);
            // Rounding may turn a variance of 0 into -0.00.
            row.push_back(examples::text(std::abs(found.variance), "%.2f"));
            means += (means.empty() ? "" : "  ") + examples::text(found.mean, "%.3f");
        }
        row.push_back(means);
        examples::print_row(row, 22);
        table.rows.push_back(row);
    };
    (add(Way{}), ...);
    save_table(folder, table);
}

/// A diffuse surface that draws its directions in one of the ways.
template <typename Way>
struct Matt {
    using Scalar = float; ///< The precision.
    Rgb albedo{0.5f};     ///< In [0, 1].
};
template <typename Way>
ljus::Lobes lobes(const Matt<Way>&) {
    return ljus::Lobes::diffuse;
}
template <typename Way>
Rgb evaluate(const Matt<Way>& matt, const ljus::Vec3& wo, const ljus::Vec3& wi) {
    return evaluate(ljus::Lambertian{.albedo = matt.albedo}, wo, wi);
}
template <typename Way>
float pdf(const Matt<Way>&, const ljus::Vec3& wo, const ljus::Vec3& wi,
          ljus::Lobes = ljus::Lobes::all) {
    if (!ljus::same_side(wo, wi)) return 0;
    return Way::pdf(ljus::Vec3{wi.x, wi.y, std::abs(wi.z)});
}
template <typename Way>
std::optional<ljus::BsdfSample> sample(const Matt<Way>& matt, const ljus::Vec3& wo,
                                       const ljus::Vec3& u, ljus::Transport,
                                       ljus::Lobes which = ljus::Lobes::all) {
    if (!has(which, ljus::Lobes::non_specular) || wo.z == 0) return std::nullopt;
    ljus::Vec3 wi = Way::sample(ljus::Vec2{u.x, u.y});
    const float density = Way::pdf(wi);
    const Rgb weight = matt.albedo * std::numbers::inv_pi_v<float> * wi.z / density;
    wi.z = std::copysign(wi.z, wo.z);
    return ljus::diffuse_sample(wi, weight, density);
}
template <typename Way>
void check(const Matt<Way>&) {}

/// A ball on a floor, under a sky that glows or under a lamp. There are no shadow rays,
/// so that the light which paths find depends on the sampler alone.
template <typename Way>
ljus::Image picture(const examples::Options& options, const std::string& name,
                    bool lamp, int rays) {
    using Scene = ljus::Scene<ljus::Shapes<Sphere, ljus::Quad>,
                              ljus::Materials<Matt<Way>, ljus::Lambertian>>;
    Scene scene;
    const auto matt = scene.add(Matt<Way>{.albedo{0.75f, 0.6f, 0.5f}});
    const auto floor = scene.add(Matt<Way>{.albedo = Rgb{0.5f}});
    const auto black = scene.add(ljus::Lambertian{.albedo = Rgb{0}});
    scene.add(ljus::Quad{{-6, 0, 6}, {12, 0, 0}, {0, 0, -12}}, floor);
    scene.add(Sphere{.center{0, 1, 0}, .radius = 1}, matt);
    if (lamp)
        scene.add(Sphere{.center{0.5f, 6, 0.8f}, .radius = 1.1f}, black, Rgb{14});
    else
        scene.add(Sphere{.center{0, 0, 0}, .radius = 40}, black, Rgb{0.7f}, true);
    const auto camera =
        ljus::look_at({.position{0, 2.4f, 6}, .target{0, 0.8f, 0}, .vfov_degrees = 32});
    const ljus::World world(std::move(scene));
    const ljus::PathTracer tracer(world, {.sample_lights = false});
    auto picture = examples::picture_settings(options);
    picture.samples = rays;
    return examples::rendered(name, tracer, camera, picture, options).image;
}

/// Nanoseconds for a direction and its density, the best of 21 runs.
template <typename Way>
double nanoseconds() {
    std::vector<ljus::Vec2> points;
    ljus::RandomStream stream = ljus::random_stream(11, ljus::Pass::user, 0, 0);
    for (int i = 0; i < 4096; ++i) points.push_back(next_2d<float>(stream));
    return examples::nanoseconds_a_call(double(points.size()), [&] {
        float sum = 0;
        for (const ljus::Vec2& u : points) {
            const ljus::Vec3 d = Way::sample(u);
            sum += d.x + d.y + d.z / Way::pdf(d);
        }
        return sum;
    });
}

/// Pictures under a sky and under a lamp, and the table of their errors.
void tabulate_pictures(const examples::Options& options) {
    examples::Options other = options;
    other.seed = options.seed + 1000;
    const int many = 16 * options.samples;
    const ljus::Image sky =
        picture<Cosine>(other, "reference under the sky", false, many);
    const ljus::Image lamp =
        picture<Cosine>(other, "reference under the lamp", true, many);
    examples::Table table{.name = "hemisphere-pictures",
                          .columns = {"", "ns", "relMSE, sky", "relMSE, lamp",
                                      "block error, sky", "block error, lamp"}};
    const auto add = [&](auto way) {
        using W = decltype(way);
        const auto a = picture<W>(options, "sky", false, options.samples);
        const auto b = picture<W>(options, "lamp", true, options.samples);
        if constexpr (std::is_same_v<W, Forgotten>)
            save_png(b, options.path("hemisphere-forgotten-lamp.png"));
        std::vector<std::string> row{
            W::name,
            examples::text(nanoseconds<W>(), "%.1f"),
            examples::text(ljus::rel_mse(a, sky), "%.3f"),
            examples::text(ljus::rel_mse(b, lamp), "%.3f"),
            examples::text(ljus::block_error(a, sky), "%.5f"),
            examples::text(ljus::block_error(b, lamp), "%.4f")};
        examples::print_row(row, 22);
        table.rows.push_back(row);
    };
    add(Cosine{});
    add(Uniform{});
    add(Naive{});
    add(Forgotten{});
    examples::save_table(options.path(""), table);
}

/// Scatter plots, histograms and p of each sampler against its pdf.
// [check all]
void check_all(const std::string& folder, int directions) {
    const auto check = [&](auto way, const std::string& file) {
        using W = decltype(way);
        const auto found = examples::plot_sampler(
            folder, file, [](const Vec2T<double>& u) { return W::sample(u); },
            [](const Direction& d) { return W::pdf(d); }, directions);
        std::printf("%-22s the pdf integrates to %.4f, chi-square p = %.3g\n", W::name,
                    found.integral, found.p);
    };
    check(Cosine{}, "hemisphere-cosine");
    check(Uniform{}, "hemisphere-uniform");
    check(Naive{}, "hemisphere-naive");
    check(Forgotten{}, "hemisphere-forgotten");
}
// [check all]

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        int directions = 100000;
        line.about("Chapter 13, directions: three samplers and a forgotten pdf.");
        line.add("--directions", directions, "Directions for each chi-square test",
                 10000, 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 150, .height = 100, .samples = 64},
                        .report{.width = 480, .height = 320, .samples = 64},
                        .reference{.width = 480, .height = 320, .samples = 1024}});
        const std::string folder = options.path("");
        check_all(folder, directions);
        tabulate_variance<Cosine, Uniform, Naive, Forgotten>(
            folder, options.pick(1000, 4000, 8000));
        tabulate_pictures(options);
    });
}
