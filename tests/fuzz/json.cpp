/// \file tests/fuzz/json.cpp
/// \brief Scene files, and a tiny picture of each by both renderers.

#include "fuzz.hpp"
#include "ljus/io/load_json.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace ljus;
    fuzz::refused_or_done([&] {
        auto loaded =
            read_json_scene({reinterpret_cast<const char*>(data), size}, "fuzz.json");
        const RenderSettings picture{
            .width = 3, .height = 2, .samples = 1, .threads = 1};
        const auto draw = [&](const auto& renderer) {
            for (const Rgb& c : render(renderer, loaded.camera, picture).image.pixels)
                fuzz::require_that(is_finite(c) && c.x >= 0 && c.y >= 0 && c.z >= 0,
                                   "a pixel is finite and at least 0");
        };
        const World world(std::move(loaded.scene));
        draw(PathTracer(world, {.max_depth = 20}));
        PhotonMappingSettings settings{.max_depth = 20, .indirect = IndirectLight::map};
        settings.caustics.photons = settings.general.photons = 20;
        settings.caustics.threads = settings.general.threads = 1;
        draw(PhotonMapper(world, settings));
    });
    return 0;
}
