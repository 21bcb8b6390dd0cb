/// \file cornell_glass.cpp
/// \brief The Cornell box with a mirror and a glass ball: rays, and a caustics map.

#include "ljus/render/photon_mapping.hpp"
#include "ljus/scenes/cornell_box.hpp"
#include "report.hpp"

using namespace ljus;

int main() {
    const auto box = cornell_box();
    PhotonMappingSettings settings;
    settings.caustics.photons = 20000;
    settings.caustics.threads = 1;
    const PhotonMapper mapper(box.world, settings);
    report(render(mapper, box.camera,
                  {.width = 64, .height = 64, .samples = 4, .threads = 1}),
           mapper.maps().caustics.records.size(), bytes_of(mapper.maps().caustics));
}
