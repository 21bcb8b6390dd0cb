// smoke: --quality draft --bounces 100
/// \file chapters/experiments/10_experiments.cpp
/// \brief Chapter 10: the experiments behind its plots and its table: light between two
/// mirrors, and the rounding of a ray that is reflected again and again.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <ljus/ljus.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/plot.hpp"

namespace {

using ljus::Quad;
using ljus::Rgb;
using ljus::Vec3;
using ljus::Vec3T;

/// Two facing mirrors, `width` apart, under a lamp that spans all of the gap.
auto corridor(const Rgb& reflectance, float width, float height) {
    const ljus::Mirror mirror{.reflectance = reflectance};
    const float depth = 4;
    return ljus::World(ljus::make_scene(
        placed(Quad{{0, -1, -depth}, {0, 0, 2 * depth}, {0, height + 2, 0}}, mirror),
        placed(Quad{{width, -1, -depth}, {0, height + 2, 0}, {0, 0, 2 * depth}},
               mirror),
        placed(Quad{{0, height, -depth}, {width, 0, 0}, {0, 0, 2 * depth}},
               ljus::Lambertian{.albedo = Rgb{0}}, Rgb{1})));
}

/// Plot: the lamp after n reflections, traced, beside R to the power of n.
void plot_powers(const std::string& folder) {
    constexpr float width = 1, height = 1;
    const Rgb reflectance{0.95f, 0.9f, 0.8f};
    const auto world = corridor(reflectance, width, height);
    const ljus::PathTracer tracer(world, {.roulette_depth = 1000});
    examples::Plot plot{
        .name = "reflection-powers",
        .columns = {"reflections", "R = 0.95", "R = 0.9", "R = 0.8", "0.9^n"},
        .y_label = "radiance of the lamp's image",
        .log_y = true};
    double worst = 0;
    for (int n = 0; n <= 30; ++n) {
        // From the middle of the gap, so flat that the ray crosses it n times.
        const Vec3 way{width * float(n), height, 0};
        const ljus::Ray ray{.origin{width / 2, 0, 0}, .direction = glm::normalize(way)};
        ljus::RandomStream stream = ljus::random_stream(1, ljus::Pass::camera, 0, 0);
        ljus::Counts counts;
        auto context = ljus::context_of(stream, counts);
        const Rgb seen = radiance(tracer, ray, context);
        examples::Row row{double(n)};
        for (int channel = 0; channel < 3; ++channel) {
            row.push_back(double(seen[channel]));
            const double exact = std::pow(double(reflectance[channel]), n);
            worst = std::max(worst, std::abs(double(seen[channel]) / exact - 1));
        }
        row.push_back(std::pow(double(reflectance.y), n));
        plot.rows.push_back(row);
    }
    save_plot(folder, plot);
    std::printf("reflection-powers: largest error of R^n, n <= 30: %.1e\n", worst);
}

/// The report's form.
constexpr auto as_report = [](const auto& d, const auto& n) {
    return ljus::reflect(d, n);
};
/// The form of the textbooks.
constexpr auto by_textbook = [](const Vec3& d, const Vec3& n) {
    return d - 2 * glm::dot(d, n) * n;
};
/// The report's form, normalised.
constexpr auto made_unit = [](const Vec3& d, const Vec3& n) {
    return glm::normalize(ljus::reflect(d, n));
};

/// Unit normals in all directions, the same in each precision up to rounding.
template <typename T>
std::vector<Vec3T<T>> normals(int count) {
    std::vector<Vec3T<T>> result;
    ljus::RandomStream stream = ljus::random_stream(8, ljus::Pass::camera, 0, 0);
    for (int i = 0; i < count; ++i)
        result.push_back(
            Vec3T<T>(ljus::sample_uniform_sphere(next_2d<double>(stream))));
    return result;
}

/// | |R| - 1 | after each reflection.
template <typename T, typename Reflect>
std::vector<double> drift(const std::vector<Vec3T<T>>& mirrors, Reflect reflect) {
    Vec3T<T> d{0, 0, 1};
    std::vector<double> result;
    for (const Vec3T<T>& normal : mirrors) {
        d = reflect(d, normal);
        result.push_back(std::abs(glm::length(Vec3T<double>(d)) - 1));
    }
    return result;
}

/// Plot: the length of a direction after many reflections.
void plot_drift(const std::string& folder, int bounces) {
    const auto in_float = normals<float>(bounces);
    const auto in_double = normals<double>(bounces);
    const auto report = drift(in_float, as_report);
    const auto textbook = drift(in_float, by_textbook);
    const auto unit = drift(in_float, made_unit);
    const auto wide = drift(in_double, as_report);
    examples::Plot plot{.name = "reflection-drift",
                        .columns = {"reflections", "2I - D", "D - 2(D.N)N",
                                    "2I - D made unit again", "2I - D in double"},
                        .y_label = "| |R| - 1 |",
                        .log_x = true,
                        .log_y = true};
    // The worst between one power of two and the next.
    const auto largest = [](const std::vector<double>& errors, int first, int last) {
        return *std::max_element(errors.begin() + first - 1, errors.begin() + last);
    };
    for (int n = 1; n <= bounces; n *= 2) {
        const int last = std::min(2 * n - 1, bounces);
        plot.rows.push_back({double(n), largest(report, n, last),
                             largest(textbook, n, last), largest(unit, n, last),
                             largest(wide, n, last)});
    }
    save_plot(folder, plot);
}

/// Nanoseconds a call, the best of 21 runs over vectors that stay in the cache.
template <typename Reflect>
double nanoseconds(const std::vector<Vec3>& vectors, Reflect reflect) {
    return examples::nanoseconds_a_call(20.0 * double(vectors.size()), [&] {
        Vec3 sum{0};
        for (int round = 0; round < 20; ++round)
            for (std::size_t i = 1; i < vectors.size(); ++i)
                sum += reflect(vectors[i - 1], vectors[i]);
        return sum.x + sum.y + sum.z;
    });
}

/// Table: what each form costs, and how far it is off after one reflection.
void tabulate_trade(const std::string& folder) {
    const auto vectors = normals<float>(4096);
    const auto errors = [&](auto form) {
        double largest = 0;
        for (std::size_t i = 1; i < vectors.size(); ++i) {
            const Vec3T<double> exact =
                ljus::reflect(Vec3T<double>(vectors[i - 1]), Vec3T<double>(vectors[i]));
            const Vec3T<double> found(form(vectors[i - 1], vectors[i]));
            largest = std::max(largest, glm::length(found - exact));
        }
        return largest / std::ldexp(1.0, -24);
    };
    const auto row = [&](const char* name, auto form) {
        const std::string time = examples::text(nanoseconds(vectors, form), "%.2f");
        const std::string error = examples::text(errors(form), "%.1f u");
        std::printf("%-26s %s ns, largest error %s\n", name, time.c_str(),
                    error.c_str());
        return std::vector<std::string>{name, time, error};
    };
    examples::save_table(
        folder, {.name = "reflection-trade",
                 .columns = {"form, in float", "ns", "largest error"},
                 .rows = {row("2I - D", as_report), row("D - 2(D.N)N", by_textbook),
                          row("2I - D made unit again", made_unit)}});
}

} // namespace

/// Makes the plots and the table.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        int bounces = 100000;
        line.about("Chapter 10, reflection: many mirrors, and rounding.");
        line.add("--bounces", bounces, "Reflections of the ray in the drift plot", 1,
                 100000000);
        line.without({"--width", "--height", "--rays", "--seed", "--threads"});
        const examples::Options options = line.parse();
        plot_powers(options.path(""));
        plot_drift(options.path(""), bounces);
        tabulate_trade(options.path(""));
    });
}
