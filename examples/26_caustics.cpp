// figures: fig-8 fig-11 table-2
// smoke: --quality draft --width 24 --height 24 --rays 1 --photons 300
/// \file 26_caustics.cpp
/// \brief Figures 8 and 11 and table 2: caustics with different numbers of photons.

#include <algorithm>
#include <string>
#include <vector>

#include <ljus/inspect/photon_dots.hpp>
#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/example.hpp"

using namespace ljus;
using examples::text;

namespace {

using GlassRoom = decltype(four_glass_room());

/// Draws the caustic photons as dots.
void figure_8(const GlassRoom& room, const examples::Options& options) {
    const auto traced = trace_photons(room.world, MapType::caustics,
                                      {.photons = 20000, .seed = options.seed});
    const int size = std::max(300, options.width);
    Image image = scene_drawing(room.world, room.camera, size, size);
    const auto color = [](const Photon& photon) { return dot_color(photon); };
    (void)add_photon_dots(image, room.world, room.camera, traced.photons,
                          {.radius = 1.2f, .brightness = 0.7f}, color);
    save_png(image, options.path("fig-8.png"));
}

/// Puts pictures of one size side by side.
Image in_a_row(const std::vector<Image>& pictures) {
    const int width = pictures[0].width, height = pictures[0].height;
    const int gap = std::max(1, width / 50), count = int(pictures.size());
    Image all = make_image(count * (width + gap) - gap, height, Rgb{1});
    for (int i = 0; i < count; ++i)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                pixel(all, i * (width + gap) + x, y) =
                    pixel(pictures[std::size_t(i)], x, y);
    return all;
}

/// Renders pictures by the report's settings, with more and more caustic photons, and
/// measures their cost in processor seconds.
void figure_11(const GlassRoom& room, long long most,
               const examples::Options& options) {
    struct Column {
        long long photons;
        const char* report; ///< The report's time.
    };
    examples::Table table{.name = "table-2",
                          .columns = {"photons", "the report's time", "photons, s",
                                      "picture, s", "stored", "found per query"}};
    std::vector<Image> pictures;
    for (const auto& [photons, report] :
         {Column{0, "26 s"}, Column{1000, "37 s"}, Column{10000, "44 s"},
          Column{100000, "53 s"}, Column{1000000, ""}}) {
        const PhotonMappingSettings settings{
            .max_depth = 4,
            .roulette_depth = 5,
            .caustics{.photons = std::min(photons, most),
                      .seed = options.seed,
                      .threads = options.threads},
            .caustics_estimate{.radius = 0.05f}};
        const double start = examples::processor_seconds();
        const PhotonMapper mapper(room.world, settings);
        const double traced = examples::processor_seconds();
        const auto picture = examples::rendered(std::to_string(photons) + " photons",
                                                mapper, room.camera, options);
        const double done = examples::processor_seconds();
        pictures.push_back(picture.image);

        const double queries = double(picture.counts.map_queries);
        const double found = double(picture.counts.map_photons);
        table.rows.push_back({std::to_string(photons), report,
                              text(traced - start, "%.2f"), text(done - traced, "%.2f"),
                              std::to_string(mapper.maps().caustics.records.size()),
                              text(queries > 0 ? found / queries : 0, "%.1f")});
    }
    if (options.wants("fig-11"))
        save_png(in_a_row(pictures), options.path("fig-11.png"));
    if (!options.wants("table-2")) return;
    save_table(options.out, table);
    if (options.quiet) return;
    examples::print_row(table.columns, 18);
    examples::print_rows(table, 18);
}

} // namespace

/// Makes fig-8.png, fig-11.png and table-2.csv.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long photons = 1000000;
        line.about("Chapter 26, caustics: figures 8 and 11, table 2.");
        line.makes({"fig-8", "fig-11", "table-2"});
        line.add("--photons", photons, "The largest number of photons", 1, 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 160, .height = 160, .samples = 6},
                        .report{.width = 400, .height = 400, .samples = 64},
                        .reference{.width = 400, .height = 400, .samples = 1024}});
        const GlassRoom room = four_glass_room();
        if (options.wants("fig-8")) figure_8(room, options);
        if (options.wants("fig-11") || options.wants("table-2"))
            figure_11(room, photons, options);
    });
}
