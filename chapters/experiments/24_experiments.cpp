// smoke: --quality draft --points 3000 --photons 500 --width 60
/// \file chapters/experiments/24_experiments.cpp
/// \brief Chapter 24: the boxes of a k-d tree, and the cost of a search beside other
/// structures.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "../benchmarks/point_structures.hpp"
#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "experiments/show_table.hpp"
#include "ljus/accel/kd_tree.hpp"
#include "ljus/accel/kd_tree8.hpp"
#include "ljus/io/png.hpp"
#include "ljus/math/random.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/scenes/report_rooms.hpp"

using namespace ljus;

namespace {

// --- Pictures: photons of the floor, seen from above ----------------------------------

/// The positions of photons on the floor of the report's room, with those behind its
/// glass ball included.
std::vector<Vec3> on_floor(const examples::Options& options, long long photons) {
    const auto room = final_room<float>();
    std::vector<Vec3> points;
    for (const MapType law : {MapType::general, MapType::caustics}) {
        const auto traced =
            trace_photons(room.world, law,
                          {.photons = law == MapType::general ? photons : 2 * photons,
                           .seed = options.seed,
                           .shadow_photons = false});
        for (const Photon& photon : traced.photons)
            if (photon.normal.z > 120) points.push_back(photon.position);
    }
    float floor = 1e30f;
    for (const Vec3& p : points) floor = std::min(floor, p.z);
    std::erase_if(points, [&](const Vec3& p) { return p.z > floor + 1e-3f; });
    return points;
}

/// A map of the floor.
struct Plan {
    Image image; ///< What is drawn.
    Vec3 low{0}; ///< The corner of the floor.
    float scale; ///< Pixels a unit.

    Plan(const std::vector<Vec3>& points, int width) {
        Vec3 high = low = points.empty() ? Vec3{0} : points[0];
        for (const Vec3& p : points) low = glm::min(low, p), high = glm::max(high, p);
        scale = float(width - 1) / std::max(high.x - low.x, 1e-6f);
        image = make_image(width, int(scale * (high.y - low.y)) + 1);
    }
    int x_of(float x) const {
        return std::clamp(int(scale * (x - low.x)), 0, image.width - 1);
    }
    int y_of(float y) const {
        return std::clamp(int(scale * (y - low.y)), 0, image.height - 1);
    }
    void dot(const Vec3& p, const Rgb& color) {
        const int x = x_of(p.x), y = y_of(p.y);
        pixel(image, x, y) = color;
        pixel(image, std::min(x + 1, image.width - 1), y) = color;
        pixel(image, x, std::min(y + 1, image.height - 1)) = color;
    }
    void box(const Vec3& a, const Vec3& b, const Rgb& color) {
        const int x0 = x_of(a.x), x1 = x_of(b.x), y0 = y_of(a.y), y1 = y_of(b.y);
        for (int x = x0; x <= x1; ++x)
            pixel(image, x, y0) = pixel(image, x, y1) = color;
        for (int y = y0; y <= y1; ++y)
            pixel(image, x0, y) = pixel(image, x1, y) = color;
    }
};

/// The boxes of all ranges after some halvings, over the photons.
void draw_boxes(const examples::Options& options, const std::vector<Vec3>& points) {
    const KdTree8 tree{std::span<const Vec3>(points)};
    for (const int depth : {2, 4, 6, 8, 99}) {
        Plan plan(points, options.width);
        for (const Vec3& p : points) plan.dot(p, Rgb{0.5f});
        const int halvings = std::min(depth, tree.halvings());
        for (std::uint64_t i = 0; i < 1ull << halvings; ++i) {
            const auto first = tree.first_point(halvings, i);
            const auto last = tree.first_point(halvings, i + 1);
            Vec3 low = tree.point(first), high = low;
            for (auto j = first; j < last; ++j) {
                low = glm::min(low, tree.point(j));
                high = glm::max(high, tree.point(j));
            }
            plan.box(low, high, Rgb{0.9f, 0.35f, 0.05f});
        }
        const std::string name =
            depth == 99 ? std::string("leaves") : std::to_string(depth);
        save_png(plan.image, options.path("kd_tree-boxes-" + name + ".png"));
    }
    if (!options.quiet)
        std::printf("%zu photons on the floor, %d halvings\n", points.size(),
                    tree.halvings());
}

// --- Times ----------------------------------------------------------------------------

/// The median time of a call, in nanoseconds, over three rounds of some calls.
template <typename Call>
double time_of(int calls, Call&& call) {
    std::array<double, 3> rounds{};
    for (double& round : rounds) {
        const double start = examples::processor_seconds();
        for (int i = 0; i < calls; ++i) call(i);
        round = (examples::processor_seconds() - start) * 1e9 / calls;
    }
    std::sort(rounds.begin(), rounds.end());
    return rounds[1];
}

/// All points in turn.
struct BruteForce {
    std::vector<Vec3> points;
    template <typename Visit>
    void visit_within(const Vec3& center, float radius, Visit visit) const {
        const double limit2 = double(radius) * double(radius);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double d2 = distance2(points[i], center);
            if (d2 <= limit2) visit(static_cast<std::uint32_t>(i), d2);
        }
    }
    std::size_t bytes() const { return points.size() * sizeof(Vec3); }
};

/// The radius that holds 50 points, as the median over centres.
float radius_of_50(const KdTree8& tree, const std::vector<Vec3>& centers) {
    std::vector<double> radii;
    std::array<Neighbor, 50> room;
    for (const Vec3& center : centers) {
        (void)tree.nearest(center, 1e30f, std::span(room));
        radii.push_back(std::sqrt(room[0].distance2));
    }
    std::nth_element(radii.begin(), radii.begin() + std::ptrdiff_t(radii.size() / 2),
                     radii.end());
    return float(radii[radii.size() / 2]);
}

double sink = 0; // sum of the results, so that no search is optimised away

/// Times of one structure: building, all within a ball, the 50 nearest.
template <typename Make>
examples::Row measure(const std::vector<Vec3>& centers, float radius, int calls,
                      Make make) {
    const double start = examples::processor_seconds();
    const auto structure = make();
    const double build = examples::processor_seconds() - start;
    const auto center = [&](int i) { return centers[std::size_t(i) % centers.size()]; };
    const double ball = time_of(calls, [&](int i) {
        structure.visit_within(center(i), radius,
                               [&](std::uint32_t, double d2) { sink += d2; });
    });
    std::array<Neighbor, 50> room;
    const double nearest = time_of(calls, [&](int i) {
        if constexpr (requires { structure.nearest(Vec3{}, 1.0f, std::span(room)); })
            sink += double(structure.nearest(center(i), 1e30f, std::span(room)));
        else
            sink += double(
                structures::nearest_by_balls(structure, center(i), radius, room));
    });
    double bytes = 0;
    if constexpr (requires { structure.bytes(); })
        bytes = double(structure.bytes());
    else // the plain tree: points, order, and a box for each range
        bytes = double(structure.size()) * 16 +
                24 * 2 * std::exp2(std::ceil(std::log2(double(structure.size()) / 16)));
    return {build, ball, nearest, bytes};
}

/// The table of structures, for photons on walls and in caustics.
void compare_structures(const examples::Options& options, int count) {
    RandomStream stream = random_stream(options.seed, Pass::user, 0, 0);
    const auto unit = [&] { return next_1d(stream); };
    for (const bool walls : {true, false}) {
        const auto points = walls ? structures::on_walls(std::size_t(count), unit)
                                  : structures::in_caustics(std::size_t(count), unit);
        std::vector<Vec3> centers;
        for (std::size_t i = 0; i < 500; ++i)
            centers.push_back(points[i * 7919 % points.size()]);
        const KdTree8 reference{std::span<const Vec3>(points)};
        const float radius = radius_of_50(reference, centers);
        const int calls = options.pick(1000, 10000, 100000);
        examples::Table table{.name = walls ? "kd_tree-walls" : "kd_tree-caustics",
                              .columns = {"", "build, ns per point", "ball of 50, ns",
                                          "50 nearest, ns", "bytes per point"},
                              .rows = {}};
        const auto add = [&](const char* name, int times, auto make) {
            const auto row = measure(centers, radius, times, make);
            const double n = double(points.size());
            table.rows.push_back({name, examples::text(1e9 * row[0] / n, "%.0f"),
                                  examples::text(row[1], "%.0f"),
                                  examples::text(row[2], "%.0f"),
                                  examples::text(row[3] / n, "%.1f")});
        };
        add("all in turn", std::max(3, calls / 1000),
            [&] { return BruteForce{points}; });
        add("hash grid", calls, [&] { return structures::HashGrid(points, radius); });
        add("Morton order", calls, [&] { return structures::MortonOrder(points); });
        add("octree", calls, [&] { return structures::Octree(points); });
        add("plain k-d tree", calls,
            [&] { return KdTree{std::span<const Vec3>(points)}; });
        add("wide k-d tree", calls, [&] { return KdTree8(points, 1); });
        examples::show_table(options, table);
    }
}

/// Time of a search against the number of points.
void plot_time(const examples::Options& options) {
    examples::Plot plot{
        .name = "kd_tree-time",
        .columns = {"photons", "all in turn", "plain k-d tree", "wide k-d tree"},
        .y_label = "ns for all within a ball of 50",
        .rows = {},
        .log_x = true,
        .log_y = true};
    RandomStream stream = random_stream(options.seed, Pass::user, 1, 0);
    const auto unit = [&] { return next_1d(stream); };
    const int last = options.pick(10, 12, 13);
    for (int step = 4; step <= last; ++step) {
        const auto count = std::size_t(std::pow(10.0, step / 2.0));
        const auto points = structures::on_walls(count, unit);
        std::vector<Vec3> centers;
        for (std::size_t i = 0; i < 300; ++i)
            centers.push_back(points[i * 7919 % count]);
        const KdTree8 wide{std::span<const Vec3>(points)};
        const KdTree plain{std::span<const Vec3>(points)};
        const BruteForce brute{points};
        const float radius = radius_of_50(wide, centers);
        const auto time = [&](const auto& structure, int calls) {
            return time_of(calls, [&](int i) {
                structure.visit_within(centers[std::size_t(i) % 300], radius,
                                       [&](std::uint32_t, double d2) { sink += d2; });
            });
        };
        const int calls = options.pick(3000, 10000, 100000);
        plot.rows.push_back({double(count),
                             time(brute, std::max(3, int(1000000 / count))),
                             time(plain, calls), time(wide, calls)});
    }
    examples::save_plot(options.out, plot);
}

} // namespace

/// Makes the pictures of boxes, the plot and the tables of chapter 23.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; after an exception 2, with one sentence on stderr.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long points = 0, photons = 0;
        line.about("Chapter 24, the k-d tree: its boxes, and the time of searches.");
        line.add("--points", points, "Points of the tables", 100, 100000000);
        line.add("--photons", photons, "Photons emitted for the pictures", 1,
                 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 480, .height = 480, .samples = 1}});
        if (!line.given("--points"))
            points = options.pick(100000LL, 1000000LL, 4000000LL);
        if (!line.given("--photons")) photons = options.pick(6000LL, 12000LL, 20000LL);
        const auto floor = on_floor(options, photons);
        if (!floor.empty()) draw_boxes(options, floor);
        compare_structures(options, int(points));
        plot_time(options);
        if (std::isnan(sink)) std::printf("no number\n");
    });
}
