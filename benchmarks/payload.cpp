/// \file payload.cpp
/// \brief The data of a photon besides its position, and their order in memory: the
/// time of a search in a ball, for maps that fit the cache and for larger ones.
///
/// A search finds about 50 photons and adds up all of their data; times are
/// nanoseconds per search. The tree is the same each time. What differs is how many
/// bytes a photon carries, whether they stand in the order of the tree or of the
/// emission, and whether the next search is near the last one, as in neighbouring
/// pixels, or anywhere. A photon of a photon map carries 32 bytes.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include <ljus/accel/kd_tree8.hpp>
#include <ljus/math/random.hpp>

#include "csv.hpp"
#include "point_structures.hpp"

namespace {

using ljus::Vec3;

/// Searches, one after the other.
constexpr std::size_t searches = 20000;

double cpu_seconds() {
    return double(std::clock()) / double(CLOCKS_PER_SEC);
}

/// Photons on walls, ordered for searching.
struct Map {
    std::vector<Vec3> points{};
    ljus::KdTree8 tree{};
    float radius = 0; ///< Holds about 50, as a median.

    explicit Map(std::size_t count) {
        ljus::RandomStream stream = ljus::random_stream(1, ljus::Pass::user, 0, 0);
        points = structures::on_walls(count, [&] { return ljus::next_1d(stream); });
        tree = ljus::KdTree8(points, 1);
        std::vector<float> radii;
        std::array<ljus::Neighbor, 50> room;
        for (std::size_t i = 0; i < count; i += count / 400 + 1) {
            (void)tree.nearest(points[i], HUGE_VALF, std::span(room));
            radii.push_back(float(std::sqrt(room[0].distance2)));
        }
        std::sort(radii.begin(), radii.end());
        radius = radii[radii.size() / 2];
    }
};

float sink = 0; // sum of the results, so that no work is optimised away

/// Nanoseconds per search that reads `floats` numbers of each photon found: the least
/// of five runs.
template <std::size_t floats>
double search_time(const Map& map, const std::vector<Vec3>& centers, bool tree_order) {
    using Carried = std::array<float, floats>;
    std::vector<Carried> carried(map.points.size());
    for (std::size_t i = 0; i < carried.size(); ++i) carried[i].fill(float(i % 7));
    const auto ids = map.tree.point_ids();
    double best = HUGE_VAL;
    for (int run = 0; run < 5; ++run) {
        const double start = cpu_seconds();
        for (const Vec3& center : centers) {
            Carried sums{}; // a chain of additions each, so that none waits
            map.tree.visit_within(center, map.radius, [&](std::uint32_t i, double) {
                const Carried& found = carried[tree_order ? i : ids[i]];
                for (std::size_t k = 0; k < floats; ++k) sums[k] += found[k];
            });
            for (const float x : sums) sink += x;
        }
        best = std::min(best, cpu_seconds() - start);
    }
    return 1e9 * best / double(centers.size());
}

} // namespace

/// Prints the table, and saves it with `--csv FOLDER`.
int main(int argc, char** argv) {
    examples::Table table{.name = "kd_tree-payload",
                          .columns = {"photons, next search", "4 bytes", "12 bytes",
                                      "32 bytes", "64 bytes",
                                      "32 bytes, order of emission"}};
    const auto add_row = [&](const std::string& name, const Map& map,
                             const std::vector<Vec3>& centers) {
        std::vector<std::string> row{name};
        for (const double time :
             {search_time<1>(map, centers, true), search_time<3>(map, centers, true),
              search_time<8>(map, centers, true), search_time<16>(map, centers, true),
              search_time<8>(map, centers, false)})
            row.push_back(examples::text(time, "%.0f"));
        for (const std::string& cell : row) std::printf("%-24s", cell.c_str());
        std::printf("\n");
        std::fflush(stdout);
        table.rows.push_back(row);
    };
    const std::array<std::pair<std::size_t, std::string>, 4> sizes{
        {{10000, "10 000"}, {100000, "100 000"}, {1000000, "1 million"},
         {4000000, "4 million"}}};
    for (const auto& [count, name] : sizes) {
        const Map map(count);
        std::vector<Vec3> near, anywhere;
        for (std::size_t i = 0; i < searches; ++i) {
            near.push_back(map.tree.point(i % count));
            anywhere.push_back(map.points[i * 102947 % count]);
        }
        add_row(name + " near", map, near);
        add_row(name + " anywhere", map, anywhere);
    }
    save_csv(csv_folder(argc, argv), table);
    return std::isnan(sink) ? 1 : 0;
}
