// The library ljus::core: instantiates the templates listed in ljus/core.hpp, and three
// more at the end of this file. To compile it without CMake:
//
//     g++ -std=c++20 -O3 -ffp-contract=off -fopenmp -Iinclude -c core/core.cpp
//     g++ -std=c++20 -O2 -fopenmp -Iinclude -DLJUS_CORE app.cpp core.o
#define LJUS_CORE_EXTERN // the templates are defined here
#define LJUS_CORE_INLINE

// The searches are compiled for SSE2, AVX2 and AVX-512, by compilers that can do so for
// templates. With a sanitizer they are compiled once, because the choice at run time
// would be made before the sanitizer is ready. Without -ffp-contract=off the results
// depend on the processor: the AVX2 and AVX-512 versions round a product and a sum once
// instead of twice.
#include <cstddef> // defines __GLIBC__ if glibc is used
#if defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) &&                      \
    defined(__x86_64__) && defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) &&     \
    !defined(__SANITIZE_THREAD__)
#define LJUS_CORE_CLONES                                                               \
    [[gnu::target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4"), gnu::flatten]]
#endif
#include "ljus/core.hpp"
#include "ljus/render/irradiance_cache.hpp"

// The headers of these three declare them for programs that define LJUS_CORE.
namespace ljus {

template std::optional<Rgb> interpolate(const IrradianceCache&, const Vec3&,
                                        const Vec3&, float);
template std::optional<Rgb> irradiance_at(const IrradiancePoints&, const Vec3&,
                                          const Vec3&);
template detail::NearestPhotons
detail::nearest_photons(const PhotonMap&, const SurfacePoint&, float,
                        std::span<Neighbor>,
                        const detail::OfIndex<detail::SourcePhotonsT<float>>&);

} // namespace ljus
