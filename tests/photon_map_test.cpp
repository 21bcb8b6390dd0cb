/// \file photon_map_test.cpp
/// \brief The estimate from photons against the flux density that they were made with.
///
/// Standard errors come from independent maps, one a seed. A mean is accepted within
/// 4.5 of them: each such check gives a false alarm once in 150 000 seeds.
/// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
/// none failed.

#include "ljus/photons/density_estimate.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <stdexcept>

#include "ljus/materials/lambertian.hpp"
#include "support/draws.hpp"
#include "support/refusal.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"
#include "support/within.hpp"

using ljus::DensityEstimateSettings;
using ljus::Kernel;
using ljus::Lambertian;
using ljus::Photon;
using ljus::PhotonKind;
using ljus::PhotonMap;
using ljus::Rgb;
using ljus::Vec3;
using ljus_test::Draws;
using ljus_test::Mean;
using ljus_test::test_seed;

namespace {

constexpr std::array kernels{Kernel::box, Kernel::cone, Kernel::gaussian,
                             Kernel::epanechnikov, Kernel::biweight};
const Lambertian matt{.albedo{0.8f, 0.4f, 0.2f}};
constexpr Rgb flux_density{3.0f, 2.0f, 1.0f}; // W per unit of area, on the square

/// The floor z = 0 at a point.
template <typename T = float>
ljus::VertexT<T> floor_at(ljus::Vec3T<T> position) {
    ljus::VertexT<T> surface{};
    surface.point.position = position;
    surface.point.normal = {0, 0, 1};
    surface.frame = ljus::frame_around(surface.point.normal);
    return surface;
}

/// Photons that fall on the square [-1, 1]^2 at a height, uniformly: together
/// they carry the flux density.
std::vector<Photon> rain(int count, Draws& numbers, float height = 0,
                         PhotonKind kind = PhotonKind::direct, float share = 1) {
    std::vector<Photon> photons;
    for (int i = 0; i < count; ++i) {
        const auto x = float(numbers.between(-1, 1));
        photons.push_back(
            {.position{x, float(numbers.between(-1, 1)), height},
             .direction = glm::normalize(Vec3{float(numbers.between(-1, 1)), 0.3f, -1}),
             .flux = share * flux_density * 4.0f / float(count),
             .kind = kind});
    }
    return photons;
}

Rgb estimate(const PhotonMap& map, const DensityEstimateSettings& gather,
             Vec3 at = Vec3{0}) {
    std::uint64_t gathered = 0;
    return ljus::estimate_radiance(map, floor_at(at), matt, Vec3{0.6f, 0, 0.8f}, gather,
                                   ljus::all_kinds, gathered);
}

/// The exact radiance: albedo / pi times the irradiance.
double exact(int channel) {
    return double(matt.albedo[channel]) / std::numbers::pi *
           double(flux_density[channel]);
}

/// Mean and variance of the first channel over maps, for several ways to gather.
std::vector<Mean> over_maps(int maps, int count,
                            const std::vector<DensityEstimateSettings>& ways,
                            std::uint64_t seed, Vec3 at = Vec3{0}) {
    Draws numbers{test_seed(seed)};
    std::vector<Mean> means(ways.size());
    for (int i = 0; i < maps; ++i) {
        const auto map = ljus::make_photon_map(rain(count, numbers));
        for (std::size_t j = 0; j < ways.size(); ++j)
            means[j].add(double(estimate(map, ways[j], at).x));
    }
    return means;
}

/// One way to gather for each kernel.
std::vector<DensityEstimateSettings> each_kernel(float radius,
                                                 std::size_t nearest = 0) {
    std::vector<DensityEstimateSettings> ways;
    for (const Kernel kernel : kernels)
        ways.push_back({.radius = radius, .nearest = nearest, .kernel = kernel});
    return ways;
}

/// A matt surface that the estimate does not know for one: it
/// is asked photon by photon.
struct Unknown {
    using Scalar = float;
    Lambertian inner = matt;
};
Rgb evaluate(const Unknown& unknown, const Vec3& wo, const Vec3& wi) {
    return evaluate(unknown.inner, wo, wi);
}

/// A kernel of the user's own, all that there is of it.
struct Triweight {};
float kernel_weight(Triweight, float x) {
    return 4 * (1 - x) * (1 - x) * (1 - x);
}
static_assert(ljus::KernelLike<Triweight> && ljus::KernelLike<Kernel> &&
              ljus::KernelLike<Kernel, double> && !ljus::KernelLike<Unknown>);

/// Without a value beyond the border of its disc.
struct Root {};
float kernel_weight(Root, float x) {
    return 1.5f * std::sqrt(1 - x);
}

/// The list's parabola, as a type: the same estimates are expected.
struct Parabola {
    float factor = 2;
};
float kernel_weight(const Parabola& parabola, float x) {
    return parabola.factor * (1 - x);
}

} // namespace

TEST_CASE("photon_map: the irradiance of a side, times the BRDF, is the radiance") {
    Draws numbers{84};
    auto photons = rain(20000, numbers);
    for (std::size_t i = 0; i < photons.size(); ++i)
        if (i % 4 == 0) { // from below, on a surface that they know
            photons[i].direction.z *= -1;
            photons[i].normal = ljus::small_normal(Vec3{0, 0, 1});
        }
    const auto map = ljus::make_photon_map(photons);
    const auto floor = floor_at<float>(Vec3{0.1f, 0.2f, 0});
    for (const std::size_t k : {0u, 2u, 50u, 500u})
        for (const float up : {1.0f, -1.0f}) {
            CAPTURE(k);
            CAPTURE(up);
            const DensityEstimateSettings gather{.radius = 0.2f, .nearest = k};
            std::uint64_t gathered = 0;
            const Rgb radiance = ljus::estimate_radiance(
                map, floor, matt, Vec3{0, 0, up}, gather, ljus::light_kinds, gathered);
            const Rgb irradiance = ljus::estimate_irradiance(
                map, floor.point, Vec3{0, 0, up}, gather, ljus::light_kinds);
            for (int c = 0; c < 3; ++c)
                CHECK(matt.albedo[c] / std::numbers::pi_v<float> * irradiance[c] ==
                      doctest::Approx(radiance[c]).epsilon(1e-6));
            if (k != 2) CHECK(irradiance.x > 0);
        }
}

TEST_CASE("photon_map: photons of the user's own need no normal, scene or material") {
    // A photon whose normal is left 0 matches every surface.
    std::vector<Photon> photons;
    for (int i = 0; i < 100; ++i)
        photons.push_back(
            {.position{0.01f * float(i), 0, 0},
             .direction{0, -1, 0},
             .flux = Rgb{1},
             .kind = i % 2 == 0 ? PhotonKind::caustic : PhotonKind::shadow});
    const auto map = ljus::make_photon_map(photons);
    const DensityEstimateSettings gather{.radius = 10, .kernel = Kernel::box};
    const double one = 50 / (std::numbers::pi * 100); // 50 photons, 1 W each
    const auto ask = [&](const PhotonMap& of, const Vec3& side) {
        return double(ljus::estimate_irradiance(
                          of, {.position{0.5f, 0, 0}, .normal{0, 1, 0}}, side, gather)
                          .x);
    };
    CHECK(ask(map, {0, 1, 0}) == doctest::Approx(one)); // shadow photons do not count
    CHECK(ask(map, {0, -1, 0}) == 0);
    CHECK(ask(PhotonMap{}, {0, 1, 0}) == 0);
}

TEST_CASE("photon_map: a kernel of the user's own, in lanes and one by one") {
    Draws numbers{83};
    const auto map = ljus::make_photon_map(rain(20000, numbers));
    const auto floor = floor_at<float>(Vec3{0});
    const Vec3 up{0, 0, 1};
    const auto ask = [&](const auto& material, const auto& gather) {
        std::uint64_t gathered = 0;
        const Rgb found = ljus::estimate_radiance(map, floor, material, up, gather,
                                                  ljus::light_kinds, gathered);
        CHECK(gathered > 100);
        return double(found.x);
    };
    const ljus::DensityEstimateOf<Triweight> gather{.radius = 0.2f};
    ljus::check(gather);
    const double in_lanes = ask(matt, gather);
    CHECK(in_lanes == doctest::Approx(ask(Unknown{}, gather)).epsilon(1e-5));
    const DensityEstimateSettings listed{.radius = 0.2f};
    CHECK(in_lanes == doctest::Approx(ask(matt, listed)).epsilon(0.1));

    const ljus::DensityEstimateOf<Parabola> parabola{.radius = 0.2f};
    CHECK(ask(matt, parabola) == ask(matt, listed));
    CHECK(ask(Unknown{}, parabola) == ask(Unknown{}, listed));
    auto few = parabola;
    auto few_listed = listed;
    few.nearest = few_listed.nearest = 150;
    CHECK(ask(matt, few) == ask(matt, few_listed));

    CHECK_THROWS_WITH_AS(
        ljus::check(ljus::DensityEstimateOf<Parabola>{.kernel{.factor = 1}}),
        doctest::Contains("the mean of gather.kernel"), std::invalid_argument);
}

TEST_CASE("photon_map: eight at a time give what one by one give") {
    Draws numbers{81};
    for (int repeat = 0; repeat < 300; ++repeat) {
        // Everything that decides: distance, height, side, kind, normal.
        std::vector<Photon> photons;
        const int count = numbers.below(300);
        for (int i = 0; i < count; ++i)
            photons.push_back({.position = numbers.point<float>(0.5),
                               .direction = glm::normalize(numbers.point<float>(1)),
                               .flux = numbers.point<float>(1) + 1.0f,
                               .light = std::uint16_t(i),
                               .kind = static_cast<PhotonKind>(numbers.below(4)),
                               .normal = numbers.below(4) == 0
                                             ? ljus::detail::SmallNormal{0}
                                             : ljus::small_normal(glm::normalize(
                                                   numbers.point<float>(1)))});
        const auto map = ljus::make_photon_map(photons);
        auto surface = floor_at<float>(numbers.point<float>(0.3));
        surface.point.normal = glm::normalize(numbers.point<float>(1));
        surface.frame = ljus::frame_around(
            glm::normalize(surface.point.normal + numbers.point<float>(0.3)));
        const Vec3 wo = glm::normalize(numbers.point<float>(1));
        for (const Kernel kernel : kernels) {
            const DensityEstimateSettings gather{
                .radius = float(numbers.between(0.01, 1)),
                .kernel = kernel,
                .thickness = float(numbers.between(0.1, 1.2))};
            const ljus::PhotonKinds kinds{static_cast<std::uint8_t>(numbers.below(16))};
            std::uint64_t in_lanes = 0, one_by_one = 0;
            const Rgb a = ljus::estimate_radiance(map, surface, matt, wo, gather, kinds,
                                                  in_lanes);
            const Rgb b = ljus::estimate_radiance(map, surface, Unknown{}, wo, gather,
                                                  kinds, one_by_one);
            std::uint64_t plainly = 0;
            const Rgb plain = ljus::estimate_radiance_plain(map, surface, matt, wo,
                                                            gather, kinds, plainly);
            REQUIRE(in_lanes == one_by_one);
            REQUIRE(in_lanes == plainly);
            for (int c = 0; c < 3; ++c)
                REQUIRE(a[c] == doctest::Approx(b[c]).epsilon(1e-5));
            REQUIRE(plain == b);
        }
    }
}

TEST_CASE("photon_map: estimates that are answered together are those one by one") {
    Draws numbers{83};
    ljus::detail::BallBlocks room; // of the search before, as it was left
    for (const int count : {0, 1, 7, 32, 33, 300, 5000})
        for (const Kernel kernel : kernels) {
            std::vector<Photon> photons = rain(count, numbers);
            for (Photon& photon : photons)
                photon.kind = static_cast<PhotonKind>(numbers.below(4));
            const auto map = ljus::make_photon_map(photons);
            const DensityEstimateSettings gather{
                .radius = float(numbers.between(0.02, 0.3)),
                .kernel = kernel,
                .thickness = float(numbers.between(0.1, 1.2))};
            const ljus::PhotonKinds kinds{static_cast<std::uint8_t>(numbers.below(16))};
            // Some within the square, some beside it, above it, and seen from below.
            std::vector<ljus::detail::EstimatePlaceT<float>> places;
            std::vector<Rgb> each(200), together(200, Rgb{0});
            std::uint64_t summed_each = 0, summed = 0;
            for (std::uint32_t i = 0; i < 200; ++i) {
                auto surface = floor_at<float>(numbers.point<float>(1.2));
                if (i % 8 != 0) surface.point.position.z *= 0.01f;
                // Two normals: the shape's decides what lies near, the frame's on which
                // side.
                surface.point.normal =
                    glm::normalize(Vec3{0, 0, 1} + numbers.point<float>(0.2));
                surface.frame = ljus::frame_around(
                    glm::normalize(surface.point.normal + numbers.point<float>(0.5)));
                surface.wo = glm::normalize(numbers.point<float>(1));
                const Rgb throughput = numbers.point<float>(1);
                ljus::detail::set_place(places.emplace_back(), surface, matt,
                                        throughput, i);
                each[i] =
                    throughput * ljus::estimate_radiance(map, surface, matt, surface.wo,
                                                         gather, kinds, summed_each);
            }
            const auto add = [&](const ljus::detail::EstimatePlaceT<float>& place,
                                 const Rgb& light) {
                together[place.item] += place.throughput * light;
            };
            ljus::detail::estimates_together<float>(map, places, gather, kinds, summed,
                                                    room, add);
            CAPTURE(count);
            REQUIRE(summed == summed_each);
            for (std::size_t i = 0; i < 200; ++i) REQUIRE(together[i] == each[i]);
        }
}

TEST_CASE(
    "photon_map: every kernel finds the flux density, in a disc or of the k nearest") {
    struct Row {
        float radius;
        std::size_t nearest;
        int maps, photons;
        std::uint64_t seed;
    };
    // A fixed radius; k nearest, few and many; and of 9.8 photons on the mean often fewer
    // than k, often more.
    for (const Row& row :
         {Row{0.25f, 0, 1000, 500, 11}, Row{0.9f, 2, 1000, 500, 12},
          Row{0.9f, 3, 1000, 500, 12}, Row{0.9f, 5, 1000, 500, 12},
          Row{0.9f, 50, 1000, 500, 12}, Row{0.25f, 5, 2000, 200, 13},
          Row{0.25f, 10, 2000, 200, 13}, Row{0.25f, 14, 2000, 200, 13}})
        for (const Mean& mean :
             over_maps(row.maps, row.photons, each_kernel(row.radius, row.nearest),
                       row.seed)) {
            CAPTURE(row.radius);
            CAPTURE(row.nearest);
            // Of k = 2 the variance is infinite: its standard error says little.
            if (row.nearest == 2)
                CHECK(mean.mean == doctest::Approx(exact(0)).epsilon(0.25));
            else
                CHECK(std::abs(mean.sigmas(exact(0))) < 4.5);
            if (row.nearest == 0) CHECK(mean.error() < 0.01 * exact(0)); // sharp enough
        }
}

TEST_CASE(
    "photon_map: the variance is that of counting, 1/(N r^2) times the kernel's") {
    // Of N photons each lies in the disc with p = pi r^2 / 4; the mean squares of the
    // kernels are those of kernel_test.cpp.
    const double e = std::exp(-2.0);
    const std::array squares{1.0, 1.5, (1 + e) / (1 - e), 4.0 / 3, 9.0 / 5};
    constexpr int maps = 2500; // a variance is found within sqrt(2/maps): 2.8 %
    struct Case {
        int count;
        float radius;
    };
    for (const Case& c : {Case{200, 0.2f}, Case{800, 0.2f}, Case{200, 0.4f}}) {
        const auto means = over_maps(maps, c.count, each_kernel(c.radius), 15);
        for (std::size_t i = 0; i < kernels.size(); ++i) {
            CAPTURE(i);
            CAPTURE(c.count);
            CAPTURE(c.radius);
            const double p = std::numbers::pi * double(c.radius) * double(c.radius) / 4;
            const double expected =
                exact(0) * exact(0) * (squares[i] / p - 1) / double(c.count);
            // Few photons make long tails: five standard errors and a half more.
            CHECK(means[i].variance() == doctest::Approx(expected).epsilon(0.16));
        }
    }
}

TEST_CASE("photon_map: an empty map is black, and so is a place without photons") {
    CHECK(estimate(PhotonMap{}, {}) == Rgb{0});
    CHECK(estimate(ljus::make_photon_map(std::vector<Photon>{}), {.nearest = 5}) ==
          Rgb{0});
    Draws numbers{1};
    const auto map = ljus::make_photon_map(rain(100, numbers));
    CHECK(PhotonMap{}.empty());
    CHECK_FALSE(map.empty());
    CHECK(estimate(map, {.radius = 0.5f}, {5, 0, 0}) == Rgb{0});
    CHECK(estimate(map, {.radius = 0.5f, .nearest = 8}, {5, 0, 0}) == Rgb{0});
}

TEST_CASE("photon_map: photons that all lie in one point give no NaN") {
    std::vector<Photon> photons(20, Photon{.direction{0, 0, -1}, .flux{1, 1, 1}});
    const auto map = ljus::make_photon_map(photons);
    // At the point itself the k-th distance is 0: no area, no estimate.
    CHECK(estimate(map, {.radius = 1, .nearest = 5}) == Rgb{0});
    // Nor is there one so near to the point that no float holds what it says.
    for (Photon& photon : photons) photon.position.x = 1e-20f;
    for (const Kernel kernel : kernels)
        CHECK(estimate(ljus::make_photon_map(photons),
                       {.radius = 1, .nearest = 5, .kernel = kernel}) == Rgb{0});
    // With more room than photons, the radius that was asked for is the disc.
    const double one = double(matt.albedo.x) / std::numbers::pi / std::numbers::pi;
    CHECK(
        double(estimate(map, {.radius = 1, .nearest = 21, .kernel = Kernel::box}).x) ==
        doctest::Approx(20 * one));
    CHECK(double(estimate(map, {.radius = 1, .kernel = Kernel::box}).x) ==
          doctest::Approx(20 * one));
    // Beside it, the k - 1 others lie on the border of the disc.
    const Vec3 beside{0.5f, 0, 0};
    CHECK(
        double(estimate(map, {.radius = 1, .nearest = 5, .kernel = Kernel::box}, beside)
                   .x) == doctest::Approx(4 * one / 0.25));
    // The largest radius is no length of the scene.
    CHECK(double(estimate(map, {.radius = 1e15f, .nearest = 5, .kernel = Kernel::box},
                          beside)
                     .x) == doctest::Approx(4 * one / 0.25));
    CHECK(estimate(map, {.radius = 1, .nearest = 5}, beside) == Rgb{0}); // Epanechnikov
}

TEST_CASE("photon_map: scenes of any size") {
    Draws numbers{31};
    const auto photons = rain(2000, numbers);
    for (const Kernel kernel : kernels)
        for (const std::size_t k : {std::size_t(0), std::size_t(40)}) {
            const DensityEstimateSettings gather{
                .radius = 0.3f, .nearest = k, .kernel = kernel};
            const Rgb expected = estimate(ljus::make_photon_map(photons), gather);
            for (const float scale : {0x1p-50f, 0x1p-20f, 0x1p20f, 0x1p50f}) {
                auto scaled = photons;
                for (Photon& photon : scaled) {
                    photon.position *= scale;
                    photon.flux *= scale * scale; // the same flux density
                }
                DensityEstimateSettings same = gather;
                same.radius *= scale;
                const Rgb found = estimate(ljus::make_photon_map(scaled), same);
                for (int c = 0; c < 3; ++c)
                    CHECK(found[c] == doctest::Approx(expected[c]).epsilon(1e-6));
            }
        }
    // A radius whose square no float can hold, and photons that are black.
    auto black = photons;
    for (Photon& photon : black) {
        photon.position *= 1e-30f;
        photon.flux = Rgb{0};
    }
    CHECK(estimate(ljus::make_photon_map(black), {.radius = 1e-30f}) == Rgb{0});
}

TEST_CASE("photon_map: two million photons in one disc are all counted") {
    // A sum in float is 2 % off.
    std::vector<Photon> photons(2'000'000,
                                Photon{.direction{0, 0, -1}, .flux{0.1f, 0, 0}});
    Draws numbers{32};
    for (Photon& photon : photons)
        photon.position = {float(numbers.unit()), float(numbers.unit()), 0};
    const auto map = ljus::make_photon_map(photons);
    const double expected = 2e6 * double(0.1f) * double(matt.albedo.x) /
                            (std::numbers::pi * std::numbers::pi * 4);
    CHECK(double(estimate(map, {.radius = 2, .kernel = Kernel::box}).x) ==
          doctest::Approx(expected).epsilon(1e-6));
}

TEST_CASE("photon_map: photons of another wall are left out by the thickness") {
    Draws numbers{41};
    const auto floor = rain(2000, numbers);
    auto both = floor;
    // A wall at x = 0.1 that stands on the floor, above 3 % of the radius.
    for (int i = 0; i < 2000; ++i)
        both.push_back({.position{0.1f, float(numbers.between(-1, 1)),
                                  float(numbers.between(0.0301, 1))},
                        .direction = glm::normalize(Vec3{1, 0, -1}),
                        .flux{1, 1, 1}});
    const DensityEstimateSettings gather{.radius = 0.3f, .thickness = 0.1f};
    const Rgb expected = estimate(ljus::make_photon_map(floor), gather);
    const Rgb found = estimate(ljus::make_photon_map(both), gather);
    for (int c = 0; c < 3; ++c)
        CHECK(found[c] == doctest::Approx(expected[c]).epsilon(1e-6));
    // A ball without a disc would count them.
    DensityEstimateSettings thick = gather;
    thick.thickness = 1;
    CHECK(estimate(ljus::make_photon_map(both), thick).x > 2 * expected.x);
}

namespace {

/// A surface point with a normal.
ljus::VertexT<float> surface_with(Vec3 position, Vec3 normal) {
    ljus::VertexT<float> surface{};
    surface.point.position = position;
    surface.point.normal = normal;
    surface.frame = ljus::frame_around(normal);
    return surface;
}

/// Photons of flux 1 that fall straight onto a ball around 0, alike everywhere.
std::vector<Photon> onto_ball(int count, float radius, Draws& numbers) {
    std::vector<Photon> photons;
    for (int i = 0; i < count; ++i) {
        const Vec3 n = ljus::sample_uniform_sphere(
            ljus::Vec2{float(numbers.unit()), float(numbers.unit())});
        photons.push_back({.position = radius * n,
                           .direction = -n,
                           .flux{1, 1, 1},
                           .normal = ljus::small_normal(n)});
    }
    return photons;
}

} // namespace

TEST_CASE("photon_map: on a ball as small as the gather radius nothing is lost") {
    // The cap within r of a point of a sphere has the area pi r^2, as on a plane, and
    // the squared distance is uniform over it: every kernel's mean is right.
    for (const float ball : {10.0f, 1.5f, 1.01f}) {
        CAPTURE(ball);
        Draws numbers{43};
        for (const std::size_t k : {std::size_t(0), std::size_t(30)}) {
            std::vector<Mean> means(kernels.size());
            for (int i = 0; i < 600; ++i) {
                // Some hundred within the disc.
                const int count = int(400 * ball * ball);
                const auto map = ljus::make_photon_map(
                    onto_ball(ball > 2 ? 4000 : count, ball, numbers));
                const Vec3 n{0, 0.6f, 0.8f};
                for (std::size_t j = 0; j < kernels.size(); ++j) {
                    std::uint64_t gathered = 0;
                    means[j].add(
                        double(ljus::estimate_radiance(
                                   map, surface_with(ball * n, n), matt, Vec3{0, 0, 1},
                                   {.radius = 1, .nearest = k, .kernel = kernels[j]},
                                   ljus::all_kinds, gathered)
                                   .x));
                }
            }
            const double count = ball > 2 ? 4000 : int(400 * ball * ball);
            const double right = double(matt.albedo.x) / std::numbers::pi * count /
                                 (4 * std::numbers::pi * double(ball) * double(ball));
            for (const Mean& mean : means) CHECK(std::abs(mean.sigmas(right)) < 4.5);
        }
    }
}

TEST_CASE("photon_map: the other wall of a corner and the other side of a wall do not "
          "count, however near") {
    Draws numbers{44};
    const auto floor = rain(3000, numbers);
    std::vector<Photon> others;
    for (int i = 0; i < 3000; ++i) {
        const auto a = float(numbers.between(-1, 1)), b = float(numbers.unit());
        // A wall at x = 0.02, lit from where the floor is, and the floor's other side,
        // lit by light that comes through this one's air: one that shines up, and one
        // whose direction alone would not tell.
        others.push_back({.position{0.02f, a, b},
                          .direction = glm::normalize(Vec3{1, 0, -1}),
                          .flux{1, 1, 1},
                          .normal = ljus::small_normal(Vec3{-1, 0, 0})});
        others.push_back({.position{a, 2 * b - 1, -0.001f},
                          .direction = glm::normalize(Vec3{1, 0, -1}),
                          .flux{1, 1, 1},
                          .normal = ljus::small_normal(Vec3{0, 0, -1})});
    }
    auto both = floor;
    both.insert(both.end(), others.begin(), others.end());
    for (const std::size_t k : {std::size_t(0), std::size_t(50)}) {
        const DensityEstimateSettings gather{.radius = 0.3f, .nearest = k};
        const Rgb expected = estimate(ljus::make_photon_map(floor), gather);
        const Rgb found = estimate(ljus::make_photon_map(both), gather);
        for (int c = 0; c < 3; ++c)
            CHECK(found[c] == doctest::Approx(expected[c]).epsilon(1e-6));
    }
}

TEST_CASE("photon_map: k nearest stays right beside a ceiling full of photons") {
    // Photons of the ceiling count among the k, set the radius at times, and are left
    // out of the sum: the mean must not care.
    for (const Kernel kernel : {Kernel::box, Kernel::epanechnikov}) {
        Draws numbers{42};
        Mean mean;
        for (int i = 0; i < 1500; ++i) {
            auto photons = rain(400, numbers);
            const auto ceiling = rain(400, numbers, 0.05f);
            photons.insert(photons.end(), ceiling.begin(), ceiling.end());
            // Half of the photons of the ceiling lie within the disc's area.
            mean.add(
                double(estimate(ljus::make_photon_map(photons), {.radius = 0.9f,
                                                                 .nearest = 20,
                                                                 .kernel = kernel,
                                                                 .thickness = 0.05f})
                           .x));
        }
        CHECK(std::abs(mean.sigmas(exact(0))) < 4.5);
    }
}

TEST_CASE("photon_map: photons of other kinds do not disturb the k nearest") {
    Draws numbers{51};
    const auto light = rain(500, numbers);
    const auto shadows = rain(3000, numbers, 0, PhotonKind::shadow, 10);
    std::vector<Photon> mixed;
    for (std::size_t i = 0; i < shadows.size(); ++i) {
        mixed.push_back(shadows[i]);
        if (i < light.size()) mixed.push_back(light[i]);
    }
    const auto map = ljus::make_photon_map(mixed);
    const auto alone = ljus::make_photon_map(light);
    for (const Kernel kernel : kernels)
        for (const std::size_t k : {0u, 5u, 50u}) {
            const DensityEstimateSettings gather{
                .radius = 0.3f, .nearest = k, .kernel = kernel};
            for (int i = 0; i < 50; ++i) {
                const Vec3 at{float(numbers.between(-0.7, 0.7)),
                              float(numbers.between(-0.7, 0.7)), 0};
                std::uint64_t gathered = 0;
                const Rgb found =
                    ljus::estimate_radiance(map, floor_at(at), matt, Vec3{0, 0, 1},
                                            gather, ljus::light_kinds, gathered);
                std::uint64_t gathered_alone = 0;
                const Rgb expected =
                    ljus::estimate_radiance(alone, floor_at(at), matt, Vec3{0, 0, 1},
                                            gather, ljus::all_kinds, gathered_alone);
                REQUIRE(gathered == gathered_alone);
                for (int c = 0; c < 3; ++c)
                    REQUIRE(found[c] == doctest::Approx(expected[c]).epsilon(1e-6));
            }
        }
}

TEST_CASE("photon_map: the k-th photon sets the radius and is left out of the sum") {
    std::vector<Photon> photons;
    for (const float x : {0.1f, 0.2f, 0.3f, 0.5f, 0.7f})
        photons.push_back({.position{x, 0, 0},
                           .direction{0, 0, -1},
                           .flux = Rgb{float(photons.size() + 1)}});
    const auto map = ljus::make_photon_map(photons);
    const double f = double(matt.albedo.x) / std::numbers::pi;
    for (std::size_t k = 2; k <= 5; ++k) {
        std::uint64_t gathered = 0;
        const Rgb found = ljus::estimate_radiance(
            map, floor_at<float>({0, 0, 0}), matt, Vec3{0, 0, 1},
            {.radius = 1, .nearest = k, .kernel = Kernel::box}, ljus::all_kinds,
            gathered);
        const double radius = double(photons[k - 1].position.x);
        double sum = 0;
        for (std::size_t i = 1; i < k; ++i) sum += double(i);
        CHECK(gathered == k - 1);
        CHECK(double(found.x) ==
              doctest::Approx(f * sum / (std::numbers::pi * radius * radius)));
    }
}

TEST_CASE("photon_map: light from below a matt surface is not seen above it") {
    std::vector<Photon> photons(10, Photon{.direction{0, 0, 1}, .flux{1, 1, 1}});
    CHECK(estimate(ljus::make_photon_map(photons), {}) == Rgb{0});
}

TEST_CASE("photon_map: at the border of the disc rounding puts no photon beyond it") {
    // A kernel that has no value beyond 1. Photons as far away as the radius: of the
    // squares in float some are more than the radius's, and their weight is that at 1.
    Draws numbers{91};
    int beyond = 0;
    for (int repeat = 0; repeat < 3000; ++repeat) {
        const Vec3 at{float(numbers.between(-1, 1)), float(numbers.between(-1, 1)), 0};
        float radius = float(glm::length(glm::dvec3(at)));
        if (double(radius) < glm::length(glm::dvec3(at)))
            radius = std::nextafter(radius, 2.0f);
        const float share =
            (at.x * at.x + at.y * at.y + at.z * at.z) * (1 / (radius * radius));
        beyond += share > 1 ? 1 : 0;
        for (const int count : {1, 2, 5}) { // one by one, and eight together
            const auto map = ljus::make_photon_map(std::vector<Photon>(
                std::size_t(count),
                {.position = at, .direction{0, 0, -1}, .flux = Rgb{1}}));
            std::uint64_t gathered = 0;
            const Rgb light = ljus::estimate_radiance(
                map, floor_at<float>(Vec3{0}), matt, Vec3{0, 0, 1},
                ljus::DensityEstimateOf<Root>{.radius = radius}, ljus::all_kinds,
                gathered);
            REQUIRE(gathered == std::uint64_t(count));
            REQUIRE(light.x >= 0); // and no NaN
            REQUIRE(double(light.x) <= count * 1e-2 / double(radius * radius));
        }
    }
    CHECK(beyond > 10);
}

TEST_CASE("photon_map: in double") {
    std::vector<ljus::PhotonT<double>> photons;
    Draws numbers{71};
    for (int i = 0; i < 4000; ++i)
        photons.push_back(
            {.position{1e6 + numbers.between(-1, 1), numbers.between(-1, 1), 0},
             .direction{0, 0, -1},
             .flux = ljus::RgbT<double>{4.0 / 4000}});
    const auto map = ljus::make_photon_map(photons);
    std::uint64_t gathered = 0;
    const auto found = ljus::estimate_radiance(
        map, floor_at<double>({1e6, 0, 0}),
        ljus::LambertianT<double>{.albedo = ljus::RgbT<double>{1.0}},
        ljus::Vec3T<double>{0, 0, 1}, {.radius = 0.5f}, ljus::all_kinds, gathered);
    CHECK(found.x * std::numbers::pi == doctest::Approx(1).epsilon(0.15));
    CHECK(gathered > 500);
}

TEST_CASE(
    "photon_map: each photon's record lies beside its position, to the last bit") {
    Draws numbers{31};
    for (const int count : {0, 1, 7, 8, 9, 4095, 4097, 20000, 150000}) {
        std::vector<Photon> photons = rain(count, numbers, 0.25f);
        for (std::size_t i = 0; i < photons.size(); ++i) {
            const auto any = [&] { return std::int8_t(numbers.between(-127, 127)); };
            photons[i].flux.x = float(i + 1);
            photons[i].light = static_cast<std::uint16_t>(84 * i);
            photons[i].kind = static_cast<PhotonKind>(i % 4);
            photons[i].normal = {any(), any(), any()};
        }
        const PhotonMap map = ljus::make_photon_map(photons);
        REQUIRE(map.records.size() == photons.size());
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < photons.size(); ++i) {
            const Photon& photon = photons[map.tree.point_ids()[i]];
            const auto record = map.records[i];
            wrong += map.tree.point(i) != photon.position ||
                     record.direction != photon.direction ||
                     record.flux != photon.flux || record.kind != photon.kind ||
                     record.normal != photon.normal || record.light != photon.light;
        }
        CHECK(wrong == 0);
        CHECK(map.records.empty() == photons.empty());
        CHECK(map.records.bytes() ==
              (photons.size() + 7) / 8 * sizeof(map.records.blocks()[0]));
        // Parts are the same photons.
        ljus::detail::PhotonPartsT<float> parts(1);
        for (const Photon& photon : photons) {
            if (parts.back().size() == 777) parts.emplace_back();
            parts.back().push_back(photon);
        }
        const PhotonMap same = ljus::detail::map_of_parts(std::move(parts), 3);
        CHECK(std::ranges::equal(same.tree.point_ids(), map.tree.point_ids()));
        for (std::size_t i = 0; i < same.records.size(); ++i)
            wrong += same.records[i].flux != map.records[i].flux;
        CHECK(wrong == 0);
    }
}

TEST_CASE("photon_map: data that are not finite or have no direction are refused") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const auto refuse = [](Photon photon) {
        CHECK_THROWS_AS((void)ljus::make_photon_map(std::vector<Photon>{photon}),
                        std::invalid_argument);
    };
    const Vec3 down{0, -1, 0};
    refuse({.position{nan, 0, 0}, .direction = down});
    refuse(
        {.position{0, std::numeric_limits<float>::infinity(), 0}, .direction = down});
    refuse({.direction{0, 0, nan}});
    refuse({.direction = down, .flux{0, nan, 0}});
    refuse({.direction{0, -1.01f, 0}});
    CHECK_NOTHROW((void)ljus::make_photon_map(
        std::vector<Photon>{Photon{.direction{0.6f, -0.8001f, 0}}}));
    CHECK_THROWS_WITH((void)ljus::make_photon_map(std::vector<Photon>(1)),
                      "photon.direction is (0, 0, 0); it must be a vector of length "
                      "1.");
    CHECK_THROWS_WITH(
        (void)ljus::make_photon_map(std::vector<Photon>{Photon{.flux{0, nan, 0}}}),
        "photon.flux is (0, NaN, 0); it must be finite in "
        "every component.");
}

TEST_CASE("photon_map: a way to gather that gives no estimate is refused") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float inf = std::numeric_limits<float>::infinity();
    const auto said = [](const DensityEstimateSettings& gather) {
        return ljus_test::refusal([&] { ljus::check(gather); });
    };
    CHECK(said({}).empty());
    for (const float good : {1e-15f, 1e15f}) CHECK(said({.radius = good}).empty());
    for (const float bad : {0.0f, -1.0f, nan, inf, 1e-30f, 0.999e-15f, 1.001e15f})
        CHECK(said({.radius = bad}) ==
              "gather.radius is " + ljus::to_text(bad) +
                  "; it must be within [1e-15, 1e15], or no float holds the radiance.");
    for (const float bad : {0.0f, -1.0f, nan, inf})
        CHECK(said({.thickness = bad}).starts_with("gather.thickness is "));
    for (const std::size_t good : {2u, 512u}) CHECK(said({.nearest = good}).empty());
    for (const std::size_t bad : {1u, 513u})
        CHECK(said({.nearest = bad}) ==
              "gather.nearest is " + std::to_string(bad) +
                  "; it must be 0 for all within the radius, or 2 to 512 (one photon "
                  "sets the radius).");
}

TEST_CASE(
    "photon_map: an estimate refuses what it has no room for, and a disc of nothing") {
    // More photons than the largest k, all at hand.
    std::vector<Photon> photons;
    for (int i = 0; i < 2000; ++i)
        photons.push_back({.position{float(i % 50) / 50, float(i) / 2000, 0},
                           .direction{0, 0, -1},
                           .flux = Rgb{1}});
    const PhotonMap map = ljus::make_photon_map(photons);
    const auto estimate = [&](const DensityEstimateSettings& gather) {
        return ljus::estimate_irradiance(map,
                                         {.position{0.5f, 0.5f, 0}, .normal{0, 0, 1}},
                                         Vec3{0, 0, 1}, gather)
            .x;
    };
    CHECK(estimate({.radius = 0.5f, .nearest = 512}) > 0);
    for (const std::size_t nearest : {1u, 513u, 10'000u}) {
        CAPTURE(nearest);
        CHECK_THROWS_WITH_AS(estimate({.radius = 0.5f, .nearest = nearest}),
                             ("gather.nearest is " + std::to_string(nearest) +
                              "; it must be 0 for all within the radius, or 2 to 512 "
                              "(one photon sets the "
                              "radius).")
                                 .c_str(),
                             std::invalid_argument);
    }
    for (const float radius : {0.0f, -1.0f, std::nanf("")})
        CHECK_THROWS_AS(estimate({.radius = radius}), std::invalid_argument);
    // The estimate of radiance has no more room.
    ljus::Vertex floor{.point{.position{0.5f, 0.5f, 0}, .normal{0, 0, 1}}};
    floor.frame = ljus::frame_around(floor.point.normal);
    std::uint64_t gathered = 0;
    CHECK_THROWS_AS((void)ljus::estimate_radiance(
                        map, floor, Lambertian{.albedo = Rgb{1}}, Vec3{0, 0, 1},
                        DensityEstimateSettings{.radius = 0.5f, .nearest = 513},
                        ljus::all_kinds, gathered),
                    std::invalid_argument);
}

TEST_CASE("photon_map: which surfaces' photons count: those within 60 degrees") {
    // Eight photons or more at once, and few: in lanes and one by one.
    for (const int count : {1, 2, 8, 11})
        for (const double degrees : {0.0, 40.0, 58.0, 62.0, 80.0, 100.0, 180.0})
            for (const double around : {0.0, 1.0, 2.5}) {
                const double a = degrees * std::numbers::pi / 180;
                const Vec3 normal(std::sin(a) * std::cos(around),
                                  std::sin(a) * std::sin(around), std::cos(a));
                std::vector<Photon> photons(
                    std::size_t(count), Photon{.direction{0, 0, -1},
                                               .flux = Rgb{1},
                                               .normal = ljus::small_normal(normal)});
                CAPTURE(count);
                CAPTURE(degrees);
                const auto map = ljus::make_photon_map(photons);
                const auto seen = estimate(map, {.radius = 1, .kernel = Kernel::box});
                const double right = degrees < 60 ? count : 0;
                CHECK(double(seen.x) ==
                      doctest::Approx(right * double(matt.albedo.x) / std::numbers::pi /
                                      std::numbers::pi));
            }
}

TEST_CASE("photon_map: the radius that k photons typically take, by hand") {
    // On a line at 0, 1, 3 and 7: the distance to the second other one is 3, 2, 3, 6,
    // and what is typical is their geometric mean.
    const auto line = [](std::initializer_list<float> places) {
        std::vector<Photon> photons;
        for (const float x : places)
            photons.push_back({.position{x, 0, 0}, .direction{0, -1, 0}});
        return ljus::make_photon_map(photons);
    };
    const auto four = line({0, 1, 3, 7});
    CHECK(double(ljus::typical_radius(four, 2)) ==
          doctest::Approx(std::pow(3.0 * 2 * 3 * 6, 0.25)));
    CHECK(double(ljus::typical_radius(four, 1)) ==
          doctest::Approx(std::pow(1.0 * 1 * 2 * 4, 0.25)));
    CHECK(double(ljus::typical_radius(four, 100)) == // as far as there are some
          doctest::Approx(std::pow(7.0 * 6 * 4 * 7, 0.25)));
    // Those that lie in one place say nothing; without any it is 1.
    CHECK(double(ljus::typical_radius(line({0, 0, 0, 5}), 1)) == doctest::Approx(5));
    CHECK(ljus::typical_radius(line({}), 5) == 1);
    CHECK(ljus::typical_radius(line({4}), 5) == 1);
    CHECK(ljus::typical_radius(line({4, 4, 4}), 2) == 1);
    // Of many every few are asked: of 600 in the order of the tree each third.
    std::vector<Photon> many;
    for (int i = 0; i < 600; ++i)
        many.push_back({.position{float(i) * float(i), 0, 0}, .direction{0, -1, 0}});
    const auto map = ljus::make_photon_map(many);
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < 600; i += 3) {
        const double n = std::sqrt(double(map.tree.point(i).x));
        sum += std::log(n > 0 ? 2 * n - 1 : 1); // to the neighbour below
        ++count;
    }
    CHECK(double(ljus::typical_radius(map, 1)) ==
          doctest::Approx(std::exp(sum / count)).epsilon(1e-4));
}

TEST_CASE("photon_map: of the k nearest the disc is as flat as it is wide") {
    // Three at 0.1, 0.2 and 0.3: the last one gives the radius, and of the others one
    // stands higher than half of it, though not than half of the widest disc.
    const auto at = [](float x, float height) {
        return Photon{.position{x, 0, height},
                      .direction{0, 0, -1},
                      .flux = Rgb{1},
                      .normal = ljus::small_normal(Vec3{0, 0, 1})};
    };
    const float beside = std::sqrt(0.2f * 0.2f - 0.18f * 0.18f);
    for (const float height : {0.14f, 0.18f}) {
        const float x = height > 0.15f ? beside : std::sqrt(0.04f - height * height);
        const auto map =
            ljus::make_photon_map(std::vector{at(0.1f, 0), at(x, height), at(0.3f, 0)});
        const double found =
            double(estimate(map, {.radius = 1, .nearest = 3, .kernel = Kernel::box}).x);
        const double of_one =
            double(matt.albedo.x) / std::numbers::pi / (std::numbers::pi * 0.09);
        CHECK(found == ljus_test::within((height < 0.15f ? 2 : 1) * of_one, 1e-4));
    }
}

namespace {

/// A kernel that makes light, or loses some.
struct Level {
    float height = 1;
};
float kernel_weight(Level level, float) {
    return level.height;
}

} // namespace

TEST_CASE("photon_map: a kernel's mean is 1, but for 1 %") {
    for (const float good : {0.992f, 1.0f, 1.008f})
        CHECK_NOTHROW(ljus::check(ljus::DensityEstimateOf<Level>{.kernel{good}}));
    for (const float bad : {0.95f, 0.985f, 1.015f, 1.05f})
        CHECK_THROWS_AS(ljus::check(ljus::DensityEstimateOf<Level>{.kernel{bad}}),
                        std::invalid_argument);
}

TEST_CASE("photon_map: what an estimate is asked for if nothing is said") {
    const DensityEstimateSettings gather;
    CHECK(gather.radius == 0.1f);
    CHECK(gather.nearest == 0);
    CHECK(gather.kernel == Kernel::epanechnikov);
    CHECK(gather.thickness == 0.5f);
    CHECK(ljus::max_nearest == 512);
}
