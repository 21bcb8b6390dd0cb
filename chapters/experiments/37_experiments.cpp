// smoke: --quality draft --width 12 --height 12 --rays 1
/// \file chapters/experiments/37_experiments.cpp
/// \brief Chapter 37: the experiments behind its pictures, tables and plots, in float and
/// in double.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/inspect/survey.hpp>
#include <ljus/ljus.hpp>

#include "common/drawing.hpp"
#include "common/example.hpp"
#include "common/fingerprint.hpp"
#include "experiments/extreme_room.hpp"
#include "experiments/numbers.hpp"

using namespace ljus;
using examples::Extreme;
using examples::ExtremeSettings;
using examples::render_extreme;
using examples::text;

namespace {

/// What all parts of the program share.
struct Run {
    const examples::Options& options; ///< Where to, how large.
    ExtremeSettings picture{};        ///< Of each picture.
    ImageT<double> plain{};           ///< The room as it is, in double.
    double noise = 0;                 ///< Error of another seed.
};

/// How far two pictures of the same rays are apart: relMSE without the worst pixels,
/// which are single bright paths.
template <typename T>
double error_of(const ImageT<T>& image, const ImageT<double>& truth) {
    return trimmed_rel_mse(image, truth, 0.05);
}

// --- Pictures side by side ------------------------------------------------------------

/// Pictures of one size in rows, with thin gaps.
class Sheet {
public:
    /// \param columns  How many in a row.
    explicit Sheet(int columns) : columns_(columns) {}
    /// Adds the next one.
    void add(const Image& image) { pictures_.push_back(image); }
    /// All of them.
    void save(const std::string& path) const {
        constexpr int gap = 4;
        const int width = pictures_.front().width, height = pictures_.front().height;
        const int rows = (static_cast<int>(pictures_.size()) + columns_ - 1) / columns_;
        Image sheet = make_image(columns_ * (width + gap) - gap,
                                 rows * (height + gap) - gap, Rgb{1});
        for (std::size_t i = 0; i < pictures_.size(); ++i) {
            const int left = static_cast<int>(i) % columns_ * (width + gap);
            const int top = static_cast<int>(i) / columns_ * (height + gap);
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    pixel(sheet, left + x, top + y) = pixel(pictures_[i], x, y);
        }
        save_png(sheet, path, {.exposure = 0.5});
    }

private:
    int columns_;
    std::vector<Image> pictures_{};
};

/// Finite, and no sample left out.
template <typename T>
bool whole(const RenderedT<T>& rendered) {
    return rendered.counts.rejected == 0 &&
           std::all_of(rendered.image.pixels.begin(), rendered.image.pixels.end(),
                       [](const auto& color) { return is_finite(color); });
}

/// The picture of a room in float.
Image pictured(const Extreme& how, const ExtremeSettings& settings) {
    const auto rendered = render_extreme<float>(how, settings).rendered;
    if (!whole(rendered)) throw std::runtime_error("a sample is not finite");
    return rendered.image;
}

/// Rooms of other sizes.
void sizes(const Run& run) {
    Sheet sheet(5);
    for (const double scale : {1e-6, 1e-3, 1.0, 1e3, 1e6})
        sheet.add(pictured({.scale = scale}, run.picture));
    sheet.save(run.options.path("extremes-scales.png"));
}

/// Lamps, albedos, roughness, glass.
void other_rooms(const Run& run) {
    Sheet lamps(5), surfaces(5), glasses(5);
    for (const double radius : {0.0, 1e-6, 0.01, 0.9, Extreme::ceiling})
        lamps.add(pictured({.lamp = radius}, run.picture));
    for (const Extreme& how :
         {Extreme{.albedo = 0}, Extreme{.albedo = 1}, Extreme{.matt = 1},
          Extreme{.gloss = 0.01}, Extreme{.gloss = 1}})
        surfaces.add(pictured(how, run.picture));
    for (const double index : {1.0, 1.0 + 1e-6, 1.5, 10.0, 1000.0})
        glasses.add(pictured({.index = index}, run.picture));
    lamps.save(run.options.path("extremes-lamps.png"));
    surfaces.save(run.options.path("extremes-surfaces.png"));
    glasses.save(run.options.path("extremes-glasses.png"));
}

/// From no photon to ten million.
void numbers_of_photons(const Run& run) {
    const auto with = [&run](long long count, std::size_t nearest) {
        ExtremeSettings now = run.picture;
        now.photons = count;
        now.nearest = nearest;
        if (nearest > 0) now.radius = 1;
        return now;
    };
    Sheet sheet(5);
    sheet.add(pictured({}, with(0, 0)));
    sheet.add(pictured({}, with(1, 0)));
    const std::size_t kept = render_extreme<float>({}, with(200, 0)).photons;
    sheet.add(pictured({}, with(200, kept + 1)));
    sheet.add(pictured({}, with(run.picture.photons, 50)));
    ExtremeSettings many =
        with(run.options.pick(100'000LL, 10'000'000LL, 10'000'000LL), 0);
    many.radius = 0.05;
    sheet.add(pictured({}, many));
    sheet.save(run.options.path("extremes-photons.png"));
}

/// Powers of two: no digit is lost, and the bytes must be the same.
void powers(const Run& run) {
    examples::Table table{.name = "extremes-powers",
                          .columns = {"times the size", "float", "double"}};
    for (const int power : {0, -20, -10, 10, 20}) {
        const auto hash = [&]<typename T>(T) {
            return examples::hex_text(examples::hash_of(
                render_extreme<T>({.scale = std::exp2(power)}, run.picture)
                    .rendered.image.pixels));
        };
        table.rows.push_back({"2^" + std::to_string(power), hash(0.0f), hash(0.0)});
    }
    save_table(run.options.out, table);
}

// --- Plots ----------------------------------------------------------------------------

/// The error over the distance from the origin, and over the size.
void plots(const Run& run) {
    const int step = run.options.pick(3, 1, 1);
    examples::Plot far{.name = "extremes-far",
                       .columns = {"distance from the origin, scene units", "float",
                                   "double", "another seed"},
                       .y_label = "error against the room at the origin",
                       .log_x = true,
                       .log_y = true};
    for (int i = 0; i <= 32; i += step) {
        const double x = std::pow(10.0, i / 2.0);
        // Beyond what a scene can be made of, in float, there is no point of the curve.
        const auto error = [&]<typename T>(T) {
            return error_of(render_extreme<T>({.moved = Vec3T<double>(x)}, run.picture)
                                .rendered.image,
                            run.plain);
        };
        far.rows.push_back(
            {x, i <= 18 ? error(0.0f) : std::nan(""), error(0.0), run.noise});
    }
    save_plot(run.options.out, far);
    examples::Plot scale{.name = "extremes-scale",
                         .columns = {"size of the room, over its own", "float",
                                     "double", "another seed"},
                         .y_label = "error against the room as it is",
                         .log_x = true,
                         .log_y = true};
    for (int i = -12; i <= 12; i += step) {
        const auto error = [&]<typename T>(T) {
            const double off =
                error_of(render_extreme<T>({.scale = std::pow(10.0, i)}, run.picture)
                             .rendered.image,
                         run.plain);
            return off > 0 ? off : std::nan(""); // the room itself
        };
        scale.rows.push_back({std::pow(10.0, i), error(0.0f), error(0.0), run.noise});
    }
    save_plot(run.options.out, scale);
}

// --- Slivers --------------------------------------------------------------------------

/// Two triangles seen along their long edges: their corners are known up to a dot, and
/// their planes up to the fans.
void tilt_drawing(const Run& run) {
    examples::Drawing drawing{
        .name = "extremes-tilt",
        .description = "Two triangles seen along their long edge. The corners of both "
                       "are known up to the same dot; the plane of the thin one turns "
                       "by much more.",
        .low = {-0.4, -0.95},
        .high = {6.4, 0.95}};
    constexpr double dot = 0.06;
    const auto triangle = [&](double left, double width, const char* name) {
        const double reach = 2.6, turn = 2 * dot / width;
        for (const double sign : {1.0, -1.0}) {
            const auto y = [&](double x) { return sign * turn * (x - width / 2); };
            examples::draw_line(drawing,
                                {{left - 0.25, y(-0.25)}, {left + reach, y(reach)}},
                                {.color = examples::colors::orange, .dashed = true});
        }
        examples::draw_line(drawing, {{left, 0}, {left + width, 0}},
                            {.color = examples::colors::blue, .width = 4});
        for (const double x : {left, left + width})
            examples::draw_dot(drawing, {x, 0}, dot * drawing.scale, "currentColor");
        examples::draw_label(drawing, {left + 1.0, -0.8}, name);
    };
    triangle(0, 2.0, "wide");
    triangle(3.5, 0.5, "thin");
    save_drawing(run.options.out, drawing);
}

/// Rays that leave thin triangles and meet them again: with their points' error alone,
/// and with the tilt of their plane.
void slivers(const Run& run) {
    examples::Table table{.name = "extremes-slivers",
                          .columns = {"height over base", "float",
                                      "double, points alone", "double, with the tilt",
                                      "its start, over the base"}};
    const int cases = run.options.pick(1000, 100'000, 1'000'000);
    for (const double thin : {1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
        examples::Numbers n;
        long again[3] = {};
        double farthest = 0;
        for (int i = 0; i < cases; ++i) {
            const auto a = n.direction(), way = n.direction();
            const auto b = glm::normalize(glm::cross(a, n.direction()));
            const auto third = n.between(0, 1) * a + thin * b;
            const Vec2T<double> u{n.next(), n.next()};
            const TriangleT<double> sliver{Vec3T<double>(0.0), a, third};
            const Triangle single{Vec3{0}, Vec3(a), Vec3(third)};
            if (!ljus::has_area(sliver)) continue;
            auto point = sample_area(sliver, u);
            const auto ray = spawn_ray(point, way);
            again[2] += intersect(ray, sliver).has_value();
            farthest = std::max(farthest, glm::distance(ray.origin, point.position));
            // As it was: the rounding of the corners and no more.
            constexpr double unit = std::numeric_limits<double>::epsilon() / 2;
            point.error = 7 * unit / (1 - 7 * unit) * (glm::abs(a) + glm::abs(third));
            again[1] += intersect(spawn_ray(point, way), sliver).has_value();
            if (!ljus::has_area(single)) continue;
            again[0] +=
                intersect(spawn_ray(sample_area(single, Vec2(u)), Vec3(way)), single)
                    .has_value();
        }
        const auto share = [&](long count) {
            return count == 0 ? std::string("0")
                              : text(100.0 * double(count) / cases, "%.2g %%");
        };
        table.rows.push_back({text(thin, "%.0e"), share(again[0]), share(again[1]),
                              share(again[2]), text(farthest, "%.0e")});
    }
    save_table(run.options.out, table);

    tilt_drawing(run);
}

/// What double costs: processor time of both passes, alternating, and memory.
void trade(const Run& run) {
    std::vector<double> seconds[2];
    std::size_t photons[2] = {};
    const int rounds = run.options.pick(1, 7, 7);
    const auto once = [&]<typename T>(T, int which) {
        const double before = examples::processor_seconds();
        const auto picture = render_extreme<T>({}, run.picture);
        seconds[which].push_back(examples::processor_seconds() - before);
        photons[which] =
            picture.photon_bytes / std::max<std::size_t>(1, picture.photons);
    };
    for (int i = 0; i < rounds; ++i) {
        once(0.0f, 0);
        once(0.0, 1);
    }
    const auto median = [](std::vector<double> values) {
        std::nth_element(values.begin(),
                         values.begin() + std::ptrdiff_t(values.size() / 2),
                         values.end());
        return values[values.size() / 2];
    };
    examples::Table table{.name = "extremes-trade",
                          .columns = {"precision", "s", "over float",
                                      "bytes per photon", "bytes per pixel",
                                      "bytes per ball"}};
    for (int i = 0; i < 2; ++i)
        table.rows.push_back(
            {i == 0 ? "float" : "double", text(median(seconds[i]), "%.3g"),
             text(median(seconds[i]) / median(seconds[0]), "%.2f"),
             std::to_string(photons[i]), std::to_string(12 * (i + 1)),
             std::to_string(i == 0 ? sizeof(Sphere) : sizeof(SphereT<double>))});
    save_table(run.options.out, table);
}

void body(examples::CommandLine& line) {
    line.about("Chapter 37: whole pictures at the extremes.");
    const examples::Options options =
        line.parse({.draft{.width = 48, .height = 48, .samples = 2},
                    .report{.width = 100, .height = 100, .samples = 8},
                    .reference{.width = 160, .height = 160, .samples = 64}});
    Run run{.options = options};
    run.picture = {.width = options.width,
                   .height = options.height,
                   .samples = options.samples,
                   .photons = options.pick(2000LL, 50'000LL, 200'000LL),
                   .seed = options.seed,
                   .threads = options.threads};
    run.plain = render_extreme<double>({}, run.picture).rendered.image;
    ExtremeSettings other = run.picture;
    other.seed = options.seed + 1;
    run.noise = error_of(render_extreme<double>({}, other).rendered.image, run.plain);
    const auto step = [&](const char* name, void (*make)(const Run&)) {
        examples::stop_if_asked();
        if (!options.quiet) std::printf("  %s\n", name);
        make(run);
    };
    step("sizes", sizes);
    step("lamps, surfaces, glass", other_rooms);
    step("photons", numbers_of_photons);
    step("powers of two", powers);
    step("plots", plots);
    step("slivers", slivers);
    step("the trade", trade);
}

} // namespace

/// Makes the chapter's figures.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, body);
}
