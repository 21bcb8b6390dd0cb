// smoke: --quality draft --width 16 --height 16 --rays 1 --size 0.9 --steps 2
/// \file chapters/experiments/21_experiments.cpp
/// \brief Chapter 21: the experiments behind its tables, plots and pictures: form
/// factors, solvers, the size of patches, leaks, and a light map seen from many sides.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>
#include <ljus/math/sum.hpp>
#include <ljus/radiosity/exchange_area.hpp>
#include <ljus/radiosity/form_factor_matrix.hpp>
#include <ljus/radiosity/light_map.hpp>
#include <ljus/radiosity/patch_grid.hpp>
#include <ljus/radiosity/patches.hpp>
#include <ljus/radiosity/radiosity.hpp>
#include <ljus/radiosity/radiosity_solve.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

using Color = RgbT<double>;

constexpr double pi = std::numbers::pi;
using Stage = Scene<Shapes<Quad>, Materials<Lambertian>>;

/// The options of this program, besides the common ones.
struct Sizes {
    double patch = 0; ///< Side of the finest patches of the room.
    int steps = 0;    ///< How many sizes of patches.
};

/// A picture, with a bar while it is made.
template <typename Renderer>
Image rendered(const std::string& name, const Renderer& renderer, const Camera& camera,
               const examples::Options& options, int rays = 0, bool wide = false) {
    RenderSettings picture = examples::picture_settings(options);
    if (wide) picture.height = std::max(1, options.height / 2);
    if (rays > 0) picture.samples = rays;
    return examples::rendered(name, renderer, camera, picture, options).image;
}

/// Seconds of processor time since the last call.
struct Lap {
    double start = examples::processor_seconds();
    double operator()() {
        const double now = examples::processor_seconds();
        const double spent = now - start;
        start = now;
        return spent;
    }
};

// --- The rooms ------------------------------------------------------------------------

/// A block on the floor, rotated about its centre.
void add_block(Stage& scene, MaterialId matt, const Vec3& middle, const Vec3& size,
               double degrees) {
    const auto angle = float(degrees * pi / 180);
    const Vec3 x = size.x * Vec3{std::cos(angle), 0, std::sin(angle)};
    const Vec3 z = size.z * Vec3{-std::sin(angle), 0, std::cos(angle)};
    const Vec3 y{0, size.y, 0};
    const Vec3 low = middle - (x + z) / 2.0f;
    scene.add(Quad{low + y, z, x}, matt);
    scene.add(Quad{low, y, x}, matt);
    scene.add(Quad{low + z, x, y}, matt);
    scene.add(Quad{low, z, y}, matt);
    scene.add(Quad{low + x, y, z}, matt);
}

/// The Cornell box with two diffuse blocks.
Room<Stage> block_room() {
    Stage scene;
    add_cornell_walls(scene);
    const auto white = scene.add(Lambertian{.albedo = Rgb{0.75f}});
    add_block(scene, white, {-0.35f, 0, -0.3f}, {0.6f, 1.2f, 0.6f}, -17);
    add_block(scene, white, {0.4f, 0, 0.3f}, {0.55f, 0.6f, 0.55f}, 20);
    scene.add(Quad{{-0.3f, 1.999f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}},
              scene.add(Lambertian{.albedo = Rgb{0}}), Rgb{12, 10, 7});
    return {World(std::move(scene)), cornell_box().camera};
}
/// Two rooms; the lamp is in the left one. The front, where the camera stands, is open.
Room<Stage> two_rooms(double wall) {
    Stage scene;
    const auto white = scene.add(Lambertian{.albedo = Rgb{0.7f}});
    const auto blue = scene.add(Lambertian{.albedo{0.3f, 0.4f, 0.7f}});
    const Vec3 x{4, 0, 0}, y{0, 2, 0}, z{0, 0, 2}, o{-2, 0, -1};
    scene.add(Quad{o, z, x}, white);
    scene.add(Quad{o + y, x, z}, white);
    scene.add(Quad{o, x, y}, white);
    scene.add(Quad{o, y, z}, blue);
    scene.add(Quad{o + x, z, y}, blue);
    scene.add(Quad{{float(wall), 0, -1}, y, z}, white);
    scene.add(Quad{{-1.2f, 1.99f, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f}},
              scene.add(Lambertian{.albedo = Rgb{0}}), Rgb{60, 54, 45});
    const Camera camera = look_at(View{
        .position{0, 1, 4.6f}, .target{0, 1, 0}, .up{0, 1, 0}, .vfov_degrees = 32});
    return {World(std::move(scene)), camera};
}

/// A closed cube whose ceiling emits: there are no shadows, and all form factors have a
/// closed form.
auto shining_cube() {
    Scene<Shapes<QuadT<double>>, Materials<LambertianT<double>>> cube;
    using V = Vec3T<double>;
    const V x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, o{0};
    const auto paint = [&](double albedo) {
        return cube.add(LambertianT<double>{.albedo = Color(albedo)});
    };
    cube.add(QuadT<double>{o, x, y}, paint(0.8));
    cube.add(QuadT<double>{z, y, x}, paint(0.5), Color(1));
    cube.add(QuadT<double>{o, y, z}, paint(0.7));
    cube.add(QuadT<double>{x, z, y}, paint(0.3));
    cube.add(QuadT<double>{o, z, x}, paint(0.6));
    cube.add(QuadT<double>{y, x, z}, paint(0.8));
    return World(std::move(cube));
}

// --- Form factors ---------------------------------------------------------------------

/// Table: the form factor of two unit squares on a common edge, by random points of
/// both, and by rays drawn by the cosine.
void factors_by_chance(const examples::Options& options) {
    const int count = options.pick(1000000, 2000000, 10000000);
    examples::Table table{.name = "radiosity-chance",
                          .columns = {"seed", "points of both", "rays by the cosine"}};
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        double points = 0, rays = 0;
        for (int i = 0; i < count; ++i) {
            auto stream = random_stream(options.seed + seed, Pass::user, 0,
                                        static_cast<std::uint64_t>(i));
            const auto a = next_2d<double>(stream), b = next_2d<double>(stream);
            // Floor (x, y, 0) and wall (0, y, z).
            const Vec3T<double> way{-a.x, b.x - a.y, b.y};
            const double r2 = glm::dot(way, way);
            points += a.x * b.y / (pi * r2 * r2);
            const auto d = sample_cosine_hemisphere(next_2d<double>(stream));
            const double t = d.x < 0 ? a.x / -d.x : 1e9;
            const double side = a.y + t * d.y;
            rays += t * d.z <= 1 && side >= 0 && side <= 1 ? 1 : 0;
        }
        table.rows.push_back({std::to_string(seed),
                              examples::text(points / count, "%.5f"),
                              examples::text(rays / count, "%.5f")});
    }
    table.rows.push_back({"exact", examples::text(form_factor_corner(1, 1, 1), "%.5f"),
                          examples::text(form_factor_corner(1, 1, 1), "%.5f")});
    save_table(options.out, table);
}

// --- Solvers --------------------------------------------------------------------------

/// Plot: the flux that is still unsent after each sweep, by each solver.
void residuals(const examples::Options& options, const Sizes& sizes) {
    const auto room = block_room();
    const auto all = make_radiosity(room.world, {.patches = {.size = 3 * sizes.patch}});
    const auto solve = [&](RadiositySolver solver) {
        return solve_radiosity(all->factors, all->patches.patches,
                               {.solver = solver, .tolerance = 1e-14})
            .residual;
    };
    const auto jacobi = solve(RadiositySolver::jacobi);
    const auto seidel = solve(RadiositySolver::gauss_seidel);
    const auto shooting = solve(RadiositySolver::shooting);
    examples::Plot plot{.name = "radiosity-residual",
                        .columns = {"sweeps: as many steps as there are patches",
                                    "shooting", "Gauss-Seidel", "Jacobi",
                                    "largest albedo ^ sweeps"},
                        .y_label = "unsent flux over emitted flux",
                        .log_y = true,
                        .more = "set yrange [1e-14:1.5]\n"};
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    const auto at = [&](const std::vector<double>& list, std::size_t i) {
        return i < list.size() ? list[i] : nothing;
    };
    for (std::size_t i = 0; i < jacobi.size(); ++i)
        plot.rows.push_back({double(i), at(shooting, i), at(seidel, i), jacobi[i],
                             std::pow(0.75, double(i))});
    save_plot(options.out, plot);
    if (!options.quiet)
        std::printf("sweeps to 1e-14: jacobi %zu, gauss_seidel %zu, shooting %zu, "
                    "bound %.0f (%zu patches)\n",
                    jacobi.size() - 1, seidel.size() - 1, shooting.size() - 1,
                    std::log(1e-14) / std::log(0.75), all->factors.size());
}

/// Pictures: the room after a few shots.
void progress(const examples::Options& options) {
    const auto room = block_room();
    // The lamp has four patches in every quality, so that four shots give the direct
    // light.
    const Patches patches = make_patches(room.world, {.size = 0.31});
    const auto factors = make_form_factors(
        room.world, patches,
        {.analytic = false, .rays = 1024, .threads = options.threads});
    std::vector<Color> radiosity(factors->size(), Color(0)), unsent;
    for (const Patch& patch : patches.patches) unsent.push_back(patch.emitted);
    int shot = 0;
    for (const int shots : {4, 30, 100, 1000}) {
        for (; shot < shots; ++shot)
            relax_patch(*factors, patches.patches, brightest_patch(*factors, unsent),
                        radiosity, unsent);
        const auto map = make_light_map(room.world, patches, *factors, radiosity);
        save_png(rendered("shots", LightMapView(room.world, map), room.camera, options),
                 options.path("radiosity-shots-" + std::to_string(shots) + ".png"));
    }
}

// --- The size of patches --------------------------------------------------------------

/// Plot: the error of the light on the floor against the size of patches.
void error_of_size(const examples::Options& options, const Sizes& sizes) {
    const auto cube = shining_cube();
    const auto solved = [&](int n) {
        return *make_radiosity(cube, {.patches = {.size = 1.0 / n}});
    };
    // The light that all patches send to a point, by Lambert's formula.
    const auto gathered = [](const Radiosity& all, const glm::dvec3& at) {
        double sum = 0;
        for (std::size_t i = 0; i < all.patches.patches.size(); ++i)
            sum += all.solution.radiosity[i].x *
                   form_factor_at(at, {0, 0, 1}, all.patches.patches[i].facet);
        return sum;
    };
    const Radiosity fine = solved(options.pick(12, 24, 32));
    std::vector<glm::dvec3> points;
    std::vector<double> truth;
    for (int i = 0; i < 19; ++i)
        for (int k = 0; k < 19; ++k) {
            points.push_back({(i + 0.37) / 19, (k + 0.61) / 19, 0});
            truth.push_back(gathered(fine, points.back()));
        }
    examples::Plot plot{.name = "radiosity-error",
                        .columns = {"side of a patch", "flat patches", "Gouraud",
                                    "gathered at the point"},
                        .y_label = "RMS error of the light on the floor",
                        .log_x = true,
                        .log_y = true};
    for (const int n : {1, 2, 3, 4, 6, 8}) {
        if (n > 1 << sizes.steps) break;
        const Radiosity all = solved(n);
        const PatchGrid& floor = all.map.grids[0];
        const auto vertices = vertex_light(
            floor, std::span(all.map.irradiance).subspan(floor.first, floor.size()));
        std::array<double, 3> squares{};
        double level = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::dvec2 at(points[i]);
            const std::array found{all.map.irradiance[cell_of(floor, at)].x,
                                   blended_light(floor, at, vertices).x,
                                   gathered(all, points[i])};
            for (std::size_t k = 0; k < 3; ++k)
                squares[k] += std::pow(found[k] - truth[i], 2);
            level += truth[i] * truth[i];
        }
        plot.rows.push_back({1.0 / n, std::sqrt(squares[0] / level),
                             std::sqrt(squares[1] / level),
                             std::sqrt(squares[2] / level)});
    }
    save_plot(options.out, plot);
    if (!options.quiet)
        for (const auto& row : plot.rows)
            std::printf("side %.3f: flat %.5f, Gouraud %.5f, gathered %.6f\n", row[0],
                        row[1], row[2], row[3]);
}

// --- The room -------------------------------------------------------------------------

/// The relative error of the means of blocks of pixels, in percent.
std::string error_text(const Image& image, const Image& truth) {
    return examples::text(100 * std::sqrt(block_error(image, truth)), "%.1f %%");
}

/// The room by patches of one size: a row of the table, and two pictures.
/// \param file  Name of the pictures; empty: none are saved.
std::vector<std::string> by_patches(const Room<Stage>& room, double size, bool analytic,
                                    const Image& truth, const std::string& file,
                                    const examples::Options& options) {
    examples::ProgressBar bar("form factors", options.quiet);
    Lap lap;
    const Patches patches = make_patches(room.world, {.size = size});
    const auto factors = make_form_factors(room.world, patches,
                                           {.analytic = analytic,
                                            .rays = 1024,
                                            .seed = options.seed,
                                            .threads = options.threads,
                                            .progress = bar});
    examples::stop_if_asked();
    const double factor_time = lap();
    const auto solution = solve_radiosity(*factors, patches.patches, {});
    const double solve_time = lap();
    const auto map = make_light_map(room.world, patches, *factors, solution.radiosity);
    const LightMapView view(room.world, map);
    (void)lap();
    const Image smooth = rendered("view", view, room.camera, options);
    const double view_time = lap();
    if (!file.empty()) {
        save_png(smooth, options.path(file + "-smooth.png"));
        save_png(rendered("view", LightMapView(room.world, map, {.smooth = false}),
                          room.camera, options),
                 options.path(file + "-flat.png"));
    }
    return {analytic ? "closed forms" : "1024 rays per patch",
            std::to_string(factors->size()),
            examples::text(factor_time, "%.2f"),
            examples::text(solve_time, "%.2f"),
            examples::text(view_time, "%.2f"),
            error_text(smooth, truth)};
}

/// Table and pictures: the room by patches of several sizes, and by path tracing.
void room_pictures(const examples::Options& options, const Sizes& sizes) {
    const auto room = block_room();
    const PathTracer tracer(room.world);
    const int many = options.pick(32, 128, 4096);
    const Image truth =
        rendered("reference", tracer, room.camera, options, options.samples * 4 + many);
    save_png(truth, options.path("radiosity-path.png"));
    examples::Table table{
        .name = "radiosity-trade",
        .columns = {"way", "patches", "factors, s", "solve, s", "view, s", "error"}};
    for (int step = sizes.steps - 1; step >= 0; --step)
        for (const bool analytic : {true, false})
            table.rows.push_back(by_patches(
                room, sizes.patch * (1 << step), analytic, truth,
                analytic ? "radiosity-room-" + std::to_string(step) : std::string(),
                options));
    for (const int rays : {1, 4, 16}) {
        Lap lap;
        RenderSettings other{options.width, options.height, rays, options.seed + 77};
        other.threads = options.threads;
        const Image image = render(tracer, room.camera, other).image;
        table.rows.push_back({"path tracing, " + std::to_string(rays) + " per pixel",
                              "", "", "", examples::text(lap(), "%.2f"),
                              error_text(image, truth)});
    }
    save_table(options.out, table);
    if (!options.quiet) examples::print_rows(table, 18);
}

/// Pictures: one solution, seen from five sides.
void views(const examples::Options& options, const Sizes& sizes) {
    const auto room = block_room();
    const auto all =
        make_radiosity(room.world, {.patches = {.size = sizes.patch},
                                    .factors = {.analytic = false, .rays = 1024}});
    const LightMapView view(room.world, all->map);
    constexpr int count = 5;
    for (int i = 0; i < count; ++i) {
        const auto x = float(-0.8 + 1.6 * i / (count - 1));
        const Camera camera = look_at(View{.position{x, 1.0f + x / 2, 4.4f - x * x},
                                           .target{0, 1, 0},
                                           .up{0, 1, 0},
                                           .vfov_degrees = 33});
        save_png(rendered("view", view, camera, options),
                 options.path("radiosity-view-" + std::to_string(i) + ".png"));
    }
}

// --- Leaks ----------------------------------------------------------------------------

/// Table and pictures: two rooms and one lamp; light leaks through patches that lie
/// under the wall.
void leaks(const examples::Options& options, const Sizes& sizes) {
    examples::Table table{.name = "radiosity-leaks",
                          .columns = {"side of a patch", "wall across patches: flat",
                                      "Gouraud", "wall on their border: flat",
                                      "Gouraud "}};
    for (int step = 0; step < sizes.steps; ++step) {
        const double size = 1.0 / (1 << step);
        std::vector<std::string> row{examples::text(size)};
        for (const double wall : {0.11, 0.0}) {
            const auto room = two_rooms(wall);
            const auto all = make_radiosity(room.world, {.patches = {.size = size}});
            for (const bool smooth : {false, true}) {
                const LightMapView view(room.world, all->map, {.smooth = smooth});
                // The floor next to the wall, on its dark or on its lit side.
                RandomStream none;
                Counts counts;
                auto context = context_of(none, counts);
                const auto near = [&](double side) {
                    double sum = 0;
                    for (int i = 0; i < 100; ++i) {
                        const auto x = float(wall + side * 0.3 * (i + 0.5) / 100);
                        const Ray down{.origin{x, 0.5f, 0.013f}, .direction{0, -1, 0}};
                        sum += double(radiance(view, down, context).x);
                    }
                    return sum;
                };
                row.push_back(examples::text(100 * near(1) / near(-1), "%.2f %%"));
                if (wall > 0)
                    save_png(rendered("leak", view, room.camera, options, 0, true),
                             options.path("radiosity-leak-" + std::to_string(step) +
                                          (smooth ? "-smooth.png" : "-flat.png")));
            }
        }
        table.rows.push_back(row);
    }
    save_table(options.out, table);
    const auto room = two_rooms(0.11);
    save_png(rendered("leak paths", PathTracer(room.world), room.camera, options,
                      8 * options.samples, true),
             options.path("radiosity-leak-path.png"));
    if (!options.quiet)
        for (const auto& row : table.rows)
            std::printf("leak %s: %s %s | %s %s\n", row[0].c_str(), row[1].c_str(),
                        row[2].c_str(), row[3].c_str(), row[4].c_str());
}

} // namespace

/// Makes the files of the experiments.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 21, radiosity: form factors, solvers, patches, leaks.");
        line.add("--size", sizes.patch, "Side of the finest patches of the room", 0.01,
                 10.0);
        line.add("--steps", sizes.steps,
                 "How many sizes of patches, each half as large", 1, 6);
        const examples::Options options =
            line.parse({.draft{.width = 200, .height = 200, .samples = 4},
                        .report{.width = 400, .height = 400, .samples = 16},
                        .reference{.width = 400, .height = 400, .samples = 64}});
        if (!line.given("--size")) sizes.patch = options.pick(0.2, 0.1, 0.0625);
        if (!line.given("--steps")) sizes.steps = options.pick(3, 4, 5);
        factors_by_chance(options);
        residuals(options, sizes);
        progress(options);
        error_of_size(options, sizes);
        room_pictures(options, sizes);
        views(options, sizes);
        leaks(options, sizes);
    });
}
