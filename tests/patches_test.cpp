// concept: radiosity
/// \file patches_test.cpp
/// \brief Patches cover each surface once; form factors by rays
/// agree with closed forms. Run with 20 further seeds: none failed.

#include <doctest/doctest.h>

#include "ljus/geometry/moving.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/radiosity/form_factor_matrix.hpp"
#include "ljus/radiosity/radiosity.hpp"
#include "ljus/scene/picture_lamp.hpp"
#include "ljus/scenes/cornell_box.hpp"
#include "ljus/scenes/furnaces.hpp"
#include "support/closed_forms.hpp"
#include "support/refusal.hpp"
#include "support/seed.hpp"

using namespace ljus;
using ljus_test::refusal;

namespace {

template <typename T>
using Stage = Scene<Shapes<QuadT<T>, TriangleT<T>, SphereT<T>>,
                    Materials<LambertianT<T>, MirrorT<T>>, Lights<PointLightT<T>>>;

Rgb grey(float value) {
    return Rgb{value};
}

/// A closed box from (0, 0, 0) to (1, 1, 1) whose floor shines.
Stage<double> unit_box() {
    Stage<double> box;
    using V = Vec3T<double>;
    const auto white = box.add(LambertianT<double>{.albedo = V(0.5)});
    const V x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, o{0};
    box.add(QuadT<double>{o, x, y}, white, V(1));
    box.add(QuadT<double>{z, y, x}, white);
    box.add(QuadT<double>{o, y, z}, white);
    box.add(QuadT<double>{x, z, y}, white);
    box.add(QuadT<double>{o, z, x}, white);
    box.add(QuadT<double>{y, x, z}, white);
    return box;
}

} // namespace

TEST_CASE("patches: each place of a shape belongs to one cell") {
    const auto check_all = [](const auto& shape, double size) {
        for (const bool inward : {false, true}) {
            PatchGrid grid = patch_grid(shape, size);
            grid.inward = inward;
            RandomStream stream = random_stream(1, Pass::user, 0, 0);
            for (std::uint32_t cell = 0; cell < grid.size(); ++cell) {
                for (int i = 0; i < 20; ++i) {
                    const auto point =
                        detail::sample_cell(grid, shape, cell, next_2d<double>(stream));
                    // A ray that comes back to the point tells the cell.
                    const Vec3T<double> outer = inward ? -point.normal : point.normal;
                    const RayT<double> ray{.origin = point.position + 0.1 * outer,
                                           .direction = -outer};
                    const auto t = intersect(ray, shape);
                    REQUIRE(t);
                    const auto at = detail::place_on(grid.kind, as_hit(*t), outer);
                    CHECK(cell_of(grid, at) == cell);
                }
                if constexpr (Flat<std::remove_cvref_t<decltype(shape)>>) {
                    const Facet facet = detail::cell_facet(grid, facet_of(shape), cell);
                    CHECK(glm::length(detail::area_vector(facet)) ==
                          doctest::Approx(double(area(shape)) / grid.size())
                              .epsilon(1e-12));
                    // Its middle lies in the cell as well.
                    Vec3T<double> middle{0};
                    for (int k = 0; k < facet.count; ++k)
                        middle += facet.corners[std::size_t(k)] / double(facet.count);
                    const Vec3T<double> up = normal(shape);
                    const auto hit = intersect(
                        RayT<double>{.origin = middle + up, .direction = -up}, shape);
                    REQUIRE(hit);
                    CHECK(cell_of(grid, detail::place_on(grid.kind, *hit, up)) == cell);
                    CHECK((glm::dot(detail::area_vector(facet),
                                    detail::area_vector(facet_of(shape))) < 0) ==
                          inward);
                }
            }
        }
    };
    check_all(QuadT<double>{{1, 2, 3}, {2, 0, 1}, {0.5, 1, 0}}, 0.4);
    check_all(TriangleT<double>{{0, 0, 0}, {2, 0, 1}, {0.5, 1, 0}}, 0.3);
    check_all(SphereT<double>{.center{1, 2, 3}, .radius = 0.7}, 0.5);
    // What rounding has put outside belongs to the border.
    const PatchGrid grid = patch_grid(QuadT<double>{}, 0.25);
    CHECK(cell_of(grid, {-1e-9, 1 + 1e-9}) == 12);
    CHECK(cell_of(grid, {-5.0, -5.0}) == 0);
    CHECK(cell_of(grid, {5.0, 5.0}) == 15);
    const PatchGrid corner =
        patch_grid(TriangleT<double>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0.5);
    CHECK(corner.columns == 3);
    for (const double u : {0.0, 0.2, 1.0 / 3, 0.5, 2.0 / 3, 1.0})
        CHECK(cell_of(corner, {u, 1 - u + 1e-15}) < corner.size());
}

TEST_CASE("patches: what there is, and what is left out") {
    const auto room = cornell_box();
    const Patches all = make_patches(room.world, {.size = 0.5});
    // Five walls of 4 x 4 seen from within, and a lamp of one patch on both sides.
    CHECK(all.patches.size() == 5 * 16 + 2);
    CHECK(!all.convex);
    double area = 0;
    RgbT<double> flux(0);
    for (const Patch& patch : all.patches) {
        area += patch.area;
        flux += patch.area * patch.emitted;
    }
    CHECK(area == doctest::Approx(20.5));
    CHECK(flux.x == doctest::Approx(std::numbers::pi * 0.25 * 17));
    REQUIRE(all.left_out.size() == 1);
    CHECK(all.left_out[0] == "2 objects are not Lambertian and reflect no light");

    const auto furnace = sphere_furnace<float>(grey(1), grey(0.5f));
    const Patches inside = make_patches(furnace.world, {.size = 1});
    CHECK(inside.convex);
    CHECK(inside.grids.size() == 1);
    CHECK(inside.grids[0].inward);

    Stage<float> odd;
    odd.add(PointLight{.position{0, 1, 0}});
    const auto white = odd.add(Lambertian{});
    odd.add(Quad{}, white);
    CHECK(refusal([&] { (void)make_patches(World(odd)); }) ==
          "the number of patches is 0; it must be at least 1: add a Lambertian quad, "
          "triangle or ball that sees another.");
    odd.add(Quad{.corner{0, 0, 1}, .edge_u{1, 0, 0}, .edge_v{1, 0, 0}}, white);
    odd.add(Triangle{{0, 0, 2}, {0, 1, 2}, {1, 0, 2}}, white);
    const Patches two = make_patches(World(odd), {.size = 10});
    CHECK(two.patches.size() == 2); // one without an area has no patch
    CHECK(two.left_out ==
          std::vector<std::string>{"1 light has no patches and lights no surface"});
}

TEST_CASE("patches: a textured lamp is said to light nothing, and is drawn as it is") {
    Scene<Shapes<Quad>, Materials<Lambertian, PictureLamp>> scene;
    scene.add(Quad{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, scene.add(Lambertian{}));
    Image picture = make_image(2, 1, Rgb{1});
    pixel(picture, 1, 0) = Rgb{3};
    scene.add(Quad{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}},
              scene.add(PictureLamp{.picture = picture}), Rgb{1});
    const World world(std::move(scene));
    const auto made = make_radiosity(world, {.patches{.size = 1}});
    CHECK(made->patches.left_out ==
          std::vector<std::string>{"1 object is not Lambertian and reflects no light",
                                   "1 light has no patches and lights no surface"});
    const LightMapView view(world, made->map);
    RandomStream stream{};
    Counts counts;
    auto context = context_of(stream, counts);
    for (const float y : {0.25f, 0.75f}) // u goes along y
        CHECK(radiance(view, Ray{.origin{0.5f, y, 0.5f}, .direction{0, 0, 1}}, context)
                  .x == (y < 0.5f ? 1 : 3));
}

TEST_CASE("patches: too many are refused before they take any memory") {
    const auto room = cornell_box();
    CHECK(refusal([&] { (void)make_patches(room.world, {.size = 0.01}); }) ==
          "the number of patches is 40000; it must be at most 8192 (each pair has a "
          "form factor): choose larger patches.");
    CHECK(refusal([&] {
              (void)make_patches(room.world, {.size = 1e-300});
          }).starts_with("the number of patches is 1e+12; "));
    for (const double size : {0.0, -1.0, std::nan("")})
        CHECK(refusal([&] {
                  (void)make_patches(room.world, {.size = size});
              }).starts_with("patch size is "));
    CHECK(refusal(
              [&] { (void)make_patches(room.world, {.size = 1, .most = 100'000}); }) ==
          "most is 100000; it must be at most 65536: their form factors take 34 GB.");
}

TEST_CASE("form_factors: the closed form in a box") {
    const auto box = unit_box();
    const Patches all = make_patches(World(box), {.size = 0.25});
    CHECK(all.convex);
    const auto factors = make_form_factors(World(box), all);
    REQUIRE(factors);
    const std::size_t n = factors->size();
    CHECK(n == 96);
    // From floor to ceiling and to a wall, put together from the patches.
    double facing = 0, corner = 0;
    for (std::size_t i = 0; i < 16; ++i)
        for (std::size_t j = 0; j < 16; ++j) {
            facing += factors->row(i)[16 + j];
            corner += factors->row(i)[32 + j];
        }
    CHECK(facing ==
          doctest::Approx(ljus_test::form_factor_facing(1, 1, 1)).epsilon(1e-12));
    CHECK(corner == doctest::Approx(form_factor_corner(1, 1, 1)).epsilon(1e-12));
    for (std::size_t i = 0; i < n; ++i) {
        CHECK(std::abs(factors->row_sum(i) - 1) < 1e-12);
        for (std::size_t j = 0; j < n; ++j)
            CHECK(factors->row(i)[j] == factors->row(j)[i]); // reciprocity, exactly
    }
}

TEST_CASE("form_factors: rays agree with the closed form") {
    const auto box = unit_box();
    const Patches all = make_patches(World(box), {.size = 0.5});
    const auto right = make_form_factors(World(box), all);
    constexpr int rays = 4000;
    const auto found = make_form_factors(
        World(box), all,
        {.analytic = false, .rays = rays, .seed = ljus_test::test_seed(1)});
    const std::size_t n = all.patches.size();
    double squares = 0, pairs = 0, worst_row = 0;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = i + 1; j < n; ++j) {
            const double f = (*right)(i, j);
            if (f == 0) {
                CHECK((*found)(i, j) == 0);
                continue;
            }
            CHECK(found->row(i)[j] == found->row(j)[i]);
            // Rays from both sides; spread evenly, they
            // scatter a little less than this.
            const double sigma = std::sqrt(f * (1 - f) / (2 * rays));
            squares += std::pow(((*found)(i, j) - f) / sigma, 2);
            pairs += 1;
            CHECK(std::abs((*found)(i, j) - f) < 5 * sigma);
        }
        worst_row = std::max(worst_row, std::abs(found->row_sum(i) - 1));
    }
    MESSAGE("mean square of error / sigma: ", squares / pairs,
            "; largest error of a row's sum: ", worst_row);
    CHECK(squares / pairs < 1.2);
    CHECK(squares / pairs > 0.3);
    CHECK(worst_row > 0); // symmetry costs the sums, which each row of rays had right
    CHECK(worst_row < 5 / std::sqrt(2.0 * rays));

    // The same rays for any number of threads.
    const auto again = make_form_factors(World(box), all,
                                         {.analytic = false,
                                          .rays = rays,
                                          .seed = ljus_test::test_seed(1),
                                          .threads = 3});
    CHECK(again->exchange == found->exchange);
    const auto stop = [](long long, long long) { return false; };
    CHECK(!make_form_factors(World(box), all, {.rays = 1, .progress = stop}));
    CHECK_THROWS_AS((void)make_form_factors(World(box), all, {.rays = 0}),
                    std::invalid_argument);
    CHECK_THROWS_AS((void)make_form_factors(World(box), all, {.shadow_rays = 0}),
                    std::invalid_argument);
}

TEST_CASE("form_factors: rays find the numbers of the tables") {
    const auto box = unit_box();
    constexpr int rays = 20000;
    const auto found = make_form_factors(
        World(box), make_patches(World(box), {.size = 1}),
        {.analytic = false, .rays = rays, .seed = ljus_test::test_seed(1)});
    REQUIRE(found->size() == 6);
    const double sigma = std::sqrt(0.2 * 0.8 / (2.0 * rays));
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const bool facing = i / 2 == j / 2;
            const double right = facing ? ljus_test::form_factor_facing(1, 1, 1)
                                        : form_factor_corner(1, 1, 1);
            CHECK(std::abs((*found)(i, j) - right) < 5 * sigma);
        }
}

TEST_CASE("form_factors: rows are closed, and stay symmetric") {
    const auto box = unit_box();
    const Patches all = make_patches(World(box), {.size = 0.5});
    const auto few = make_form_factors(World(box), all,
                                       {.analytic = false, .rays = 50, .closed = true});
    for (std::size_t i = 0; i < few->size(); ++i) {
        CHECK(std::abs(few->row_sum(i) - 1) < 1e-13);
        for (std::size_t j = 0; j < few->size(); ++j)
            CHECK(few->row(i)[j] == doctest::Approx(few->row(j)[i]).epsilon(1e-14));
    }
    Stage<float> open; // the triangle sees the quad's back, which has no other
    const auto white = open.add(Lambertian{});
    open.add(Quad{}, white);
    open.add(Triangle{{0, 0, 2}, {0, 1, 2}, {1, 0, 2}}, white);
    open.add(Triangle{{9, 9, 9}, {9, 10, 9}, {9, 9, 10}}, white);
    CHECK(refusal([&] {
              (void)make_form_factors(World(open),
                                      make_patches(World(open), {.size = 9}),
                                      {.closed = true});
          }).starts_with("closed is 1; it must be false"));
}

TEST_CASE("form_factors: what stands between") {
    // A screen at half height covers a part of the way from the floor to the ceiling.
    const auto share = [](double width) {
        Stage<double> stage;
        using V = Vec3T<double>;
        const auto white = stage.add(LambertianT<double>{});
        stage.add(QuadT<double>{V(0), {1, 0, 0}, {0, 1, 0}}, white);
        stage.add(QuadT<double>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}, white);
        if (width > 0)
            stage.add(QuadT<double>{{-5, -5, 0.5}, {5 + width, 0, 0}, {0, 10, 0}},
                      stage.add(MirrorT<double>{}));
        const Patches all = make_patches(World(stage), {.size = 1});
        CHECK(all.convex == (width <= 0));
        const auto factors = make_form_factors(
            World(stage), all, {.shadow_rays = 4000, .seed = ljus_test::test_seed(1)});
        const auto rays = make_form_factors(
            World(stage), all,
            {.analytic = false, .rays = 20000, .seed = ljus_test::test_seed(1)});
        CHECK((*rays)(0, 1) == doctest::Approx((*factors)(0, 1)).epsilon(0.03));
        return (*factors)(0, 1) / ljus_test::form_factor_facing(1, 1, 1);
    };
    CHECK(share(0) == doctest::Approx(1).epsilon(1e-12));
    CHECK(share(1) == 0);
    // By symmetry; 4000 rays know it to 1.6 %.
    CHECK(share(0.5) == doctest::Approx(0.5).epsilon(0.03));
}

TEST_CASE("form_factors: within a ball each patch sees all alike") {
    const auto furnace = sphere_furnace<double>(RgbT<double>(1), RgbT<double>(0.5));
    const Patches all = make_patches(furnace.world, {.size = 1});
    const auto factors = make_form_factors(furnace.world, all, {.rays = 4000});
    const double right = 1.0 / double(all.patches.size());
    for (std::size_t i = 0; i < factors->size(); ++i)
        for (std::size_t j = 0; j < factors->size(); ++j) // itself among them: hollow
            CHECK(std::abs((*factors)(i, j) - right) < 5 * std::sqrt(right / 4000));
    // Against a floor, a ball and rays in float: Howell's C-39 for a ball above the
    // middle of a square floor is F = 4 / (4 pi) asin(1 / (1 + h^2)) from the ball.
    Stage<float> stage;
    const auto white = stage.add(Lambertian{});
    stage.add(Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, white);
    stage.add(Sphere{.center{0, 0, 2}, .radius = 0.5f}, white);
    const Patches two = make_patches(World(stage), {.size = 1});
    const auto mixed = make_form_factors(
        World(stage), two, {.rays = 2000, .seed = ljus_test::test_seed(1)});
    double sum = 0, ball = 0;
    for (std::size_t i = 4; i < two.patches.size(); ++i) {
        for (std::size_t j = 0; j < 4; ++j) sum += mixed->row(i)[j];
        ball += two.patches[i].area;
        CHECK((*mixed)(i, i) == 0);
    }
    CHECK(ball == doctest::Approx(std::numbers::pi));
    const double c39 = std::asin(1 / (1 + 4.0)) / std::numbers::pi;
    CHECK(sum / ball == doctest::Approx(c39).epsilon(0.03));
}

TEST_CASE("patches: how many cells, at least, and what a ball reaches over") {
    const PatchGrid ball = patch_grid(SphereT<double>{.radius = 0.1}, 10);
    CHECK(ball.columns == 2);
    CHECK(ball.rows == 3);
    const PatchGrid quad =
        patch_grid(QuadT<double>{{0, 0, 0}, {3, 4, 0}, {0, 0, 2}}, 1);
    CHECK(quad.columns == 5);
    CHECK(quad.rows == 2);
    CHECK(quad.size() == 10);
    CHECK(quad.vertices() == 18);
    const PatchGrid triangle =
        patch_grid(TriangleT<double>{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, 1.001);
    CHECK(triangle.columns == 5);
    CHECK(triangle.size() == 25);
    CHECK(triangle.vertices() == 21);
    // A ball below a floor that is cut by it lies before its upper side, too.
    Stage<double> stage;
    const auto white = stage.add(LambertianT<double>{});
    stage.add(QuadT<double>{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, white);
    stage.add(SphereT<double>{.center{0, 0, -0.3}, .radius = 0.2}, white);
    CHECK(make_patches(World(stage), {.size = 9}).grids.size() ==
          2); // the lower side, the ball
    stage.add(SphereT<double>{.center{0, 0, -0.3}, .radius = 0.5}, white);
    CHECK(make_patches(World(stage), {.size = 9}).grids.size() == 4);
    // What has no patches is said.
    Scene<Shapes<Quad, Moving<Quad>>, Materials<Lambertian>> moving;
    const auto grey = moving.add(Lambertian{});
    moving.add(Quad{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, grey);
    moving.add(Moving<Quad>{Quad{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}, {0, 0, 1}}, grey);
    const Patches all = make_patches(World(moving), {.size = 9});
    CHECK(all.left_out ==
          std::vector<std::string>{
              "1 object is of a shape that is not divided into patches"});
    moving.add(Moving<Quad>{Quad{{0, 0, 5}, {0, 1, 0}, {1, 0, 0}}, {0, 0, 1}}, grey);
    const World moving_world(std::move(moving));
    CHECK(make_patches(moving_world, {.size = 9}).left_out[0] ==
          "2 objects are of a shape that is not divided into patches");
}

TEST_CASE("form_factors: the visible share has the weights of the form factor") {
    using V = Vec3T<double>;
    // Two squares of side 1 at a distance h, and half way between them a screen that
    // ends at x = 1/4: against the midpoint rule over both.
    for (const double h : {0.3, 1.0, 100.0}) {
        Stage<double> stage;
        const auto white = stage.add(LambertianT<double>{});
        stage.add(QuadT<double>{V(0), {1, 0, 0}, {0, 1, 0}}, white);
        stage.add(QuadT<double>{{0, 0, h}, {0, 1, 0}, {1, 0, 0}}, white);
        const Patches open = make_patches(World(stage), {.size = 1});
        CHECK(detail::visible_fraction(World(stage), open, 0, 1, 100, 1) == 1);
        stage.add(QuadT<double>{{0.25, -50, h / 2}, {50, 0, 0}, {0, 100, 0}},
                  stage.add(MirrorT<double>{}));
        const Patches all = make_patches(World(stage), {.size = 1});
        constexpr int n = 24;
        double seen = 0, whole = 0;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                for (int k = 0; k < n; ++k)
                    for (int l = 0; l < n; ++l) {
                        const double dx = double(i - j) / n, dy = double(k - l) / n;
                        const double d2 = dx * dx + dy * dy + h * h;
                        const double weight = h * h / (d2 * d2);
                        whole += weight;
                        const double middle = (i + j + 1) / 2.0 / n;
                        seen += middle < 0.25    ? weight
                                : middle == 0.25 ? weight / 2
                                                 : 0;
                    }
        const double share = detail::visible_fraction(World(stage), all, 0, 1, 10000,
                                                      ljus_test::test_seed(1));
        CAPTURE(h);
        CHECK(share == doctest::Approx(seen / whole).epsilon(0.02));
    }
}

TEST_CASE("form_factors: what lies behind a patch has no part in what is visible") {
    // A wall of side 1 stands on a floor at x = 1.5 and faces the larger part of it.
    // From the rest a screen hides the wall's back, which nothing sees anyway.
    Stage<double> stage;
    const auto white = stage.add(LambertianT<double>{});
    stage.add(QuadT<double>{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}, white);
    stage.add(QuadT<double>{{1.5, 0, 0}, {0, 0, 1}, {0, 1, 0}}, white);
    stage.add(QuadT<double>{{1.51, -9, -9}, {0, 18, 0}, {0, 0, 18}},
              stage.add(MirrorT<double>{}));
    const Patches all = make_patches(World(stage), {.size = 9});
    const World indexed(stage);
    int faced = 0;
    for (std::uint32_t i = 0; i < all.patches.size(); ++i)
        for (std::uint32_t j = 0; j < all.patches.size(); ++j) {
            const auto side = [&](std::uint32_t patch) {
                return detail::sample_patch(indexed, all, patch, Vec2T<double>{0.5})
                    .normal;
            };
            if (side(i).z < 0.5 || side(j).x > -0.5) continue;
            ++faced;
            CHECK(detail::visible_fraction(indexed, all, i, j, 1000, 1) == 1);
            CHECK(detail::visible_fraction(indexed, all, j, i, 1000, 1) == 1);
        }
    CHECK(faced == 1);
}

TEST_CASE("patches: how many cells an edge of any length is cut into") {
    const auto quad = [](double u, double v, double size) {
        return patch_grid(QuadT<double>{{0, 0, 0}, {u, 0, 0}, {0, v, 0}}, size);
    };
    CHECK(quad(1, 0.5, 0.3).columns == 4);
    CHECK(quad(1, 0.5, 0.3).rows == 2);
    // Lengths that are multiples of the size, up to rounding, get no extra cell.
    for (int n = 1; n <= 60; ++n) {
        CHECK(quad(n * 0.1, 1, 0.1).columns == std::uint32_t(n));
        CHECK(quad(n * 0.7, 1, 0.7).columns == std::uint32_t(n));
    }
    // A triangle by the longest of its edges, whichever that is.
    const Vec3T<double> a{0, 0, 0}, b{1, 0, 0}, c{0.3, 2, 0};
    const auto longest = std::uint32_t(std::ceil(glm::distance(b, c) / 0.1));
    for (const auto& shape : {TriangleT<double>{a, b, c}, TriangleT<double>{c, a, b},
                              TriangleT<double>{b, c, a}}) {
        CHECK(patch_grid(shape, 0.1).columns == longest);
        CHECK(patch_grid(shape, 0.1).rows == longest);
    }
    // A ball by half of its circumference, and by all of it.
    for (const double radius : {0.5, 1.0, 3.0}) {
        const PatchGrid grid = patch_grid(SphereT<double>{.radius = radius}, 0.5);
        CHECK(grid.columns == std::ceil(std::numbers::pi * radius / 0.5));
        CHECK(grid.rows == std::ceil(2 * std::numbers::pi * radius / 0.5));
    }
    // As many patches as may be, and one more.
    const auto box = unit_box(); // 4 to a side
    CHECK(make_patches(World(box), {.size = 0.5, .most = 24}).patches.size() == 24);
    CHECK(refusal([&] {
              (void)make_patches(World(box), {.size = 0.5, .most = 23});
          }).starts_with("the number of patches is 24; it must be at most 23"));
}

TEST_CASE("patches: what stands between, and what only seems to stand before") {
    using V = Vec3T<float>;
    Stage<float> stage;
    const auto white = stage.add(LambertianT<float>{});
    stage.add(QuadT<float>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, white);
    stage.add(QuadT<float>{{0, 0, 2}, {0, 1, 0}, {1, 0, 0}}, white);
    CHECK(make_patches(World(stage), {.size = 9}).convex);
    Stage<float> with_ball = stage;
    with_ball.add(SphereT<float>{.center{0.5f, 0.5f, 1}, .radius = 0.2f}, white);
    CHECK_FALSE(make_patches(World(with_ball), {.size = 9}).convex);
    // From within a ball nothing stands in the way of anything.
    Stage<float> within;
    const auto inside = within.add(LambertianT<float>{});
    within.add(SphereT<float>{.radius = 2}, inside, V(1), true);
    CHECK(make_patches(World(within), {.size = 9}).convex);
    CHECK(make_patches(World(within), {.size = 9}).patches.size() > 0);

    // Pieces of one plane, whichever way it lies: rounding
    // puts no piece before another.
    const V u = glm::normalize(V{1, 2, 3}),
            v = glm::normalize(glm::cross(u, V{5, 1, 2}));
    Stage<float> plane;
    const auto grey_one = plane.add(LambertianT<float>{});
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 5; ++j)
            plane.add(
                QuadT<float>{V{7.1f, -3.3f, 9.7f} + float(i) * u + float(j) * v, u, v},
                grey_one);
    CHECK(refusal([&] {
              (void)make_patches(World(plane), {.size = 9});
          }).starts_with("the number of patches is 0"));
}

TEST_CASE("form_factors: rows of different areas, and a patch that sees no other") {
    FormFactors factors{.area = {1, 4, 0.5},
                        .exchange = {0, 0.5, 0.25, 0.5, 0, 0.125, 0.25, 0.125, 0}};
    const double sums[] = {0.75, 0.625 / 4, 0.375 / 0.5};
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(factors.row_sum(i) == doctest::Approx(sums[i]).epsilon(1e-15));
    CHECK(factors(1, 0) == 0.125);
    CHECK(factors(0, 1) == 0.5);
    FormFactors alone{.area = {1, 1, 1}, .exchange = {0, 1, 0, 1, 0, 0, 0, 0, 0}};
    CHECK_FALSE(detail::close_rows(alone));
    FormFactors pair{.area = {1, 1}, .exchange = {0, 0.4, 0.4, 0}};
    CHECK(detail::close_rows(pair));
    CHECK(pair(0, 1) == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("form_factors: rays from both patches, the smaller one's count for more") {
    // Of N rays a share F arrives: A F has the variance A^2 F / N where F is small, so
    // in proportion to A. The weights are one over it: the other patch's area.
    using V = Vec3T<double>;
    Stage<double> stage;
    const auto white = stage.add(LambertianT<double>{});
    stage.add(QuadT<double>{V(0), {1, 0, 0}, {0, 1, 0}}, white);
    stage.add(QuadT<double>{{-1, -1, 1}, {0, 4, 0}, {3, 0, 0}}, white);
    const Patches all = make_patches(World(stage), {.size = 9});
    REQUIRE(all.patches.size() == 2);
    const World indexed(stage);
    for (const std::uint64_t seed : {1u, 2u}) {
        std::array<double, 2> row{}, back{};
        shoot_rays(indexed, all, 0, 50, seed, row);
        shoot_rays(indexed, all, 1, 50, seed, back);
        REQUIRE(row[1] != back[0]);
        const auto factors = make_form_factors(
            World(stage), all, {.analytic = false, .rays = 50, .seed = seed});
        const double wanted = (12 * row[1] + 1 * back[0]) / 13;
        CHECK(factors->row(0)[1] == doctest::Approx(wanted).epsilon(1e-14));
        CHECK(factors->row(1)[0] == factors->row(0)[1]);
    }
}

TEST_CASE("form_factors: each patch, each pair and each seed has numbers of its own") {
    using V = Vec3T<double>;
    // Two squares, and above them a roof whose columns run the other way: the patches 0
    // and 3 lie to each other as 1 and 2 do. Half way stands a ball for each pair.
    Stage<double> stage;
    const auto white = stage.add(LambertianT<double>{});
    stage.add(QuadT<double>{V(0), {2, 0, 0}, {0, 1, 0}}, white);
    stage.add(QuadT<double>{{2, 0, 1}, {-2, 0, 0}, {0, 1, 0}}, white);
    for (const double x : {0.4, 1.4})
        stage.add(SphereT<double>{.center{x, 0.5, 0.5}, .radius = 0.25},
                  stage.add(MirrorT<double>{}));
    const Patches all = make_patches(World(stage), {.size = 1});
    const World indexed(stage);
    REQUIRE(all.patches.size() == 4);
    const auto share = [&](std::uint32_t i, std::uint32_t k, std::uint64_t seed) {
        return detail::visible_fraction(indexed, all, i, k, 500, seed);
    };
    CHECK(share(0, 3, 1) == doctest::Approx(share(1, 2, 1)).epsilon(0.1));
    CHECK(std::abs(share(0, 3, 1) - share(1, 2, 1)) > 1e-9);
    CHECK(share(0, 3, 1) != share(0, 3, 2));
    // Sides that face away from each other exchange nothing, although the product is
    // positive.
    Stage<double> away;
    const auto matt = away.add(LambertianT<double>{});
    away.add(QuadT<double>{V(0), {0, 1, 0}, {1, 0, 0}}, matt);           // downwards
    away.add(QuadT<double>{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}, matt);      // upwards
    away.add(QuadT<double>{{-9, -9, 5}, {0, 20, 0}, {20, 0, 0}}, matt);  // above both
    away.add(QuadT<double>{{-9, -9, -5}, {20, 0, 0}, {0, 20, 0}}, matt); // below both
    const Patches outer = make_patches(World(away), {.size = 30});
    const World around(away);
    int asked = 0;
    for (std::uint32_t i = 0; i < outer.patches.size(); ++i)
        for (std::uint32_t k = 0; k < outer.patches.size(); ++k) {
            const auto side = [&](std::uint32_t n) {
                return detail::sample_patch(around, outer, n, Vec2T<double>{0.5});
            };
            if (side(i).position.z != 0 || side(i).normal.z > 0) continue;
            if (side(k).position.z != 1 || side(k).normal.z < 0) continue;
            ++asked;
            CHECK(detail::visible_fraction(around, outer, i, k, 50, 1) == 0);
        }
    CHECK(asked == 1);

    // By settings, too: rays and shadow rays by the seed that is asked for.
    const auto factors = [&](const FormFactorSettings& settings) {
        return make_form_factors(World(stage), all, settings)->exchange;
    };
    for (const bool analytic : {false, true}) {
        const FormFactorSettings one{.analytic = analytic, .rays = 30, .seed = 1};
        const FormFactorSettings two{.analytic = analytic, .rays = 30, .seed = 2};
        CHECK(factors(one) == factors(one));
        CHECK(factors(one) != factors(two));
    }
    // One ray from each of many patches: not all of them go the same way.
    Stage<double> wide;
    const auto one = wide.add(LambertianT<double>{});
    wide.add(QuadT<double>{V(0), {8, 0, 0}, {0, 8, 0}}, one);
    wide.add(QuadT<double>{{-40, -40, 30}, {0, 88, 0}, {88, 0, 0}}, one);
    const Patches many = make_patches(World(wide), {.size = 1.0});
    const World open(wide);
    double arrived = 0;
    std::vector<double> row(many.patches.size());
    for (std::uint32_t i = 0; i < 64; ++i) shoot_rays(open, many, i, 1, 1, row);
    for (const double share_of : row) arrived += share_of;
    CHECK(arrived > 10);
    CHECK(arrived < 60);
}

TEST_CASE("patches: how scenes are cut and form factors found if nothing is said") {
    const PatchSettings cut;
    CHECK(cut.size == 0.25);
    CHECK(cut.most == 8192);
    const FormFactorSettings factors;
    CHECK(factors.analytic);
    CHECK(factors.rays == 256);
    CHECK(factors.shadow_rays == 16);
    CHECK_FALSE(factors.closed);
    CHECK(factors.seed == 1);
    CHECK(factors.threads == 0);
    const auto box = unit_box();
    CHECK(refusal([&] { (void)make_patches(World(box), {.most = 65537}); }) ==
          "most is 65537; it must be at most 65536: their form factors take 34 GB.");
    CHECK_NOTHROW((void)make_patches(World(box), {.size = 1, .most = 65536}));
}
