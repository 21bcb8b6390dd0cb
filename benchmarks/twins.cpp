/// \file twins.cpp
/// \brief Each fast twin beside its plain one: what a build gains by it.
///
/// A fast twin must not be slower than its plain one in any build. This table is made
/// with one compiler and one set of flags; the six that count are
///
///     for cxx in g++ clang++-14; do for flags in -O2 -O3 "-O3 -march=native"; do
///         $cxx -std=c++20 $flags -Iinclude benchmarks/twins.cpp -o twins &&
///         echo "$cxx $flags" && ./twins; done; done
///
/// `./twins photons` and so on run one part alone. Times are of this process; each block
/// of queries is answered by one twin after the other, and the best of some runs counts,
/// so that other work on the machine hardly does. "same" says that both gave the same
/// counts and the same sums.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <limits>
#include <string_view>
#include <vector>

#include <ljus/accel/kd_tree.hpp>
#include <ljus/photons/photon_map.hpp>

#include "rays_scenes.hpp"
#include "rays_timing.hpp"

using namespace ljus;

namespace {

/// What the answers to some queries add up to.
struct Sums {
    double count = 0;
    double sum = 0;
};

/// Runs `plain(first, last)` and `fast(first, last)` over all queries and prints a row.
/// \param tolerance  By how much the sums may differ, relative.
template <typename Plain, typename Fast>
void row(const char* name, std::size_t queries, double tolerance, Plain plain,
         Fast fast) {
    const std::size_t block = std::min<std::size_t>(queries, 500);
    double seconds[2] = {};
    Sums sums[2];
    std::vector<double> ratios;
    for (std::size_t first = 0; first + block <= queries; first += block) {
        double best[2] = {1e9, 1e9};
        for (int run = 0; run < 5; ++run)
            for (int twin = 0; twin < 2; ++twin) {
                const double start = rays::seconds();
                const Sums s = twin == 0 ? plain(first, first + block)
                                         : fast(first, first + block);
                best[twin] = std::min(best[twin], rays::seconds() - start);
                if (run > 0) continue;
                sums[twin].count += s.count;
                sums[twin].sum += s.sum;
            }
        for (int twin = 0; twin < 2; ++twin) seconds[twin] += best[twin];
        ratios.push_back(best[0] / best[1]);
    }
    std::nth_element(ratios.begin(), ratios.begin() + std::ptrdiff_t(ratios.size() / 2),
                     ratios.end());
    const bool same =
        sums[0].count == sums[1].count &&
        std::abs(sums[0].sum - sums[1].sum) <= tolerance * std::abs(sums[0].sum);
    const double all = double(queries / block * block);
    std::printf("%-34s %10.1f %10.1f %7.2f   %s\n", name, 1e9 * seconds[0] / all,
                1e9 * seconds[1] / all, ratios[ratios.size() / 2],
                same ? "same" : "DIFFERENT");
}

/// Photons on the walls of a room of side 1, and places to gather at.
void photons() {
    RandomStream stream = random_stream(7, Pass::user, 0, 0);
    const auto on_a_wall = [&](Vec3& normal) {
        Vec3 p = next_3d<float>(stream);
        const auto wall = static_cast<int>(6 * next_1d<float>(stream)) % 6;
        p[wall / 2] = float(wall % 2);
        normal = Vec3{0};
        normal[wall / 2] = wall % 2 == 0 ? 1.0f : -1.0f;
        return p;
    };
    const auto upwards = [&](const Vec3& normal) {
        return to_world(frame_around(normal),
                        sample_cosine_hemisphere(next_2d<float>(stream)));
    };
    const int count = 200000;
    std::vector<Photon> photons;
    for (int i = 0; i < count; ++i) {
        Vec3 normal;
        const Vec3 p = on_a_wall(normal);
        photons.push_back(
            {.position = p,
             .direction = -upwards(normal),
             .flux = next_3d<float>(stream) / float(count),
             .kind = i % 8 == 0 ? PhotonKind::direct : PhotonKind::indirect,
             .normal = small_normal(normal)});
    }
    const PhotonMap map = make_photon_map(photons, 1);
    std::vector<SurfaceT<float>> at(20000);
    for (auto& surface : at) {
        surface.point.position = on_a_wall(surface.point.normal);
        surface.frame = frame_around(surface.point.normal);
    }
    const Lambertian matt{};
    const Vec3 wo{0.6f, 0, 0.8f};
    for (const auto& [name, kernel] : {std::pair{"box", Kernel::box},
                                       {"cone", Kernel::cone},
                                       {"epanechnikov", Kernel::epanechnikov}})
        for (const int within : {10, 50, 500}) {
            const float radius =
                std::sqrt(6 * float(within) / (float(count) * 3.14159f));
            const DensityEstimateSettings gather{.radius = radius, .kernel = kernel};
            const std::size_t queries = within == 500 ? 4000 : 20000;
            const auto plain = [&](std::size_t first, std::size_t last) {
                std::uint64_t gathered = 0;
                double sum = 0;
                for (std::size_t i = first; i < last; ++i)
                    sum += double(estimate_radiance_plain(
                                      map, at[i], matt, wo, gather,
                                      one_kind(PhotonKind::indirect), gathered)
                                      .x);
                return Sums{double(gathered), sum};
            };
            const auto fast = [&](std::size_t first, std::size_t last) {
                std::uint64_t gathered = 0;
                double sum = 0;
                for (std::size_t i = first; i < last; ++i)
                    sum += double(estimate_radiance(map, at[i], matt, wo, gather,
                                                    one_kind(PhotonKind::indirect),
                                                    gathered)
                                      .x);
                return Sums{double(gathered), sum};
            };
            char title[64];
            std::snprintf(title, sizeof title, "estimate, %s, %d", name, within);
            row(title, queries, 1e-5, plain, fast);
        }
}

} // namespace

/// Prints the table.
int main(int argc, char** argv) {
    const std::string_view part = argc > 1 ? argv[1] : "all";
    std::printf("%-34s %10s %10s %7s\n", "", "plain, ns", "fast, ns", "ratio");
    if (part == "all" || part == "photons") photons();
}
