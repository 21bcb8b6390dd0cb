// smoke: --width 16 --rays 1
/// \file 37_break_it.cpp
/// \brief Chapter 37: what each mistake looks like. The program is compiled against
/// headers in which the rows of tests/break_it can be switched on, one at a time: the
/// right picture, the wrong one, and their difference with its sign.

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#if __has_include("ljus_break_it.hpp")
#include "ljus_break_it.hpp" // made by cmake/break_it_gallery.py
#define LJUS_HAS_MISTAKES
#endif

#include <ljus/accel/kd_tree.hpp>
#include <ljus/accel/mesh.hpp>
#include <ljus/inspect/photon_dots.hpp>
#include <ljus/io/load_image.hpp>
#include <ljus/io/png.hpp>
#include <ljus/ljus.hpp>
#include <ljus/render/distributed.hpp>
#include <ljus/render/plain_path_tracing.hpp>
#include <ljus/render/whitted.hpp>
#include <ljus/scenes/cornell_box.hpp>
#include <ljus/scenes/mesh_formulas.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/error_map.hpp"
#include "common/plot.hpp"
#include "common/terminal.hpp"

using namespace ljus;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

using Stage = CornellSceneT<float>; // quads and balls; matt, mirror, glass
using SmoothStage = Scene<Shapes<Mesh, Quad>, Materials<Lambertian>>;

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
                    sum += color(primary_ray(camera,
                                             Vec2{float(x), float(y)} + place,
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

// --- Rays and surfaces ----------------------------------------------------------------

/// Rays whose directions have the length that the film gives them.
Image unnormalised(const Eye& eye) {
    const std::array balls{Sphere{.center{0.55f, 0.1f, -2.2f}, .radius = 1},
                           Sphere{.center{-0.95f, -0.5f, -1.9f}, .radius = 0.6f}};
    const Camera camera{.half_height = 1};
    return draw(eye, camera, [&](Ray ray) {
        ray.direction /= -ray.direction.z; // (x, y, -1): a point of the film
        Rgb seen{0.05f};
        for (const Sphere& ball : balls)
            if (const auto t = intersect(ray, ball)) {
                ray.t_max = *t;
                const Vec3 place = ray.origin + *t * ray.direction;
                const Vec3 normal = glm::normalize(place - ball.center);
                seen = shaded(normal, ball.radius < 1 ? Rgb{0.9f, 0.5f, 0.2f}
                                                      : Rgb{0.3f, 0.5f, 0.8f});
            }
        return seen;
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
            const Triangle one = ljus::detail::triangle_of(data, i);
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
Image icosahedron(const Eye& eye) {
    return facets(eye, 1, 0);
}
Image small_mesh(const Eye& eye) {
    return facets(eye, 0.006f, 2);
}

/// A hundred balls, found by the plain tree.
Image many_balls(const Eye& eye) {
    std::vector<Sphere> balls;
    for (int i = 0; i < 140; ++i) {
        const float a = 2.39996f * float(i), r = 0.16f * std::sqrt(float(i) + 0.5f);
        balls.push_back({.center{r * std::cos(a), r * std::sin(a), 0}, .radius = 0.12f});
    }
    std::vector<Box> boxes;
    for (const Sphere& ball : balls) boxes.push_back(bounds(ball));
    const Bvh tree(boxes);
    const Camera camera = look_at({.position{0, 0, 5}, .vfov_degrees = 46});
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

/// Three blobs that have grown together.
Image blobs(const Eye& eye) {
    const Metaballs balls{.blobs = {{.center{-0.75f, -0.3f, 0}, .radius = 1.3f},
                                    {.center{0.75f, -0.3f, 0}, .radius = 1.3f},
                                    {.center{0, 0.75f, 0.2f}, .radius = 1.1f}}};
    const Camera camera = look_at({.position{0, 0.1f, 6}, .vfov_degrees = 36});
    return draw(eye, camera, [&](const Ray& ray) {
        const auto t = intersect(ray, balls);
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

/// What a swimmer sees above: the sky within a cone, and the floor of the pool beside it.
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
    constexpr int side = 12;
    return draw({eye.size, 1, eye.seed, eye.threads}, camera, [&](const Ray& ray) {
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
        for (int i = 0; i < side * side; ++i) {
            const Vec2 u{(float(i % side) + 0.5f) / side, (float(i / side) + 0.5f) / side};
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

// --- Light ----------------------------------------------------------------------------

/// An open floor and a wall behind it.
Stage floor_stage(const Rgb& albedo = Rgb{0.7f}) {
    Stage stage;
    const auto matt = stage.add(Lambertian{.albedo = albedo});
    stage.add(Quad{.corner{-4, 0, -2}, .edge_u{0, 0, 8}, .edge_v{8, 0, 0}}, matt);
    stage.add(Quad{.corner{-4, 0, -2}, .edge_u{8, 0, 0}, .edge_v{0, 5, 0}}, matt);
    return stage;
}
Camera floor_camera() {
    return look_at({.position{0, 2.2f, 5}, .target{0, 0.75f, 0}, .vfov_degrees = 36});
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
Image by_photons(const Eye& eye, const Stage& stage, const Camera& camera,
                 PhotonMappingSettings how, double share = 1) {
    how.caustics.threads = how.general.threads = eye.threads;
    const RenderSettings picture = eye.settings(share);
    PhotonMapsT<float> maps = make_photon_maps(stage, how);
    add_irradiance_cache(maps, stage, camera, picture, how);
    return render(make_photon_mapper<StratifiedStream>(stage, maps, how), camera,
                  picture)
        .image;
}
/// Direct light alone, by sixteen shadow rays to each lamp.
Image direct_light_of(const Eye& eye, const Stage& stage) {
    return by_photons(eye, stage, floor_camera(),
                      {.max_depth = 10,
                       .shadow_rays = 16,
                       .split_glass = true,
                       .indirect = IndirectLight::none,
                       .caustics{.photons = 0}},
                      0.125);
}
/// Hard shadows and mirrors, without any chance.
template <typename S>
Image by_whitted(const Eye& eye, const S& stage, const Camera& camera,
                 const WhittedSettings& how = {.max_depth = 12}) {
    return render(make_whitted(stage, how), camera, eye.settings(0.15)).image;
}

/// Two balls under a point light.
Image point_light(const Eye& eye) {
    Stage stage = floor_stage();
    stage.add(Sphere{.center{-0.7f, 0.5f, 0}, .radius = 0.5f},
              matt(stage, {0.8f, 0.5f, 0.2f}));
    stage.add(Sphere{.center{1.1f, 0.7f, -0.6f}, .radius = 0.7f},
              matt(stage, {0.3f, 0.5f, 0.8f}));
    stage.add(PointLight{.position{0.2f, 1.9f, 0.9f}, .intensity = Rgb{7}});
    return by_whitted(eye, stage, floor_camera());
}
/// The same on a floor of a size at which float's roundings show.
Image own_shadow(const Eye& eye) {
    return point_light(eye);
}
/// A small bright lamp on the left, a large dim one on the right.
Image two_sizes(const Eye& eye) {
    Stage stage = floor_stage();
    add_lamp(stage, {-1.1f, 1.7f, 0}, 0.3f, 26);
    add_lamp(stage, {1.1f, 1.7f, 0}, 1.2f, 1.6f);
    stage.add(Sphere{.center{0, 0.4f, 0.3f}, .radius = 0.4f},
              matt(stage, {0.8f, 0.5f, 0.2f}));
    return direct_light_of(eye, stage);
}
/// One ball below one lamp.
Image one_lamp(const Eye& eye) {
    Stage stage = floor_stage();
    add_lamp(stage, {-0.6f, 2.1f, 0.2f}, 0.8f, 9);
    stage.add(Sphere{.center{0.3f, 0.5f, 0.2f}, .radius = 0.5f},
              matt(stage, {0.8f, 0.5f, 0.2f}));
    return direct_light_of(eye, stage);
}
/// The same by distributed rays.
Image penumbra(const Eye& eye) {
    Stage stage = floor_stage();
    add_lamp(stage, {-0.6f, 2.1f, 0.2f}, 0.8f, 9);
    stage.add(Sphere{.center{0.3f, 0.5f, 0.2f}, .radius = 0.5f},
              matt(stage, {0.8f, 0.5f, 0.2f}));
    return render(make_distributed(stage), floor_camera(), eye.settings(0.5)).image;
}
/// Two lamps of two colours, of which a path asks one.
Image two_lamps(const Eye& eye) {
    Stage stage = floor_stage();
    const auto black = matt(stage, Rgb{0});
    stage.add(Quad{.corner{-1.6f, 1.8f, 0}, .edge_u{0.6f, 0, 0}, .edge_v{0, 0, 0.6f}},
              black, Rgb{9, 5, 2});
    stage.add(Quad{.corner{1.0f, 1.8f, 0}, .edge_u{0.6f, 0, 0}, .edge_v{0, 0, 0.6f}},
              black, Rgb{2, 5, 9});
    stage.add(Sphere{.center{0, 0.5f, 0.3f}, .radius = 0.5f}, matt(stage, Rgb{0.7f}));
    return render(make_path_tracer(stage, {.max_depth = 1}), floor_camera(),
                  eye.settings())
        .image;
}
/// A lamp, and a point light beside it.
Image lamp_and_point(const Eye& eye) {
    Stage stage = floor_stage();
    add_lamp(stage, {-1.2f, 1.8f, 0.2f}, 0.6f, 6);
    stage.add(PointLight{.position{1.6f, 1.9f, 1.0f}, .intensity{1.6f, 2.2f, 3.2f}});
    stage.add(Sphere{.center{0, 0.5f, 0.2f}, .radius = 0.5f}, matt(stage, Rgb{0.8f}));
    return direct_light_of(eye, stage);
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
        stage.add(Quad{.corner{x, 0, -2}, .edge_u{0, 0, 8}, .edge_v{0.5f, 0, 0}}, stripe);
        stage.add(Quad{.corner{x, 0, -2}, .edge_u{0.5f, 0, 0}, .edge_v{0, 4, 0}}, stripe);
    }
    stage.add(PointLight{.position{-2, 4, 4}, .intensity = Rgb{50}});
    stage.add(PointLight{.position{3, 3, 2}, .intensity = Rgb{14}});
    add_ball(stage);
    const Camera camera =
        look_at({.position{0, 1.3f, 5}, .target{0, 0.95f, 0}, .vfov_degrees = 32});
    return by_whitted(eye, stage, camera);
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

// --- Paths ----------------------------------------------------------------------------

/// The box with two matt balls, by a path tracer of three surfaces.
Image box_by_paths(const Eye& eye) {
    const auto room = matt_cornell_box();
    return render(make_path_tracer(room.scene, {.max_depth = 3}), room.camera,
                  eye.settings())
        .image;
}
Image box_with_roulette(const Eye& eye) {
    const auto room = matt_cornell_box();
    return render(make_path_tracer(room.scene, {.max_depth = 12, .roulette_depth = 1}),
                  room.camera, eye.settings())
        .image;
}
Image box_by_plain_paths(const Eye& eye) {
    const auto room = matt_cornell_box();
    return render(make_plain_path_tracer(room.scene, 3), room.camera, eye.settings(1.5))
        .image;
}
/// Four rays a pixel, so that one sees what the numbers are like.
Image box_with_few_rays(const Eye& eye) {
    const auto room = matt_cornell_box();
    return render(make_path_tracer(room.scene, {.max_depth = 1}), room.camera,
                  eye.settings(0.0625))
        .image;
}
Image box_direct(const Eye& eye) {
    const auto room = matt_cornell_box();
    return render(make_path_tracer(room.scene, {.max_depth = 1}), room.camera,
                  eye.settings(0.5))
        .image;
}

/// A ball of few triangles that is shaded as if it were round, the lamp behind it.
Image smooth_ball(const Eye& eye) {
    MeshData data = icosphere(Sphere{.center{0, 1, 0}, .radius = 1}, 1);
    smooth_normals(data);
    SmoothStage stage;
    stage.add(Mesh(data), stage.add(Lambertian{.albedo{0.8f, 0.6f, 0.4f}}));
    stage.add(Quad{.corner{-4, 0, -4}, .edge_u{0, 0, 8}, .edge_v{8, 0, 0}},
              stage.add(Lambertian{.albedo = Rgb{0.4f}}));
    stage.add(PointLight{.position{-2.5f, 2.8f, -2.2f}, .intensity = Rgb{45}});
    const Camera camera =
        look_at({.position{0, 1.6f, 4.6f}, .target{0, 0.95f, 0}, .vfov_degrees = 32});
    return by_whitted(eye, stage, camera);
}

/// Where the seven shadow rays of each point go to on the lamp.
Image lamp_places(const Eye& eye) {
    constexpr int rays = 8;
    const auto strata = ljus::detail::strata_for(rays);
    Image image = make_image(eye.size, eye.size, Rgb{0.05f});
    for (std::uint64_t point = 0; point < 400; ++point)
        for (int i = 0; i < rays; ++i) {
            RandomStream stream = random_stream(eye.seed, Pass::camera, 0, 8 * point + i);
            const Vec2 place =
                ljus::detail::stratified(strata, i, point, next_2d<float>(stream));
            const int x = std::clamp(int(place.x * float(eye.size)), 0, eye.size - 1);
            const int y = std::clamp(int(place.y * float(eye.size)), 0, eye.size - 1);
            pixel(image, x, y) = Rgb{0.9f, 0.75f, 0.3f};
        }
    return image;
}

/// What a reader of the file sees, in which a picture with a bright lamp is kept.
Image as_saved(const Eye& eye) {
    const Image image = one_lamp(eye);
    return ljus::detail::decode_image<float>(ljus::detail::encode_png(image), "the picture");
}

// --- Photons --------------------------------------------------------------------------

/// What the maps say of each matt surface, looked at directly.
/// \param maps  Of one picture: each of them adds.
Image maps_alone(const Eye& eye, const Stage& stage, const Camera& camera,
                 const std::vector<PhotonMap>& maps,
                 const DensityEstimateSettings& gather) {
    return draw(eye, camera, [&](const Ray& ray) {
        const auto hit = closest_hit(stage, ray);
        if (!hit) return Rgb{0};
        const Vertex vertex = vertex_at(stage, ray, *hit);
        if (vertex.emits()) return Rgb{1};
        return visit_material_at(stage, vertex, [&](const auto& material) {
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
PhotonMap traced(const Eye& eye, const Stage& stage, MapType type,
                 PhotonPassSettings pass) {
    pass.seed = eye.seed;
    pass.threads = eye.threads;
    pass.shadow_photons = false;
    return make_photon_map(trace_photons(stage, type, pass).photons);
}
/// How many photons a picture of this size deserves.
long long photons_for(const Eye& eye, double per_pixel) {
    return static_cast<long long>(per_pixel * eye.size * eye.size);
}

/// A lamp above a floor and a ball, by its photons.
Image lamp_by_photons(const Eye& eye, const DensityEstimateSettings& gather,
                      double photons, int bounces = 1) {
    Stage stage = floor_stage();
    add_lamp(stage, {0, 2.1f, 0.4f}, 0.7f, 8);
    stage.add(Sphere{.center{0.7f, 0.5f, 0}, .radius = 0.5f},
              matt(stage, {0.8f, 0.5f, 0.2f}));
    const PhotonMap map = traced(
        eye, stage, MapType::general,
        {.photons = photons_for(eye, photons), .max_bounces = bounces});
    return maps_alone(eye, stage, floor_camera(), {map}, gather);
}
Image direct_photons(const Eye& eye) {
    return lamp_by_photons(eye, {.radius = 0.15f}, 20);
}
Image few_photons(const Eye& eye) {
    return lamp_by_photons(eye, {.radius = 1, .nearest = 8}, 5);
}
/// In the box photons are reflected again and again.
Image box_by_photons(const Eye& eye) {
    const auto room = matt_cornell_box();
    const PhotonMap map = traced(eye, room.scene, MapType::general,
                                 {.photons = photons_for(eye, 10)});
    return maps_alone(eye, room.scene, room.camera, {map}, {.radius = 0.1f});
}

/// Glass below a lamp.
Stage glass_stage(bool second) {
    Stage stage = floor_stage(Rgb{0.8f});
    stage.add(PointLight{.position{-1.2f, 3.2f, 0.4f}, .intensity = Rgb{4}});
    const auto glass = stage.add(Glass{.index = 1.5f});
    stage.add(Sphere{.center{-0.3f, 0.9f, 0.2f}, .radius = 0.5f}, glass);
    if (second) stage.add(Sphere{.center{0.25f, 0.45f, 0.25f}, .radius = 0.3f}, glass);
    return stage;
}
Image caustic(const Eye& eye, bool second) {
    const Stage stage = glass_stage(second);
    const PhotonMap map =
        traced(eye, stage, MapType::caustics, {.photons = photons_for(eye, 8)});
    return maps_alone(eye, stage, floor_camera(), {map}, {.radius = 0.05f});
}
Image caustic_of_one(const Eye& eye) {
    return caustic(eye, false);
}
Image caustic_of_two(const Eye& eye) {
    return caustic(eye, true);
}
/// Both maps, added.
Image caustic_and_general(const Eye& eye) {
    const Stage stage = glass_stage(false);
    const PhotonMap caustics =
        traced(eye, stage, MapType::caustics, {.photons = photons_for(eye, 8)});
    const PhotonMap general =
        traced(eye, stage, MapType::general, {.photons = photons_for(eye, 40)});
    return maps_alone(eye, stage, floor_camera(), {caustics, general},
                      {.radius = 0.06f});
}
/// Where photons lie, as dots.
Image dots(const Eye& eye) {
    const Stage stage = glass_stage(true);
    const auto found =
        trace_photons(stage, MapType::general,
                      {.photons = 20000, .seed = eye.seed, .shadow_photons = false});
    const Camera camera = floor_camera();
    Image image = scene_drawing(stage, camera, eye.size, eye.size);
    (void)add_photon_dots(image, stage, camera, found.photons,
                          {.radius = 1.0f, .brightness = 0.6f},
                          [](const Photon& photon) { return dot_color(photon); });
    return image;
}
/// A thin screen, lit from behind: its dark side is looked at.
Image screen(const Eye& eye) {
    Stage stage = floor_stage();
    stage.add(Quad{.corner{-1, 0, 0.3f}, .edge_u{2, 0, 0}, .edge_v{0, 1.5f, 0}},
              matt(stage, {0.8f, 0.5f, 0.2f}));
    stage.add(PointLight{.position{0, 1.6f, -1.1f}, .intensity = Rgb{5}});
    const PhotonMap map =
        traced(eye, stage, MapType::general,
               {.photons = photons_for(eye, 20), .max_bounces = 1});
    return maps_alone(eye, stage, floor_camera(), {map}, {.radius = 0.12f});
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
    const auto room = matt_cornell_box();
    return by_photons(eye, room.scene, room.camera,
                      {.max_depth = 3, .direct = DirectLight::analytic});
}
Image box_with_map_seen(const Eye& eye) {
    const auto room = matt_cornell_box();
    return by_photons(eye, room.scene, room.camera,
                      {.max_depth = 4,
                       .direct = DirectLight::analytic,
                       .indirect = IndirectLight::photons,
                       .general{.photons = photons_for(eye, 10)},
                       .general_estimate{.radius = 0.15f}},
                      0.25);
}
Image box_with_gathering(const Eye& eye) {
    const auto room = matt_cornell_box();
    return by_photons(eye, room.scene, room.camera,
                      {.direct = DirectLight::analytic,
                       .indirect = IndirectLight::gather,
                       .general{.photons = photons_for(eye, 5)}},
                      0.5);
}
Image box_with_cache(const Eye& eye) {
    const auto room = matt_cornell_box();
    return by_photons(eye, room.scene, room.camera,
                      {.direct = DirectLight::analytic,
                       .indirect = IndirectLight::cache,
                       .general{.photons = photons_for(eye, 5)},
                       .gather{.rays = 64, .tile = 9}},
                      0.125);
}
/// Two lamps and a post: which shadow rays can be left out.
Image two_lamps_skipped(const Eye& eye) {
    Stage stage = floor_stage();
    add_lamp(stage, {-1.5f, 2.0f, 0.6f}, 0.4f, 14);
    add_lamp(stage, {1.5f, 2.0f, 0.6f}, 0.4f, 14);
    stage.add(Sphere{.center{0, 0.6f, 0.2f}, .radius = 0.6f},
              matt(stage, {0.8f, 0.5f, 0.2f}));
    return by_photons(eye, stage, floor_camera(),
                      {.max_depth = 1,
                       .shadow_rays = 16,
                       .indirect = IndirectLight::none,
                       .caustics{.photons = 0},
                       .general{.photons = photons_for(eye, 30)},
                       .skip{.rule = SkipRule::enough}},
                      0.125);
}
/// Caustics of two balls, the budget of photons shared out by what they need.
Image shared_budget(const Eye& eye) {
    const Stage stage = glass_stage(true);
    PhotonMappingSettings how{.caustics{.photons = photons_for(eye, 8)},
                              .caustic_budget = CausticBudget::flux,
                              .caustics_estimate{.radius = 0.05f}};
    how.caustics.seed = eye.seed;
    how.caustics.threads = eye.threads;
    const PhotonMapsT<float> maps = make_photon_maps(stage, how);
    return maps_alone(eye, stage, floor_camera(), {maps.caustics}, {.radius = 0.05f});
}

// --- The gallery ----------------------------------------------------------------------

/// A mistake and the scene that shows it.
struct Mistake {
    const char* row;              ///< Of tests/break_it.
    Image (*picture)(const Eye&); ///< Right or wrong, as the headers are switched.
    double range = 0.5; ///< Of the map of differences, in shares of white.
};

constexpr std::array mistakes{
    // Rays and surfaces
    Mistake{.row = "sphere-direction-length", .picture = unnormalised},
    Mistake{.row = "triangle-epsilon", .picture = small_mesh},
    Mistake{.row = "triangle-u-plus-v", .picture = icosahedron},
    Mistake{.row = "ray-stay", .picture = own_shadow},
    Mistake{.row = "shading_normals-side", .picture = smooth_ball},
    Mistake{.row = "bvh-later", .picture = many_balls},
    Mistake{.row = "metaballs-blossom", .picture = blobs},
    Mistake{.row = "reflection-half", .picture = mirror_ball},
    // Glass
    Mistake{.row = "glass-half-vector", .picture = glass_ball},
    Mistake{.row = "schlick-thin-side", .picture = pool_by_schlick},
    Mistake{.row = "refraction-total-ignored", .picture = pool_without_fresnel},
    Mistake{.row = "glass-index-swapped", .picture = glass_ball},
    Mistake{.row = "glass-squared-index", .picture = lamp_in_glass},
    Mistake{.row = "whitted-branch", .picture = glass_ball},
    // Light
    Mistake{.row = "lambertian-missing-pi", .picture = box_by_paths, .range = 1},
    Mistake{.row = "lambertian-doubled-cosine", .picture = box_by_paths, .range = 0.1},
    Mistake{.row = "hemisphere_sampling-belt", .picture = open_sky},
    Mistake{.row = "oren_nayar-azimuth", .picture = rough_ball, .range = 0.2},
    Mistake{.row = "direct-light-pdf", .picture = one_lamp, .range = 2},
    Mistake{.row = "direct-light-distance", .picture = point_light, .range = 1},
    Mistake{.row = "solid-angle-area", .picture = two_sizes, .range = 1},
    Mistake{.row = "path-tracing-light-choice", .picture = two_lamps},
    Mistake{.row = "direct-light-inverted", .picture = lamp_and_point},
    Mistake{.row = "direct-light-shadow", .picture = one_lamp},
    Mistake{.row = "distributed-rays-hard-shadow", .picture = penumbra},
    Mistake{.row = "path-tracing-plain-twice", .picture = box_by_plain_paths,
            .range = 0.5},
    Mistake{.row = "depth-roulette", .picture = box_with_roulette, .range = 0.2},
    Mistake{.row = "stratified-remainder", .picture = lamp_places},
    Mistake{.row = "rays-alike", .picture = box_with_few_rays},
    Mistake{.row = "render-shared-stream", .picture = box_direct, .range = 0.1},
    Mistake{.row = "png-maximum", .picture = as_saved},
    // Photons
    Mistake{.row = "emission-cosine", .picture = direct_photons, .range = 0.2},
    Mistake{.row = "tracing-stored", .picture = caustic_of_one, .range = 1},
    Mistake{.row = "aim-weight", .picture = caustic_of_one, .range = 4},
    Mistake{.row = "caustics-overlap", .picture = caustic_of_two, .range = 0.5},
    Mistake{.row = "tracing-owner", .picture = caustic_and_general},
    Mistake{.row = "photon-mapping-emission", .picture = box_by_two_passes},
    Mistake{.row = "photon-mapping-direct-twice", .picture = box_with_map_seen},
    Mistake{.row = "roulette-uncompensated", .picture = box_by_photons, .range = 0.1},
    Mistake{.row = "general-map-mirror", .picture = dots},
    Mistake{.row = "general-map-other-side", .picture = screen},
    Mistake{.row = "kd-tree-cube", .picture = spread_photons},
    Mistake{.row = "photon-mapping-kernel", .picture = direct_photons},
    Mistake{.row = "photon-map-k", .picture = few_photons, .range = 0.2},
    Mistake{.row = "shadow-photons-lights", .picture = two_lamps_skipped},
    Mistake{.row = "final-gathering-edge", .picture = box_with_gathering, .range = 0.1},
    Mistake{.row = "irradiance-cache-weight", .picture = box_with_cache, .range = 0.05},
    Mistake{.row = "caustic_budget-flux", .picture = shared_budget, .range = 0.5},
};

#ifdef LJUS_HAS_MISTAKES

/// The right picture, the wrong one, and the map of their difference, side by side.
Image side_by_side(const Image& right, const Image& wrong, double range) {
    ImageT<double> difference = make_image<double>(right.width, right.height);
    for (std::size_t i = 0; i < right.pixels.size(); ++i)
        difference.pixels[i] =
            RgbT<double>{double(luminance(wrong.pixels[i]) - luminance(right.pixels[i]))};
    const Image map =
        examples::error_picture(difference, examples::Ramp::signs, -range, range);
    const int gap = 6, width = right.width;
    Image all = make_image(2 * (width + gap) + map.width, map.height, Rgb{1});
    const auto put = [&](const Image& part, int left) {
        for (int y = 0; y < part.height; ++y)
            for (int x = 0; x < part.width; ++x)
                pixel(all, left + x, y) = pixel(part, x, y);
    };
    put(right, 0);
    put(wrong, width + gap);
    put(map, 2 * (width + gap));
    return all;
}

/// Text for a page.
std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        result += c == '&'   ? std::string("&amp;")
                  : c == '<' ? std::string("&lt;")
                             : std::string(1, c);
    return result;
}

/// A page's address, as Doxygen names that of a source file.
std::string source_page(const std::string& file) {
    std::string name;
    for (const char c : file)
        name += c == '_' ? std::string("__") : std::string(1, c);
    return name + "_8cpp_source.html";
}

/// The line as it was and as it is broken, and the test that notices.
std::string told(const ljus_break_it::Told& row) {
    char line[32];
    std::snprintf(line, sizeof line, "#l%05d", row.line);
    const std::string to = row.to;
    return "<div class=\"ljus-mistake\"><pre class=\"fragment\">ljus/" +
           escaped(row.header) + "\n<del>- " + escaped(row.from) + "</del>\n<ins>+ " +
           (to.empty() ? std::string("(nothing)") : escaped(to)) +
           "</ins></pre>\n<p>Row <code>" + row.name +
           "</code>; noticed by <a href=\"" +
           source_page(std::string(row.test) + "_test") + line + "\">" +
           escaped(row.noticed) + "</a>.</p></div>\n";
}

/// The mean of the luminance, without what is no number.
double mean(const Image& image) {
    double sum = 0;
    for (const Rgb& color : image.pixels)
        if (is_finite(color)) sum += double(luminance(color));
    return sum / double(image.pixels.size());
}

/// Makes the gallery, or the part of it that is asked for.
void gallery(const examples::Options& options, const Eye& eye,
             const std::string& only) {
    std::map<Image (*)(const Eye&), Image> right; // shared by several mistakes
    examples::Table list{.name = "break_it-list",
                         .columns = {"row", "header", "test", "brightness",
                                     "largest difference", "seconds"}};
    examples::ProgressBar bar("mistakes", options.quiet);
    long long done = 0;
    for (const Mistake& mistake : mistakes) {
        (void)bar(done++, static_cast<long long>(mistakes.size()));
        if (!only.empty() && only != mistake.row) continue;
        const examples::StopWatch clock;
        const int number = ljus_break_it::number_of(mistake.row);
        ljus_break_it::row = 0;
        if (!right.contains(mistake.picture))
            right[mistake.picture] = mistake.picture(eye);
        const Image& good = right[mistake.picture];
        ljus_break_it::row = number;
        const Image wrong = mistake.picture(eye);
        ljus_break_it::row = 0;
        const std::string name = std::string("break_it-") + mistake.row;
        save_png(side_by_side(good, wrong, mistake.range), options.path(name + ".png"));
        const auto& row = ljus_break_it::told[static_cast<std::size_t>(number)];
        examples::save_text(options.path(name + ".html"), told(row));
        double largest = 0;
        for (std::size_t i = 0; i < wrong.pixels.size(); ++i) {
            const double d = double(luminance(wrong.pixels[i] - good.pixels[i]));
            if (std::abs(d) > std::abs(largest)) largest = d;
        }
        list.rows.push_back({mistake.row, row.header, row.test,
                             examples::text(mean(wrong) / mean(good), "%.2f"),
                             examples::text(largest, "%+.2f"),
                             examples::text(clock.seconds(), "%.2f")});
    }
    if (only.empty()) save_table(options.out, list);
    else
        for (const auto& line : list.rows)
            std::printf("%s: brightness %s, largest difference %s, %s s\n",
                        line[0].c_str(), line[3].c_str(), line[4].c_str(),
                        line[5].c_str());
}

#endif

} // namespace

/// The program's entry.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("What each mistake of tests/break_it looks like.");
        std::string only;
        line.add("--row", only, "only this mistake");
        line.without({"--height"});
        const examples::Options options =
            line.parse({.draft{.width = 160, .height = 160, .samples = 32},
                        .report{.width = 200, .height = 200, .samples = 256},
                        .reference{.width = 320, .height = 320, .samples = 1024}});
        const Eye eye{.size = options.width,
                      .samples = options.samples,
                      .seed = options.seed,
                      .threads = options.threads};
#ifdef LJUS_HAS_MISTAKES
        gallery(options, eye, only);
#else
        (void)mistakes;
        (void)eye;
        std::puts("This program shows mistakes, and was compiled against headers "
                  "without any: build it with CMake, and with Python 3.9 or later.");
#endif
    });
}
