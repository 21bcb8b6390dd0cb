/// \file light_transport_test.cpp
/// \brief Classes of paths against std::regex; renderers cut down to a class add up to
/// the whole; Eq. 1's g against a closed form.
///
/// Run with 20 further seeds: none failed.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <regex>
#include <string>
#include <vector>

#include "ljus/path/light_transport.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scenes/cornell_box.hpp"
#include "ljus/scenes/furnaces.hpp"
#include "support/closed_forms.hpp"
#include "support/numbers.hpp"
#include "support/refusal.hpp"
#include "support/seed.hpp"
#include "support/within.hpp"

using namespace ljus;
using doctest::Approx;

namespace {

/// A random expression, at most `depth` brackets deep.
std::string expression(ljus_test::Numbers& n, int depth) {
    std::string result;
    for (int parts = 1 + n.below(3); parts > 0; --parts) {
        if (depth > 0 && n.below(3) == 0)
            result += "(" + expression(n, depth - 1) + ")";
        else
            result += "EDSL."[n.below(5)];
        if (n.below(2) == 0) result += "*+?"[n.below(3)];
        if (parts > 1 && n.below(4) == 0) result += '|';
    }
    return result;
}

RenderSettings small() {
    return {.width = 16,
            .height = 16,
            .samples = 4,
            .seed = ljus_test::test_seed(3),
            .threads = 1};
}

template <typename Renderer>
Image picture(const Renderer& renderer, const Camera& camera) {
    return render(renderer, camera, small()).image;
}

/// The largest difference of two pictures, relative to what is there.
double difference(const Image& a, const Image& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double x = double(a.pixels[i][c]), y = double(b.pixels[i][c]);
            largest = std::max(largest, std::abs(x - y) / (1 + std::abs(x)));
        }
    return largest;
}

} // namespace

TEST_CASE("light_transport: classes of paths, by hand") {
    constexpr LightPathExpression whitted = light_path_expression("ES*D?L");
    CHECK((detail::contains(whitted, "EL") && detail::contains(whitted, "ESSDL")));
    CHECK_FALSE(
        (detail::contains(whitted, "EDSL") || detail::contains(whitted, "EDDL")));
    const LightPathExpression caustic = light_path_expression("E.*DS+L");
    for (const char* path : {"EDSL", "EDSSL", "ESDDSL"})
        CHECK(detail::contains(caustic, path));
    for (const char* path : {"EL", "EDL", "ESL", "EDS", "DSL", "EDSDL", "EDSLL", ""})
        CHECK_FALSE(detail::contains(caustic, path));
    CHECK(detail::contains(light_path_expression(""), ""));
    CHECK(detail::contains(light_path_expression("((E)(S|D|)*)L"), "ESDSDL"));
    const std::string deep = "E" + std::string(100000, 'D') + "L";
    CHECK(detail::contains(light_path_expression("E(D*S?)*L"), deep));
    // Of several signs behind one letter each counts: together "any number of".
    for (const char* words : {"ED+?L", "ED?+L", "ED*?L", "ED??+L", "E(D+)?L"}) {
        REQUIRE_NOTHROW((void)light_path_expression(words));
        const LightPathExpression any = light_path_expression(words);
        for (const char* path : {"EL", "EDL", "EDDDL"})
            CHECK(detail::contains(any, path));
        for (const char* path : {"ESL", "ED", "E", "EDDSL"})
            CHECK_FALSE(detail::contains(any, path));
    }
}

TEST_CASE("light_transport: classes of paths, 120 random ones beside std::regex") {
    ljus_test::Numbers n;
    int matched = 0;
    for (int test = 0; test < 120; ++test) {
        const std::string words = expression(n, 2);
        std::string other;
        for (const char c : words) other += c == '.' ? "[DS]" : std::string(1, c);
        const std::regex judge(other);
        const LightPathExpression paths = light_path_expression(words);
        for (int k = 0; k < 30; ++k) {
            std::string path;
            for (int length = n.below(6); length > 0; --length)
                path += "EDSL"[n.below(4)];
            const bool expected = std::regex_match(path, judge);
            matched += expected;
            CAPTURE(words);
            CAPTURE(path);
            REQUIRE(detail::contains(paths, path) == expected);
        }
    }
    CHECK(matched > 200); // so that both answers are tested
}

TEST_CASE("light_transport: an expression that is none is refused with its place") {
    const auto refusal = [](const char* words) {
        return ljus_test::refusal([&] { (void)light_path_expression(words); });
    };
    CHECK(refusal("ES*L") == "");
    CHECK(refusal("EXL") ==
          "The class of paths 'EXL' has an unexpected character at position 2; it "
          "may contain E, D, S, L, '.' for D or S, and | ( ) * + ?.");
    const auto said = [&](const char* words, const char* what, int place) {
        return refusal(words) ==
               std::string("The class of paths '") + words + "' has " + what +
                   " at position " + std::to_string(place) +
                   "; it may contain E, D, S, L, '.' for D or S, and | ( ) * + ?.";
    };
    CHECK(said("E(S|D", "no closing bracket", 6));
    CHECK(said("E)L", "an unmatched closing bracket", 2));
    CHECK(said("*", "an unexpected character", 1));
    CHECK(said("E L", "an unexpected character", 2));
    CHECK(said("E(S|D)(", "no closing bracket", 8));
    CHECK(said("E{2}L", "an unexpected character", 2));
    CHECK(refusal(std::string(64, 'D').c_str()).find("63 letters") !=
          std::string::npos);
    CHECK(refusal(std::string(63, 'D').c_str()) == "");
    CHECK(refusal((std::string(63, '(') + 'D' + std::string(63, ')')).c_str()) == "");
    CHECK(refusal(std::string(1'000'000, '(').c_str()).find("63 opening brackets at") !=
          std::string::npos); // and no stack overflows
}

TEST_CASE("light_transport: the parts of a picture add up to the whole") {
    const auto room = cornell_box();
    const PathTracer tracer(room.world);
    const Image whole = picture(tracer, room.camera);
    CHECK(difference(whole, picture(OnlyPaths(tracer, "E.*L"), room.camera)) == 0);
    // And cost as much: nothing is left out but the sums.
    const Counts all = render(tracer, room.camera, small()).counts;
    const Counts some = render(OnlyPaths(tracer, "EDL"), room.camera, small()).counts;
    CHECK(all.bounce_rays > 0);
    CHECK(some.camera_rays == all.camera_rays);
    CHECK(some.bounce_rays == all.bounce_rays);
    CHECK(some.shadow_rays == all.shadow_rays);
    for (const auto& classes :
         {std::vector<const char*>{"EL", "E.L", "E..L", "E...+L"},
          std::vector<const char*>{"ES*L", "ES*DL", "E.*DDL", "E.*DS+DL", "E.*DS+L"}}) {
        Image sum = make_image(16, 16);
        for (const char* words : classes) {
            const Image part = picture(OnlyPaths(tracer, words), room.camera);
            for (std::size_t i = 0; i < sum.pixels.size(); ++i)
                sum.pixels[i] += part.pixels[i];
        }
        CHECK(difference(whole, sum) < 1e-6);
    }
}

TEST_CASE(
    "light_transport: cut short by the letters or by the depth, the same picture") {
    const auto room = cornell_box();
    const PathTracer tracer(room.world);
    const PathTracer one(room.world, {.max_depth = 1});
    CHECK(difference(picture(one, room.camera),
                     picture(OnlyPaths(tracer, "ED?L"), room.camera)) == 0);
    const PathTracer three(room.world, {.max_depth = 3});
    CHECK(difference(picture(three, room.camera),
                     picture(OnlyPaths(tracer, "E(..?)?D?L"), room.camera)) < 1e-6);
}

TEST_CASE("light_transport: g is 1/r^2 where points see each other, and else 0") {
    // A point below the corner of a lamp.
    const double a = 0.8, b = 0.5, h = 0.6;
    const double share = ljus_test::form_factor_of_corner(a, b, h);
    const QuadT<double> lamp{.corner{0, h, 0}, .edge_u{a, 0, 0}, .edge_v{0, 0, b}};
    // A screen at half the height hides the half of the lamp with x above a / 2.
    const QuadT<double> screen{
        .corner{a / 4, h / 2, -9}, .edge_u{9, 0, 0}, .edge_v{0, 0, 18}};
    Scene<Shapes<QuadT<double>>, Materials<LambertianT<double>>> lamp_alone, screened;
    const auto grey = lamp_alone.add(LambertianT<double>{});
    (void)screened.add(LambertianT<double>{});
    lamp_alone.add(lamp, grey);
    screened.add(lamp, grey);
    screened.add(screen, grey);
    const World open(std::move(lamp_alone)), hidden(std::move(screened));
    const SurfacePointT<double> floor{.normal{0, 1, 0}};
    const int n = 80;
    double seen = 0, half = 0, below_half = 0;
    const auto squared = [](const Vec3T<double>& v) { return glm::dot(v, v); };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const auto point =
                sample_area(lamp, Vec2T<double>{(i + 0.5) / n, (j + 0.5) / n});
            const double g = transport_factor(open, floor, point);
            CHECK(g == Approx(transport_factor(open, point, floor)).epsilon(1e-12));
            // g is 1/r^2, and the two cosines h/r bring in another.
            const auto share_by = [&](double factor) {
                return h * h / squared(point.position) * factor / std::numbers::pi * a *
                       b / (n * n);
            };
            seen += share_by(g);
            below_half += i < n / 2 ? share_by(g) : 0;
            half += share_by(transport_factor(hidden, floor, point));
        }
    CHECK(seen == Approx(share).epsilon(1e-4));
    CHECK(half == Approx(below_half).epsilon(1e-12));
    CHECK(transport_factor(open, floor, floor) == 0);
    const auto at = [](double right, double up, double back) {
        return SurfacePointT<double>{.position{right, up, back}, .normal{0, 0, 1}};
    };
    CHECK(transport_factor(open, at(7, 8, -9), at(8, 6, -7)) == Approx(1.0 / 9));
}

TEST_CASE("light_transport: in a furnace each bounce has its power of the albedo") {
    // Inside of a ball that shines, each bounce keeps rho. 1024 paths; a path's share
    // of a bounce scatters by less than its mean, so that 6 standard errors are 0.19.
    const auto furnace = sphere_furnace<float>(Rgb{1}, {0.9f, 0.5f, 0.1f});
    const PathTracer tracer(furnace.world, {.max_depth = 4});
    std::string words = "E";
    for (int bounce = 0; bounce < 4; ++bounce) {
        const std::string all = words + "L"; // the class does not keep it
        const Image image = picture(OnlyPaths(tracer, all), furnace.camera);
        Rgb mean{0};
        for (const Rgb& c : image.pixels) mean += c / 256.0f;
        CAPTURE(bounce);
        CHECK(double(mean.x) == ljus_test::within(std::pow(0.9, bounce), 0.19));
        CHECK(double(mean.y) == ljus_test::within(std::pow(0.5, bounce), 0.19));
        CHECK(double(mean.z) == ljus_test::within(std::pow(0.1, bounce), 0.19));
        words += "D";
    }
}

TEST_CASE("light_transport: a map's terms count by the shortest path of their class") {
    // "DL|D..DL" is one lookup for two classes, "DS+L" for all caustics.
    const auto counted = [](const char* words, const char* way, const char* term) {
        const LightPathExpression wanted = light_path_expression(words);
        detail::ExpressionLog<double> log{.wanted = wanted};
        log.begin();
        for (const char letter : std::string(way))
            log.vertex(letter, Vec3T<double>{0}, RgbT<double>{1}, 0.0);
        const std::uint64_t states = log.states;
        log.term("map", term, RgbT<double>{1, 2, 3});
        log.term("map", term, RgbT<double>{1, 2, 3});
        CHECK(log.states == states); // the path goes on from where it was
        const bool none = log.sum == RgbT<double>{0};
        CHECK((none || log.sum == RgbT<double>{2, 4, 6}));
        return !none;
    };
    CHECK(counted("EDL", "", "DL"));
    CHECK_FALSE(counted("EDL", "D", "DL"));
    CHECK(counted("EDDL", "D", "DL"));
    CHECK(counted("EDL", "", "DL|D..DL"));
    CHECK_FALSE(counted("EDDL", "", "DL|D..DL"));
    CHECK(counted("EDDL", "", "D..DL"));
    CHECK_FALSE(counted("EDL", "", "D..DL"));
    CHECK(counted("ESDSL", "S", "DS+L"));
    CHECK_FALSE(counted("ESDL", "S", "DS+L"));
    CHECK_FALSE(counted("ESDSSL", "S", "DS+L"));
    // The beginning of a longer path is not in its class.
    CHECK_FALSE(counted("EDLD", "", "DL"));
    CHECK_FALSE(counted("E.*LL", "D", "DL"));
    CHECK(counted("EDL(D|S)*", "", "DL"));
    // A path that begins anew has come from nowhere.
    const LightPathExpression twice = light_path_expression("E(E|D)*L");
    detail::ExpressionLog<double> log{.wanted = twice};
    log.begin();
    const std::uint64_t states = log.states;
    log.vertex('D', Vec3T<double>{0}, RgbT<double>{1}, 0.0);
    log.begin();
    CHECK(log.states == states);
}
