// smoke: --quality draft --width 16 --height 16 --most 10 --repeats 1
/// \file chapters/experiments/34_experiments.cpp
/// \brief Chapter 34: the experiments behind its tables and plots: the model behind the
/// times of table 1, schedules, and the same bytes for any number of threads.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/drawing.hpp"
#include "common/oracle.hpp"
#include "common/plot.hpp"

using namespace ljus;

namespace {

using examples::text;

/// The options of this program, besides the common ones.
struct Sizes {
    int most = 0;    ///< The largest number of rays of table 1 that is tried.
    int repeats = 0; ///< Pairs of one thread and several.
};

/// The columns of a table of times.
struct Times {
    std::vector<double> rays{}; ///< Per pixel.
    std::vector<double> one{};  ///< Seconds with one thread.
    std::vector<double> many{}; ///< Seconds with several.
};

/// Those of the report's table 1.
const Times report_times{
    {1, 10, 100, 200, 1000}, {3, 17, 188, 362, 1391}, {22, 28, 106, 208, 640}};

/// Depth 4 and no roulette, as in the report.
PhotonMappingSettings report_settings(int threads) {
    PhotonMappingSettings settings{.max_depth = 4, .roulette_depth = 5};
    settings.caustics.photons = 100000;
    settings.caustics.threads = threads;
    settings.caustics_estimate.radius = 0.05f; // the report's
    return settings;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// --- A straight line through times ---------------------------------------------------

/// Times of the form fixed + each * rays.
struct Line {
    double fixed = 0; ///< Seconds, independent of the number of rays.
    double each = 0;  ///< Seconds for one ray in every pixel.
};

/// Fits a line by least squares of the *relative* residuals: otherwise the row with
/// most rays would decide alone, and hide a fixed cost of seconds in its minutes.
/// \param rays     At least two different numbers.
/// \param seconds  As many, above 0.
// [fit]
Line fit_line(const std::vector<double>& rays, const std::vector<double>& seconds) {
    double w = 0, wx = 0, wxx = 0, wy = 0, wxy = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const double weight = 1 / (seconds[i] * seconds[i]);
        w += weight;
        wx += weight * rays[i];
        wxx += weight * rays[i] * rays[i];
        wy += weight * seconds[i];
        wxy += weight * rays[i] * seconds[i];
    }
    const double each = (w * wxy - wx * wy) / (w * wxx - wx * wx);
    return {(wy - each * wx) / w, each};
}
// [fit]

// --- The times of table 1 ------------------------------------------------------------

using examples::timed;
using examples::Timing;

/// The first pass, in its two halves.
struct FirstPass {
    Timing emission{}; ///< Photons sent and traced, by all threads.
    Timing tree{};     ///< The k-d tree over them.
};

template <typename R>
FirstPass first_pass(const R& room, const PhotonMappingSettings& settings) {
    FirstPass pass;
    TracedPhotonsT<float> traced;
    pass.emission = timed([&] {
        traced = trace_photons(room.world, MapType::caustics, settings.caustics);
    });
    pass.tree = timed([&] { (void)make_photon_map(traced.photons); });
    return pass;
}

/// The second pass, with the report's numbers of rays: medians of pairs of pictures.
/// \param shot  Renders the picture with some rays per pixel and some threads: its
///              Timing.
template <typename Shot>
Times time_pairs(Shot shot, const Sizes& sizes, int threads) {
    Times times;
    for (const double rays : report_times.rays) {
        if (rays > sizes.most) continue;
        std::vector<double> one, many;
        for (int repeat = 0; repeat < sizes.repeats; ++repeat) {
            one.push_back(shot(int(rays), 1).wall);
            many.push_back(shot(int(rays), threads).wall);
            examples::stop_if_asked();
        }
        times.rays.push_back(rays);
        times.one.push_back(median(one));
        times.many.push_back(median(many));
    }
    return times;
}

/// The straight lines through the columns of table 1, and the times of the first pass.
/// \return The line of our second pass with one thread.
Line save_lines(const Times& measured, const FirstPass& alone, const FirstPass& shared,
                const examples::Options& options, int threads) {
    examples::Table lines{.name = "parallel-lines",
                          .columns = {"", "fixed, s", "one ray in every pixel, s",
                                      "microseconds per path"}};
    const auto add = [&](const std::string& name, const Line& line, double of_pixels) {
        lines.rows.push_back({name, text(line.fixed, "%.3g"), text(line.each, "%.3g"),
                              text(1e6 * line.each / of_pixels, "%.3g")});
    };
    const auto once = [&](const std::string& name, double seconds) {
        lines.rows.push_back({name, text(seconds, "%.3g"), "", ""});
    };
    add("report, 1 thread", fit_line(report_times.rays, report_times.one), 160000);
    add("report, 4 threads", fit_line(report_times.rays, report_times.many), 160000);
    const Line loop = fit_line(measured.rays, measured.one);
    const double pixels = double(options.width) * options.height;
    const std::string several = std::to_string(threads) + " threads";
    add("second pass, 1 thread", loop, pixels);
    add("second pass, " + several, fit_line(measured.rays, measured.many), pixels);
    once("photons, 1 thread", alone.emission.wall);
    once("photons, " + several, shared.emission.wall);
    once("make the photon map", alone.tree.wall);
    save_table(options.path(""), lines);
    return loop;
}

/// The straight lines through the times of table 1.
/// \param[out] loop  The line of the second pass with one thread.
/// \return Seconds of the first pass with one thread, for Amdahl's law.
template <typename R>
FirstPass lines(const R& room, const examples::Options& options, const Sizes& sizes,
                int threads, Line& loop) {
    const PhotonMappingSettings settings = report_settings(1);
    const FirstPass alone = first_pass(room, settings);
    const FirstPass shared = first_pass(room, report_settings(threads));
    const PhotonMapper mapper(room.world, settings);
    const auto shot = [&](int rays, int by) {
        return timed([&] {
            (void)render(mapper, room.camera,
                         {options.width, options.height, rays, options.seed, by});
        });
    };
    (void)shot(1, threads); // starts the threads
    loop =
        save_lines(time_pairs(shot, sizes, threads), alone, shared, options, threads);
    return alone;
}

// --- What a picture costs, pixel by pixel --------------------------------------------

/// A renderer whose radiance is the cost of the path: rays, and photon searches.
template <typename Renderer>
struct CostOf {
    using Stream = typename Renderer::Stream;
    const Renderer& renderer; ///< Of what.
};

// [cost]
template <typename Renderer, typename Context>
Rgb radiance(const CostOf<Renderer>& cost, const Ray& ray, Context& context) {
    Counts counts;
    auto counted = context_of(context.stream, counts);
    (void)radiance(cost.renderer, ray, counted);
    return Rgb{float(counts.rays() + counts.map_queries)};
}
// [cost]

/// When each of some jobs begins and ends, and on which thread.
struct Schedule {
    std::vector<int> thread{};   ///< Of each job.
    std::vector<double> begin{}; ///< Of each job.
    double end = 0;              ///< Of all.
};

/// Jobs that are handed out one by one, in order, to the next free thread.
Schedule dynamic_schedule(const std::vector<double>& jobs, int threads) {
    Schedule schedule;
    std::vector<double> free(static_cast<std::size_t>(threads), 0.0);
    for (const double job : jobs) {
        const auto first = std::min_element(free.begin(), free.end());
        schedule.thread.push_back(static_cast<int>(first - free.begin()));
        schedule.begin.push_back(*first);
        *first += job;
        schedule.end = std::max(schedule.end, *first);
    }
    return schedule;
}

/// Each thread gets an equal number of neighbouring jobs.
Schedule static_schedule(const std::vector<double>& jobs, int threads) {
    Schedule schedule;
    const std::size_t count = jobs.size(), parts = static_cast<std::size_t>(threads);
    for (std::size_t part = 0; part < parts; ++part) {
        double now = 0;
        for (std::size_t i = count * part / parts; i < count * (part + 1) / parts;
             ++i) {
            schedule.thread.push_back(static_cast<int>(part));
            schedule.begin.push_back(now);
            now += jobs[i];
        }
        schedule.end = std::max(schedule.end, now);
    }
    return schedule;
}

double sum_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

/// The costs of strips of pixels, row by row.
std::vector<double> strips_of(const Image& costs, int width) {
    std::vector<double> jobs;
    for (int y = 0; y < costs.height; ++y)
        for (int x = 0; x < costs.width; x += width) {
            jobs.push_back(0);
            for (int i = x; i < std::min(x + width, costs.width); ++i)
                jobs.back() += double(pixel(costs, i, y).x);
        }
    return jobs;
}

/// The report's program: a loop over the columns, and within each a parallel loop that
/// gives each thread an equal part of the column, and waits for all.
double column_by_column(const Image& costs, int threads) {
    double time = 0;
    for (int x = 0; x < costs.width; ++x) {
        std::vector<double> column;
        for (int y = 0; y < costs.height; ++y)
            column.push_back(double(pixel(costs, x, y).x));
        time += static_schedule(column, threads).end;
    }
    return time;
}

/// Which thread renders which strip, in a picture, and when, in a drawing.
void draw_schedules(const Image& costs, const examples::Options& options) {
    constexpr int threads = 4;
    constexpr std::array<const char*, 4> names{
        examples::colors::blue, examples::colors::orange, examples::colors::green,
        examples::colors::violet};
    // Bands of rows, few enough to be visible.
    const int rows = std::max(1, costs.height / 40);
    std::vector<double> jobs;
    for (int y = 0; y < costs.height; ++y) {
        if (y % rows == 0) jobs.push_back(0);
        for (int x = 0; x < costs.width; ++x)
            jobs.back() += double(pixel(costs, x, y).x);
    }
    const double unit = sum_of(jobs) / threads; // the ideal work of each
    examples::Drawing drawing{.name = "parallel-schedules",
                              .description = "Four threads: each renders an equal "
                                             "number of rows, or the next rows go to "
                                             "whichever thread is free",
                              .low{-0.2, -0.1},
                              .high{6.9, 3.6},
                              .scale = 100};
    const auto draw = [&](const Schedule& schedule, double top, const char* title) {
        draw_label(drawing, {3.1, top + 0.22}, title);
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            const double y = top - 0.3 * (schedule.thread[i] + 1);
            const double a = 6.2 * schedule.begin[i] / unit;
            const double b = a + 6.2 * jobs[i] / unit;
            const char* color = names[static_cast<std::size_t>(schedule.thread[i])];
            draw_area(drawing, {{a, y}, {b, y}, {b, y + 0.26}, {a, y + 0.26}}, color);
            draw_line(drawing, {{a, y}, {b, y}, {b, y + 0.26}, {a, y + 0.26}, {a, y}},
                      {.color = color, .width = 1});
        }
        draw_line(drawing,
                  {{6.2 * schedule.end / unit, top + 0.05},
                   {6.2 * schedule.end / unit, top - 1.3}},
                  {.dashed = true});
    };
    draw(static_schedule(jobs, threads), 3.1,
         "each thread renders an equal number of rows");
    draw(dynamic_schedule(jobs, threads), 1.3,
         "the next rows go to whichever thread is free");
    save_drawing(options.path(""), drawing);
}

/// The picture of costs, and how evenly the work can be divided.
void schedules(const Image& costs, const examples::Options& options) {
    const double all = sum_of(strips_of(costs, costs.width));
    float most = 0;
    for (const Rgb& c : costs.pixels) most = std::max(most, c.x);
    Image shown = costs;
    for (Rgb& c : shown.pixels) c /= most;
    save_png(shown, options.path("parallel-cost.png"));
    draw_schedules(costs, options);

    examples::Plot plot{.name = "parallel-schedule",
                        .columns = {"threads", "strips of 16 pixels: dynamic",
                                    "rows: dynamic", "rows: static",
                                    "column by column: static"},
                        .y_label = "speed-up over the number of threads",
                        .log_x = true,
                        .more = "set format x '%g'\nset yrange [0.6:1.02]\n"};
    for (const int threads : {1, 2, 3, 4, 8, 16, 32, 64}) {
        const auto strips = strips_of(costs, 16), rows = strips_of(costs, costs.width);
        const std::array speed{all / dynamic_schedule(strips, threads).end,
                               all / dynamic_schedule(rows, threads).end,
                               all / static_schedule(rows, threads).end,
                               all / column_by_column(costs, threads)};
        plot.rows.push_back({double(threads)});
        for (const double s : speed) plot.rows.back().push_back(s / threads);
    }
    save_plot(options.path(""), plot);
}

// --- Amdahl's law --------------------------------------------------------------------

void amdahl(const FirstPass& first, const Line& loop,
            const examples::Options& options) {
    examples::Plot plot{.name = "parallel-amdahl",
                        .columns = {"threads", "1 ray per pixel", "10", "100", "1000"},
                        .y_label = "speed-up of both passes, by Amdahl's law",
                        .log_x = true,
                        .log_y = true,
                        .more = "set format xy '%g'\n"};
    for (int threads = 1; threads <= 1024; threads *= 2) {
        examples::Row row{double(threads)};
        for (const int rays : {1, 10, 100, 1000}) {
            const double serial = first.tree.wall;
            const double shared = first.emission.wall + loop.each * rays;
            row.push_back((serial + shared) / (serial + shared / threads));
        }
        plot.rows.push_back(row);
    }
    save_plot(options.path(""), plot);
}

// --- The same bytes ------------------------------------------------------------------

/// A sum whose parts are made by each thread, as OpenMP's `reduction` would: with
/// another number of threads it is rounded differently.
// [sum by thread]
float sum_by_thread(const std::vector<float>& values, std::size_t threads) {
    std::vector<float> part(threads, 0.0f);
    for (std::size_t t = 0; t < threads; ++t)
        for (std::size_t i = values.size() * t / threads;
             i < values.size() * (t + 1) / threads; ++i)
            part[t] += values[i];
    return std::accumulate(part.begin(), part.end(), 0.0f);
}
// [sum by thread]

/// The same in blocks whose size does not depend on the number of threads.
// [sum by block]
float sum_by_block(const std::vector<float>& values, int threads) {
    constexpr std::size_t size = 512;
    std::vector<float> part((values.size() + size - 1) / size, 0.0f);
    const auto body = [&](long long number) {
        const auto block = static_cast<std::size_t>(number);
        const std::size_t last = std::min((block + 1) * size, values.size());
        float sum = 0; // of its own: the list is touched once per block
        for (std::size_t i = block * size; i < last; ++i) sum += values[i];
        part[block] = sum;
    };
    parallel_blocks(static_cast<long long>(part.size()), body, {.threads = threads});
    return std::accumulate(part.begin(), part.end(), 0.0f);
}
// [sum by block]

/// Pictures, maps and sums for several numbers of threads.
/// \return Whether all pictures and maps are the same.
template <typename R>
bool same_bytes(const R& room, const examples::Options& options) {
    const int size = options.pick(64, 200, 200);
    examples::Table table{.name = "parallel-bytes",
                          .columns = {"threads", "photons in order", "picture",
                                      "sum by thread", "sum by block"}};
    std::vector<float> values;
    bool same = true;
    for (const int threads : {1, 2, 3, 8}) {
        const PhotonMappingSettings settings = report_settings(threads);
        const auto traced =
            trace_photons(room.world, MapType::caustics, settings.caustics);
        std::vector<Vec3> marks;
        for (const Photon& photon : traced.photons) {
            marks.push_back(photon.position);
            marks.push_back(photon.flux);
        }
        const PhotonMapper mapper(room.world, settings);
        const Image image = render(mapper, room.camera,
                                   {.width = size,
                                    .height = size,
                                    .samples = 4,
                                    .seed = options.seed,
                                    .threads = threads})
                                .image;
        if (values.empty())
            for (const Rgb& c : image.pixels) values.push_back(c.y);
        table.rows.push_back(
            {std::to_string(threads), examples::hex_text(examples::hash_of(marks)),
             examples::hex_text(examples::hash_of(image.pixels)),
             text(double(sum_by_thread(values, std::size_t(threads))), "%.9g"),
             text(double(sum_by_block(values, threads)), "%.9g")});
        for (const std::size_t column : {1u, 2u, 4u})
            same = same && table.rows.back()[column] == table.rows[0][column];
    }
    save_table(options.path(""), table);

    return same;
}

} // namespace

/// Makes the tables and figures of chapter 34.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 34, many threads: schedules, and the same bytes.");
        line.add("--most", sizes.most, "The largest number of rays that is timed", 10,
                 1000);
        line.add("--repeats", sizes.repeats, "Pairs of one thread and several", 1,
                 1000);
        const examples::Options options =
            line.parse({.draft{.width = 48, .height = 48, .samples = 4},
                        .report{.width = 400, .height = 400, .samples = 64},
                        .reference{.width = 400, .height = 400, .samples = 64}});
        if (!line.given("--most")) sizes.most = options.pick(100, 1000, 1000);
        if (!line.given("--repeats")) sizes.repeats = options.pick(3, 3, 5);
        const int processors = int(std::thread::hardware_concurrency());
        const int threads =
            std::max(2, options.threads > 0 ? options.threads : processors);

        const auto room = four_glass_room();
        Line loop;
        const FirstPass first = lines(room, options, sizes, threads, loop);

        const PhotonMappingSettings settings = report_settings(options.threads);
        const PhotonMapper mapper(room.world, settings);
        // A fixed size: the results for schedules depend on it.
        const Image costs = render(CostOf<decltype(mapper)>{mapper}, room.camera,
                                   {.width = 400,
                                    .height = 400,
                                    .samples = options.pick(1, 16, 16),
                                    .threads = options.threads})
                                .image;
        schedules(costs, options);
        amdahl(first, loop, options);
        const bool same = same_bytes(room, options);
        if (!options.quiet)
            std::printf("1, 2, 3 and 8 threads: %s\n",
                        same ? "the same bytes" : "NOT the same bytes");
        if (!same)
            throw std::runtime_error("the number of threads has changed the picture");
    });
}
