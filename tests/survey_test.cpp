#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "ljus/accel/mesh.hpp"
#include "ljus/geometry/metaballs.hpp"
#include "ljus/inspect/survey.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/lights/sun_light.hpp"
#include "ljus/materials/cut_out.hpp"
#include "ljus/materials/dispersive_glass.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/glossy.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/materials/nested.hpp"
#include "ljus/materials/normal_map.hpp"
#include "ljus/materials/oren_nayar.hpp"
#include "ljus/materials/rough_glass.hpp"
#include "ljus/materials/soap_film.hpp"
#include "ljus/render/budgeting.hpp"
#include "ljus/render/gathering.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "ljus/render/skipping.hpp"
#include "ljus/scene/picture_lamp.hpp"
#include "support/refusal.hpp"
#include "support/rooms.hpp"

using namespace ljus;
using namespace ljus_test;

/// A shape of a user's own, with a misspelt hook.
namespace user {

struct Ball {
    Sphere inner;
};

auto intersect(const Ray& ray, const Ball& ball) {
    return intersect(ray, ball.inner);
}
SurfacePoint surface_point(const Ball& ball, const Ray& ray,
                           const ShapeHitT<float>& hit) {
    return surface_point(ball.inner, ray, hit);
}
Sphere bounding_sphere(const Ball& ball) {
    return ball.inner;
}
void check(const Ball& ball) {
    check(ball.inner);
}
[[maybe_unused]] Box bound(const Ball& ball) {
    return bounds(ball.inner);
} // bounds
float area(const Ball& ball) {
    return area(ball.inner);
}
template <typename Compute>
bool meets(const Ray& ray, const Ball& ball) {
    return intersect<Compute>(ray, ball.inner).has_value();
}

/// A material of a user's own, with a misspelt hook.
struct Fog {
    using Scalar = float;
};
Lobes lobes(const Fog&) {
    return Lobes::none;
}
Rgb evaluate(const Fog&, const Vec3&, const Vec3&) {
    return Rgb{0};
}
float pdf(const Fog&, const Vec3&, const Vec3&, Lobes) {
    return 0;
}
std::optional<BsdfSample> sample(const Fog&, const Vec3&, const Vec3&, Transport,
                                 Lobes) {
    return std::nullopt;
}
void check(const Fog&) {}
[[maybe_unused]] Rgb absorbtion(const Fog&) {
    return Rgb{1};
} // absorption
Rgb emission(const Fog&) {
    return Rgb{2};
}

/// A wrapper of a user's own, which has only the absorption of its base.
template <Material Base>
struct Named {
    using Scalar = float;
    static constexpr bool scatters_as_base = true;
    Base base{};
};
template <typename Base>
void check(const Named<Base>&) {}
template <MayAbsorb Base>
Rgb absorption(const Named<Base>& named) {
    return absorption(named.base);
}

} // namespace user

TEST_CASE("survey: counts what a scene is made of") {
    const ClosedRoom room = make_room<float>(Ball::mixture, Lamp::quad, 2);
    const SceneNeeds found = needs(room);
    CHECK(found.objects == 6 + 1 + 2);
    CHECK(found.diffuse == 6 + 1 + 2); // the mixture is both
    CHECK(found.specular == 1);
    CHECK(found.lights == 2);
    const SceneNeeds points = needs(make_room<float>(Ball::glass, Lamp::point, 2));
    CHECK(points.objects == 7);
    CHECK(points.diffuse == 6);
    CHECK(points.specular == 1);
    CHECK(points.lights == 2);
}

TEST_CASE("survey: each pass is on or off for a reason that is printed") {
    const ClosedRoom matt = make_room<float>(Ball::oren_nayar, Lamp::sphere, 1);
    const ClosedRoom glass = make_room<float>(Ball::glass, Lamp::sphere, 1);
    BallRoom dark;
    add_walls(dark);
    add_ball(dark, Ball::mirror);
    const World world(std::move(dark));

    PhotonMappingSettings settings;
    Plan plan = survey(glass, settings);
    CHECK(plan.shadow_rays.on);
    CHECK(plan.shadow_rays.why ==
          "7 of 8 objects reflect diffusely, lit by 1 light(s)");
    CHECK(plan.indirect_rays.on);
    CHECK(plan.caustics_map.on);
    CHECK(plan.caustics_map.why ==
          "1 of 8 objects mirrors or refracts; radius 0.1 in a scene 2 across");
    CHECK_FALSE(plan.general_map.on);
    CHECK(plan.general_map.why == "no ray uses it");
    CHECK_FALSE(plan.shadow_photons.on);
    CHECK(plan.skipped_rays.why == "no rule was asked for");
    CHECK(plan.skipped_bounces.why == "not asked for");
    settings.skip = {.rule = SkipRule::enough, .indirect_rays = true};
    settings.general.photons = 0;
    plan = survey(glass, settings);
    CHECK(plan.skipped_rays.why.starts_with("0 photons, and each light needs "));
    CHECK(plan.skipped_bounces.why == "0 photons were asked for");
    plan = survey(glass, settings = {});
    CHECK(plan.tree.on);
    CHECK(plan.tree.why == "8 objects, a tree finds the first on a ray");
    BallRoom one;
    one.add(Sphere{}, one.add(Lambertian{}));
    one.add(Sphere{}, one.add(Lambertian{}));
    plan = survey(World(one), settings); // of two
    CHECK_FALSE(plan.tree.on);
    CHECK(plan.tree.why == "2 object(s), a loop tests each");
    one.add(Sphere{}, one.add(Lambertian{}));
    CHECK(survey(World(one), settings).tree.on); // of three

    plan = survey(matt, settings);
    CHECK_FALSE(plan.caustics_map.on);
    CHECK(plan.caustics_map.why == "no object mirrors or refracts");

    settings.caustics.photons = 0;
    plan = survey(glass, settings);
    CHECK_FALSE(plan.caustics_map.on);
    CHECK(plan.caustics_map.why ==
          "0 photons were asked for, and caustics are missing");

    settings = {};
    settings.indirect = IndirectLight::map;
    plan = survey(matt, settings);
    CHECK(plan.general_map.on);
    CHECK(plan.shadow_photons.on);
    settings.general.shadow_photons = false;
    plan = survey(matt, settings);
    CHECK(plan.general_map.on);
    CHECK_FALSE(plan.shadow_photons.on);
    CHECK(plan.shadow_photons.why == "no map keeps them");
    settings = {};
    settings.keep_general_map = true;
    CHECK(survey(matt, settings).general_map.on);

    plan = survey(world, PhotonMappingSettings{});
    CHECK_FALSE(plan.shadow_rays.on);
    CHECK(plan.shadow_rays.why == "the scene has no light");
    CHECK_FALSE(plan.indirect_rays.on);
    CHECK_FALSE(plan.caustics_map.on);
    CHECK(plan.caustics_map.why == "nothing is lit");
    CHECK(PhotonMapper(world).maps().caustics.empty());

    for (const PlanItem* item : plan.items()) {
        CHECK(std::string(item->pass).size() > 0);
        CHECK(item->why.size() > 0);
    }
}

TEST_CASE("survey: the lines as they are printed, and one photon is enough") {
    PhotonMappingSettings settings{.indirect = IndirectLight::map};
    settings.caustics.photons = 1;
    settings.general.photons = 1;
    const Plan plan = survey(make_room<float>(Ball::glass, Lamp::sphere, 1), settings);
    CHECK(plan.caustics_map.on);
    CHECK(plan.general_map.on);
    CHECK(plan.shadow_photons.why == "the general map keeps them");
    CHECK(plan.general_map.why ==
          "it provides indirect light; radius 0.3 in a scene 2 across");
    CHECK(plan.indirect_rays.why == "7 of 8 objects light each other");
    CHECK(to_text(plan.tree) ==
          "tree             on   8 objects, a tree finds the first on a ray\n");
    CHECK(to_text(plan.thin_film) ==
          "thin film        off  no material is a thin film\n");
    std::string all;
    for (const PlanItem* item : plan.items()) all += to_text(*item);
    CHECK(to_text(plan) == all);
    CHECK(all.starts_with("shadow rays      on   7 of 8 objects reflect diffusely"));
    CHECK(std::count(all.begin(), all.end(), '\n') ==
          std::ptrdiff_t(plan.items().size()));
}

TEST_CASE("survey: what the plan leaves out is not done") {
    BallRoom dark;
    add_walls(dark);
    const World world(std::move(dark)); // nothing is lit, so no ray looks for light
    const PhotonMapper mapper(world);
    CHECK(mapper.bounces() == Lobes::specular);
    const auto picture =
        render(mapper, room_camera<float>(), {.width = 4, .height = 4, .samples = 2});
    CHECK(picture.counts.rays() == picture.counts.camera_rays);
    BallRoom lit;
    add_walls(lit);
    add_lamps(lit, Lamp::quad, 1);
    const World lit_world(std::move(lit));
    CHECK(PhotonMapper(lit_world).bounces() == Lobes::all);
}

TEST_CASE("survey: a hook that is misspelt shows") {
    const World world(Scene<Shapes<user::Ball, Quad>, Materials<user::Fog, Glass>>{});
    const std::vector<std::string> lines = survey_hooks(world);
    REQUIRE(lines.size() == 4);
    CHECK(lines[0].starts_with("shape "));
    CHECK(lines[0].find("user::Ball ") != std::string::npos); // as the compiler has it
    CHECK(lines[0].ends_with(
        " has meets, area; without bounds (its sphere's box), "
        "shading_normal (the geometric one), sample_area (refused as a light), "
        "sample_towards (points of its area), pdf_towards (points of its area), "
        "center_sample (u = v = 1/2), normal (at its sphere), point_at (at each "
        "point), form_factor_from (by facet_of()), facet_of (by rays), patch_grid "
        "(left out of it), corners_of (darker at them), texture_coordinates (those "
        "of the hit), texture_tangents (refused with one), translated (does not "
        "compile), area_sums (by sample_area()), "
        "prototype (it has all its data)"));
    CHECK(lines[1].starts_with("shape QuadT<float> has bounds, area, "));
    CHECK(lines[2].ends_with(
        " has emission; without absorption (clear), refractive_index (opaque in "
        "contact), priority (0), emission_picture (even light), at_point (the same "
        "anywhere), uses_uv (uv is 0), is_open (solid), normal_at (the shape's), split "
        "(one branch at random), "
        "pass_through (opaque), at_wavelength (one index for all light), only_specular "
        "(write both)"));
    CHECK(lines[2].starts_with("material "));
    CHECK(lines[3].starts_with("material GlassT<float> has absorption, "
                               "refractive_index, split, only_specular; without "
                               "priority (0), emission (black), "));
}

TEST_CASE("survey: the hooks of the house's own types") {
    const auto has = [](const auto& hooks, std::string_view name) {
        for (const auto& hook : hooks)
            if (hook.name == name) return hook.provided;
        FAIL("no such hook: " << name);
        return false;
    };
    const auto sphere = detail::shape_hooks<Sphere>();
    for (const auto* name : {"bounds", "area", "sample_area", "sample_towards",
                             "pdf_towards", "center_sample", "form_factor_from",
                             "patch_grid", "texture_coordinates", "translated"})
        CHECK_MESSAGE(has(sphere, name), name);
    for (const auto* name :
         {"meets", "shading_normal", "normal", "point_at", "facet_of", "corners_of"})
        CHECK_FALSE_MESSAGE(has(sphere, name), name);
    const auto mesh = detail::shape_hooks<Mesh>();
    for (const auto* name :
         {"bounds", "meets", "shading_normal", "area", "texture_coordinates"})
        CHECK_MESSAGE(has(mesh, name), name);
    CHECK_FALSE(has(mesh, "sample_towards"));
    for (const auto* name :
         {"normal", "point_at", "facet_of", "corners_of", "patch_grid"})
        CHECK_MESSAGE(has(detail::shape_hooks<Triangle>(), name), name);
    CHECK_FALSE(has(detail::shape_hooks<Metaballs>(), "area"));
    CHECK_FALSE(has(detail::shape_hooks<Metaballs>(), "sample_area"));

    for (const auto& hook : detail::material_hooks<Lambertian>())
        CHECK_FALSE_MESSAGE(hook.provided, hook.name);
    CHECK(has(detail::material_hooks<Mixture>(), "emission"));
    CHECK(has(detail::material_hooks<SoapFilm>(), "pass_through"));
    CHECK(has(detail::material_hooks<SoapFilm>(), "at_point"));
    CHECK(has(detail::material_hooks<Textured<Lambertian, UvPicture>>(), "uses_uv"));
}

TEST_CASE_TEMPLATE("survey: the wrappers of the house keep the hooks of any base", M,
                   Lambertian, Mirror, Mixture, SoapFilm, ThinGlass, PictureLamp, Glass,
                   RoughGlass, DispersiveGlass) {
    const auto keeps = []<typename Over>(const Over&) {
        CHECK_MESSAGE(detail::keeps_hooks<Over>, detail::type_name<Over>());
    };
    keeps(Textured<M, NormalMap>{});
    keeps(CutOut<M, UvPicture>{});
    keeps(CutOut<Textured<M, NormalMap>, UvPicture>{});
    keeps(Textured<CutOut<M, UvPicture>, NormalMap>{});
    if constexpr (Transparent<M>) {
        keeps(Nested<M>{});
        keeps(Nested<Textured<M, NormalMap>>{});
        keeps(Textured<Nested<M>, NormalMap>{});
    }
}

TEST_CASE("survey: a wrapper that hides a hook of its base is not taken for one") {
    CHECK(detail::keeps_hooks<Lambertian>);
    CHECK(detail::keeps_hooks<user::Named<Lambertian>>);
    CHECK_FALSE(detail::keeps_hooks<user::Named<Glass>>);
    CHECK_FALSE(detail::keeps_hooks<user::Named<Mixture>>);
    CHECK_FALSE(detail::keeps_hooks<user::Named<Textured<Lambertian, UvPicture>>>);
}

TEST_CASE("survey: a sigma that looks like degrees is remarked on") {
    Scene<Shapes<Sphere>, Materials<Lambertian, OrenNayar, Mixture>, Lights<PointLight>>
        scene;
    scene.add(PointLight{.intensity = Rgb{1}});
    scene.add(OrenNayar{.sigma = std::numbers::pi_v<float> / 2}); // the steepest slope
    scene.add(Mixture{.sigma = 0.3f});
    CHECK(survey(World(scene), {}).remarks.empty());
    scene.add(OrenNayar{.sigma = 30});
    scene.add(Mixture{.sigma = 1.7f});
    const auto remarks = survey(World(std::move(scene)), {}).remarks;
    REQUIRE(remarks.size() == 1);
    CHECK(remarks[0] ==
          "2 material(s) have a sigma above 1.6 radians, where the models of rough "
          "surfaces hardly change: divide degrees by 57.3");
}

TEST_CASE("survey: the light that no path carries is named") {
    const auto remarks = [](bool glass, bool sun, bool lamp) {
        Scene<Shapes<Sphere>, Materials<Lambertian, Glass>,
              Lights<PointLight, SunLight>>
            scene;
        const auto matt = scene.add(Lambertian{});
        scene.add(Sphere{{0, -10, 0}, 10}, matt);
        if (glass) scene.add(Sphere{{0, 2, 0}, 1}, scene.add(Glass{}));
        if (lamp) scene.add(Sphere{{0, 6, 0}, 1}, matt, Rgb{1});
        if (sun) {
            scene.add(SunLight{.direction = {0, -1, 0}});
            scene.add(PointLight{.position = {3, 3, 0}});
        }
        const World world(std::move(scene));
        CHECK(survey(world, {}).remarks.empty()); // photons carry it
        return path_remarks(world);
    };
    CHECK(remarks(true, true, true) ==
          std::vector<std::string>{
              "2 light(s) have no size, so that no path meets them: what mirrors and "
              "glass make of their light is missing; photon mapping carries it"});
    CHECK(remarks(true, false, true).empty());
    CHECK(remarks(false, true, true).empty());
}

TEST_CASE("survey: where float stops holding, it says so, with the digits left") {
    const auto remarks = [](const auto& world) {
        return survey(world, PhotonMappingSettings{}).remarks;
    };
    const auto moved = [](auto far, auto radius) {
        using T = decltype(far);
        Scene<Shapes<SphereT<T>>, Materials<LambertianT<T>>, Lights<PointLightT<T>>>
            scene;
        const auto white = scene.add(LambertianT<T>{});
        scene.add(SphereT<T>{.center{T(0), T(0), T(0)}, .radius = T(1)}, white);
        scene.add(SphereT<T>{.center{T(0), -far, T(0)}, .radius = radius}, white);
        scene.add(PointLightT<T>{.intensity = RgbT<T>(T(1))});
        return World(std::move(scene));
    };
    CHECK(remarks(moved(1e4f, 1.0f)).empty());
    CHECK(remarks(moved(1e7f, 1e4f)).empty()); // a large thing may be far away
    REQUIRE(remarks(moved(1e5f, 1.0f)).size() == 1);
    CHECK(
        remarks(moved(1e5f, 1.0f))[0] ==
        "coordinates reach 1e+05 times the smallest radius, 1: float keeps 2 digits of "
        "it; use double, or move the scene towards the origin");
    CHECK(remarks(moved(1e6f, 1.0f))[0].find("keeps 1 digit of") != std::string::npos);
    CHECK(remarks(moved(1e8f, 1.0f))[0].find("keeps 0 digits of") != std::string::npos);
    CHECK(remarks(moved(1.0f, 1e-6f))[0].find("keeps 1 digit of") != std::string::npos);
    CHECK(remarks(moved(1e8, 1.0)).empty());
    CHECK(
        remarks(moved(1e14, 1.0))[0] ==
        "coordinates reach 1e+14 times the smallest radius, 1: double keeps 1 digit of "
        "it; move the scene towards the origin");
    // Whichever comes first, and however large what comes later is.
    Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<PointLight>> turned;
    const auto grey = turned.add(Lambertian{});
    turned.add(PointLight{.intensity = Rgb{1}});
    turned.add(Sphere{.center{0, -1e5f, 0}, .radius = 1}, grey);
    turned.add(Sphere{.radius = 0.5f}, grey);
    CHECK(remarks(World(turned)) == remarks(moved(1e5f, 1.0f)));
    turned.add(Sphere{.center{1e6f, 0, 0}, .radius = 1e6f}, grey);
    const World world(std::move(turned));
    CHECK(remarks(world) == remarks(moved(1e5f, 1.0f)));
    // All corners are one point: no digit is left, and no ratio to say it by.
    const auto point = [](auto far) {
        using T = decltype(far);
        Scene<Shapes<TriangleT<T>>, Materials<LambertianT<T>>> scene;
        const Vec3T<T> corner{far, -far, far};
        scene.add(TriangleT<T>{.v1 = corner, .v2 = corner, .v3 = corner},
                  scene.add(LambertianT<T>{}));
        const World closed(std::move(scene));
        return detail::digits_remark(closed);
    };
    CHECK(point(100.0f) ==
          "an object is so small or so far away that float keeps nothing of its size; "
          "use double, or move the scene towards the origin");
    CHECK(point(100.0) ==
          "an object is so small or so far away that double keeps nothing of its size; "
          "move the scene towards the origin");
    // It stands in the plan, and the first pass says it again.
    const auto far = moved(1e5f, 1.0f);
    const Plan plan = survey(far, PhotonMappingSettings{});
    CHECK(to_text(plan).ends_with("\nremark          " + plan.remarks[0] + "\n"));
    CHECK(mapper_remarks(PhotonMapper(far)) == plan.remarks[0] + "\n");
}

TEST_CASE("survey: lengths whose squares leave the range, and a gloss, by what it is") {
    const auto said = [](auto radius) {
        using T = decltype(radius);
        Scene<Shapes<SphereT<T>>, Materials<LambertianT<T>>> scene;
        scene.add(SphereT<T>{.radius = radius}, scene.add(LambertianT<T>{}));
        const World world(std::move(scene));
        return detail::digits_remark(world);
    };
    CHECK(said(0.9e9f).empty());
    CHECK(said(2e9f) ==
          "coordinates reach 2e+09: above 1e9 the squares of areas leave the range of "
          "float; use double, or a larger unit of length");
    // Along each axis, to both sides, with smaller shapes before or after.
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.5e9f, 1.5e9f}) {
            Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
            const auto grey = scene.add(Lambertian{});
            Vec3 center{0};
            center[axis] = side;
            scene.add(Sphere{.radius = 5e8f}, grey);
            scene.add(Sphere{.center = center, .radius = 5e8f}, grey);
            scene.add(Sphere{.radius = 5e8f}, grey);
            const World closed(std::move(scene));
            CHECK(detail::digits_remark(closed) == said(2e9f));
        }
    CHECK(said(0.9e75).empty());
    CHECK(said(2e75) ==
          "coordinates reach 2e+75: above 1e75 the squares of areas leave the range of "
          "double; use a larger unit of length");
    // A gloss is no mirror, unless it has no roughness.
    for (const float roughness : {0.0f, 0.3f}) {
        Scene<Shapes<Sphere>, Materials<Glossy>> scene;
        scene.add(Sphere{}, scene.add(Glossy{.roughness = roughness}));
        const World closed(std::move(scene));
        const SceneNeeds found = needs(closed);
        CHECK(found.objects == 1);
        CHECK(found.diffuse == (roughness > 0 ? 1 : 0));
        CHECK(found.specular == (roughness > 0 ? 0 : 1));
    }
    // How a plan says where the caustics' photons go.
    PhotonMappingSettings settings;
    settings.caustics_estimate.radius = 0.1f;
    const auto clause = [&](CausticBudget budget) {
        settings.caustic_budget = budget;
        return detail::caustics_clause(settings);
    };
    CHECK(clause(CausticBudget::as_seen).empty());
    CHECK(clause(CausticBudget::equal) == ", each gets as many photons");
    CHECK(clause(CausticBudget::flux) == ", photons are shared out by flux");
    CHECK(clause(CausticBudget::area) == ", photons are shared out by caustic area");
    CHECK(clause(CausticBudget::brightness) ==
          ", photons are shared out by flux over brightness");
    settings.caustics_estimate.radius = 0;
    CHECK(clause(CausticBudget::as_seen) == ", the radius comes from the photons");
    CHECK(clause(CausticBudget::equal) ==
          ", each gets as many photons, the radius comes from the photons");
    settings.caustics.shares = {1.0};
    CHECK(clause(CausticBudget::equal) ==
          ", photons in given shares, the radius comes from the photons");
}

TEST_CASE("survey: a scene without a lamp is said to be black, and it is") {
    Scene<Shapes<Sphere>, Materials<Lambertian>> scene;
    scene.add(Sphere{.center{0, 0, -3}}, scene.add(Lambertian{}));
    const World black(scene);
    const Plan plan = survey(black, PhotonMappingSettings{});
    REQUIRE(plan.remarks.size() == 1);
    CHECK(plan.remarks[0] ==
          "the scene has no light, and the picture will be black: add an object with a "
          "radiance, or a point light");
    // It stands in the plan, and the first pass says it again.
    CHECK(to_text(plan).ends_with("\nremark          " + plan.remarks[0] + "\n"));
    const PhotonMapper mapper(black);
    CHECK(mapper_remarks(mapper) == plan.remarks[0] + "\n");
    const auto seen =
        render(mapper, look_at({}), {.width = 8, .height = 6, .samples = 4});
    for (const Rgb& pixel : seen.image.pixels) CHECK(pixel == Rgb{0});
    // One lamp, and there is nothing to say.
    scene.add(Sphere{.center{0, 3, -3}}, scene.add(Lambertian{}), Rgb{1});
    const World world(std::move(scene));
    CHECK(survey(world, PhotonMappingSettings{}).remarks.empty());
}

TEST_CASE("survey: a lobe that shadow rays do not find is named") {
    const auto remarks = [](float roughness, DirectLight direct) {
        Scene<Shapes<Sphere>, Materials<Lambertian, Glossy>> scene;
        scene.add(Sphere{}, scene.add(Lambertian{}), Rgb{1});
        scene.add(Sphere{.center{3, 0, 0}},
                  scene.add(Glossy{.reflectance = Rgb{1}, .roughness = roughness}));
        const World world(std::move(scene));
        return survey(world, PhotonMappingSettings{.direct = direct}).remarks;
    };
    REQUIRE(remarks(0.01f, DirectLight::sampled).size() == 1);
    CHECK(remarks(0.01f, DirectLight::sampled)[0].find("1 object(s) are nearly") == 0);
    CHECK(remarks(0.05f, DirectLight::sampled).size() == 1);
    // A density of 1000 along the mirrored way is a roughness of 0.0998.
    CHECK(remarks(0.097f, DirectLight::sampled).size() == 1);
    for (const float wide : {0.0f, 0.103f, 0.2f, 1.0f})
        CHECK(remarks(wide, DirectLight::sampled).empty());
    CHECK(remarks(0.01f, DirectLight::mis).empty());
    CHECK(remarks(0.01f, DirectLight::analytic).empty());
    // Objects are counted, and not their materials.
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glossy>, Lights<PointLight>>
        three;
    const auto polished = three.add(Glossy{.reflectance = Rgb{1}, .roughness = 0.01f});
    three.add(Sphere{}, polished);
    three.add(Sphere{.center{3, 0, 0}}, polished);
    three.add(Quad{}, polished);
    three.add(Quad{.corner{0, 5, 0}}, three.add(Glossy{.roughness = 0.5f}));
    three.add(PointLight{.intensity = Rgb{1}});
    const World three_world(std::move(three));
    const auto said = survey(three_world, PhotonMappingSettings{}).remarks;
    REQUIRE(said.size() == 1);
    CHECK(said[0].starts_with("3 object(s) are nearly mirrors"));
}

TEST_CASE("survey: narrow gloss is a mirror to those who look irradiance up") {
    const auto room = [](float roughness) {
        Scene<Shapes<Sphere>, Materials<Lambertian, Glossy>, Lights<PointLight>> scene;
        scene.add(Sphere{.radius = 9}, scene.add(Lambertian{}));
        scene.add(Sphere{},
                  scene.add(Glossy{.reflectance = Rgb{0.9f}, .roughness = roughness}));
        scene.add(PointLight{.position{0, 4, 0}});
        return World(std::move(scene));
    };
    for (const float roughness : {0.02f, 0.1f, 0.3f, 0.4f, 0.45f, 1.0f})
        for (const IndirectLight indirect :
             {IndirectLight::rays, IndirectLight::map, IndirectLight::photons,
              IndirectLight::gather, IndirectLight::cache, IndirectLight::none}) {
            CAPTURE(roughness);
            CAPTURE(int(indirect));
            const auto world = room(roughness);
            PhotonMappingSettings settings{.direct = DirectLight::mis,
                                           .indirect = indirect};
            const bool narrow = roughness < 0.42f;
            const bool mirror = narrow && (indirect == IndirectLight::gather ||
                                           indirect == IndirectLight::cache);
            CHECK(needs(world).narrow == (narrow ? 1 : 0));
            const Plan plan = survey(world, settings);
            CHECK(plan.caustics_map.on == mirror);
            CHECK(plan.caustics_map.why ==
                  (mirror ? "1 of 2 objects is nearly a mirror, whose light is blurred "
                            "as a caustic; radius 0.1 in a scene 18 across"
                          : "no object mirrors or refracts"));
            CHECK(plan.remarks.empty());
            const Passes run = choose_passes(needs(world), settings);
            CHECK(run.gloss_as_mirrors == mirror);
            CHECK(run.caustics_on_gloss == !mirror);
            SceneNeeds with_mirror = needs(world);
            with_mirror.specular = 1;
            CHECK(choose_passes(with_mirror, settings).caustics_on_gloss);
            // With no photons for it paths carry the light.
            settings.caustics.photons = 0;
            CHECK_FALSE(choose_passes(needs(world), settings).gloss_as_mirrors);
            settings.caustics.photons = 1;
            settings.general.photons = 0;
            CHECK_FALSE(choose_passes(needs(world), settings).gloss_as_mirrors);
        }
    const PhotonMappingSettings gather{.indirect = IndirectLight::gather};
    CHECK(detail::make_plan(
              {.objects = 5, .diffuse = 4, .specular = 2, .narrow = 1, .lights = 1},
              gather)
              .caustics_map.why ==
          "2 of 5 objects mirror or refract; 1 of 5 objects is "
          "nearly a mirror, whose light is blurred as a caustic");
    const Plan one = detail::make_plan({.objects = 2, .diffuse = 1, .lights = 1}, {});
    CHECK(one.indirect_rays.why == "1 of 2 objects lights others");
    CHECK(one.shadow_rays.why ==
          "1 of 2 objects reflects diffusely, lit by 1 light(s)");
}

TEST_CASE("survey: which passes each way of indirect light needs, and from how many") {
    const SceneNeeds found{.objects = 3, .diffuse = 2, .specular = 1, .lights = 2};
    const auto passes = [&](IndirectLight indirect, int depth, long long photons) {
        PhotonMappingSettings settings{.max_depth = depth, .indirect = indirect};
        settings.general.photons = photons;
        return choose_passes(found, settings);
    };
    struct Row {
        IndirectLight indirect;
        bool rays, general, irradiance, cache; // at a depth of two surfaces
        bool general_at_one, irradiance_at_one;
    };
    for (const Row& row : {Row{IndirectLight::rays, 1, 0, 0, 0, 0, 0},
                           Row{IndirectLight::map, 1, 1, 0, 0, 0, 0},
                           Row{IndirectLight::gather, 1, 1, 1, 0, 0, 0},
                           Row{IndirectLight::photons, 0, 1, 0, 0, 1, 0},
                           Row{IndirectLight::cache, 0, 1, 1, 1, 1, 1},
                           Row{IndirectLight::none, 0, 0, 0, 0, 0, 0}}) {
        CAPTURE(int(row.indirect));
        const auto two = passes(row.indirect, 2, 1);
        CHECK(two.shadow_rays);
        CHECK(two.indirect_rays == row.rays);
        if (!row.rays) {
            PhotonMappingSettings settings{.max_depth = 2, .indirect = row.indirect};
            CHECK(detail::make_plan(found, settings).indirect_rays.why ==
                  "not asked for");
            settings.max_depth = 1;
            CHECK(detail::make_plan(found, settings).indirect_rays.why ==
                  "the depth ends at the first surface");
        }
        CHECK(two.general_map == row.general);
        CHECK(two.shadow_photons == row.general);
        CHECK(two.irradiance == row.irradiance);
        CHECK(two.cache == row.cache);
        CHECK(two.caustics_map);
        const auto one = passes(row.indirect, 1, 1);
        CHECK_FALSE(one.indirect_rays);
        CHECK(one.general_map == row.general_at_one);
        CHECK(one.irradiance == row.irradiance_at_one);
        const auto none = passes(row.indirect, 2, 0);
        CHECK_FALSE((none.general_map || none.irradiance || none.cache));
        CHECK_FALSE(none.shadow_photons);
    }
    // Rays are left out if each of both lights has the 59 photons that it takes; those
    // of indirect light if there are such rays, and a photon.
    for (const long long photons : {0LL, 1LL, 117LL, 118LL}) {
        PhotonMappingSettings settings;
        settings.general.photons = photons;
        settings.skip = {.rule = SkipRule::enough, .indirect_rays = true};
        const auto run = choose_passes(found, settings);
        CHECK(run.skipped_rays == (photons == 118));
        CHECK(run.shadow_photons == (photons == 118));
        CHECK(run.skipped_bounces == (photons > 0));
        const SkipSettings skip = detail::skipping(run, settings);
        CHECK(skip.rule == (photons == 118 ? SkipRule::enough : SkipRule::none));
        CHECK(skip.indirect_rays == (photons > 0));
        settings.indirect = IndirectLight::none;
        CHECK_FALSE(choose_passes(found, settings).skipped_bounces);
        settings.skip = {};
        CHECK_FALSE(choose_passes(found, settings).skipped_rays);
    }
    // Without lights, or without a diffuse surface, nothing is done.
    for (const SceneNeeds& dark :
         {SceneNeeds{.objects = 3, .diffuse = 2, .specular = 1},
          SceneNeeds{.objects = 3, .specular = 3, .lights = 1}}) {
        PhotonMappingSettings settings{.indirect = IndirectLight::cache};
        settings.skip = {.rule = SkipRule::any, .indirect_rays = true};
        const auto run = choose_passes(dark, settings);
        CHECK_FALSE((run.shadow_rays || run.caustics_map || run.general_map ||
                     run.shadow_photons || run.skipped_rays || run.skipped_bounces ||
                     run.irradiance || run.cache));
    }
    Scene<Shapes<Sphere>, Materials<Lambertian, SoapFilm>> bubble;
    bubble.add(Sphere{}, bubble.add(Lambertian{}));
    CHECK_FALSE(needs(World(bubble)).films);
    bubble.add(SoapFilm{});
    const World world(std::move(bubble));
    CHECK(needs(world).films);
}

TEST_CASE("survey: every reason, in the order in which they are printed") {
    const SceneNeeds lit{.objects = 30, .diffuse = 20, .specular = 10, .lights = 2};
    const auto plan_of = [](const SceneNeeds& found, auto change) {
        PhotonMappingSettings settings;
        change(settings);
        return detail::make_plan(found, settings);
    };
    const Plan plan = plan_of(lit, [](auto&) {});
    const char* const names[] = {
        "shadow rays", "indirect rays",    "caustics map", "general map",
        "volume map",  "shadow photons",   "skipped rays", "skipped bounces",
        "irradiance",  "irradiance cache", "thin film",    "tree"};
    REQUIRE(plan.items().size() == std::size(names));
    for (std::size_t i = 0; i < std::size(names); ++i)
        CHECK(std::string(plan.items()[i]->pass) == names[i]);
    CHECK(plan.tree.on);
    CHECK(plan.tree.why == "30 objects, a tree finds the first on a ray");
    CHECK(plan.irradiance.why == "no gather ray asks for it");
    const auto gather_with = [&](int least) {
        return plan_of(lit, [least](PhotonMappingSettings& settings) {
            settings.indirect = IndirectLight::gather;
            settings.irradiance.least = least;
        });
    };
    CHECK(gather_with(0).irradiance.why == "gather rays look it up where they end");
    CHECK(gather_with(70).irradiance.why ==
          "gather rays look it up where they end, unless fewer than 70 indirect "
          "photons are kept");
    CHECK(plan.cache.why == "not asked for");

    // Skipping: with enough photons for the lights, with one too few, and in the dark.
    const auto skip = [&](const SceneNeeds& found, long long photons) {
        return plan_of(found, [&](PhotonMappingSettings& settings) {
            settings.skip = {.rule = SkipRule::enough, .indirect_rays = true};
            settings.general.photons = photons;
        });
    };
    PhotonMappingSettings enough;
    enough.skip.rule = SkipRule::enough;
    const long long needed = photons_needed(enough.skip);
    const std::string n = std::to_string(needed), twice = std::to_string(2 * needed);
    const Plan on = skip(lit, 2 * needed), off = skip(lit, 2 * needed - 1);
    CHECK(on.skipped_rays.on);
    CHECK(on.skipped_rays.why == "where " + n + " of " + twice + " photons agree");
    CHECK(on.shadow_photons.why == "they show which shadow rays to skip");
    CHECK(on.skipped_bounces.why == "where none of " + twice + " photons is near");
    CHECK_FALSE(off.skipped_rays.on);
    CHECK(off.skipped_rays.why ==
          std::to_string(2 * needed - 1) + " photons, and each light needs " + n);
    SceneNeeds dark = lit;
    dark.lights = 0;
    CHECK(skip(dark, 1000).skipped_rays.why == "nothing is lit");
    CHECK(skip(dark, 1000).skipped_bounces.why == "there are no indirect rays");
    CHECK(skip(dark, 1000).indirect_rays.why == "nothing is lit");

    const auto indirect = [&](IndirectLight way) {
        return plan_of(lit, [&](PhotonMappingSettings& s) { s.indirect = way; });
    };
    const Plan gather = indirect(IndirectLight::gather);
    CHECK(gather.irradiance.on);
    CHECK(gather.irradiance.why == "gather rays look it up where they end");
    CHECK_FALSE(gather.cache.on);
    const Plan cache = indirect(IndirectLight::cache);
    CHECK(cache.cache.on);
    CHECK(cache.cache.why == "pixels interpolate what few points gather");
    CHECK(cache.irradiance.on);
    CHECK(indirect(IndirectLight::none).indirect_rays.why == "not asked for");

    // A map without photons is missing where indirect light is read from it, only there.
    const auto unmapped = [&](const SceneNeeds& found, IndirectLight way) {
        return plan_of(found, [&](PhotonMappingSettings& s) {
            s.indirect = way;
            s.general.photons = 0;
        });
    };
    for (const IndirectLight way : {IndirectLight::map, IndirectLight::photons,
                                    IndirectLight::gather, IndirectLight::cache})
        CHECK(unmapped(lit, way).general_map.why ==
              "0 photons were asked for, and indirect light is missing");
    for (const IndirectLight way : {IndirectLight::rays, IndirectLight::none})
        CHECK(unmapped(lit, way).general_map.why == "no ray uses it");
    CHECK(unmapped(dark, IndirectLight::map).general_map.why == "no ray uses it");
    CHECK(unmapped(lit, IndirectLight::gather).irradiance.why ==
          "there is no general map");
    CHECK(unmapped(lit, IndirectLight::cache).cache.why == "there is no general map");
    SceneNeeds films = lit;
    films.films = true;
    const Plan bubble = plan_of(films, [](auto&) {});
    CHECK(bubble.thin_film.on);
    CHECK(bubble.thin_film.why == "paths pass through the listed films");
}
