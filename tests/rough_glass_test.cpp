/// \file rough_glass_test.cpp
/// \brief Rough glass: a density on both sides, no light from nowhere, and glass at the
/// end.

#include "ljus/materials/rough_glass.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "support/bsdf_checks.hpp"
#include "support/seed.hpp"
#include "support/within.hpp"

using ljus::RoughGlass, ljus::RoughGlassT, ljus::GlassT, ljus::Lobes, ljus::Transport;
using ljus::Vec3T;
using namespace ljus_test;

namespace {

using Vec = Vec3T<double>;
constexpr double pi = std::numbers::pi;

/// Fresnel's reflectance as Walter et al. print it, Eq. 22. \param c  Of the facet.
double printed_fresnel(double c, double n_i, double n_t) {
    const double g2 = n_t * n_t / (n_i * n_i) - 1 + c * c;
    if (g2 <= 0) return 1;
    const double g = std::sqrt(g2);
    const double a = (g - c) / (g + c), b = (c * (g + c) - 1) / (c * (g - c) + 1);
    return a * a * (1 + b * b) / 2;
}

/// Eq. 33, with an angle.
double printed_d(double alpha, const Vec& m) {
    if (m.z <= 0) return 0;
    const double c2 = m.z * m.z, t2 = (1 - c2) / c2;
    const double s = alpha * alpha + t2;
    return alpha * alpha / (pi * c2 * c2 * s * s);
}

/// Eq. 34.
double printed_g1(double alpha, const Vec& v, const Vec& m) {
    if (glm::dot(v, m) / v.z <= 0) return 0;
    const double t2 = (1 - v.z * v.z) / (v.z * v.z);
    return 2 / (1 + std::sqrt(1 + alpha * alpha * t2));
}

/// Eqs. 16 and 17: the half direction of transmission, and the BTDF, Eq. 21. Light
/// comes from i, in index n_i, and leaves along o, in index n_o.
double printed_btdf(double alpha, const Vec& i, const Vec& o, double n_i, double n_o) {
    Vec h = -glm::normalize(n_i * i + n_o * o);
    if (h.z < 0) h = -h; // Eq. 16 has its normal on the side of the thinner medium
    const double ih = glm::dot(i, h), oh = glm::dot(o, h);
    if (ih * oh >= 0) return 0;
    const double root = n_i * ih + n_o * oh;
    return std::abs(ih * oh / (i.z * o.z)) * n_o * n_o *
           (1 - printed_fresnel(std::abs(ih), n_i, n_o)) * printed_g1(alpha, i, h) *
           printed_g1(alpha, o, h) * printed_d(alpha, h) / (root * root);
}

/// The index on the side of a direction.
double index_at(const RoughGlassT<double>& m, const Vec& w) {
    return w.z > 0 ? 1 : m.index;
}

/// The fractions of light that come back, and go through.
struct Fractions {
    double reflected = 0, transmitted = 0;
    [[nodiscard]] double sum() const { return reflected + transmitted; }
};

/// By the midpoint rule over f cos, without the square of the index; fine along the
/// surface.
Fractions by_quadrature(const RoughGlassT<double>& m, const Vec& wo) {
    constexpr int n = 800, around = 200;
    const auto ring = ljus_test::directions_around(around);
    Fractions found;
    const double scale = index_at(m, wo) / index_at(m, -wo);
    for (int i = 0; i < n; ++i) {
        const double t = 1 - (i + 0.5) / n, theta = pi / 2 * (1 - t * t);
        const double s = std::sin(theta), z = std::copysign(std::cos(theta), wo.z);
        const double part = s * std::abs(z) * pi * t / n * 2 * pi / around;
        for (const glm::dvec2& way : ring) {
            const Vec wi{s * way, z}, other{s * way, -z};
            found.reflected += evaluate(m, wo, wi).x * part;
            found.transmitted += evaluate(m, wo, other).x * part / (scale * scale);
        }
    }
    return found;
}

/// By the weights of samples of flux, at the points of a lattice.
Fractions by_samples(const RoughGlassT<double>& m, const Vec& wo, int count = 100000) {
    Fractions found;
    for (int i = 0; i < count; ++i) {
        const auto part = [&](double step) {
            const double x = 0.5 + i * step;
            return x - std::floor(x);
        };
        // Roberts' steps: the powers of the root of x^4 = x + 1.
        const Vec u{part(0.8191725133961645), part(0.6710436067037893),
                    part(0.5497004779019703)};
        const auto s = sample(m, wo, u, Transport::flux);
        if (!s) continue;
        (ljus::same_side(wo, s->wi) ? found.reflected : found.transmitted) +=
            s->weight.x / count;
    }
    return found;
}

} // namespace

TEST_CASE("rough glass: f is the formula that Walter et al. print") {
    Draws draws{ljus_test::test_seed(1)};
    double worst = 0;
    int through = 0;
    for (int i = 0; i < 20000; ++i) {
        const RoughGlassT<double> m{.index = draws.between(0.4, 2.5),
                                    .roughness = draws.between(0.1, 1.0)};
        if (std::abs(m.index - 1) < 0.02) continue; // nearly no boundary
        const double alpha = m.roughness * m.roughness;
        const auto wo = draws.direction<double>();
        auto wi = draws.direction<double>();
        if (i % 2)
            if (const auto s = sample(m, wo, draws.cube<double>(), Transport::flux))
                wi = s->wi;
        const double f = evaluate(m, wo, wi).x;
        const double n_o = index_at(m, wo), n_i = index_at(m, wi);
        double right = 0;
        if (wo.z * wi.z < 0) {
            right = printed_btdf(alpha, wi, wo, n_i, n_o);
            through += right > 0 ? 1 : 0;
        } else { // Eq. 20, with G2 as GlossyT has it
            const Vec out{wo.x, wo.y, std::abs(wo.z)}, in{wi.x, wi.y, std::abs(wi.z)};
            const Vec h = glm::normalize(out + in);
            const double g2 =
                1 / (1 / printed_g1(alpha, out, h) + 1 / printed_g1(alpha, in, h) - 1);
            right = printed_fresnel(glm::dot(out, h), n_o, index_at(m, -wo)) * g2 *
                    printed_d(alpha, h) / (4 * out.z * in.z);
        }
        CAPTURE(m.index);
        CAPTURE(wo.z);
        CAPTURE(wi.z);
        REQUIRE(std::abs(f - right) <= 1e-7 * std::max(right, 1e-3));
        worst = std::max(worst, std::abs(f - right) / std::max(right, 1e-3));
    }
    MESSAGE(through, " pairs on different sides, worst ", worst);
    CHECK(through > 5000);
    CHECK(worst < 1e-7);
}

TEST_CASE("rough glass: of two directions on different sides, f over the square of the "
          "index stays when they are exchanged") {
    Draws draws{ljus_test::test_seed(2)};
    int through = 0;
    for (int i = 0; i < 20000; ++i) {
        const RoughGlassT<double> m{.index = draws.between(1.05, 2.5),
                                    .roughness = draws.between(0.1, 1.0)};
        const auto wo = draws.direction<double>();
        auto wi = draws.direction<double>();
        if (i % 2)
            if (const auto s = sample(m, wo, draws.cube<double>(), Transport::flux))
                wi = s->wi;
        const double n_o = index_at(m, wo), n_i = index_at(m, wi);
        const double one = evaluate(m, wo, wi).x / (n_o * n_o);
        const double other = evaluate(m, wi, wo).x / (n_i * n_i);
        REQUIRE(one == doctest::Approx(other).epsilon(1e-8));
        through += one > 0 && wo.z * wi.z < 0 ? 1 : 0;
    }
    CHECK(through > 5000);
}

TEST_CASE(
    "rough glass: by quadrature and by samples the same light comes back and goes "
    "through, and never more than there is") {
    double worst = 0;
    for (const double index : {1.5, 0.75, 2.4})
        for (const double roughness : {0.5, 1.0})
            for (const double degrees : {0.0, 40.0, 75.0, 100.0, 138.5, 180.0}) {
                const RoughGlassT<double> m{.index = index, .roughness = roughness};
                const auto wo = at_degrees<double>(degrees, 20);
                const auto summed = by_quadrature(m, wo);
                const auto sampled = by_samples(m, wo);
                CAPTURE(index);
                CAPTURE(roughness);
                CAPTURE(degrees);
                CHECK(std::abs(summed.reflected - sampled.reflected) < 2e-3);
                CHECK(std::abs(summed.transmitted - sampled.transmitted) < 2e-3);
                CHECK(sampled.sum() <= 1);
                worst = std::max({worst, std::abs(summed.reflected - sampled.reflected),
                                  std::abs(summed.transmitted - sampled.transmitted)});
            }
    MESSAGE("at most ", worst, " apart");
}

TEST_CASE("rough glass: what a second facet would have carried is lost, as stated") {
    // Roughness, what is lost of light along the normal from outside, and from inside.
    const double stated[][3] = {{0.1, 0, 0},
                                {0.3, 0, 0.01},
                                {0.5, 0.01, 0.07},
                                {0.7, 0.03, 0.24},
                                {1, 0.11, 0.58}};
    for (const auto& row : stated) {
        const double roughness = row[0], outside = row[1], inside = row[2];
        const RoughGlassT<double> m{.roughness = roughness};
        CAPTURE(roughness);
        CHECK(std::abs(1 - by_samples(m, {0, 0, 1}).sum() - outside) < 5e-3);
        CHECK(std::abs(1 - by_samples(m, {0, 0, -1}).sum() - inside) < 5e-3);
        double most = 0;
        for (int degrees = 0; degrees < 180; degrees += 4)
            most = std::max(
                most, 1 - by_samples(m, at_degrees<double>(degrees), 20000).sum());
        MESSAGE(roughness, ": at most ", most);
        CHECK(most < 0.65);
    }
}

// 12 materials, angles and seeds, at 3 in 10 million each. Along the surface the
// density has edges, which a fine grid resolves.
TEST_CASE(
    "rough glass: samples follow the density on both sides, at the critical angle "
    "and along the surface; their weight is f cos over it") {
    // 41.8 degrees is the critical angle of 1.5, and 138.2 is it from inside.
    std::uint64_t seed = 0;
    for (const double degrees : {0.0, 50.0, 85.0, 100.0, 138.2, 170.0}) {
        Draws draws{ljus_test::test_seed(++seed)};
        const auto wo = at_degrees<double>(degrees, draws.between(0.0, 360.0));
        CAPTURE(degrees);
        const int fine = std::abs(degrees - 90) < 15 ? 96 : 16;
        check_sampling(RoughGlass{.roughness = draws.between(0.7f, 1.0f)},
                       ljus::Vec3(wo), Lobes::all, seed, fine);
        check_sampling(RoughGlassT<double>{.index = draws.between(0.5, 0.7),
                                           .roughness = draws.between(0.7, 1.0)},
                       wo, Lobes::glossy, seed + 100, fine);
    }
}

TEST_CASE(
    "rough glass: where a small square of u becomes a solid angle, the density is "
    "their ratio, times the fraction of the light") {
    // For any roughness: the derivatives of sample() by differences.
    Draws draws{ljus_test::test_seed(3)};
    int checked = 0;
    for (int i = 0; i < 3000; ++i) {
        const RoughGlassT<double> m{.index = i % 3 ? 1.5 : draws.between(0.4, 2.5),
                                    .roughness = draws.between(0.03, 1.0)};
        if (std::abs(m.index - 1) < 0.05) continue;
        const auto wo = draws.direction<double>();
        const Vec u{draws.between(0.01, 0.99), draws.between(0.01, 0.99), draws.unit()};
        const auto s = sample(m, wo, u, Transport::flux);
        if (!s || std::abs(wo.z) < 0.02 || std::abs(s->wi.z) < 0.02) continue;
        const bool back = ljus::same_side(wo, s->wi);
        const auto at = [&](double x, double y) {
            const Vec moved{u.x + x, u.y + y, back ? 0 : std::nextafter(1.0, 0.0)};
            const auto near = sample(m, wo, moved, Transport::flux);
            return near && ljus::same_side(wo, near->wi) == back
                       ? std::optional<Vec>(near->wi)
                       : std::nullopt;
        };
        constexpr double e = 1e-6;
        const auto x0 = at(-e, 0), x1 = at(e, 0), y0 = at(0, -e), y1 = at(0, e);
        if (!x0 || !x1 || !y0 || !y1) continue;
        const double angle =
            glm::length(glm::cross((*x1 - *x0) / (2 * e), (*y1 - *y0) / (2 * e)));
        double low = 0, high = 1; // F, by bisection of what sample() does
        while (high - low > 1e-12) {
            const double middle = (low + high) / 2;
            const auto t = sample(m, wo, Vec{u.x, u.y, middle}, Transport::flux);
            const bool reflects = t ? ljus::same_side(wo, t->wi) : !back;
            (reflects ? low : high) = middle;
        }
        const double fraction = back ? low : 1 - low;
        if (fraction < 1e-3) continue;
        REQUIRE(s->pdf == within(fraction / angle, 1e-4));
        ++checked;
    }
    MESSAGE(checked, " densities");
    CHECK(checked > 1500);
}

TEST_CASE("rough glass: the smoother, the more it is glass; at roughness 0 it is") {
    Draws draws{ljus_test::test_seed(4)};
    for (int i = 0; i < 2000; ++i) {
        const RoughGlassT<double> m{.index = 1.5, .roughness = 0};
        const GlassT<double> glass{.index = 1.5};
        const auto wo = draws.direction<double>();
        const auto u = draws.cube<double>();
        const auto a = sample(m, wo, u, Transport::radiance);
        const auto b = sample(glass, wo, u, Transport::radiance);
        REQUIRE((a && b));
        REQUIRE(a->specular);
        REQUIRE(a->wi == b->wi);
        REQUIRE(a->weight == b->weight);
        REQUIRE(a->eta_scale == b->eta_scale);
        REQUIRE(ljus::is_black(evaluate(m, wo, a->wi)));
        REQUIRE(pdf(m, wo, a->wi) == 0);
        const auto both = split(m, wo, Transport::flux);
        REQUIRE(bool(both) == bool(split(glass, wo, Transport::flux)));
        REQUIRE(
            (!both || both->at(1).wi == split(glass, wo, Transport::flux)->at(1).wi));
    }
    CHECK(ljus::lobes(RoughGlass{.roughness = 0}) == Lobes::specular);
    CHECK(ljus::lobes(RoughGlass{}) == Lobes::glossy);
    CHECK_FALSE(split(RoughGlass{}, {0, 0, 1}, Transport::flux));
    // Snell's direction and Fresnel's fraction are approached.
    for (const double degrees : {0.0, 30.0, 60.0, 150.0, 160.0}) {
        const auto wo = at_degrees<double>(degrees);
        const double n_i = wo.z > 0 ? 1 : 1.5, n_t = wo.z > 0 ? 1.5 : 1;
        const Vec snell = *ljus::refract(wo, n_i / n_t);
        const double f = printed_fresnel(std::abs(wo.z), n_i, n_t);
        double last = 1;
        for (const double roughness : {0.2, 0.1, 0.03, 0.01}) {
            const RoughGlassT<double> m{.roughness = roughness};
            const auto next = sample(m, wo, {0.3, 0.4, 0.9999}, Transport::flux);
            REQUIRE(next);
            const double apart = glm::length(next->wi - snell);
            CHECK(apart < last);
            CHECK(apart < 4 * roughness * roughness);
            last = apart;
            CAPTURE(degrees);
            CAPTURE(roughness);
            CHECK(std::abs(by_samples(m, wo).reflected - f) < roughness / 4);
        }
        CHECK(std::abs(by_samples({.roughness = 0.01}, wo).reflected - f) < 1e-3);
    }
}

TEST_CASE("rough glass: the index of its surroundings makes it invisible, and nothing "
          "happens at once on the way there") {
    Draws draws{ljus_test::test_seed(5)};
    for (int i = 0; i < 2000; ++i) {
        const RoughGlassT<double> none{.index = 1,
                                       .roughness = draws.between(0.01, 1.0)};
        const auto wo = draws.direction<double>();
        const auto s = sample(none, wo, draws.cube<double>(), Transport::radiance);
        REQUIRE(s);
        REQUIRE(s->specular);
        REQUIRE(glm::length(s->wi + wo) < 1e-15);
        REQUIRE(s->weight.x == 1);
    }
    for (const double beside : {1e-1, 1e-2, 1e-3, 2e-4, 1e-4, 1e-5}) {
        const RoughGlassT<double> m{.index = 1 + beside, .roughness = 0.4};
        CHECK((ljus::lobes(m) == Lobes::glossy) == (0.16 * beside > 2e-5));
        const auto s =
            sample(m, at_degrees<double>(30), {0.3, 0.4, 0.9999}, Transport::radiance);
        REQUIRE(s);
        CHECK(glm::length(s->wi + at_degrees<double>(30)) < beside);
        CHECK(s->weight.x == doctest::Approx(1).epsilon(3 * beside + 0.01));
        if (!s->specular) {
            const auto f = evaluate(m, at_degrees<double>(30), s->wi);
            CHECK(s->weight.x ==
                  doctest::Approx(f.x * std::abs(s->wi.z) / s->pdf).epsilon(1e-9));
        }
    }
}

TEST_CASE("rough glass: along the surface, where float overflows, f is 0") {
    const RoughGlass rough{.roughness = 1};
    int finite = 0;
    for (const float out : {1e-3f, 1e-20f, 1e-38f, 5e-43f})
        for (const float in : {1e-3f, 1e-20f, 1e-38f, 5e-43f, 2e-40f})
            for (const float side : {1.0f, -1.0f}) {
                const auto f = evaluate(rough, Vec3T<float>{1, 0, side * out},
                                        Vec3T<float>{-1, 0, side * in});
                REQUIRE((std::isfinite(f.x) && f.x >= 0));
                finite += f.x > 0 ? 1 : 0;
            }
    CHECK(finite > 2);
}

TEST_CASE("rough glass: beyond the critical angle most stays inside, and what leaves "
          "does so by tilted facets") {
    const auto wo = at_degrees<double>(180 - 60);
    const auto smooth = by_samples({.roughness = 0.1}, wo);
    const auto rough = by_samples({.roughness = 0.6}, wo);
    CHECK(smooth.transmitted < 1e-3);
    CHECK(smooth.reflected > 0.99);
    CHECK(rough.transmitted > 0.05);
    MESSAGE("transmitted: ", smooth.transmitted, " and ", rough.transmitted);
    // A facet that sends light straight up is tilted by more than 20 degrees.
    CHECK(evaluate(RoughGlassT<double>{.roughness = 0.1}, wo, {0, 0, 1}).x < 1e-3);
}

TEST_CASE("rough glass: radiance that goes in and out again is what it was") {
    Draws draws{ljus_test::test_seed(6)};
    for (const double index : {1.5, 0.6}) {
        const RoughGlassT<double> m{.index = index, .roughness = 0.5};
        for (int i = 0; i < 2000; ++i) {
            const auto wo = draws.direction<double>();
            const auto u = draws.cube<double>();
            const auto radiance = sample(m, wo, u, Transport::radiance);
            const auto flux = sample(m, wo, u, Transport::flux);
            REQUIRE(bool(radiance) == bool(flux));
            if (!radiance) continue;
            REQUIRE(flux->eta_scale == 1);
            const double eta = index_at(m, wo) / index_at(m, radiance->wi);
            REQUIRE(radiance->eta_scale == doctest::Approx(eta * eta).epsilon(1e-12));
            REQUIRE(radiance->weight.x ==
                    doctest::Approx(flux->weight.x * eta * eta).epsilon(1e-12));
            REQUIRE(flux->weight.x <= 1 + 1e-14);
        }
    }
}

TEST_CASE_TEMPLATE(
    "rough glass: no NaN from grazing to straight on, from 0.01 to 1, for "
    "indices from 1e-3 to 1e3",
    T, float, double) {
    for (const T index : {T(1e-3), T(0.5), T(1), T(1.0001), T(1.3), T(1.5), T(1e3)})
        for (const T roughness : {T(0.01), T(0.1), T(0.5), T(1)})
            check_extremes(RoughGlassT<T>{.index = index, .roughness = roughness},
                           1 + 8 * double(std::numeric_limits<T>::epsilon()));
    // Float is close to double, on both sides.
    Draws draws{ljus_test::test_seed(7)};
    for (int i = 0; i < 5000; ++i) {
        const RoughGlassT<T> m{.index = T(1.5),
                               .roughness = draws.between(T(0.05), T(1))};
        const RoughGlassT<double> exact{.index = 1.5, .roughness = double(m.roughness)};
        const auto wo = draws.direction<T>();
        const auto s = sample(m, wo, draws.cube<T>(), Transport::radiance);
        if (!s || std::abs(wo.z) < T(0.01) || std::abs(s->wi.z) < T(0.01)) continue;
        const double f = evaluate(exact, Vec(wo), Vec(s->wi)).x;
        const double allowed = m.roughness < T(0.2) ? 5e-3 : 3e-4;
        if (f > 1e-3) REQUIRE(double(evaluate(m, wo, s->wi).x) == within(f, allowed));
    }
}

TEST_CASE("rough glass: it is glossy, a body, and its colour is absorption") {
    const RoughGlass m{.absorption = {1, 2, 3}};
    CHECK(m.index == 1.5f);
    CHECK(m.roughness == 0.3f);
    CHECK(ljus::absorption(m) == ljus::Rgb{1, 2, 3});
    CHECK(ljus::refractive_index(m) == 1.5f);
    CHECK(relative_to(m, 1.25f).index == doctest::Approx(1.2));
    CHECK(ljus::emission(m) == ljus::Rgb{0, 0, 0});
    const ljus::Vec3 up{0, 0, 1}, u{0.5f, 0.5f, 0.5f};
    CHECK_FALSE(sample(m, up, u, Transport::flux, Lobes::specular));
    CHECK_FALSE(
        sample(RoughGlass{.roughness = 0}, up, u, Transport::flux, Lobes::glossy));
    static_assert(ljus::Material<RoughGlass>);
}

TEST_CASE("rough glass: nearly specular below a roughness of 0.84, for index 1.5") {
    for (const float roughness : {0.01f, 0.4f, 0.84f})
        CHECK(nearly_specular(RoughGlass{.roughness = roughness}));
    for (const float roughness : {0.85f, 1.0f})
        CHECK_FALSE(nearly_specular(RoughGlass{.roughness = roughness}));
    CHECK_FALSE(nearly_specular(RoughGlass{.roughness = 0})); // which is specular
    // Of a body that is denser lobes are wider.
    CHECK_FALSE(nearly_specular(RoughGlass{.index = 2, .roughness = 0.8f}));
}

TEST_CASE("rough glass: light of both sides counts on it, but not on glass or gloss") {
    CHECK(scatters_through(RoughGlass{}));
    CHECK_FALSE(scatters_through(RoughGlass{.roughness = 0}));
    CHECK_FALSE(scatters_through(RoughGlass{.index = 1}));
    CHECK_FALSE(scatters_through(ljus::Glass{}));
    CHECK_FALSE(scatters_through(ljus::Glossy{}));
}

TEST_CASE("rough glass: what no glass can be is refused by name and value") {
    CHECK(refusal(RoughGlass{}).empty());
    CHECK(refusal(RoughGlass{.roughness = 0}).empty());
    CHECK(refusal(RoughGlass{.index = 1}).empty());
    CHECK(refusal(RoughGlass{.index = -1}).find("rough_glass.index is -1") == 0);
    CHECK(refusal(RoughGlass{.index = 1001}).find("rough_glass.index") == 0);
    CHECK(refusal(RoughGlass{.absorption = {0, -1, 0}})
              .find("rough_glass.absorption is (0, -1, 0)") == 0);
    for (const float bad : {NAN, -0.1f, 0.005f, 1.01f, INFINITY}) {
        const std::string said = refusal(RoughGlass{.roughness = bad});
        CHECK(said.find("rough_glass.roughness") == 0);
        CHECK(said.find("within [0.01, 1]") != std::string::npos);
    }
}

namespace {

/// A boundary of its own: facets by all normals, Walter's Eqs. 35, 36, 40 and 41, and
/// Fresnel as printed. Returns the weight of the new direction; 0: it ends.
double cross_boundary(double alpha, double n_i, double n_t, Vec& v, Draws& draws) {
    const double theta = std::atan(alpha * std::sqrt(1 / draws.unit() - 1));
    const double phi = 2 * pi * draws.unit();
    const Vec m{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                std::cos(theta)};
    const Vec i = v; // away from the surface, z > 0
    const double c = glm::dot(i, m);
    if (c <= 0) return 0;
    const bool reflects = draws.unit() < printed_fresnel(c, n_i, n_t);
    if (reflects) {
        v = 2 * c * m - i;
        if (v.z <= 0) return 0;
        // The heights of both ways are one facet's.
        const double g2 =
            1 / (1 / printed_g1(alpha, i, m) + 1 / printed_g1(alpha, v, m) - 1);
        return c * g2 / (i.z * m.z);
    }
    const double eta = n_i / n_t;
    v = (eta * c - std::sqrt(1 + eta * (c * c - 1) * eta)) * m - eta * i;
    if (v.z >= 0) return 0;
    return c * printed_g1(alpha, i, m) * printed_g1(alpha, v, m) / (i.z * m.z);
}

} // namespace

// Three roughnesses, two angles, two numbers each: 5 errors, 1 in 140 000.
TEST_CASE("rough glass: a slab carries what an independent walk between its two rough "
          "faces does") {
    constexpr int count = 60000;
    for (const double roughness : {0.2, 0.5, 0.8})
        for (const double degrees : {10.0, 65.0}) {
            const RoughGlassT<double> m{.roughness = roughness};
            Mean ours[2], other[2]; // reflected, transmitted
            Draws draws{ljus_test::test_seed(8)};
            for (int k = 0; k < count; ++k) {
                // With sample(): wo on the face at hand, in the frame of that face.
                double w = 1;
                Vec wo = at_degrees<double>(degrees);
                int face = 0; // 0: above, 1: below
                bool out = false;
                while (w > 0 && !out) {
                    const auto s = sample(m, wo, draws.cube<double>(), Transport::flux);
                    if (!s) w = 0;
                    if (!s) break;
                    w *= s->weight.x;
                    out = s->wi.z > 0;
                    if (!out) { // inside, on to the other face
                        face = 1 - face;
                        wo = {-s->wi.x, -s->wi.y, s->wi.z};
                    }
                }
                ours[0].add(w > 0 && face == 0 ? w : 0);
                ours[1].add(w > 0 && face == 1 ? w : 0);
                // The independent walk: v is above the face at hand.
                w = 1;
                Vec v = at_degrees<double>(degrees);
                bool inside = false;
                face = 0;
                for (;;) {
                    w *= cross_boundary(roughness * roughness, inside ? 1.5 : 1,
                                        inside ? 1 : 1.5, v, draws);
                    if (w == 0) break;
                    inside = inside == (v.z > 0);
                    if (!inside) break;
                    face = 1 - face;
                    v = {-v.x, -v.y, std::abs(v.z)};
                }
                other[0].add(face == 0 ? w : 0);
                other[1].add(face == 1 ? w : 0);
            }
            CAPTURE(roughness);
            CAPTURE(degrees);
            for (int side = 0; side < 2; ++side)
                CHECK(std::abs(apart(ours[side], other[side])) < 5);
            MESSAGE(roughness, ", ", degrees, " degrees: ", ours[0].mean, " and ",
                    ours[1].mean, "; by the other walk ", other[0].mean, " and ",
                    other[1].mean);
        }
}
