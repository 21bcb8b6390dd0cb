/// \file tests/fuzz/ies.cpp
/// \brief IES files, and the directions of the photons of each lamp.

#include "fuzz.hpp"

#include <cmath>

#include "ljus/io/load_ies.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace ljus;
    fuzz::refused_or_done([&] {
        const GoniometricLightT<double> lamp{
            .table = read_ies({reinterpret_cast<const char*>(data), size}, "fuzz.ies")
                         .table};
        check(lamp);
        const auto light = in_scene(lamp, SphereT<double>{});
        const double flux = power(light).x;
        fuzz::require_that(std::isfinite(flux) && flux >= 0, "the power is finite");
        if (flux == 0) return; // no photon leaves it
        for (const double x : {0.0, 0.4, 0.9999})
            for (const double y : {0.0, 0.7, 0.9999}) {
                const Vec3T<double> way = sample_emission(light, {}, {x, y});
                fuzz::require_that(std::abs(glm::length(way) - 1) < 1e-9,
                                   "a photon's direction has the length 1");
                fuzz::require_that(std::isfinite(pdf_emission(light, {}, way)),
                                   "its density is finite");
            }
    });
    return 0;
}
