/// \file own_light_test.cpp
/// \brief The torch of examples/own_light.hpp against closed forms.

#include "own_light.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

#include "ljus/materials/lambertian.hpp"
#include "ljus/scene/scene.hpp"

using ljus::Vec3;
using reader::Torch;

static_assert(ljus::LightSource<Torch>);

namespace {

using Room = ljus::Scene<ljus::Shapes<ljus::Sphere>, ljus::Materials<ljus::Lambertian>>;

/// The irradiance of a surface that faces up, by one shadow ray without obstacles.
double irradiance(const Torch& torch, const Vec3& from) {
    Room room;
    room.add(torch);
    const auto sample = sample_light(room, room.lights[0], from, ljus::Vec2{0.5f});
    return sample ? double(sample->weight.x) * double(sample->wi.z) : 0;
}

} // namespace

TEST_CASE(
    "own light: below a torch the irradiance is watts by solid angle and distance") {
    const Torch torch{
        .position{0, 0, 3}, .target{0, 0, 0}, .watts = 12, .beam_degrees = 50};
    const double pi = std::numbers::pi;
    const double intensity = 12 / (2 * pi * (1 - std::cos(25 * pi / 180)));
    CHECK(irradiance(torch, {0, 0, 0}) == doctest::Approx(intensity / 9));
    // A step aside: the cosine, and the longer way.
    CHECK(irradiance(torch, {1, 0, 0}) ==
          doctest::Approx(intensity / 10 * 3 / std::sqrt(10.0)));
    const float edge = 3 * float(std::tan(25 * pi / 180));
    CHECK(irradiance(torch, {0, 0.99f * edge, 0}) > 0);
    CHECK(irradiance(torch, {0, 1.01f * edge, 0}) == 0);
}

TEST_CASE("own light: all that falls onto a floor is what the torch sends") {
    for (const float degrees : {2.0f, 40.0f, 120.0f}) {
        const Torch torch{
            .position{0, 0, 2}, .target{0, 0, 0}, .watts = 7, .beam_degrees = degrees};
        const double edge = 2 * std::tan(double(degrees) * std::numbers::pi / 360);
        double sum = 0; // rings around the axis
        constexpr int rings = 4000;
        for (int i = 0; i < rings; ++i) {
            const double r = edge * (i + 0.5) / rings;
            sum += irradiance(torch, {float(r), 0, 0}) * 2 * std::numbers::pi * r *
                   edge / rings;
        }
        CHECK(sum == doctest::Approx(7).epsilon(2e-3));
        CHECK(double(make_light(torch).flux.x) == doctest::Approx(7).epsilon(1e-3));
    }
}

TEST_CASE("own light: what no picture can be made with is refused by name") {
    CHECK_NOTHROW(check(Torch{}));
    CHECK_THROWS_WITH_AS(check(Torch{.watts = 0}), doctest::Contains("torch.watts"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(check(Torch{.beam_degrees = 180}),
                         doctest::Contains("torch.beam_degrees"),
                         std::invalid_argument);
    Room room;
    CHECK_THROWS_AS(room.add(Torch{.position{1, 1, 1}, .target{1, 1, 1}}),
                    std::invalid_argument); // it points nowhere
}
