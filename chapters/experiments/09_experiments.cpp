// smoke: --quality draft --cases 200
/// \file chapters/experiments/09_experiments.cpp
/// \brief Chapter 9: the experiments behind its plot and its table: four solvers for
/// the same rays.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <ljus/geometry/metaballs.hpp>
#include <ljus/geometry/shape.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "experiments/numbers.hpp"

namespace {

using Balls = ljus::MetaballsT<double>;
using Ray = ljus::RayT<double>;
using Point = ljus::Vec3T<double>;
using examples::Numbers;

// --- The solvers ------------------------------------------------------------------

enum Way : std::size_t { pieces, radicals, bisection, tracing, way_count };
constexpr const char* way_names[] = {"pieces of the quartic", "radicals",
                                     "interval bisection", "sphere tracing"};

/// The first hit, NaN for a miss.
template <Way way>
double hit(const Ray& ray, const Balls& balls) {
    constexpr double miss = std::numeric_limits<double>::quiet_NaN();
    using ljus::intersect;
    if constexpr (way == pieces)
        return intersect(ray, balls).value_or(miss);
    else if constexpr (way == radicals)
        return intersect<ljus::Radicals>(ray, balls).value_or(miss);
    else if constexpr (way == bisection)
        return intersect<ljus::Bisection>(ray, balls).value_or(miss);
    else
        return intersect<ljus::SphereTracing>(ray, balls).value_or(miss);
}

/// A ray and its target.
struct Case {
    Ray ray;
    Balls balls;
};

/// Blobs in a heap, and a ray at them.
Case heap(Numbers& n, int blobs) {
    Case result;
    const double size = 0.6 * std::cbrt(blobs);
    for (int i = 0; i < blobs; ++i)
        result.balls.blobs.push_back(
            {n.direction() * (size * std::cbrt(n.next())), n.between(0.6, 1), 1});
    result.ray.origin = n.direction() * 8.0;
    result.ray.direction =
        glm::normalize(n.direction() * (size + 0.3) * n.next() - result.ray.origin);
    return result;
}

/// Two equal blobs, and a ray at them.
Case pair(Numbers& n) {
    Case result;
    const Point half = n.direction() * n.between(0.2, 0.95);
    result.balls.blobs = {{half, 1, 1}, {-half, 1, 1}};
    result.ray.origin = n.direction() * 5.0;
    result.ray.direction =
        glm::normalize(n.direction() * (1.4 * n.next()) - result.ray.origin);
    return result;
}

/// A ray that dips into a ball by `depth` radii, or passes it by as much.
Case graze(Numbers& n, double depth) {
    Case result{.ray{}, .balls{.blobs{{Point{0}, 1, 1}}}};
    const double r = std::sqrt(0.5); // of the ball, at level 1/4
    const Point way = n.direction(), side = glm::normalize(cross(way, n.direction()));
    const double in = n.next() < 0.5 ? -depth : depth;
    result.ray = {.origin = side * (r * (1 + in)) - 3.0 * way, .direction = way};
    return result;
}

/// The truth: the same in long double.
double truth(const Case& c) {
    using Long = long double;
    ljus::MetaballsT<Long> balls{.level = c.balls.level};
    for (const auto& b : c.balls.blobs)
        balls.blobs.push_back({ljus::Vec3T<Long>(b.center), b.radius, b.weight});
    const ljus::RayT<Long> ray{.origin = ljus::Vec3T<Long>(c.ray.origin),
                               .direction = ljus::Vec3T<Long>(c.ray.direction)};
    const auto t = intersect(ray, balls);
    return t ? static_cast<double>(*t) : std::numeric_limits<double>::quiet_NaN();
}

/// The errors of a solver.
struct Errors {
    double wrong = 0;    ///< Fraction of rays whose hit or miss is wrong.
    double distance = 0; ///< The largest distance |f|/|grad f| of a hit to the surface.
};

template <Way way>
Errors errors(const std::vector<Case>& cases, const std::vector<double>& truths) {
    Errors result;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double t = hit<way>(cases[i].ray, cases[i].balls);
        if (std::isnan(t) != std::isnan(truths[i])) result.wrong += 1;
        if (std::isnan(t)) continue;
        const Point x = point_at(cases[i].ray, t);
        result.distance =
            std::max(result.distance, std::abs(field(cases[i].balls, x)) /
                                          glm::length(gradient(cases[i].balls, x)));
    }
    result.wrong /= static_cast<double>(cases.size());
    return result;
}

std::array<Errors, way_count> all_errors(const std::vector<Case>& cases) {
    std::vector<double> truths;
    for (const Case& c : cases) truths.push_back(truth(c));
    return {errors<pieces>(cases, truths), errors<radicals>(cases, truths),
            errors<bisection>(cases, truths), errors<tracing>(cases, truths)};
}

/// Nanoseconds per ray, the best of some runs.
template <Way way>
double nanoseconds(const std::vector<Case>& cases) {
    return examples::nanoseconds_a_call(
        static_cast<double>(cases.size()),
        [&] {
            double sum = 0;
            for (const Case& c : cases) {
                const double t = hit<way>(c.ray, c.balls);
                if (t < 100) sum += t;
            }
            return sum;
        },
        7);
}

std::array<double, way_count> times(const std::vector<Case>& cases) {
    return {nanoseconds<pieces>(cases), nanoseconds<radicals>(cases),
            nanoseconds<bisection>(cases), nanoseconds<tracing>(cases)};
}

template <typename Make>
std::vector<Case> made(int count, Make make) {
    std::vector<Case> cases;
    for (int i = 0; i < count; ++i) cases.push_back(make());
    return cases;
}

/// Plot: wrong decisions against how deep the ray dips in.
void plot_grazing(const examples::Options& options, int count) {
    examples::Plot plot{.name = "metaballs-grazing",
                        .columns = {"how deep a ray dips in, or passes by, in radii"},
                        .y_label = "wrong hits and misses, %",
                        .rows = {},
                        .log_x = true};
    for (const char* name : way_names) plot.columns.emplace_back(name);
    Numbers n{3};
    for (int exponent = -30; exponent <= -2; ++exponent) {
        const double depth = std::pow(10.0, exponent / 2.0);
        const auto all = all_errors(made(count / 4, [&] { return graze(n, depth); }));
        examples::Row row{depth};
        for (const Errors& e : all) row.push_back(100 * e.wrong);
        plot.rows.push_back(row);
    }
    save_plot(options.path(""), plot);
}

/// Table: the cost and the errors of each solver.
void tabulate(const examples::Options& options, int count) {
    Numbers n{7};
    const auto heaps = made(count, [&] { return heap(n, 8); });
    const auto pairs = made(count, [&] { return pair(n); });
    const auto grazes =
        made(count, [&] { return graze(n, std::pow(10.0, n.between(-14, -2))); });
    const auto time_heap = times(heaps), time_pair = times(pairs),
               time_graze = times(grazes);
    const auto in_heap = all_errors(heaps), in_pair = all_errors(pairs),
               in_graze = all_errors(grazes);
    examples::Table table{.name = "metaballs-solvers",
                          .columns = {"", "8 blobs: ns", "wrong", "off by",
                                      "2 blobs: ns", "wrong", "off by", "grazing: ns",
                                      "wrong"}};
    const auto percent = [](double share) {
        return examples::text(100 * share, "%.2g %%");
    };
    for (std::size_t w = 0; w < way_count; ++w)
        table.rows.push_back(
            {way_names[w], examples::text(time_heap[w], "%.0f"),
             percent(in_heap[w].wrong), examples::text(in_heap[w].distance, "%.1e"),
             examples::text(time_pair[w], "%.0f"), percent(in_pair[w].wrong),
             examples::text(in_pair[w].distance, "%.1e"),
             examples::text(time_graze[w], "%.0f"), percent(in_graze[w].wrong)});
    save_table(options.path(""), table);
    if (options.quiet) return;
    examples::print_row(table.columns, 20);
    examples::print_rows(table, 20);
}

} // namespace

/// Makes the plot and the table.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 9: four solvers for the same rays at metaballs.");
        int cases = 0;
        line.add("--cases", cases, "Rays a family; 0: as the quality says", 0,
                 10000000);
        line.without({"--width", "--height", "--rays", "--seed", "--threads"});
        const examples::Options options = line.parse();
        if (cases == 0) cases = options.pick(3000, 40000, 400000);
        plot_grazing(options, cases);
        tabulate(options, cases);
    });
}
