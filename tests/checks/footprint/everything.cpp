/// \file everything.cpp
/// \brief Every shape and material listed, both maps, skipped shadow rays, the
/// irradiance cache.

#include "ljus/ljus.hpp"
#include "ljus/render/gathering.hpp"
#include "ljus/render/skipping.hpp"
#include "ljus/scenes/report_rooms.hpp"
#include "report.hpp"

using namespace ljus;

int main() {
    Scene<
        Shapes<Quad, Sphere, Triangle, Metaballs>,
        Materials<Lambertian, Mirror, Glass, Mixture, Glossy, Eon, OrenNayar, SoapFilm>>
        scene;
    add_report_room(scene);
    const auto place = [&](float x, const auto& material) {
        scene.add(Sphere{.center{7, x, -3}, .radius = 0.7f}, scene.add(material));
    };
    place(-4, Mirror{.reflectance = Rgb{0.98f}});
    place(-2.4f, Glass{.index = 1.5f});
    place(-0.8f, Mixture{.color = Rgb{0}, .reflectivity = 0.4f, .transparency = 1});
    place(0.8f, Glossy{.reflectance = Rgb{0.9f}});
    place(2.4f, Eon{.albedo = Rgb{0.7f}});
    place(4, SoapFilm{});
    scene.add(Quad{{5, -1, 4.99f}, {0, 2, 0}, {2, 0, 0}},
              scene.add(Lambertian{.albedo = Rgb{0}}), Rgb{30});
    PhotonMappingSettings settings{.indirect = IndirectLight::cache};
    settings.caustics.photons = settings.general.photons = 20000;
    settings.caustics.threads = settings.general.threads = 1;
    settings.skip.rule = SkipRule::enough;
    const RenderSettings picture{.width = 64, .height = 64, .samples = 4, .threads = 1};
    const World world(std::move(scene));
    PhotonMapper mapper(world, settings, abilities<Gathering, Skipping>);
    mapper.fill_cache(report_camera(), picture);
    const auto& maps = mapper.maps();
    report(render(mapper, report_camera(), picture),
           maps.caustics.records.size() + maps.general.records.size(),
           bytes_of(maps.caustics) + bytes_of(maps.general));
}
