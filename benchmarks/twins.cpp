/// \file twins.cpp
/// \brief Each fast twin beside its plain one: the speed-up in a build.
///
/// A fast twin must not be slower than its plain one in any build. This table is made
/// with one compiler and one set of flags; the six that count are
///
///     for cxx in g++ clang++-14; do for flags in -O2 -O3 "-O3 -march=native"; do
///         $cxx -std=c++20 $flags -Iinclude benchmarks/twins.cpp -o twins &&
///         echo "$cxx $flags" && ./twins; done; done
///
/// `./twins photons` and so on run one part only. Times are of this process; each block
/// of queries is answered by one twin after the other, and the best of some runs
/// counts, so that other work on the machine hardly matters. "same" says that both gave
/// the same counts and the same sums.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <ljus/accel/bvh8.hpp>
#include <ljus/accel/kd_tree.hpp>
#include <ljus/accel/triangle_bvh.hpp>
#include <ljus/geometry/shape.hpp>
#include <ljus/photons/density_estimate.hpp>

#include "rays_scenes.hpp"
#include "rays_timing.hpp"

using namespace ljus;

namespace {

/// Counts and sums of the results of some queries.
struct Sums {
    double count = 0;
    double sum = 0;
};

/// Runs `plain(first, last)` and `fast(first, last)` over all queries and prints a row.
/// \param tolerance  Allowed relative difference of the sums.
template <typename Plain, typename Fast>
void row(const char* name, std::size_t queries, double tolerance, Plain plain,
         Fast fast) {
    // Enough that the branch predictor does not learn the branches of a block: with
    // 500, those of a search for one neighbour took it half their time.
    const std::size_t block = std::min<std::size_t>(queries, 5000);
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
struct PhotonRoom {
    static constexpr int count = 200000;
    PhotonMap map;
    std::vector<VertexT<float>> at;
};

PhotonRoom photon_room() {
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
    constexpr int count = PhotonRoom::count;
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
    PhotonRoom room{make_photon_map(photons, 1), std::vector<VertexT<float>>(20000)};
    for (auto& surface : room.at) {
        surface.point.position = on_a_wall(surface.point.normal);
        surface.frame = frame_around(surface.point.normal);
    }
    return room;
}

/// Both estimates of the radiance, by one kernel, with a radius that holds this many
/// photons on average.
void estimates(const PhotonRoom& room, const char* name, Kernel kernel, int within) {
    const Lambertian matt{};
    const Vec3 wo{0.6f, 0, 0.8f};
    const float radius =
        std::sqrt(6 * float(within) / (float(PhotonRoom::count) * 3.14159f));
    const DensityEstimateSettings gather{.radius = radius, .kernel = kernel};
    const auto by = [&](auto estimate) {
        return [&, estimate](std::size_t first, std::size_t last) {
            std::uint64_t gathered = 0;
            double sum = 0;
            for (std::size_t i = first; i < last; ++i)
                sum += double(estimate(room.at[i], gathered).x);
            return Sums{double(gathered), sum};
        };
    };
    const auto plain = [&](const auto& at, std::uint64_t& gathered) {
        return estimate_radiance_plain(room.map, at, matt, wo, gather,
                                       one_kind(PhotonKind::indirect), gathered);
    };
    const auto fast = [&](const auto& at, std::uint64_t& gathered) {
        return estimate_radiance(room.map, at, matt, wo, gather,
                                 one_kind(PhotonKind::indirect), gathered);
    };
    char title[64];
    std::snprintf(title, sizeof title, "estimate, %s, %d", name, within);
    row(title, within == 500 ? 4000 : 20000, 1e-5, by(plain), by(fast));
}

void photons() {
    const PhotonRoom room = photon_room();
    for (const auto& [name, kernel] : {std::pair{"box", Kernel::box},
                                       {"cone", Kernel::cone},
                                       {"epanechnikov", Kernel::epanechnikov}})
        for (const int within : {10, 50, 500}) estimates(room, name, kernel, within);
}

/// The k-d trees: points on the walls of a room, and in it.
void points() {
    RandomStream stream = random_stream(8, Pass::user, 0, 0);
    std::vector<Vec3> all;
    for (int i = 0; i < 200000; ++i) {
        Vec3 p = next_3d<float>(stream);
        if (i % 4 != 0) p[i % 3] = 0;
        all.push_back(p);
    }
    const KdTree plain_tree(all);
    const KdTree8 fast_tree(all, 1);
    std::vector<Vec3> centers;
    for (int i = 0; i < 20000; ++i)
        centers.push_back(all[static_cast<std::size_t>(i) * 10] +
                          0.003f * next_3d<float>(stream));
    const auto both = [&](const char* name, std::size_t queries, auto ask) {
        const auto with = [&](const auto& tree) {
            return [&](std::size_t first, std::size_t last) {
                Sums sums;
                for (std::size_t i = first; i < last; ++i) ask(tree, centers[i], sums);
                return sums;
            };
        };
        row(name, queries, 1e-9, with(plain_tree), with(fast_tree));
    };
    for (const float radius : {0.005f, 0.01f, 0.03f}) {
        char title[64];
        std::snprintf(title, sizeof title, "k-d tree, ball of %.3f", double(radius));
        both(title, 10000, [&](const auto& tree, const Vec3& center, Sums& sums) {
            tree.visit_within(center, radius, [&](std::uint32_t, double distance2) {
                sums.count += 1;
                sums.sum += distance2;
            });
        });
    }
    for (const std::size_t k : {1u, 10u, 50u, 200u}) {
        char title[64];
        std::snprintf(title, sizeof title, "k-d tree, %zu nearest", k);
        both(title, 5000, [&](const auto& tree, const Vec3& center, Sums& sums) {
            Neighbor room[200];
            const std::size_t count = tree.nearest(center, 1.0f, std::span(room, k));
            sums.count += double(count);
            for (std::size_t i = 0; i < count; ++i) sums.sum += room[i].distance2;
        });
    }
    const auto size_of = [](const auto& tree) {
        return Sums{double(tree.point_ids().size()), 0};
    };
    row(
        "k-d tree, build of 200 000", 1, 0,
        [&](std::size_t, std::size_t) { return size_of(KdTree(all)); },
        [&](std::size_t, std::size_t) { return size_of(KdTree8(all, 1)); });
}

/// The trees of boxes, over meshes and over a few shapes.
/// \param fast   The fast tree: a TriangleBvh, or a Bvh8.
/// \param plain  A Bvh.
template <typename Fast>
void rays_of(const std::string& name, const rays::Mesh& mesh, const Bvh& plain,
             const Fast& fast, const rays::RaySets& sets) {
    const auto nearest = [&](const auto& tree, const Ray& ray, Sums& sums) {
        NearestHit found;
        tree.closest(ray, [&](std::uint32_t place, Ray& rest) {
            if (const auto hit =
                    intersect<double>(rest, rays::triangle_at(tree, mesh, place)))
                found.offer(*hit, tree.primitive_ids()[place], rest);
        });
        if (!found.found) return;
        sums.count += 1;
        sums.sum += double(found.at.t) + double(found.number);
    };
    const auto any = [&](const auto& tree, const Ray& ray, Sums& sums) {
        sums.count += tree.any(ray, [&](std::uint32_t place) {
            return intersect<double>(ray, rays::triangle_at(tree, mesh, place))
                .has_value();
        });
    };
    const auto both = [&](const char* set_name, const std::vector<Ray>& set, auto ask) {
        const auto with = [&](const auto& tree) {
            return [&](std::size_t first, std::size_t last) {
                Sums sums;
                for (std::size_t i = first; i < last; ++i) ask(tree, set[i], sums);
                return sums;
            };
        };
        row((name + ", " + set_name).c_str(), std::min<std::size_t>(set.size(), 20000),
            0, with(plain), with(fast));
    };
    both("primary", sets.primary, nearest);
    both("diffuse", sets.diffuse, nearest);
    both("shadow", sets.shadow, any);
}

void meshes() {
    for (const int count : {12, 30, 6000, 70000}) {
        const rays::Mesh mesh =
            count > 1000 ? rays::bumpy_ball(count) : rays::balls(192 * 40);
        rays::Mesh some = mesh;
        if (count < 1000) { // a room of separate triangles
            some.clear();
            for (int i = 0; i < count; ++i)
                some.push_back(mesh[static_cast<std::size_t>(i) * 251 % mesh.size()]);
            for (Triangle& t : some) {
                const Vec3 middle = (t.v1 + t.v2 + t.v3) / 3.0f;
                for (Vec3* v : {&t.v1, &t.v2, &t.v3}) *v += 20.0f * (*v - middle);
            }
        }
        const Bvh plain = rays::plain_tree(some);
        const TriangleBvh fast = rays::wide_tree(some);
        const auto first_hit = [&](const Ray& ray) -> std::optional<SurfacePoint> {
            NearestHit found;
            plain.closest(ray, [&](std::uint32_t place, Ray& rest) {
                const std::uint32_t i = plain.primitive_ids()[place];
                if (const auto hit = intersect<double>(rest, some[i]))
                    found.offer(*hit, i, rest);
            });
            if (!found.found) return std::nullopt;
            return point_at(some[found.number], found.at.u, found.at.v);
        };
        const rays::RaySets sets =
            rays::ray_sets(first_hit, {0, 0.6f, 2.6f}, Vec3{0}, {0, 1, 0},
                           {-0.5f, 2.5f, -0.5f}, {1, 0, 0}, {0, 0, 1}, 250);
        const std::string size = std::to_string(count);
        std::vector<Box> boxes;
        for (const Triangle& triangle : some) boxes.push_back(bounds(triangle));
        if (count <= 6000) {
            const Bvh one(boxes, {.leaf_size = 1, .threads = 1});
            const Bvh8 eight(boxes, {.leaf_size = 1, .threads = 1});
            rays_of("bvh, " + size, some, one, eight, sets);
        }
        if (count >= 6000) rays_of("triangles, " + size, some, plain, fast, sets);
    }
}

} // namespace

/// Prints the table.
int main(int argc, char** argv) {
    const std::string_view part = argc > 1 ? argv[1] : "all";
    std::printf("%-34s %10s %10s %7s\n", "", "plain, ns", "fast, ns", "ratio");
    if (part == "all" || part == "photons") photons();
    if (part == "all" || part == "points") points();
    if (part == "all" || part == "meshes") meshes();
}
