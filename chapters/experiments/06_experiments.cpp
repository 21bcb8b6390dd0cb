// smoke: --quality draft --cases 2000
/// \file chapters/experiments/06_experiments.cpp
/// \brief Chapter 6: the experiments behind its plot and its table: how often the
/// printed formula fails, and what a better one costs.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/intersect.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "experiments/numbers.hpp"
#include "ljus/geometry/sphere.hpp"

using ljus::Ray;
using ljus::Sphere;
using ljus::Vec3;

namespace {

using Point = ljus::Vec3T<double>;
using examples::Numbers;

/// A ray of float numbers from `distance` radii away towards the disc of `reach` radii
/// around the centre of the unit sphere.
Ray random_ray(Numbers& numbers, double distance, double reach) {
    const Point origin = distance * numbers.direction();
    const Point across = glm::normalize(glm::cross(origin, numbers.direction()));
    const Point aim = reach * std::sqrt(numbers.next()) * across;
    return {.origin = Vec3(origin), .direction = Vec3(glm::normalize(aim - origin))};
}

/// The ways to intersect that are compared.
enum Way { printed, glms, robust, in_double, way_count };
constexpr const char* way_names[] = {"as printed", "glm", "robust", "robust in double"};

/// The distance to the hit, NaN for a miss.
template <Way way>
float hit(const Ray& ray, const Sphere& sphere) {
    constexpr float miss = std::numeric_limits<float>::quiet_NaN();
    if constexpr (way == printed) {
        return ljus::intersect_as_printed(ray, sphere).value_or(miss);
    } else if constexpr (way == glms) {
        float t = 0;
        const bool found = glm::intersectRaySphere(
            ray.origin, ray.direction, sphere.center, sphere.radius * sphere.radius, t);
        return found ? t : miss;
    } else if constexpr (way == robust) {
        return ljus::intersect(ray, sphere).value_or(miss);
    } else {
        return ljus::intersect<double>(ray, sphere).value_or(miss);
    }
}

/// The errors of a way on some rays.
struct Errors {
    double wrong = 0;     ///< Fraction of rays whose hit or miss is wrong.
    double largest_t = 0; ///< Largest error of t, in radii, where both hit.
};

/// The truth: the same numbers in long double, or in double where that is all there is.
double truth(const Ray& ray, const Sphere& sphere) {
    using Long = long double;
    const ljus::RayT<Long> r{.origin = ljus::Vec3T<Long>(ray.origin),
                             .direction = ljus::Vec3T<Long>(ray.direction)};
    const ljus::SphereT<Long> s{.center = ljus::Vec3T<Long>(sphere.center),
                                .radius = Long(sphere.radius)};
    const auto t = ljus::intersect(r, s);
    return t ? static_cast<double>(*t) : std::numeric_limits<double>::quiet_NaN();
}

template <Way way>
Errors errors(const std::vector<Ray>& rays, const std::vector<double>& truths) {
    Errors result;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const double t = static_cast<double>(hit<way>(rays[i], Sphere{}));
        if (std::isnan(t) != std::isnan(truths[i]))
            ++wrong;
        else if (!std::isnan(t))
            result.largest_t = std::max(result.largest_t, std::abs(t - truths[i]));
    }
    result.wrong = static_cast<double>(wrong) / static_cast<double>(rays.size());
    return result;
}

/// The errors of all ways from one distance.
std::vector<Errors> errors_at(double distance, std::size_t count, std::uint64_t seed) {
    Numbers numbers{seed};
    std::vector<Ray> rays;
    std::vector<double> truths;
    for (std::size_t i = 0; i < count; ++i) {
        rays.push_back(random_ray(numbers, distance, 1.25));
        truths.push_back(truth(rays.back(), Sphere{}));
    }
    return {errors<printed>(rays, truths), errors<glms>(rays, truths),
            errors<robust>(rays, truths), errors<in_double>(rays, truths)};
}

/// Plot: wrong decisions against the distance.
void plot_errors(const std::string& folder, std::size_t count) {
    examples::Plot wrong{.name = "sphere-wrong",
                         .columns = {"distance of the origin in radii"},
                         .y_label = "wrong hits and misses, %",
                         .rows = {},
                         .log_x = true,
                         .log_y = true};
    for (const char* name : way_names) wrong.columns.emplace_back(name);
    for (int step = 2; step <= 24; ++step) {
        const double distance = std::pow(10.0, step / 4.0);
        const auto all = errors_at(distance, count, static_cast<std::uint64_t>(step));
        examples::Row row{distance};
        for (const Errors& e : all) {
            // A logarithmic axis has no 0: nothing is drawn there.
            const double nothing = std::numeric_limits<double>::quiet_NaN();
            row.push_back(e.wrong > 0 ? 100 * e.wrong : nothing);
        }
        wrong.rows.push_back(row);
    }
    examples::save_plot(folder, wrong);
}

/// Nanoseconds for one intersection in the loop of a small scene, which looks for the
/// nearest of eight spheres. The best of 21 runs: other programs can only add time.
template <Way way>
double nanoseconds() {
    Numbers numbers;
    std::vector<Sphere> spheres;
    for (int i = 0; i < 8; ++i)
        spheres.push_back({.center = Vec3(3.0 * numbers.direction()), .radius = 0.8f});
    std::vector<Ray> rays;
    for (int i = 0; i < 4096; ++i) rays.push_back(random_ray(numbers, 8, 3));

    constexpr int rounds = 10;
    const auto tests = double(rounds) * double(rays.size() * spheres.size());
    return examples::nanoseconds_a_call(tests, [&] {
        float sum = 0;
        for (int round = 0; round < rounds; ++round)
            for (const Ray& ray : rays) {
                float nearest = 100;
                for (const Sphere& sphere : spheres) {
                    const float t = hit<way>(ray, sphere);
                    if (t < nearest) nearest = t;
                }
                sum += nearest;
            }
        return sum;
    });
}

/// Table: the cost and the errors of each way.
void tabulate_trade(const std::string& folder, std::size_t count) {
    const double times[] = {nanoseconds<printed>(), nanoseconds<glms>(),
                            nanoseconds<robust>(), nanoseconds<in_double>()};
    const double distances[] = {10, 1e3, 1e4, 1e6};
    examples::Table table{
        .name = "sphere-trade", .columns = {"", "ns", "ratio"}, .rows = {}};
    std::vector<std::vector<Errors>> all;
    for (const double distance : distances) {
        table.columns.push_back("at " + examples::text(distance, "%.0f") + " R");
        all.push_back(errors_at(distance, count, 99));
    }
    table.columns.emplace_back("t at 1000 R");
    for (std::size_t way = 0; way < way_count; ++way) {
        std::vector<std::string> row{way_names[way], examples::text(times[way], "%.1f"),
                                     examples::text(times[way] / times[0], "%.2f")};
        for (const auto& at_distance : all)
            row.push_back(examples::text(100 * at_distance[way].wrong, "%.2g %%"));
        row.push_back(examples::text(all[1][way].largest_t, "%.2g R"));
        table.rows.push_back(row);
    }
    examples::save_table(folder, table);
    examples::print_row(table.columns, 16);
    examples::print_rows(table, 16);
}

} // namespace

/// Makes the chapter's plot and table.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long cases = 0;
        line.about("Chapter 6, the sphere: its plot and its table.");
        line.add("--cases", cases, "Rays a distance", 1, 100000000);
        line.without({"--width", "--height", "--rays", "--seed", "--threads"});
        const examples::Options options = line.parse();
        if (!line.given("--cases")) cases = options.pick(100000, 200000, 5000000);
        const auto rays = static_cast<std::size_t>(cases);
        plot_errors(options.out, rays);
        tabulate_trade(options.out, rays);
    });
}
