#pragma once

/// \file chapters/experiments/break_it_scenes.hpp
/// \brief The small scenes in which the mistakes of chapter 38 show.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <ljus/accel/kd_tree.hpp>
#include <ljus/accel/mesh.hpp>
#include <ljus/inspect/photon_dots.hpp>
#include <ljus/io/load_image.hpp>
#include <ljus/io/png.hpp>
#include <ljus/ljus.hpp>
#include <ljus/radiosity/light_map.hpp>
#include <ljus/radiosity/radiosity.hpp>
#include <ljus/render/budgeting.hpp>
#include <ljus/render/distributed.hpp>
#include <ljus/render/gathering.hpp>
#include <ljus/render/plain_path_tracing.hpp>
#include <ljus/render/progressive.hpp>
#include <ljus/render/skipping.hpp>
#include <ljus/render/whitted.hpp>
#include <ljus/scenes/cornell_box.hpp>
#include <ljus/scenes/mesh_formulas.hpp>

namespace {

using namespace ljus;

constexpr float pi = std::numbers::pi_v<float>;

using Stage = Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Mirror, Glass>,
                    Lights<PointLight>>;
using SmoothStage =
    Scene<Shapes<Mesh, Quad>, Materials<Lambertian>, Lights<PointLight>>;

/// How a picture of the gallery is made.
struct Eye {
    int size = 168;         ///< Pixels on a side.
    int samples = 64;       ///< Rays in a pixel, where chance has a part in it.
    std::uint64_t seed = 1; ///< Of the random numbers.
    int threads = 0;        ///< 0: all.

    /// For a renderer.
    /// \param share  Of the samples: what has little noise needs few of them.
    [[nodiscard]] RenderSettings settings(double share = 1) const {
        return {.width = size,
                .height = size,
                .samples = std::max(1, int(std::lround(samples * share))),
                .seed = seed,
                .threads = threads};
    }
};

/// A picture from a function of the primary ray: nine rays a pixel, in a grid.
template <typename F>
Image draw(const Eye& eye, const Camera& camera, F&& color) {
    Image image = make_image(eye.size, eye.size);
    const int grid = eye.samples > 1 ? 3 : 1;
    (void)parallel_blocks(
        eye.size,
        [&](long long row) {
            const int y = static_cast<int>(row);
            for (int x = 0; x < eye.size; ++x) {
                Rgb sum{0};
                for (int i = 0; i < grid * grid; ++i) {
                    const Vec2 place{(float(i % grid) + 0.5f) / float(grid),
                                     (float(i / grid) + 0.5f) / float(grid)};
                    sum += color(primary_ray(camera, Vec2{float(x), float(y)} + place,
                                             eye.size, eye.size));
                }
                pixel(image, x, y) = sum / float(grid * grid);
            }
        },
        {.threads = eye.threads});
    return image;
}

/// A floor with squares of two greys, and a sky that is brighter at the horizon.
Rgb checker(const Vec3& place, float side = 1) {
    const auto cell = [&](float x) { return static_cast<int>(std::floor(x / side)); };
    return ((cell(place.x) + cell(place.z)) & 1) == 0 ? Rgb{0.75f} : Rgb{0.25f};
}
Rgb sky(const Vec3& direction) {
    const float up = std::max(0.0f, direction.y);
    return glm::mix(Rgb{0.95f, 0.85f, 0.7f}, Rgb{0.2f, 0.4f, 0.8f}, std::sqrt(up));
}
const Vec3 sun = glm::normalize(Vec3{-0.5f, 1, 0.7f});

/// A matt surface under a sun and an even sky.
Rgb shaded(const Vec3& normal, const Rgb& albedo) {
    return albedo * (0.15f + 0.85f * std::max(0.0f, glm::dot(normal, sun)));
}

// --- Rays and surfaces ---------------------------------------------------------------

/// An egg on a floor: rays are brought into the space in which it is a ball, and their
/// directions have another length there.
Image egg(const Eye& eye) {
    const Vec3 size{0.6f, 1.5f, 0.6f}, middle{0, 1.5f, 0};
    const Camera camera =
        look_at({.position{0, 2.2f, 7}, .target{0, 1.4f, 0}, .vfov_degrees = 36});
    return draw(eye, camera, [&](const Ray& ray) {
        const Ray inside{.origin = (ray.origin - middle) / size,
                         .direction = ray.direction / size};
        if (const auto t = intersect(inside, Sphere{})) {
            const Vec3 place = inside.origin + *t * inside.direction;
            const Rgb albedo = std::sin(12 * place.y) > 0 ? Rgb{0.85f, 0.75f, 0.55f}
                                                          : Rgb{0.6f, 0.25f, 0.15f};
            return shaded(glm::normalize(place / size), albedo);
        }
        if (ray.direction.y >= 0) return sky(ray.direction);
        const float t = -ray.origin.y / ray.direction.y;
        return glm::mix(checker(ray.origin + t * ray.direction), Rgb{0.6f},
                        std::min(1.0f, t / 40));
    });
}

/// A ball of flat triangles, each asked by itself.
/// \param radius  In scene units; the picture is the same for any.
Image facets(const Eye& eye, float radius, int cuts) {
    const MeshData data = icosphere(Sphere{.center{0, 0, 0}, .radius = radius}, cuts);
    const Camera camera = look_at({.position{0, 0, 4 * radius}, .vfov_degrees = 36});
    return draw(eye, camera, [&](Ray ray) {
        Rgb seen{0.05f};
        for (std::size_t i = 0; i < data.triangles.size(); ++i) {
            const auto& [a, b, c] = data.triangles[i];
            const Triangle one{data.positions[a], data.positions[b], data.positions[c]};
            if (const auto hit = intersect(ray, one)) {
                ray.t_max = hit->t;
                const Vec3 n =
                    glm::normalize(glm::cross(one.v2 - one.v1, one.v3 - one.v1));
                seen = shaded(n, {0.8f, 0.6f, 0.3f});
            }
        }
        return seen;
    });
}
/// Three triangles.
Image triangles(const Eye& eye) {
    const std::array<Triangle, 3> all{
        Triangle{{-1.6f, -0.9f, 0}, {-0.7f, -1.1f, 0}, {-1.2f, 0.1f, 0}},
        Triangle{{0.1f, 0.2f, 0}, {-0.5f, 0.7f, 0}, {0.9f, 1.1f, 0}},
        Triangle{{0.5f, -1.0f, 0}, {1.4f, -0.6f, 0}, {0.9f, -0.2f, 0}}};
    const std::array<Rgb, 3> colors{Rgb{0.8f, 0.6f, 0.3f}, Rgb{0.3f, 0.5f, 0.8f},
                                    Rgb{0.4f, 0.65f, 0.5f}};
    const Camera camera = look_at({.position{0, 0, 6}, .vfov_degrees = 36});
    return draw(eye, camera, [&](const Ray& ray) {
        Rgb seen{0.05f};
        for (std::size_t i = 0; i < all.size(); ++i)
            if (intersect(ray, all[i])) seen = colors[i];
        return seen;
    });
}
Image small_mesh(const Eye& eye) {
    return facets(eye, 0.006f, 2);
}

/// Five hundred balls, found by the plain tree.
Image many_balls(const Eye& eye) {
    std::vector<Sphere> balls;
    for (std::uint64_t i = 0; i < 500; ++i) {
        RandomStream stream = random_stream(1, Pass::camera, 0, i);
        const Vec3 u = next_3d<float>(stream);
        balls.push_back({.center = 2.0f * u - Vec3{1}, .radius = 0.09f});
    }
    std::vector<Box> boxes;
    for (const Sphere& ball : balls) boxes.push_back(bounds(ball));
    const Bvh tree(boxes);
    const Camera camera =
        look_at({.position{2.5f, 2, 4}, .target{0, 0, 0}, .vfov_degrees = 32});
    return draw(eye, camera, [&](const Ray& ray) {
        NearestHit nearest;
        tree.closest(ray, [&](std::uint32_t slot, Ray& rest) {
            const std::uint32_t i = tree.primitive_ids()[slot];
            if (const auto t = intersect(rest, balls[i])) nearest.offer({*t}, i, rest);
        });
        if (!nearest.found) return Rgb{0.05f};
        const Sphere& ball = balls[nearest.number];
        const Vec3 place = ray.origin + nearest.at.t * ray.direction;
        return shaded(glm::normalize(place - ball.center), {0.4f, 0.65f, 0.5f});
    });
}

/// A ring of thin blobs, found by steps along the ray.
Image blobs(const Eye& eye) {
    Metaballs balls;
    for (int i = 0; i < 14; ++i) {
        const float a = 2 * pi * float(i) / 14;
        balls.blobs.push_back(
            {.center{1.2f * std::cos(a), 0.4f * std::sin(2 * a), 1.2f * std::sin(a)},
             .radius = 0.42f});
    }
    const Camera camera =
        look_at({.position{0, 2, 5}, .target{0, 0, 0}, .vfov_degrees = 32});
    return draw(eye, camera, [&](const Ray& ray) {
        const auto t = intersect(ray, balls, SphereTracing{});
        if (!t) return Rgb{0.05f};
        return shaded(surface_point(balls, ray, {.t = *t}).normal, {0.8f, 0.35f, 0.3f});
    });
}

/// A mirror ball over a floor of squares: one reflection, by hand.
Image mirror_ball(const Eye& eye) {
    const Sphere ball{.center{0, 1, 0}, .radius = 1};
    const Camera camera =
        look_at({.position{0, 1.6f, 4.2f}, .target{0, 0.9f, 0}, .vfov_degrees = 40});
    const auto around = [](const Ray& ray) {
        if (ray.direction.y >= 0) return sky(ray.direction);
        const float t = -ray.origin.y / ray.direction.y;
        const float fade = std::min(1.0f, t / 40);
        return glm::mix(checker(ray.origin + t * ray.direction), Rgb{0.6f}, fade);
    };
    return draw(eye, camera, [&](const Ray& ray) {
        const auto t = intersect(ray, ball);
        if (!t) return around(ray);
        const SurfacePoint point = surface_point(ball, ray, {.t = *t});
        return 0.95f *
               around({.origin = point.position,
                       .direction = ljus::reflect(ray.direction, point.normal)});
    });
}

/// What a swimmer sees above: the sky within a cone, and the mirrored floor beside it.
/// \param reflectance  Called with the cosine below and above the water's surface.
template <typename F>
Image pool(const Eye& eye, F&& reflectance) {
    constexpr float index = 1.333f;
    const Camera camera = look_at({.position{0, -1, 0},
                                   .target{0, 0, -0.45f},
                                   .up{0, 0, -1},
                                   .vfov_degrees = 115});
    const Vec3 surface{0, 1, 0};
    return draw(eye, camera, [&](const Ray& ray) {
        if (!(ray.direction.y > 0)) return Rgb{0.1f, 0.2f, 0.25f};
        const float t = 1 / ray.direction.y;
        const Vec3 place = ray.origin + t * ray.direction;
        const Vec3 down = ljus::reflect(ray.direction, surface);
        const Vec3 floor = place + (-2 - place.y) / down.y * down;
        const Rgb below =
            checker(floor) * Rgb{0.25f, 0.6f, 0.65f}; // of the pool, mirrored
        const auto up = ljus::refract(ray.direction, surface, index);
        if (!up) return below;
        const float r = reflectance(ray.direction.y, up->y);
        return r * below + (1 - r) * sky(*up);
    });
}
Image pool_without_fresnel(const Eye& eye) {
    return pool(eye, [](float, float) { return 0.0f; });
}
Image pool_by_schlick(const Eye& eye) {
    return pool(eye, [](float below, float above) {
        return schlick(1.333f, 1.0f, below, above);
    });
}

/// A floor in a white hall of open sky above, with a ball on it: how much of the sky
/// each place sees, by directions that crowd the pole, each divided by its density.
Image open_sky(const Eye& eye) {
    const Sphere ball{.center{0, 0.6f, 0}, .radius = 0.6f};
    const Camera camera =
        look_at({.position{0, 2, 3.6f}, .target{0, 0.35f, 0}, .vfov_degrees = 36});
    constexpr int side = 8;
    return draw(eye, camera, [&](const Ray& ray) {
        SurfacePoint point;
        if (const auto t = intersect(ray, ball)) {
            point = surface_point(ball, ray, {.t = *t});
        } else if (ray.direction.y < 0) {
            const float way = -ray.origin.y / ray.direction.y;
            point = {.position = ray.origin + way * ray.direction, .normal{0, 1, 0}};
        } else {
            return Rgb{1};
        }
        const Frame frame = frame_around(point.normal);
        float sum = 0;
        const Vec2 shift{glm::fract(1e4f * ray.direction.x), // another one for each ray
                         glm::fract(1e4f * ray.direction.y)};
        for (int i = 0; i < side * side; ++i) {
            const Vec2 u = glm::fract(shift + Vec2{float(i % side), float(i / side)} /
                                                  float(side));
            const Vec3 local = sample_naive_hemisphere(u);
            const Vec3 way = to_world(frame, local);
            const Ray out = spawn_ray(point, way);
            if (way.y > 0 && !intersect(out, ball))
                sum += 0.8f / pi * local.z / pdf_naive_hemisphere(local);
        }
        return Rgb{sum / (side * side)};
    });
}

/// A rough ball and a rough floor under one lamp beside the camera.
Image rough_ball(const Eye& eye) {
    const Sphere ball{.center{0, 0, 0}, .radius = 1};
    const OrenNayar clay{.albedo{0.85f, 0.55f, 0.4f}, .sigma = 0.7f};
    const Camera camera = look_at({.position{0, 0, 4.2f}, .vfov_degrees = 36});
    const Vec3 light = glm::normalize(Vec3{-0.9f, 0.5f, 0.6f});
    return draw(eye, camera, [&](const Ray& ray) {
        const auto t = intersect(ray, ball);
        if (!t) return Rgb{0.05f};
        const Frame frame = frame_around(surface_point(ball, ray, {.t = *t}).normal);
        const Vec3 wo = to_local(frame, -ray.direction), wi = to_local(frame, light);
        return wi.z > 0 ? pi * wi.z * evaluate(clay, wo, wi) : Rgb{0};
    });
}

// --- Light ---------------------------------------------------------------------------

/// An open floor and a wall behind it.
Stage floor_stage(const Rgb& albedo = Rgb{0.7f}) {
    Stage stage;
    const auto matt = stage.add(Lambertian{.albedo = albedo});
    stage.add(Quad{.corner{-4, 0, -2}, .edge_u{0, 0, 8}, .edge_v{8, 0, 0}}, matt);
    stage.add(Quad{.corner{-4, 0, -2}, .edge_u{8, 0, 0}, .edge_v{0, 5, 0}}, matt);
    return stage;
}
Camera floor_camera() {
    return look_at({.position{0, 2.1f, 5}, .target{0, 0.5f, 0}, .vfov_degrees = 32});
}
/// A square lamp that shines down.
void add_lamp(Stage& stage, const Vec3& middle, float side, float radiance) {
    stage.add(Quad{.corner = middle - Vec3{side / 2, 0, side / 2},
                   .edge_u{side, 0, 0},
                   .edge_v{0, 0, side}},
              stage.add(Lambertian{.albedo = Rgb{0}}), Rgb{radiance});
}
MaterialId matt(Stage& stage, const Rgb& albedo) {
    return stage.add(Lambertian{.albedo = albedo});
}

/// A picture by the report's renderer.
template <AnyWorld W>
Image by_photons(const Eye& eye, const W& world, const Camera& camera,
                 PhotonMappingSettings how, double share = 1) {
    how.caustics.threads = how.general.threads = eye.threads;
    const RenderSettings picture = eye.settings(share);
    PhotonMapper mapper(world, how, abilities<StratifiedStream, Gathering, Skipping>);
    mapper.fill_cache(camera, picture);
    return render(mapper, camera, picture).image;
}
/// Direct light alone, by sixteen shadow rays to each lamp.
Image direct_light_of(const Eye& eye, const World<Stage>& world) {
    return by_photons(eye, world, floor_camera(),
                      {.max_depth = 10,
                       .shadow_rays = 16,
                       .split_glass = true,
                       .indirect = IndirectLight::none,
                       .caustics{.photons = 0}},
                      0.125);
}
/// Hard shadows and mirrors, without any chance.
template <AnyWorld W>
Image by_whitted(const Eye& eye, const W& world, const Camera& camera,
                 const WhittedSettings& how = {.max_depth = 12}) {
    return render(WhittedTracer(world, how), camera, eye.settings(0.15)).image;
}

/// Two balls under a point light.
Image point_light(const Eye& eye) {
    Stage stage = floor_stage();
    stage.add(Sphere{.center{-0.7f, 0.5f, 0}, .radius = 0.5f},
              matt(stage, {0.8f, 0.5f, 0.2f}));
    stage.add(Sphere{.center{1.1f, 0.7f, -0.6f}, .radius = 0.7f},
              matt(stage, {0.3f, 0.5f, 0.8f}));
    stage.add(PointLight{.position{0.2f, 1.9f, 0.9f}, .intensity = Rgb{7}});
    return by_whitted(eye, World(std::move(stage)), floor_camera());
}
/// A small bright lamp on the left, a large dim one on the right.
Image two_sizes(const Eye& eye) {
    Stage stage = floor_stage();
    add_lamp(stage, {-1.0f, 2.1f, 0}, 0.3f, 70);
    add_lamp(stage, {1.0f, 2.1f, 0}, 1.2f, 5);
    stage.add(Sphere{.center{0, 0.4f, 0.3f}, .radius = 0.4f},
              matt(stage, {0.8f, 0.5f, 0.2f}));
    return direct_light_of(eye, World(std::move(stage)));
}
/// One ball below one lamp.
Image one_lamp(const Eye& eye) {
    Stage stage = floor_stage();
    add_lamp(stage, {-0.6f, 2.1f, 0.2f}, 0.8f, 22);
    stage.add(Sphere{.center{-0.1f, 0.5f, 0.2f}, .radius = 0.5f},
              matt(stage, {0.8f, 0.5f, 0.2f}));
    return direct_light_of(eye, World(std::move(stage)));
}
/// The same by distributed rays.
Image penumbra(const Eye& eye) {
    Stage stage = floor_stage();
    add_lamp(stage, {-0.6f, 2.1f, 0.2f}, 0.8f, 22);
    stage.add(Sphere{.center{-0.1f, 0.5f, 0.2f}, .radius = 0.5f},
              matt(stage, {0.8f, 0.5f, 0.2f}));
    const World world(std::move(stage));
    return render(DistributedTracer(world), floor_camera(), eye.settings(0.5)).image;
}
/// Two lamps of two colours; a path samples one of them.
Image two_lamps(const Eye& eye) {
    Stage stage = floor_stage();
    const auto black = matt(stage, Rgb{0});
    stage.add(Quad{.corner{-1.6f, 2.1f, 0}, .edge_u{0.6f, 0, 0}, .edge_v{0, 0, 0.6f}},
              black, Rgb{40, 24, 10});
    stage.add(Quad{.corner{1.0f, 2.1f, 0}, .edge_u{0.6f, 0, 0}, .edge_v{0, 0, 0.6f}},
              black, Rgb{10, 24, 40});
    stage.add(Sphere{.center{0, 0.5f, 0.3f}, .radius = 0.5f}, matt(stage, Rgb{0.7f}));
    const World world(std::move(stage));
    return render(PathTracer(world, {.max_depth = 1}), floor_camera(), eye.settings(3))
        .image;
}
/// A lamp, and a point light beside it.
Image lamp_and_point(const Eye& eye) {
    Stage stage = floor_stage();
    add_lamp(stage, {-1.2f, 2.1f, 0.2f}, 0.6f, 16);
    stage.add(PointLight{.position{1.6f, 1.9f, 1.0f}, .intensity{4, 5.5f, 8}});
    stage.add(Sphere{.center{0, 0.5f, 0.2f}, .radius = 0.5f}, matt(stage, Rgb{0.8f}));
    return direct_light_of(eye, World(std::move(stage)));
}

/// A ball of glass between walls of bright and dark stripes.
template <typename Add>
Image glass_room(const Eye& eye, Add&& add_ball) {
    Stage stage;
    const auto bright = matt(stage, {0.85f, 0.8f, 0.7f});
    const auto dark = matt(stage, {0.25f, 0.35f, 0.5f});
    for (int i = 0; i < 16; ++i) {
        const float x = -4 + 0.5f * float(i);
        const auto stripe = i % 2 == 0 ? bright : dark;
        stage.add(Quad{.corner{x, 0, -2}, .edge_u{0, 0, 8}, .edge_v{0.5f, 0, 0}},
                  stripe);
        stage.add(Quad{.corner{x, 0, -2}, .edge_u{0.5f, 0, 0}, .edge_v{0, 4, 0}},
                  stripe);
    }
    stage.add(PointLight{.position{-2, 3.5f, 4}, .intensity = Rgb{50}});
    stage.add(PointLight{.position{3, 3, 2}, .intensity = Rgb{14}});
    // The ball mirrors glowing walls that light nothing else.
    const auto black = matt(stage, Rgb{0});
    stage.add(Quad{.corner{-4, 4, -2}, .edge_u{8, 0, 0}, .edge_v{0, 0, 8}}, black,
              Rgb{0.9f, 0.95f, 1.0f});
    for (const float side : {-1.0f, 1.0f})
        stage.add(Quad{.corner{4 * side, 0, 2 - 4 * side},
                       .edge_u{0, 0, 8 * side},
                       .edge_v{0, 4, 0}},
                  black, Rgb{0.55f, 0.5f, 0.6f});
    stage.add(Quad{.corner{4, 0, 6}, .edge_u{-8, 0, 0}, .edge_v{0, 4, 0}}, black,
              Rgb{0.3f, 0.3f, 0.35f});
    add_ball(stage);
    const Camera camera =
        look_at({.position{0, 1.3f, 5}, .target{0, 0.95f, 0}, .vfov_degrees = 32});
    return by_whitted(eye, World(std::move(stage)), camera,
                      {.max_depth = 12, .lamps = false});
}
Image glass_ball(const Eye& eye) {
    return glass_room(eye, [](Stage& stage) {
        stage.add(Sphere{.center{0, 1, 0}, .radius = 0.95f},
                  stage.add(Glass{.index = 1.5f}));
    });
}
/// A lamp in the middle of a ball of glass, and the same lamp beside it.
Image lamp_in_glass(const Eye& eye) {
    return glass_room(eye, [](Stage& stage) {
        const auto black = matt(stage, Rgb{0});
        stage.add(Sphere{.center{-0.55f, 0.95f, 0}, .radius = 0.85f},
                  stage.add(Glass{.index = 1.5f}));
        stage.add(Sphere{.center{-0.55f, 0.95f, 0}, .radius = 0.4f}, black,
                  Rgb{0.7f, 0.55f, 0.3f});
        stage.add(Sphere{.center{0.95f, 0.95f, 0}, .radius = 0.4f}, black,
                  Rgb{0.7f, 0.55f, 0.3f});
    });
}

// --- Paths ---------------------------------------------------------------------------

/// The box with two matt balls, and a lamp so large that paths meet it often.
Room<Stage> wide_lamp_box() {
    Stage stage;
    add_cornell_walls(stage);
    stage.add(Sphere{.center{-0.42f, 0.38f, -0.3f}, .radius = 0.38f},
              matt(stage, {0.2f, 0.35f, 0.7f}));
    stage.add(Sphere{.center{0.42f, 0.38f, 0.3f}, .radius = 0.38f},
              matt(stage, Rgb{0.7f}));
    add_lamp(stage, {0, 1.98f, 0}, 1.4f, 1.3f);
    return {World(std::move(stage)), ljus::cornell_camera()};
}

/// The box with two matt balls, by a path tracer of three surfaces.
Image box_by_paths(const Eye& eye) {
    const auto room = matt_cornell_box();
    return render(PathTracer(room.world, {.max_depth = 3}), room.camera, eye.settings())
        .image;
}
Image box_with_roulette(const Eye& eye) {
    const auto room = matt_cornell_box();
    return render(PathTracer(room.world, {.max_depth = 12, .roulette_depth = 1}),
                  room.camera, eye.settings())
        .image;
}
Image box_by_plain_paths(const Eye& eye) {
    const auto room = wide_lamp_box();
    return render(PlainPathTracer(room.world, 3), room.camera, eye.settings(2)).image;
}
/// Four rays a pixel, so that one sees what the numbers are like.
Image box_with_few_rays(const Eye& eye) {
    const auto room = matt_cornell_box();
    RenderSettings picture = eye.settings();
    picture.samples = std::min(4, picture.samples);
    return render(PathTracer(room.world, {.max_depth = 1}), room.camera, picture).image;
}
Image box_direct(const Eye& eye) {
    const auto room = matt_cornell_box();
    return render(PathTracer(room.world, {.max_depth = 1}), room.camera,
                  eye.settings(0.5))
        .image;
}

/// Cards whose normals are fanned out, as leaves of a game have them, so that they look
/// round. The strong light stands behind them, a weak one in front.
Image cards(const Eye& eye) {
    SmoothStage stage;
    const auto leaf = stage.add(Lambertian{.albedo{0.35f, 0.7f, 0.25f}});
    for (const float x : {-1.3f, 0.0f, 1.3f}) {
        MeshData card{.positions{{x - 0.5f, 0.1f, 0},
                                 {x + 0.5f, 0.1f, 0},
                                 {x + 0.5f, 1.7f, 0},
                                 {x - 0.5f, 1.7f, 0}},
                      .triangles{{0, 1, 2}, {0, 2, 3}}};
        for (const Vec3& corner : card.positions)
            card.normals.push_back(
                glm::normalize(Vec3{2.2f * (corner.x - x), corner.y - 0.9f, 0.6f}));
        stage.add(Mesh(card), leaf);
    }
    stage.add(Quad{.corner{-4, 0, -4}, .edge_u{0, 0, 8}, .edge_v{8, 0, 0}},
              stage.add(Lambertian{.albedo = Rgb{0.4f}}));
    stage.add(PointLight{.position{-3.5f, 2.4f, -1.6f}, .intensity = Rgb{50}});
    stage.add(PointLight{.position{1, 3, 5}, .intensity = Rgb{12}});
    const Camera camera =
        look_at({.position{0, 1.6f, 5.6f}, .target{0, 0.8f, 0}, .vfov_degrees = 42});
    return by_whitted(eye, World(std::move(stage)), camera);
}

/// Where the seven shadow rays of each of many points go to. The lamp is the square.
/// \param eye  Its seed chooses the positions.
Image lamp_places(const Eye& eye) {
    const int rays = 3 + std::min(4, eye.size); // no constant: it is to break
    const auto pattern = ljus::make_pattern(ljus::Sampling::jittered, rays);
    Image image = make_image(eye.size, eye.size, Rgb{0.03f});
    const auto at = [&](float x, float y) -> Rgb& { // the lamp in the middle
        const auto scaled = [&](float u) {
            return std::clamp(int((u + 0.25f) / 1.75f * float(eye.size)), 0,
                              eye.size - 1);
        };
        return pixel(image, scaled(x), scaled(y));
    };
    for (int i = 0; i < 4 * eye.size; ++i)
        for (int j = 0; j < 4 * eye.size; ++j)
            at((float(i) + 0.5f) / float(4 * eye.size),
               (float(j) + 0.5f) / float(4 * eye.size)) = Rgb{0.12f};
    for (std::uint64_t point = 0; point < 150; ++point)
        for (int i = 0; i < rays; ++i) {
            RandomStream stream = random_stream(eye.seed, Pass::camera, 0,
                                                8 * point + static_cast<unsigned>(i));
            const Vec2 place = ljus::spread(pattern, i, point, next_2d<float>(stream));
            at(place.x, place.y) = Rgb{0.95f, 0.8f, 0.35f};
        }
    return image;
}

/// What a reader of the file sees, in which a picture with a bright lamp is kept.
Image as_saved(const Eye& eye) {
    const Image image = box_direct(eye);
    return ljus::decode_image<float>(ljus::encode_png(image), "the picture");
}

// --- Photons -------------------------------------------------------------------------

/// What the maps say of each matt surface, looked at directly.
/// \param maps  Of one picture: each of them adds.
template <AnyWorld W>
Image maps_alone(const Eye& eye, const W& world, const Camera& camera,
                 const std::vector<PhotonMap>& maps,
                 const DensityEstimateSettings& gather) {
    return draw(eye, camera, [&](const Ray& ray) {
        const auto hit = closest_hit(world, ray);
        if (!hit) return Rgb{0};
        const Vertex vertex = vertex_at(world, ray, *hit);
        if (vertex.emits()) return Rgb{1};
        return visit_material_at(world, vertex, [&](const auto& material) {
            if (!has(lobes(material), Lobes::non_specular)) // glass: a hint of it
                return Rgb{0.03f + 0.2f * (1 - std::abs(vertex.wo.z))};
            Rgb sum{0};
            std::uint64_t gathered = 0;
            for (const PhotonMap& map : maps)
                sum += estimate_radiance(map, vertex, material, vertex.wo, gather,
                                         light_kinds, gathered);
            return sum;
        });
    });
}
template <AnyWorld W>
PhotonMap traced(const Eye& eye, const W& world, MapType type,
                 PhotonPassSettings pass) {
    pass.seed = eye.seed;
    pass.threads = eye.threads;
    pass.shadow_photons = false;
    return make_photon_map(trace_photons(world, type, pass).photons);
}
/// How many photons a picture of this size deserves.
long long photons_for(const Eye& eye, double per_pixel) {
    return static_cast<long long>(per_pixel * eye.size * eye.size);
}

/// A lamp above a floor and a ball, by its photons.
Image lamp_by_photons(const Eye& eye, const DensityEstimateSettings& gather,
                      double photons) {
    Stage stage = floor_stage();
    add_lamp(stage, {0, 2.1f, 0.4f}, 0.7f, 25);
    stage.add(Sphere{.center{0.7f, 0.5f, 0}, .radius = 0.5f},
              matt(stage, {0.8f, 0.5f, 0.2f}));
    const World world(std::move(stage));
    const PhotonMap map =
        traced(eye, world, MapType::general,
               {.photons = photons_for(eye, photons), .max_bounces = 1});
    return maps_alone(eye, world, floor_camera(), {map}, gather);
}
Image direct_photons(const Eye& eye) {
    return lamp_by_photons(eye, {.radius = 0.15f}, 20);
}
Image few_photons(const Eye& eye) {
    return lamp_by_photons(eye, {.radius = 1, .nearest = 8, .kernel = Kernel::box}, 5);
}
/// A point light, half of whose photons hit nothing.
Image point_by_photons(const Eye& eye) {
    Stage stage = floor_stage();
    stage.add(PointLight{.position{-0.5f, 1.6f, 0.3f}, .intensity = Rgb{4}});
    stage.add(Sphere{.center{0.6f, 0.5f, 0}, .radius = 0.5f},
              matt(stage, {0.8f, 0.5f, 0.2f}));
    const World world(std::move(stage));
    const PhotonMap map = traced(eye, world, MapType::general,
                                 {.photons = photons_for(eye, 20), .max_bounces = 1});
    return maps_alone(eye, world, floor_camera(), {map}, {.radius = 0.15f});
}
/// In the box photons are reflected again and again.
Image box_by_photons(const Eye& eye) {
    const auto room = matt_cornell_box();
    const PhotonMap map =
        traced(eye, room.world, MapType::general, {.photons = photons_for(eye, 10)});
    return maps_alone(eye, room.world, room.camera, {map}, {.radius = 0.1f});
}

/// Near enough to see what the glass makes.
Camera caustic_camera() {
    return look_at(
        {.position{0.1f, 1.9f, 2.6f}, .target{0.15f, 0.25f, 0.2f}, .vfov_degrees = 27});
}
/// Glass below a lamp.
World<Stage> glass_stage(bool second) {
    Stage stage = floor_stage(Rgb{0.8f});
    stage.add(PointLight{.position{-1.2f, 3.2f, 0.4f}, .intensity = Rgb{4}});
    const auto glass = stage.add(Glass{.index = 1.5f});
    stage.add(Sphere{.center{-0.3f, 0.9f, 0.2f}, .radius = 0.5f}, glass);
    if (second) stage.add(Sphere{.center{0.25f, 0.45f, 0.25f}, .radius = 0.3f}, glass);
    return World(std::move(stage));
}
Image caustic(const Eye& eye, bool second) {
    const auto world = glass_stage(second);
    const PhotonMap map =
        traced(eye, world, MapType::caustics, {.photons = photons_for(eye, 8)});
    return maps_alone(eye, world, caustic_camera(), {map}, {.radius = 0.03f});
}
Image caustic_of_one(const Eye& eye) {
    return caustic(eye, false);
}
Image caustic_of_two(const Eye& eye) {
    return caustic(eye, true);
}
/// Both maps, added.
Image caustic_and_general(const Eye& eye) {
    const auto world = glass_stage(false);
    const PhotonMap caustics =
        traced(eye, world, MapType::caustics, {.photons = photons_for(eye, 8)});
    const PhotonMap general =
        traced(eye, world, MapType::general, {.photons = photons_for(eye, 40)});
    return maps_alone(eye, world, caustic_camera(), {caustics, general},
                      {.radius = 0.06f});
}
/// Where photons lie, as dots: a floor, and a ball of a mixture that is all clear.
Image dots(const Eye& eye) {
    Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Mixture>, Lights<PointLight>>
        stage;
    const auto wall = stage.add(Lambertian{.albedo = Rgb{0.7f}});
    stage.add(Quad{.corner{-4, 0, -2}, .edge_u{0, 0, 8}, .edge_v{8, 0, 0}}, wall);
    stage.add(Quad{.corner{-4, 0, -2}, .edge_u{8, 0, 0}, .edge_v{0, 5, 0}}, wall);
    stage.add(Sphere{.center{0, 0.7f, 0}, .radius = 0.65f},
              stage.add(Mixture{.transparency = 1, .index = 1.5f}));
    stage.add(PointLight{.position{-0.8f, 2.4f, 1.2f}, .intensity = Rgb{4}});
    const World world(std::move(stage));
    const auto found =
        trace_photons(world, MapType::general,
                      {.photons = 8000, .seed = eye.seed, .shadow_photons = false});
    const Camera camera = floor_camera();
    Image image = scene_drawing(world, camera, eye.size, eye.size);
    (void)add_photon_dots(image, world, camera, found.photons,
                          {.radius = 1.4f, .brightness = 0.8f},
                          [](const Photon& photon) { return dot_color(photon); });
    return image;
}
/// A thin screen, lit from behind: its dark side is looked at.
Image screen(const Eye& eye) {
    Stage stage = floor_stage();
    stage.add(Quad{.corner{-1, 0, 0.3f}, .edge_u{2, 0, 0}, .edge_v{0, 1.5f, 0}},
              matt(stage, {0.8f, 0.5f, 0.2f}));
    stage.add(PointLight{.position{0, 1.6f, -1.1f}, .intensity = Rgb{5}});
    const World world(std::move(stage));
    const PhotonMap map = traced(eye, world, MapType::general,
                                 {.photons = photons_for(eye, 20), .max_bounces = 1});
    return maps_alone(eye, world, floor_camera(), {map}, {.radius = 0.12f});
}
/// Sixty photons on a floor, each spread over the ball around it.
Image spread_photons(const Eye& eye) {
    std::vector<Vec3> places;
    for (std::uint64_t i = 0; i < 60; ++i) {
        RandomStream stream = random_stream(eye.seed, Pass::camera, 0, i);
        const Vec2 u = next_2d<float>(stream);
        places.push_back({u.x, u.y, 0});
    }
    const KdTree tree(places);
    constexpr float radius = 0.1f;
    Image image = make_image(eye.size, eye.size);
    for (int y = 0; y < eye.size; ++y)
        for (int x = 0; x < eye.size; ++x) {
            const Vec3 at{(float(x) + 0.5f) / float(eye.size),
                          (float(y) + 0.5f) / float(eye.size), 0};
            int count = 0;
            tree.visit_within(at, radius, [&](std::uint32_t, double) { ++count; });
            pixel(image, x, y) = Rgb{0.16f, 0.12f, 0.06f} * float(count);
        }
    return image;
}

/// The two-pass renderer in the matt box: who adds what.
Image box_by_two_passes(const Eye& eye) {
    const auto room = wide_lamp_box();
    return by_photons(eye, room.world, room.camera,
                      {.max_depth = 3, .direct = DirectLight::analytic});
}
Image box_with_map_seen(const Eye& eye) {
    const auto room = matt_cornell_box();
    return by_photons(eye, room.world, room.camera,
                      {.max_depth = 4,
                       .direct = DirectLight::analytic,
                       .indirect = IndirectLight::photons,
                       .general{.photons = photons_for(eye, 10)},
                       .general_estimate{.radius = 0.15f},
                       .keep_general_map = true},
                      0.25);
}
/// What gather rays look up, looked at directly.
Image box_with_points(const Eye& eye) {
    const auto room = matt_cornell_box();
    PhotonMappingSettings how{.indirect = IndirectLight::gather,
                              .general{.photons = photons_for(eye, 5)}};
    how.general.threads = eye.threads;
    const PhotonMapper mapper(room.world, how, abilities<Gathering>);
    const auto& points = mapper.state<Gathering>().points;
    return draw(eye, room.camera, [&](const Ray& ray) {
        const auto hit = closest_hit(room.world, ray);
        if (!hit) return Rgb{0};
        const Vertex vertex = vertex_at(room.world, ray, *hit);
        if (vertex.emits()) return Rgb{1};
        const Rgb irradiance =
            irradiance_at(points, vertex.point.position,
                          std::copysign(1.0f, vertex.wo.z) * vertex.frame.normal)
                .value_or(Rgb{0});
        return visit_material_at(room.world, vertex, [&](const auto& material) {
            return evaluate(material, vertex.wo, vertex.wo) * irradiance;
        });
    });
}
Image box_with_cache(const Eye& eye) {
    const auto room = matt_cornell_box();
    return by_photons(eye, room.world, room.camera,
                      {.direct = DirectLight::analytic,
                       .indirect = IndirectLight::cache,
                       .general{.photons = photons_for(eye, 5)},
                       .gather{.rays = 64, .tile = 9}},
                      0.125);
}
/// Two lamps and a post: which shadow rays can be left out.
Image two_lamps_skipped(const Eye& eye) {
    Stage stage = floor_stage();
    add_lamp(stage, {-1.3f, 2.0f, 0.6f}, 0.4f, 24);
    add_lamp(stage, {1.3f, 2.0f, 0.6f}, 0.4f, 24);
    stage.add(Sphere{.center{0, 0.6f, 0.2f}, .radius = 0.6f},
              matt(stage, {0.8f, 0.5f, 0.2f}));
    return by_photons(eye, World(std::move(stage)), floor_camera(),
                      {.max_depth = 1,
                       .shadow_rays = 16,
                       .indirect = IndirectLight::none,
                       .caustics{.photons = 0},
                       .general{.photons = std::min(2000LL, photons_for(eye, 10))},
                       .skip{.rule = SkipRule::any, .radius = 0.04f}},
                      0.125);
}
/// Caustics of two balls, whose photons are divided by need.
Image shared_budget(const Eye& eye) {
    const auto world = glass_stage(true);
    PhotonMappingSettings how{.caustics{.photons = photons_for(eye, 8)},
                              .caustic_budget = CausticBudget::flux,
                              .caustics_estimate{.radius = 0.05f}};
    how.caustics.seed = eye.seed;
    how.caustics.threads = eye.threads;
    const PhotonMapper mapper(world, how, abilities<Budgeting>);
    return maps_alone(eye, world, caustic_camera(), {mapper.maps().caustics},
                      {.radius = 0.03f});
}

/// Sixteen passes, each with photons of its own and a smaller radius.
Image sixteen_passes(const Eye& eye) {
    const auto world = glass_stage(false);
    ProgressiveState state;
    (void)run_progressive(
        state, 16,
        [&](long long pass, double shrink) {
            const PhotonMap map = traced(
                eye, world, MapType::caustics,
                {.photons = photons_for(eye, 0.25), .iteration = std::uint64_t(pass)});
            const DensityEstimateSettings gather{.radius = 0.12f * float(shrink)};
            return RenderedT<float>{maps_alone({eye.size, 1, eye.seed, eye.threads},
                                               world, caustic_camera(), {map}, gather)};
        },
        [](const ProgressiveState&) { return true; });
    return mean_image(state);
}
/// The light that the lamp's patches send to all others, in large patches. No solution:
/// with what is broken here there is none.
Image box_by_radiosity(const Eye& eye) {
    const auto room = matt_cornell_box();
    const Patches patches = make_patches(room.world, {.size = 0.25});
    const auto factors =
        make_form_factors(room.world, patches, {.threads = eye.threads});
    std::vector<RgbT<double>> sent;
    for (const Patch& patch : patches.patches) sent.push_back(patch.emitted);
    const auto map = make_light_map(room.world, patches, *factors, sent);
    return render(LightMapView(room.world, map), room.camera, eye.settings(0.1)).image;
}

} // namespace
