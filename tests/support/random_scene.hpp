#pragma once

/// \file support/random_scene.hpp
/// \brief Makes random scenes of the shapes, materials and lights of the library.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "ljus/accel/instances.hpp"
#include "ljus/geometry/cylinder.hpp"
#include "ljus/geometry/disc.hpp"
#include "ljus/geometry/metaballs.hpp"
#include "ljus/geometry/moving.hpp"
#include "ljus/lights/environment.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/lights/spot_light.hpp"
#include "ljus/lights/sun_light.hpp"
#include "ljus/materials/compensated_glossy.hpp"
#include "ljus/materials/eon.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/materials/oren_nayar.hpp"
#include "ljus/materials/rough_diffuse.hpp"
#include "ljus/materials/rough_glass.hpp"
#include "ljus/materials/soap_film.hpp"
#include "ljus/materials/textured.hpp"
#include "ljus/scene/camera.hpp"
#include "ljus/scene/world.hpp"
#include "ljus/scenes/mesh_formulas.hpp"
#include "support/draws.hpp"

namespace ljus_test {

using Checkered = ljus::Textured<ljus::Lambertian, ljus::Checker>;
using RandomScene = ljus::Scene<
    ljus::Shapes<ljus::Quad, ljus::Sphere, ljus::Triangle, ljus::Disc, ljus::Cylinder,
                 ljus::Mesh, ljus::Instance, ljus::Metaballs,
                 ljus::Moving<ljus::Sphere>, ljus::Moving<ljus::Quad>>,
    ljus::Materials<ljus::Lambertian, ljus::OrenNayar, ljus::Eon, ljus::RoughDiffuse,
                    Checkered, ljus::Glossy, ljus::RoughMetal, ljus::CompensatedGlossy,
                    ljus::Mirror, ljus::Metal, ljus::Glass, ljus::RoughGlass,
                    ljus::ThinGlass, ljus::SoapFilm, ljus::Mixture>,
    ljus::Lights<ljus::PointLight, ljus::SpotLight, ljus::SunLight,
                 ljus::EnvironmentLight>>;

/// A random scene with its properties.
struct DrawnScene {
    ljus::World<RandomScene> world;
    ljus::Camera camera{};
    std::string what{};    ///< The parts of the scene, in words.
    bool specular = false; ///< Whether a material is specular.
    bool glossy = false;   ///< Whether a material is glossy.
    bool sharp = false;    ///< Whether a material is nearly specular.
    bool point = false;    ///< Whether a light has no area.
    bool open = false;     ///< Whether light can leave the scene.
    bool merges = true;    ///< Whether vertex merging accepts the scene.
};

/// Makes random scenes. Objects touch neither each other nor a wall. A path tracer
/// cannot find caustics of a light without an area. No scene therefore has such a light
/// together with a specular or nearly specular material. In scenes with specular
/// materials the lamps are large enough for paths to meet them.
class SceneDrawer {
public:
    explicit SceneDrawer(std::uint64_t seed) : draws_{seed} {
        for (int i = 0; i < 4; ++i) (void)draws_.bits();
    }

    /// Makes the scene of the seed.
    DrawnScene draw() {
        const int place = draws_.below(6); // 0 to 3: a room, 4: a corridor, 5: a floor
        open_ = place == 5;
        point_ = draws_.below(open_ ? 2 : 4) == 0;
        say(open_ ? "floor:" : place == 4 ? "corridor:" : "room:");
        const float length = place == 4 ? 3.0f : 1.0f;
        if (open_)
            wall({-4, -1, -4}, {0, 0, 8}, {8, 0, 0});
        else
            walls(length);
        const int count = 2 + draws_.below(3);
        const int first = draws_.below(4);
        for (int i = 0; i < count; ++i) object((first + i) % 4, length);
        const int lamps = 1 + draws_.below(2);
        for (int i = 0; i < lamps; ++i) lamp(i, place == 4);
        const float across = draws_.between(-0.3f, 0.3f);
        const float height = draws_.between(-0.2f, 0.5f);
        const float front = open_ ? 2.4f : length - 0.04f;
        const ljus::Vec3 target{-across, draws_.between(-0.6f, -0.2f), 0};
        const auto camera = ljus::look_at({.position{across, height, front},
                                           .target = target,
                                           .vfov_degrees = open_ ? 45.0f : 70.0f});
        return {ljus::World(std::move(scene_)),
                camera,
                what_,
                specular_,
                glossy_,
                sharp_,
                point_,
                open_,
                merges_};
    }

private:
    using V = ljus::Vec3;
    using Rgb = ljus::Rgb;
    using Id = ljus::MaterialId;

    void say(const std::string& word) { what_ += (what_.empty() ? "" : " ") + word; }

    Rgb color(float low, float high) {
        const float r = draws_.between(low, high), g = draws_.between(low, high);
        return {r, g, draws_.between(low, high)};
    }

    /// A material that reflects diffusely.
    Id matt() {
        const Rgb albedo = color(0.2f, 0.8f);
        switch (draws_.below(6)) {
        case 0:
            say("Oren-Nayar");
            return scene_.add(
                ljus::OrenNayar{.albedo = albedo, .sigma = draws_.between(0.1f, 0.7f)});
        case 1:
            say("EON");
            return scene_.add(ljus::Eon{.albedo = albedo, .roughness = unit()});
        case 2:
            say("rough");
            return scene_.add(
                ljus::RoughDiffuse{.albedo = albedo,
                                   .sigma = draws_.between(0.1f, 0.7f),
                                   .model = ljus::RoughModel(draws_.below(4))});
        case 3: {
            say("checkered");
            const float side = draws_.between(0.3f, 1.5f);
            return scene_.add(Checkered{
                {.albedo = Rgb{1}},
                {.map{.edge_u{side, 0, 0}, .edge_v{0, 0, side}}, .even = albedo}});
        }
        default:
            say("Lambertian");
            return scene_.add(ljus::Lambertian{.albedo = albedo});
        }
    }

    /// A material with a glossy lobe.
    Id gloss() {
        glossy_ = true;
        const float roughness = draws_.between(point_ ? 0.45f : 0.15f, 0.8f);
        sharp_ = sharp_ || roughness < 0.42f;
        const ljus::Glossy glossy{.reflectance = color(0.4f, 0.95f),
                                  .roughness = roughness};
        const std::string of = std::to_string(roughness).substr(0, 4);
        switch (draws_.below(3)) {
        case 0:
            say("rough-metal" + of);
            return scene_.add(ljus::RoughMetal{.reflectance = ljus::copper<float>,
                                               .roughness = roughness});
        case 1:
            say("full-gloss" + of);
            return scene_.add(ljus::compensated_glossy(glossy));
        default:
            say("gloss" + of);
            return scene_.add(glossy);
        }
    }

    /// A specular material, or a mixture with a specular lobe.
    /// \param solid  Whether the shape is closed, so that it can contain a medium.
    Id specular(bool solid) {
        specular_ = true;
        switch (draws_.below(solid ? 7 : 4)) {
        case 0:
            say("mirror");
            return scene_.add(ljus::Mirror{.reflectance = color(0.6f, 0.95f)});
        case 1:
            say("metal");
            return scene_.add(ljus::Metal{});
        case 2:
            say("thin-glass");
            return scene_.add(ljus::ThinGlass{.tint = color(0.5f, 1)});
        case 3:
            say("film");
            return scene_.add(ljus::SoapFilm{
                .thickness = draws_.between(200.f, 700.f), .scale = 1, .up{0, 1, 0}});
        case 4: {
            say("glass");
            const float index = draws_.between(1.2f, 1.9f);
            return scene_.add(
                ljus::Glass{.index = index, .absorption = color(0, 1.5f)});
        }
        case 5: {
            const float roughness = draws_.between(0.2f, 0.7f);
            say("rough-glass" + std::to_string(roughness).substr(0, 4));
            sharp_ = sharp_ || roughness < 0.42f;
            return scene_.add(ljus::RoughGlass{.index = draws_.between(1.2f, 1.9f),
                                               .roughness = roughness,
                                               .absorption = color(0, 1)});
        }
        default: {
            say("mixture");
            const Rgb albedo = color(0.2f, 0.9f);
            const float reflectivity = draws_.between(0.f, 0.5f);
            const float transparency = draws_.between(0.f, 0.8f);
            return scene_.add(ljus::Mixture{.color = albedo,
                                            .reflectivity = reflectivity,
                                            .transparency = transparency,
                                            .index = 1.5f,
                                            .specularity = unit(),
                                            .sigma = draws_.between(0.f, 0.5f),
                                            .absorption = color(0, 1)});
        }
        }
    }

    Id any(bool solid) {
        const int kind = draws_.below(5);
        if (kind < 2 && !point_) return specular(solid);
        return kind == 2 ? gloss() : matt();
    }

    void wall(const V& corner, const V& u, const V& v) {
        const int kind = draws_.below(12);
        const bool mirror = kind == 0 && !point_;
        if (mirror) {
            specular_ = true;
            say("mirror");
        }
        const Id material = mirror ? scene_.add(ljus::Mirror{.reflectance = Rgb{0.8f}})
                            : kind == 1 ? gloss()
                                        : matt();
        scene_.add(ljus::Quad{corner, u, v}, material);
    }

    void walls(float length) {
        const V x{2, 0, 0}, y{0, 2, 0}, z{0, 0, 2 * length};
        wall({-1, -1, -length}, z, x);
        wall({-1, 1, -length}, x, z);
        wall({-1, -1, -length}, x, y);
        wall({-1, -1, length}, y, x);
        wall({-1, -1, -length}, y, z);
        wall({1, -1, -length}, z, y);
    }

    /// A mesh of a box with outward normals, turned about the vertical axis.
    ljus::Mesh box(const V& center, float half) {
        const float angle = draws_.between(0.f, 1.5f);
        const V u = half * V{std::cos(angle), 0, std::sin(angle)};
        const V w = half * V{-std::sin(angle), 0, std::cos(angle)};
        const V up{0, half * draws_.between(0.4f, 1.f), 0};
        ljus::MeshData data;
        for (int i = 0; i < 8; ++i)
            data.positions.push_back(center + (i & 1 ? u : -u) + (i & 2 ? up : -up) +
                                     (i & 4 ? w : -w));
        const auto face = [&](unsigned a, unsigned b, unsigned c, unsigned d) {
            data.triangles.push_back({a, b, c});
            data.triangles.push_back({a, c, d});
        };
        face(0, 2, 3, 1);
        face(4, 5, 7, 6);
        face(0, 4, 6, 2);
        face(1, 3, 7, 5);
        face(2, 6, 7, 3);
        face(0, 1, 5, 4);
        return ljus::Mesh(std::move(data));
    }

    void object(int cell, float length) {
        const float reach = draws_.between(0.22f, 0.36f); // radius of the bounding
                                                          // sphere
        const float high = draws_.between(-0.98f + reach, -0.3f);
        const V center{cell % 2 == 0 ? -0.45f : 0.45f, high,
                       (cell / 2 == 0 ? -0.5f : 0.25f) * length};
        const int shape = draws_.below(11);
        const bool solid = shape < 5 || shape > 8;
        switch (shape) {
        case 0:
        case 1:
            say("sphere");
            scene_.add(ljus::Sphere{center, reach}, any(solid));
            break;
        case 2:
            say("box");
            scene_.add(box(center, 0.57f * reach), any(solid));
            break;
        case 3:
            if (draws_.below(2) == 0) {
                say("ball-mesh");
                scene_.add(ljus::Mesh(ljus::icosphere(ljus::Sphere{center, reach},
                                                      1 + draws_.below(3))),
                           any(solid));
            } else {
                say("torus");
                scene_.add(ljus::Mesh(ljus::torus(center, 0.7f * reach, 0.28f * reach,
                                                  24, 12)),
                           any(solid));
            }
            break;
        case 4: {
            say("metaballs");
            const V off = 0.4f * reach * draws_.direction<float>();
            const float blob = 0.6f * reach;
            scene_.add(
                ljus::Metaballs{
                    {{.center = center + off, .radius = blob},
                     {.center = center - off, .radius = blob, .weight = 0.7f}}},
                any(solid));
            break;
        }
        case 5: {
            say("moving-ball");
            merges_ = false;
            const V way = 0.7f * reach * draws_.direction<float>();
            scene_.add(
                ljus::Moving<ljus::Sphere>{{center - 0.5f * way, 0.6f * reach}, way},
                any(true));
            break;
        }
        case 6: {
            say("screen");
            const float angle = draws_.between(-1.f, 1.f);
            const V u = reach * V{std::cos(angle), 0, std::sin(angle)};
            const V v{0, 1.2f * reach, 0};
            scene_.add(ljus::Quad{center - 0.5f * (u + v), u, v}, any(solid));
            break;
        }
        case 7:
            say("disc");
            scene_.add(ljus::Disc{center, draws_.direction<float>(), reach},
                       any(solid));
            break;
        case 9: {
            say("cylinder");
            const V axis = 1.2f * reach * draws_.direction<float>();
            const ljus::Cylinder tube{center - 0.5f * axis, axis, 0.6f * reach};
            const Id material = any(solid);
            scene_.add(tube, material);
            for (const ljus::Disc& end : ljus::ends_of(tube)) scene_.add(end, material);
            break;
        }
        case 10: { // turned, stretched, sometimes mirrored
            say("instance");
            const V u = draws_.direction<float>();
            const V v = glm::normalize(glm::cross(u, draws_.direction<float>()));
            const float mirror = draws_.below(3) == 0 ? -1.0f : 1.0f;
            const ljus::Affine place(
                mirror * reach * u, draws_.between(0.4f, 1.f) * reach * v,
                draws_.between(0.4f, 1.f) * reach * glm::cross(u, v), center);
            const auto mesh = scene_.add(ljus::Mesh(
                draws_.below(2) == 0
                    ? ljus::icosphere(ljus::Sphere{V{0}, 1}, 1 + draws_.below(3))
                    : ljus::torus(V{0}, 0.7f, 0.28f, 24, 12)));
            scene_.add(ljus::Instance(mesh, place), any(solid));
            break;
        }
        default:
            say("triangle");
            const V a = reach * draws_.direction<float>();
            const V b = reach * draws_.direction<float>();
            scene_.add(ljus::Triangle{center + a, center + b, center - 0.7f * (a + b)},
                       any(solid));
            break;
        }
    }

    void lamp(int number, bool corridor) {
        const float x = number == 0 ? -0.4f : 0.45f;
        const V center{x + draws_.between(-0.1f, 0.1f), draws_.between(0.6f, 0.9f),
                       corridor ? -2.6f : draws_.between(-0.5f, 0.5f)};
        const Rgb light = draws_.between(2.f, 8.f) * color(0.5f, 1);
        const float size = draws_.between(0.15f, 0.3f);
        if (point_ && number == 0) {
            const int kind = draws_.below(open_ ? 3 : 2);
            if (kind == 0) {
                say("POINT");
                scene_.add(
                    ljus::PointLight{.position = center, .intensity = 0.2f * light});
            } else if (kind == 1) {
                say("SPOT");
                const V to = draws_.direction<float>();
                scene_.add(
                    ljus::SpotLight{.position = center,
                                    .direction = V{0, -1, 0} + 0.5f * to,
                                    .intensity = 0.5f * light,
                                    .inner_degrees = draws_.between(5.f, 30.f),
                                    .outer_degrees = draws_.between(35.f, 90.f)});
            } else {
                say("SUN");
                merges_ = false;
                const V to = draws_.direction<float>();
                scene_.add(ljus::SunLight{.direction = V{0, -1, 0} + 0.6f * to,
                                          .irradiance = light});
            }
            return;
        }
        if (open_ && draws_.below(2) == 0) return sky(light);
        const Id black = scene_.add(ljus::Lambertian{.albedo = Rgb{0}});
        switch (draws_.below(6)) {
        case 0:
        case 1:
            say("QUAD");
            scene_.add(ljus::Quad{center - V{size, 0, size},
                                  {2 * size, 0, 0},
                                  {0, 0, 2 * size}},
                       black, light);
            break;
        case 2:
            say("SPHERE");
            scene_.add(ljus::Sphere{center - V{0, 0.2f, 0}, 0.7f * size}, black, light);
            break;
        case 3:
            say("TRIANGLE");
            scene_.add(ljus::Triangle{center + V{-size, 0, -size},
                                      center + V{size, 0, -size},
                                      center + V{0, 0.05f, 1.5f * size}},
                       black, light);
            break;
        case 4:
            say("MESH");
            scene_.add(ljus::Mesh(ljus::icosphere(
                           ljus::Sphere{center - V{0, 0.2f, 0}, 0.7f * size}, 0)),
                       black, light);
            break;
        default:
            say("MOVING");
            merges_ = false;
            scene_.add(
                ljus::Moving<ljus::Quad>{
                    {center - V{size, 0, size}, {2 * size, 0, 0}, {0, 0, 2 * size}},
                    {0, -0.3f, 0}},
                black, light);
            break;
        }
    }

    /// A sky that is brighter at one side.
    void sky(const Rgb& light) {
        say("SKY");
        merges_ = false;
        ljus::Image picture = ljus::make_image(8, 4);
        for (Rgb& pixel : picture.pixels) pixel = 0.05f * draws_.unit<float>() * light;
        picture.pixels[std::size_t(draws_.below(16))] = light;
        scene_.add(ljus::EnvironmentLight{.picture = std::move(picture)});
    }

    float unit() { return draws_.unit<float>(); }

    Draws draws_;
    RandomScene scene_{};
    std::string what_{};
    bool specular_ = false, glossy_ = false, sharp_ = false, point_ = false,
         open_ = false, merges_ = true;
};

} // namespace ljus_test
