#include <doctest/doctest.h>

#include <limits>

#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "support/rooms.hpp"

using namespace ljus;
using namespace ljus_test;

TEST_CASE("survey: counts what a scene is made of") {
    const Room room = make_room<float>(Ball::mixture, Lamp::quad, 2);
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
    const Room matt = make_room<float>(Ball::oren_nayar, Lamp::sphere, 1);
    const Room glass = make_room<float>(Ball::glass, Lamp::sphere, 1);
    Room dark;
    add_walls(dark);
    add_ball(dark, Ball::mirror);

    PhotonMappingSettings settings;
    Plan plan = survey(glass, settings);
    CHECK(plan.shadow_rays.on);
    CHECK(plan.shadow_rays.why ==
          "7 of 8 objects reflect diffusely, lit by 1 light(s)");
    CHECK(plan.indirect_rays.on);
    CHECK(plan.caustics_map.on);
    CHECK(plan.caustics_map.why == "1 of 8 objects mirror or refract");
    CHECK_FALSE(plan.general_map.on);
    CHECK(plan.general_map.why == "no ray asks it");
    CHECK_FALSE(plan.shadow_photons.on);
    CHECK(plan.tree.on);
    CHECK(plan.tree.why == "8 objects, a tree finds the first on a ray");
    Room one;
    one.add(Sphere{}, one.add(Lambertian{}));
    CHECK_FALSE(survey(one, settings).tree.on);

    plan = survey(matt, settings);
    CHECK_FALSE(plan.caustics_map.on);
    CHECK(plan.caustics_map.why == "no object mirrors or refracts");

    settings.caustics.photons = 0;
    plan = survey(glass, settings);
    CHECK_FALSE(plan.caustics_map.on);
    CHECK(plan.caustics_map.why == "0 photons were asked for");

    settings = {};
    settings.indirect = IndirectLight::map;
    plan = survey(matt, settings);
    CHECK(plan.general_map.on);
    CHECK(plan.shadow_photons.on);
    settings.general.shadow_photons = false;
    plan = survey(matt, settings);
    CHECK(plan.general_map.on);
    CHECK_FALSE(plan.shadow_photons.on);
    settings.general.photons = 0;
    CHECK_FALSE(survey(matt, settings).general_map.on);

    settings = {};
    settings.indirect = IndirectLight::photons; // no ray, but the map
    plan = survey(matt, settings);
    CHECK_FALSE(plan.indirect_rays.on);
    CHECK(plan.general_map.on);

    settings = {};
    settings.keep_general_map = true;
    CHECK(survey(matt, settings).general_map.on);

    settings = {};
    settings.max_depth = 1;
    plan = survey(matt, settings);
    CHECK_FALSE(plan.indirect_rays.on);
    CHECK(plan.indirect_rays.why == "the depth ends at the first surface");
    settings.indirect = IndirectLight::map; // no gather ray is sent at depth 1
    CHECK_FALSE(survey(matt, settings).general_map.on);

    settings = {};
    settings.indirect = IndirectLight::none;
    plan = survey(matt, settings);
    CHECK_FALSE(plan.indirect_rays.on);
    CHECK(plan.indirect_rays.why == "not asked for");

    plan = survey(dark, PhotonMappingSettings{});
    CHECK_FALSE(plan.shadow_rays.on);
    CHECK(plan.shadow_rays.why == "the scene has no light");
    CHECK_FALSE(plan.indirect_rays.on);
    CHECK_FALSE(plan.caustics_map.on);
    CHECK(plan.caustics_map.why == "nothing is lit");
    CHECK(make_photon_maps(dark, PhotonMappingSettings{}).caustics.empty());

    for (const PlanItem* item : plan.items()) {
        CHECK(std::string(item->pass).size() > 0);
        CHECK(item->why.size() > 0);
    }
}

TEST_CASE("survey: what the plan leaves out is not done") {
    Room dark;
    add_walls(dark); // nothing is lit, so no ray looks for light
    const PhotonMapsT<float> none{};
    const auto mapper = make_photon_mapper(dark, none);
    CHECK_FALSE(mapper.indirect_rays);
    const auto picture =
        render(mapper, room_camera<float>(), {.width = 4, .height = 4, .samples = 2});
    CHECK(picture.counts.rays() == picture.counts.camera_rays);
    Room lit;
    add_walls(lit);
    add_lamps(lit, Lamp::quad, 1);
    CHECK(make_photon_mapper(lit, none).indirect_rays);
}

TEST_CASE("survey: settings that give no picture are refused") {
    const auto refused = [](auto change) {
        PhotonMappingSettings settings;
        change(settings);
        CHECK_THROWS_AS(check(settings), std::invalid_argument);
        CHECK_THROWS_AS((void)make_photon_maps(Room{}, settings),
                        std::invalid_argument);
    };
    CHECK_NOTHROW(check(PhotonMappingSettings{}));
    refused([](PhotonMappingSettings& s) { s.max_depth = 0; });
    refused([](PhotonMappingSettings& s) { s.caustics.photons = -1; });
    refused([](PhotonMappingSettings& s) { s.general.photons = -1; });
    refused([](PhotonMappingSettings& s) { s.caustics_estimate.radius = 0; });
    refused([](PhotonMappingSettings& s) {
        s.general_estimate.radius = std::numeric_limits<float>::quiet_NaN();
    });
    refused(
        [](PhotonMappingSettings& s) { s.general_estimate.nearest = max_nearest + 1; });
    refused([](PhotonMappingSettings& s) { s.caustics_estimate.thickness = -1; });
}
