// concept: oren_nayar
/// \file rough_diffuse_test.cpp
/// \brief Each model against its formula in angles, and what white returns.

#include "ljus/materials/rough_diffuse.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/bsdf_checks.hpp"

using ljus::RoughDiffuse, ljus::RoughDiffuseT, ljus::RoughModel, ljus::Vec3T;
using namespace ljus_test;

namespace {

using L = long double;
constexpr L pi = std::numbers::pi_v<L>;
constexpr RoughModel models[] = {RoughModel::as_printed, RoughModel::full,
                                 RoughModel::fujii, RoughModel::fon};

/// The angles of two directions, as the papers name them.
struct Angles {
    L theta_i, theta_o, phi;
};

template <typename T>
Angles angles(const Vec3T<T>& wo, const Vec3T<T>& wi) {
    const auto theta = [](const Vec3T<T>& w) {
        return std::atan2(std::hypot(L(w.x), L(w.y)), L(w.z));
    };
    return {theta(wi), theta(wo),
            std::atan2(L(wi.y), L(wi.x)) - std::atan2(L(wo.y), L(wo.x))};
}

/// Pi f by the formulas of the papers, with acos, tan and all.
L printed(RoughModel model, L rho, L sigma, const Angles& at) {
    const L s2 = sigma * sigma;
    const L alpha = std::max(at.theta_i, at.theta_o);
    const L beta = std::min(at.theta_i, at.theta_o);
    const L b = 0.45L * s2 / (s2 + 0.09L), a = 1 - s2 / (2 * (s2 + 0.33L));
    const L between = std::cos(at.theta_i) * std::cos(at.theta_o) +
                      std::sin(at.theta_i) * std::sin(at.theta_o) * std::cos(at.phi);
    const L s = between - std::cos(at.theta_i) * std::cos(at.theta_o);
    const L t = s > 0 ? std::max(std::cos(at.theta_i), std::cos(at.theta_o)) : 1;
    switch (model) {
    case RoughModel::as_printed:
        return rho * std::min(L(1), 1 - s2 / (2 * (s2 + 0.57L)) +
                                        b * std::max(L(0), between) * std::sin(alpha) *
                                            std::tan(beta));
    case RoughModel::full: {
        const L cube = std::pow(2 * beta / pi, 3);
        const L c2 = b * (std::sin(alpha) - (std::cos(at.phi) >= 0 ? 0 : cube));
        const L c3 =
            0.125L * s2 / (s2 + 0.09L) * std::pow(4 * alpha * beta / pi / pi, 2);
        const L once =
            a + std::cos(at.phi) * c2 * std::tan(beta) +
            (1 - std::abs(std::cos(at.phi))) * c3 * std::tan((alpha + beta) / 2);
        const L twice = 0.17L * s2 / (s2 + 0.13L) *
                        (1 - std::cos(at.phi) * std::pow(2 * beta / pi, 2));
        return std::max(L(0), rho * once + rho * rho * twice); // cut off at 0
    }
    case RoughModel::fujii:
        return rho * (a + 0.17L * rho * s2 / (s2 + 0.13L) + b * s / t);
    case RoughModel::fon:
        break;
    }
    return rho * (1 + sigma * s / t) / (1 + sigma * (0.5L - 2 / (3 * pi)));
}

} // namespace

TEST_CASE_TEMPLATE("rough_diffuse: within 64 roundoffs of the printed formulas", T,
                   float, double) {
    const L u = std::numeric_limits<T>::epsilon() / 2;
    for (const RoughModel model : models) {
        Draws draws{static_cast<unsigned>(model) + 1u};
        L worst = 0;
        for (int i = 0; i < 50000; ++i) {
            const T sigma = model == RoughModel::fon || i % 2
                                ? draws.unit<T>()
                                : draws.between(T(0), T(100));
            const T rho = draws.unit<T>();
            const auto wo =
                i % 7 ? draws.above<T>() : at_degrees<T>(draws.between(85.0, 89.9), 20);
            const auto wi = i % 5 ? draws.above<T>() : wo;
            const RoughDiffuseT<T> m{ljus::RgbT<T>{rho}, sigma, model};
            const L exact = printed(model, L(rho), L(sigma), angles(wo, wi));
            const L ours = L(ljus::detail::rough_weight(m, wo, wi).x);
            // At crossed azimuths the cosine itself is small: count against its factor.
            const L factor = std::hypot(L(wi.x), L(wi.y)) *
                             std::hypot(L(wo.x), L(wo.y)) / std::max(L(wi.z), L(wo.z));
            worst = std::max(worst, std::abs(ours - exact) /
                                        ((std::abs(exact) + L(rho) * factor) * u));
        }
        MESSAGE("model ", int(model), ": ", double(worst), " u");
        CHECK(worst <= 64);
    }
}

TEST_CASE("rough_diffuse: what white returns of a constant sky, at most") {
    const auto most = [](RoughModel model, double largest_sigma) {
        double largest = 0;
        for (const double sigma : {0.1, 0.3, 0.6, 1.0, 10.0}) {
            if (sigma > largest_sigma) continue;
            for (const double theta : {0.0, 30.0, 60.0, 75.0, 82.0, 86.0, 89.0}) {
                const RoughDiffuseT<double> m{ljus::RgbT<double>{1}, sigma, model};
                largest = std::max(
                    largest, albedo_by_quadrature(m, at_degrees<double>(theta), 300).x);
            }
        }
        return largest;
    };
    CHECK(most(RoughModel::full, 100) == doctest::Approx(1.049).epsilon(0.01));
    CHECK(most(RoughModel::fujii, 100) == doctest::Approx(1.026).epsilon(0.01));
    // The one that claims to gain nothing, and its limit at the grazing angle.
    CHECK(most(RoughModel::fon, 1) <= 1.0001);
    CHECK(most(RoughModel::as_printed, 100) <= 1.0001); // by its clamp
}

TEST_CASE("rough_diffuse: without roughness every model is Lambert's") {
    Draws draws{4};
    for (const RoughModel model : models)
        for (int i = 0; i < 200; ++i) {
            const auto wo = draws.above<float>(), wi = draws.above<float>();
            const RoughDiffuse m{ljus::Rgb{0.7f}, 0, model};
            CHECK(ljus::detail::rough_weight(m, wo, wi).x == doctest::Approx(0.7f));
        }
}

TEST_CASE_TEMPLATE("rough_diffuse: samples, sides and extremes", T, float, double) {
    for (const RoughModel model : models) {
        const RoughDiffuseT<T> m{{T(0.9), T(0.5), T(0)}, T(0.8), model};
        check_sampling(m, at_degrees<T>(50));
        check_extremes(m, 1 + 1 / std::sqrt(double(std::numeric_limits<T>::epsilon())));
        Draws draws{9};
        for (int i = 0; i < 500; ++i) { // the roles can be exchanged
            const auto wo = draws.above<T>(), wi = draws.above<T>();
            const auto there = evaluate(m, wo, wi), back = evaluate(m, wi, wo);
            REQUIRE(there.x == doctest::Approx(back.x).epsilon(1e-5));
        }
    }
}

TEST_CASE("rough_diffuse: a ball lit from the front is flatter than Lambert's") {
    const auto fall = [](RoughModel model, double degrees) {
        const RoughDiffuseT<double> m{ljus::RgbT<double>{0.8}, 0.6, model};
        const auto w = at_degrees<double>(degrees);
        const auto up = at_degrees<double>(0);
        return evaluate(m, w, w).x * w.z / evaluate(m, up, up).x;
    };
    for (const RoughModel model :
         {RoughModel::full, RoughModel::fujii, RoughModel::fon})
        for (const double degrees : {30.0, 50.0, 70.0})
            CHECK(fall(model, degrees) >
                  std::cos(degrees * std::numbers::pi / 180) + 0.02);
}

TEST_CASE("rough_diffuse: what is no albedo and no roughness is refused") {
    CHECK(refusal(RoughDiffuse{}).empty());
    CHECK(refusal(RoughDiffuse{.albedo{1, 1, 1.1f}}).find("rough_diffuse.albedo") == 0);
    CHECK(refusal(RoughDiffuse{.sigma = NAN}).find("rough_diffuse.sigma") == 0);
    CHECK(refusal(RoughDiffuse{.sigma = 2}).find("rough_diffuse.sigma") == 0);
    CHECK(refusal(RoughDiffuse{.sigma = 2, .model = RoughModel::full}).empty());
    for (const auto model :
         {RoughModel::as_printed, RoughModel::full, RoughModel::fujii}) {
        CHECK(refusal(RoughDiffuse{.sigma = 1000, .model = model}).empty());
        CHECK(refusal(RoughDiffuse{.sigma = 1001, .model = model}) ==
              "rough_diffuse.sigma is 1001; it must be within [0, 1000] radians (the "
              "model saturates near 1).");
    }
    CHECK(refusal(RoughDiffuse{.sigma = 1}).empty());
    CHECK(refusal(RoughDiffuse{.sigma = 1.001f}) ==
          "rough_diffuse.sigma is 1.001; it must be within [0, 1].");
    CHECK(refusal(RoughDiffuse{.sigma = -1, .model = RoughModel::full})
              .find("rough_diffuse.sigma") == 0);
}

TEST_CASE_TEMPLATE("rough_diffuse: light is never negative, and finite down to the "
                   "horizon",
                   T, float, double) {
    // Grazing and opposed, where the model of 1994 is below 0; and cosines of which the
    // smallest numbers are made.
    Draws draws{37};
    const double least = sizeof(T) == 4 ? -45 : -320;
    int negative = 0, endless = 0, cut = 0;
    for (const RoughModel model : models)
        for (int i = 0; i < 40000; ++i) {
            const auto at = [&](T cosine, double phi) {
                const T sine = std::sqrt((T(1) - cosine) * (T(1) + cosine));
                return Vec3T<T>{sine * T(std::cos(phi)), sine * T(std::sin(phi)),
                                cosine};
            };
            const auto small = [&] {
                return T(std::pow(10.0, draws.between(i % 2 ? least : -4.0, 0.0)));
            };
            const double turn = i % 3 ? 3.141592653589793 : draws.between(0.0, 6.28);
            const double phi = draws.between(0.0, 6.28);
            const Vec3T<T> wo = at(small(), phi), wi = at(small(), phi + turn);
            const T sigma = i % 5 ? draws.between(T(0), T(1)) : T(1);
            const RoughDiffuseT<T> m{ljus::RgbT<T>{T(0.1)}, sigma, model};
            const T weight = ljus::detail::rough_weight(m, wo, wi).x;
            const T f = evaluate(m, wo, wi).x;
            negative += weight < 0 || f < 0;
            endless += !std::isfinite(weight) || !std::isfinite(f);
            cut += model == RoughModel::full && weight == 0;
        }
    CHECK(negative == 0);
    CHECK(endless == 0);
    CHECK(cut > 1000); // so that the hard place was found
    // How far it is below 0 where it is: as the doc text says.
    const Vec3T<T> wo{T(1), T(0), T(0.001)}, wi{T(-1), T(0), T(0.001)};
    const auto raw = ljus::detail::rough_full(T(1), wo, wi);
    CHECK(double(raw.single + T(0.1) * raw.twice) ==
          doctest::Approx(-0.134).epsilon(0.02));
}

TEST_CASE("rough diffuse: the same from all around, and from both sides") {
    for (const RoughModel model : models)
        for (const double sigma : {0.0, 0.4, 0.9})
            check_symmetry(
                RoughDiffuseT<double>{ljus::RgbT<double>{0.9, 0.5, 0.1}, sigma, model});
}

TEST_CASE("rough_diffuse: black has no sample, but a lobe; other lobes are not drawn") {
    const ljus::Vec3 up{0, 0, 1}, u{0.5f, 0.5f, 0.5f};
    const auto flux = ljus::Transport::flux;
    for (const RoughModel model : models) {
        const RoughDiffuse black{.albedo = ljus::Rgb{0}, .model = model};
        CHECK_FALSE(sample(black, up, u, flux));
        CHECK(lobes(black) == ljus::Lobes::diffuse);
        const RoughDiffuse grey{.model = model};
        CHECK(sample(grey, up, u, flux, ljus::Lobes::diffuse));
        CHECK_FALSE(sample(grey, up, u, flux, ljus::Lobes::specular));
        CHECK_FALSE(sample(grey, up, u, flux, ljus::Lobes::glossy));
        CHECK(pdf(grey, up, up, ljus::Lobes::glossy) == 0);
    }
    CHECK(RoughDiffuse{}.albedo == ljus::Rgb{0.5f});
    CHECK(RoughDiffuse{}.sigma == 0.3f);
    CHECK(RoughDiffuse{}.model == RoughModel::fon);
}
