// smoke: --quality draft
/// \file chapters/experiments/44_experiments.cpp
/// \brief Chapter 44: a field of instances against a field of copies.

#include <string>
#include <utility>

#include <ljus/accel/instances.hpp>
#include <ljus/ljus.hpp>
#include <ljus/scenes/mesh_formulas.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

/// A field of rings, and what it costs.
struct Cost {
    double bytes = 0, seconds = 0, ns = 0;
};

/// Where ring number i stands.
Vec3 place_of(int i) {
    return {float(i % 40), 0, float(i / 40)};
}

/// Closes a scene and sends rays down at it.
template <typename S>
Cost cost_of(S& scene, double bytes, const examples::StopWatch& watch, int count) {
    const World world(std::move(scene));
    Cost cost{.bytes = bytes + double(world.tree().bytes()),
              .seconds = watch.seconds()};
    constexpr int rays = 20000;
    cost.ns = examples::nanoseconds_a_call(
        rays,
        [&] {
            auto stream = random_stream(44, Pass::user, 0, 0);
            double sum = 0;
            for (int i = 0; i < rays; ++i) {
                const int ring = int(float(count) * next_1d<float>(stream));
                const Vec3 to = place_of(ring) + next_3d<float>(stream) - 0.5f;
                const Vec3 from = to + Vec3{next_1d<float>(stream), 2, 1};
                const auto hit =
                    closest_hit(world, Ray{.origin = from, .direction = to - from});
                sum += hit ? double(hit->at.t) : 0;
            }
            return sum;
        },
        5);
    return cost;
}

Cost of_instances(const MeshData& ring, int count) {
    const examples::StopWatch watch;
    Scene<Shapes<Instance>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{});
    const auto mesh = scene.add(Mesh(ring, 1));
    for (int i = 0; i < count; ++i) {
        Affine map(1.0f);
        map[3] = place_of(i);
        scene.add(Instance(mesh, map), grey);
    }
    const double bytes = double(mesh.get().bytes()) + count * double(sizeof(Instance));
    return cost_of(scene, bytes, watch, count);
}

Cost of_copies(const MeshData& ring, int count) {
    const examples::StopWatch watch;
    Scene<Shapes<Mesh>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{});
    double bytes = 0;
    for (int i = 0; i < count; ++i) {
        MeshData copy = ring;
        for (Vec3& p : copy.positions) p += place_of(i);
        Mesh mesh(std::move(copy), 1);
        bytes += double(mesh.bytes());
        scene.add(std::move(mesh), grey);
    }
    return cost_of(scene, bytes, watch, count);
}

/// Table: memory, the time until the first ray, and the time of a ray.
void tabulate_trade(const examples::Options& options, const MeshData& ring, int most) {
    examples::Table table{
        .name = "instances-trade",
        .columns = {"placements", "MB", "s to build", "ns a ray"},
        .notes = {std::to_string(ring.triangles.size()) + " triangles"}};
    const auto add = [&](const char* name, int count, const Cost& cost) {
        table.rows.push_back({std::string(name) + " " + std::to_string(count),
                              examples::text(cost.bytes / 1e6, "%.4g"),
                              examples::text(cost.seconds, "%.2g"),
                              examples::text(cost.ns, "%.0f")});
    };
    for (int count = 10; count <= most; count *= 10) {
        add("instances", count, of_instances(ring, count));
        add("copies", count, of_copies(ring, count));
    }
    examples::print_table(table);
    examples::save_table(options.path(""), table);
}

} // namespace

/// Makes the chapter's table.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 44, instances: memory and time against copies.");
        const examples::Options options = line.parse({});
        const int around = options.pick(40, 200, 200);
        tabulate_trade(options, torus(Vec3(0), 0.35f, 0.12f, around, around / 4),
                       options.pick(10, 1000, 1000));
    });
}
