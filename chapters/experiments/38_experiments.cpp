// smoke: --width 16 --rays 1
// headers: broken
/// \file chapters/experiments/38_experiments.cpp
/// \brief Chapter 38: the gallery, what each mistake looks like. The program is
/// compiled against headers in which the rows of tests/break_it can be switched on, one
/// at a time: the right picture, the wrong one, and their difference with its sign.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#if __has_include("ljus_break_it.hpp")
#include "ljus_break_it.hpp" // made by cmake/break_it_gallery.py
#define LJUS_HAS_MISTAKES
#endif

#include "common/command_line.hpp"
#include "common/drawing.hpp"
#include "common/error_map.hpp"
#include "common/plot.hpp"
#include "common/terminal.hpp"
#include "experiments/break_it_scenes.hpp"

namespace {

/// A mistake and the scene that shows it.
struct Mistake {
    const char* row;              ///< Of tests/break_it.
    Image (*picture)(const Eye&); ///< Right or wrong, as the headers are switched.
};

constexpr std::array mistakes{
    // Rays and surfaces
    Mistake{.row = "sphere-direction-length", .picture = egg},
    Mistake{.row = "triangle-epsilon", .picture = small_mesh},
    Mistake{.row = "triangle-u-plus-v", .picture = triangles},
    Mistake{.row = "surface-shadow-stay", .picture = point_light},
    Mistake{.row = "shading_normals-side", .picture = cards},
    Mistake{.row = "bvh-later", .picture = many_balls},
    Mistake{.row = "metaballs-overstep", .picture = blobs},
    Mistake{.row = "reflection-half", .picture = mirror_ball},
    // Glass
    Mistake{.row = "glass-half-vector", .picture = glass_ball},
    Mistake{.row = "schlick-thin-side", .picture = pool_by_schlick},
    Mistake{.row = "refraction-total-ignored", .picture = pool_without_fresnel},
    Mistake{.row = "glass-index-swapped", .picture = glass_ball},
    Mistake{.row = "glass-squared-index", .picture = lamp_in_glass},
    Mistake{.row = "whitted-branch", .picture = glass_ball},
    // Light
    Mistake{.row = "lambertian-missing-pi", .picture = box_by_paths},
    Mistake{.row = "lambertian-doubled-cosine", .picture = box_by_paths},
    Mistake{.row = "hemisphere_sampling-belt", .picture = open_sky},
    Mistake{.row = "oren_nayar-azimuth", .picture = rough_ball},
    Mistake{.row = "direct-light-pdf", .picture = one_lamp},
    Mistake{.row = "direct-light-distance", .picture = point_light},
    Mistake{.row = "solid-angle-area", .picture = two_sizes},
    Mistake{.row = "path-tracing-light-choice", .picture = two_lamps},
    Mistake{.row = "direct-light-inverted", .picture = lamp_and_point},
    Mistake{.row = "direct-light-shadow", .picture = one_lamp},
    Mistake{.row = "distributed-rays-hard-shadow", .picture = penumbra},
    Mistake{.row = "path-tracing-plain-twice", .picture = box_by_plain_paths},
    Mistake{.row = "depth-roulette", .picture = box_with_roulette},
    Mistake{.row = "stratified-remainder", .picture = lamp_places},
    Mistake{.row = "rays-alike", .picture = box_with_few_rays},
    Mistake{.row = "render-shared-stream", .picture = box_direct},
    Mistake{.row = "png-maximum", .picture = as_saved},
    // Photons
    Mistake{.row = "emission-cosine", .picture = direct_photons},
    Mistake{.row = "tracing-stored", .picture = point_by_photons},
    Mistake{.row = "aim-weight", .picture = caustic_of_one},
    Mistake{.row = "caustics-overlap", .picture = caustic_of_two},
    Mistake{.row = "tracing-owner", .picture = caustic_and_general},
    Mistake{.row = "photon-mapping-emission", .picture = box_by_two_passes},
    Mistake{.row = "photon-mapping-direct-twice", .picture = box_with_map_seen},
    Mistake{.row = "roulette-uncompensated", .picture = box_by_photons},
    Mistake{.row = "general-map-mirror", .picture = dots},
    Mistake{.row = "general-map-other-side", .picture = screen},
    Mistake{.row = "kd-tree-cube", .picture = spread_photons},
    Mistake{.row = "photon-mapping-kernel", .picture = direct_photons},
    Mistake{.row = "photon-map-k", .picture = few_photons},
    Mistake{.row = "shadow-photons-lights", .picture = two_lamps_skipped},
    Mistake{.row = "final-gathering-edge", .picture = box_with_points},
    Mistake{.row = "irradiance-cache-normal", .picture = box_with_cache},
    Mistake{.row = "caustic_budget-flux", .picture = shared_budget},
    Mistake{.row = "progressive-radius", .picture = sixteen_passes},
    Mistake{.row = "form-factors-visible", .picture = box_by_radiosity},
};

#ifdef LJUS_HAS_MISTAKES

/// The right picture, the wrong one, and the map of their difference, side by side.
Image side_by_side(const Image& right, const Image& wrong, double range) {
    ImageT<double> difference = make_image<double>(right.width, right.height);
    for (std::size_t i = 0; i < right.pixels.size(); ++i)
        difference.pixels[i] = RgbT<double>{
            double(luminance(wrong.pixels[i]) - luminance(right.pixels[i]))};
    const Image map =
        examples::error_picture(difference, examples::Ramp::signs, -range, range);
    const int gap = 6, width = right.width;
    Image all = make_image(2 * (width + gap) + map.width, map.height, Rgb{1});
    const auto put = [&](const Image& part, int left) {
        for (int y = 0; y < part.height; ++y)
            for (int x = 0; x < part.width; ++x)
                pixel(all, left + x, y) = pixel(part, x, y);
    };
    put(right, 0);
    put(wrong, width + gap);
    put(map, 2 * (width + gap));
    return all;
}

/// The range of the map's colours: a round number that few differences
/// exceed, as a fraction of white.
double range_of(const Image& right, const Image& wrong) {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < right.pixels.size(); ++i) {
        const double d =
            std::abs(double(luminance(wrong.pixels[i]) - luminance(right.pixels[i])));
        if (d > 1e-4) sizes.push_back(d);
    }
    if (sizes.empty()) return 1;
    std::sort(sizes.begin(), sizes.end());
    const double most = sizes[sizes.size() * 97 / 100];
    for (const double range : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0})
        if (most <= range) return range;
    return 10;
}

/// A page's address, as Doxygen names that of a source file.
std::string source_page(const std::string& file) {
    std::string name;
    for (const char c : file) name += c == '_' ? std::string("__") : std::string(1, c);
    return name + "_8cpp_source.html";
}

/// The line as it was and as it is broken, the test that notices, and what it does to
/// the picture.
std::string told(const ljus_break_it::Told& row, const std::string& brightness,
                 const std::string& largest) {
    char line[32];
    std::snprintf(line, sizeof line, "#l%05d", row.line);
    const std::string to = row.to;
    return "<div class=\"ljus-mistake\"><pre class=\"fragment\">ljus/" +
           examples::escaped(row.header) + "\n<del>- " + examples::escaped(row.from) +
           "</del>\n<ins>+ " +
           (to.empty() ? std::string("(nothing)") : examples::escaped(to)) +
           "</ins></pre>\n<p>Row <code>" + row.name + "</code>; noticed by <a href=\"" +
           source_page(std::string(row.test) + "_test") + line + "\">" +
           examples::escaped(row.noticed) + "</a>. Mean brightness " + brightness +
           " of the right one; largest difference " + largest + ".</p></div>\n";
}

/// The mean of the luminance, without what is no number.
double mean(const Image& image) {
    double sum = 0;
    for (const Rgb& color : image.pixels)
        if (is_finite(color)) sum += double(luminance(color));
    return sum / double(image.pixels.size());
}

/// Plot: of all mistakes, how many a look at the mean brightness would find.
void save_brightness(const examples::Options& options,
                     const std::vector<double>& ratios) {
    examples::Plot plot{.name = "break_it-brightness",
                        .columns = {"tolerance of the mean brightness (%)",
                                    "mistakes that are found (%)"},
                        .y_label = "mistakes that are found (%)",
                        .log_x = true,
                        .more = "set yrange [0:100]\nset key off\n"};
    examples::Table table{.name = "break_it-found",
                          .columns = {"tolerance", "found", "of", "share"}};
    for (int i = 0; i <= 40; ++i) {
        const double percent = 0.1 * std::pow(10.0, i / 10.0 * 0.75);
        double found = 0;
        for (const double ratio : ratios)
            found += std::abs(ratio - 1) > percent / 100 ? 1 : 0;
        plot.rows.push_back({percent, 100 * found / double(ratios.size())});
    }
    for (const int percent : {1, 5, 20}) {
        int found = 0;
        for (const double ratio : ratios)
            found += std::abs(ratio - 1) > percent / 100.0 ? 1 : 0;
        table.rows.push_back(
            {std::to_string(percent) + " %", std::to_string(found),
             std::to_string(ratios.size()),
             examples::text(100.0 * found / double(ratios.size()), "%.0f %%")});
    }
    save_plot(options.out, plot);
    save_table(options.out, table);
}

/// Drawing: one function, twice in one program.
void draw_switch(const examples::Options& options) {
    using examples::draw_arrow, examples::draw_label, examples::draw_line;
    examples::Drawing drawing{
        .name = "break_it-switch",
        .description =
            "A row of tests/break_it replaces a text in the body of a function. "
            "The body stands in the header twice, and a switch chooses.",
        .low{0, 0},
        .high{7, 3.1}};
    const auto box = [&](double left, double low, double right, double high,
                         const examples::Pen& pen) {
        draw_line(drawing,
                  {{left, low}, {right, low}, {right, high}, {left, high}, {left, low}},
                  pen);
    };
    box(0.1, 1.1, 1.6, 2.0, {});
    draw_label(drawing, {0.85, 1.7}, "a header");
    draw_label(drawing, {0.85, 1.35}, "of the library");
    draw_arrow(drawing, {1.65, 1.55}, {2.35, 1.55});
    box(2.4, 0.2, 4.9, 2.95, {});
    draw_label(drawing, {3.65, 2.72}, "the same, switched");
    box(2.55, 1.6, 4.75, 2.5, {.color = examples::colors::blue});
    draw_label(drawing, {3.65, 2.2}, "if no row is on:", examples::colors::blue);
    draw_label(drawing, {3.65, 1.87}, "the body as it was", examples::colors::blue);
    box(2.55, 0.4, 4.75, 1.3, {.color = examples::colors::orange});
    draw_label(drawing, {3.65, 1.0}, "if row 7 is on:", examples::colors::orange);
    draw_label(drawing, {3.65, 0.67}, "FROM replaced by TO", examples::colors::orange);
    draw_arrow(drawing, {4.95, 2.05}, {5.55, 2.05}, {.color = examples::colors::blue});
    draw_arrow(drawing, {4.95, 0.85}, {5.55, 0.85},
               {.color = examples::colors::orange});
    draw_label(drawing, {6.25, 2.2}, "right picture", examples::colors::blue);
    draw_label(drawing, {6.25, 1.87}, "test passes", examples::colors::blue);
    draw_label(drawing, {6.25, 1.0}, "wrong picture", examples::colors::orange);
    draw_label(drawing, {6.25, 0.67}, "test must fail", examples::colors::orange);
    save_drawing(options.out, drawing);
}

/// Table: how many mutants the tests notice, as far as that has been measured.
void table_of_mutants(const examples::Options& options) {
    const std::string file = LJUS_SOURCE_FOLDER "/chapters/measured/mutation.csv";
    examples::Table table{.name = "break_it-mutation"};
    std::string notes;
    if (std::ifstream in(file); in) {
        for (std::string line; std::getline(in, line);) {
            if (line.starts_with("#")) {
                notes += line.substr(1);
                continue;
            }
            std::vector<std::string> cells(1);
            for (const char c : line)
                if (c == ',')
                    cells.emplace_back();
                else
                    cells.back() += c;
            if (table.columns.empty())
                table.columns = cells;
            else
                table.rows.push_back(cells);
        }
    } else {
        table.columns = {"floor", "made", "equivalent", "killed now", "share now"};
        notes = " Not measured yet: ./scripts/test --mutate -- --csv "
                "chapters/measured/mutation.csv does it.";
    }
    save_table(options.out, table);
    examples::save_text(options.path("break_it-mutation-notes.html"),
                        "<div class=\"ljus-caption\">" + notes + "</div>\n");
}

/// Makes the gallery, or the requested part of it.
void gallery(const examples::Options& options, const Eye& eye,
             const std::string& only) {
    std::map<Image (*)(const Eye&), Image> right; // shared by several mistakes
    examples::ProgressBar bar("mistakes", options.quiet);
    std::vector<double> ratios;
    long long done = 0;
    for (const Mistake& mistake : mistakes) {
        (void)bar(done++, static_cast<long long>(mistakes.size()));
        if (!only.empty() && only != mistake.row) continue;
        const int number = ljus_break_it::number_of(mistake.row);
        ljus_break_it::row = 0;
        if (!right.contains(mistake.picture))
            right[mistake.picture] = mistake.picture(eye);
        const Image& good = right[mistake.picture];
        ljus_break_it::row = number;
        const Image wrong = mistake.picture(eye);
        ljus_break_it::row = 0;
        const std::string name = std::string("break_it-") + mistake.row;
        save_png(side_by_side(good, wrong, range_of(good, wrong)),
                 options.path(name + ".png"));
        double largest = 0;
        for (std::size_t i = 0; i < wrong.pixels.size(); ++i) {
            const double d = double(luminance(wrong.pixels[i] - good.pixels[i]));
            if (std::abs(d) > std::abs(largest)) largest = d;
        }
        const double ratio = mean(wrong) / mean(good);
        ratios.push_back(ratio);
        const auto& row = ljus_break_it::told[static_cast<std::size_t>(number)];
        const std::string brightness = examples::text(ratio, "%.2f");
        const std::string difference = examples::text(largest, "%+.2f");
        examples::save_text(options.path(name + ".html"),
                            told(row, brightness, difference));
        if (!only.empty())
            std::printf("%s: brightness %s, largest difference %s\n", mistake.row,
                        brightness.c_str(), difference.c_str());
    }
    if (only.empty()) save_brightness(options, ratios);
}

#endif

} // namespace

/// The program's entry.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("What each mistake of tests/break_it looks like.");
        std::string only;
        line.add("--row", only, "only this mistake");
        line.without({"--height"});
        const examples::Options options =
            line.parse({.draft{.width = 160, .height = 160, .samples = 32},
                        .report{.width = 160, .height = 160, .samples = 256},
                        .reference{.width = 240, .height = 240, .samples = 1024}});
        const Eye eye{.size = options.width,
                      .samples = options.samples,
                      .seed = options.seed,
                      .threads = options.threads};
#ifdef LJUS_HAS_MISTAKES
        gallery(options, eye, only);
        if (only.empty()) {
            draw_switch(options);
            table_of_mutants(options);
        }
#else
        (void)mistakes;
        (void)eye;
        std::puts("This program shows mistakes, and was compiled against headers "
                  "without any: build it with CMake, and with Python 3.9 or later.");
#endif
    });
}
