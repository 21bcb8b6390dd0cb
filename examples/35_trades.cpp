// smoke: --quality draft --truth 32 --size 12 --seeds 2 --only radius
/// \file 35_trades.cpp
/// \brief Every knob of the photon mapper, turned: error against time and memory, and
/// the Pareto front of all settings.
///
/// Each setting that is done is a line of trades.csv; what is there is not done again,
/// so that a run can be stopped and gone on with. ./scripts/trades builds and runs it.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <ljus/image/flip.hpp>
#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/oracle.hpp"
#include "common/plot.hpp"

using namespace ljus;

namespace {

using examples::text;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// What the user may set besides the common options.
struct Request {
    std::string only = "all"; ///< A knob.
    int size = 0;             ///< Side of the pictures.
    int seeds = 0;            ///< Runs of each setting.
    int truth = 0;            ///< Rays a pixel of the reference.
    bool references = false;  ///< Only those.
};

/// One setting of everything.
struct Setting {
    std::string knob{};              ///< What is turned.
    std::string value{};             ///< How far; "paths" is the path tracer.
    int rays = 16;                   ///< A pixel.
    PhotonMappingSettings photons{}; ///< All else.
};

const std::vector<std::string> knobs{"rays",     "depth",  "photons",     "radius",
                                     "nearest",  "kernel", "shadow rays", "indirect",
                                     "roulette", "glass"};

/// The settings of one knob, around a middle.
std::vector<Setting> settings_of(const std::string& knob, bool quick) {
    Setting middle{.knob = knob, .value = {}, .rays = 16, .photons = {}};
    middle.photons.caustics.photons = 30000;
    middle.photons.general.photons = 30000;
    middle.photons.caustics_estimate.radius = 0.1f;
    std::vector<Setting> all;
    const auto add = [&](const std::string& value, auto change) {
        all.push_back(middle);
        all.back().value = value;
        change(all.back());
    };
    if (knob == "rays")
        for (int n = 1; n <= (quick ? 64 : 1024); n *= 4) {
            add(std::to_string(n), [n](Setting& s) { s.rays = n; });
            add("paths " + std::to_string(n), [n](Setting& s) { s.rays = n; });
        }
    if (knob == "depth")
        for (const int depth : {1, 2, 3, 4, 6, 8, 16})
            add(std::to_string(depth), [depth](Setting& s) {
                s.photons.max_depth = depth;
                s.photons.roulette_depth = depth + 1;
            });
    if (knob == "photons")
        for (long long n = 100; n <= (quick ? 100000 : 1000000); n *= 10)
            add(std::to_string(n), [n](Setting& s) { s.photons.caustics.photons = n; });
    if (knob == "radius")
        for (const double r : {0.0125, 0.025, 0.05, 0.1, 0.2, 0.4})
            add(text(r),
                [r](Setting& s) { s.photons.caustics_estimate.radius = float(r); });
    if (knob == "nearest")
        for (const std::size_t k : {4u, 16u, 64u, 256u})
            add(std::to_string(k),
                [k](Setting& s) { s.photons.caustics_estimate.nearest = k; });
    if (knob == "kernel") {
        constexpr std::array names{"box", "cone", "gaussian", "epanechnikov",
                                   "biweight"};
        for (std::size_t k = 0; k < names.size(); ++k)
            add(names[k], [k](Setting& s) {
                s.photons.caustics_estimate.kernel = static_cast<Kernel>(k);
            });
    }
    if (knob == "shadow rays")
        for (const int n : {1, 2, 4, 8})
            add(std::to_string(n), [n](Setting& s) { s.photons.shadow_rays = n; });
    if (knob == "indirect")
        for (const auto& [name, way] : {std::pair{"rays", IndirectLight::rays},
                                        {"map", IndirectLight::map},
                                        {"photons", IndirectLight::photons},
                                        {"none", IndirectLight::none}}) {
            const IndirectLight chosen = way;
            add(name, [chosen](Setting& s) { s.photons.indirect = chosen; });
        }
    if (knob == "roulette")
        for (const int from : {1, 2, 4, 8, 16})
            add(std::to_string(from),
                [from](Setting& s) { s.photons.roulette_depth = from; });
    if (knob == "glass")
        for (const bool split : {false, true})
            add(split ? "both ways" : "one way",
                [split](Setting& s) { s.photons.split_glass = split; });
    return all;
}

/// What a setting brought: a line of the table.
struct Result {
    std::string scene{}; ///< Which room.
    std::string knob{};  ///< What was turned.
    std::string value{}; ///< How far.
    double seconds = 0;  ///< Processor time of both passes, the median.
    double bytes = 0;    ///< Of the maps.
    double rays = 0;     ///< Traced for a pixel.
    double rmse = 0;     ///< Mean over the seeds.
    double bias = 0;     ///< bias² of relMSE.
    double variance = 0; ///< Noise of relMSE.
    double block = 0;    ///< Of the means of 10 x 10 pixels.
    double trimmed = 0;  ///< Without the worst hundredth.
    double flip = 0;     ///< Of the first seed.
    std::string stamp{}; ///< Of all that decides it; see key().

    [[nodiscard]] double error() const { return std::max(bias + variance, 1e-9); }
};

const std::vector<std::string> columns{"scene",   "knob", "value", "seconds", "bytes",
                                       "rays",    "rmse", "bias2", "noise",   "blocks2",
                                       "trimmed", "flip", "stamp"};

std::vector<std::string> cells_of(const Result& r) {
    std::vector<std::string> cells{r.scene, r.knob, r.value};
    for (const double number : {r.seconds, r.bytes, r.rays, r.rmse, r.bias, r.variance,
                                r.block, r.trimmed, r.flip})
        cells.push_back(text(number, "%.6g"));
    cells.push_back(r.stamp);
    return cells;
}

/// The lines of a table that is there.
std::vector<Result> read_results(const std::string& path) {
    std::vector<Result> results;
    if (!std::filesystem::exists(path)) return results;
    const Bytes bytes = load_file(path, std::size_t(1) << 26);
    std::string line;
    std::vector<std::string> cells(1);
    for (const unsigned char c : bytes) {
        if (c != '\n') {
            if (c == ',')
                cells.emplace_back();
            else
                cells.back() += static_cast<char>(c);
            continue;
        }
        if (cells.size() == columns.size() && cells[0] != "scene") {
            const auto number = [&](std::size_t i) {
                return std::strtod(cells[i].c_str(), nullptr);
            };
            results.push_back({cells[0], cells[1], cells[2], number(3), number(4),
                               number(5), number(6), number(7), number(8), number(9),
                               number(10), number(11), cells[12]});
        }
        cells.assign(1, {});
    }
    return results;
}

/// The program's notebook: what has been measured, on which machine.
struct Notebook {
    std::string path;            ///< trades.csv.
    std::vector<Result> results; ///< In the order of measuring.

    [[nodiscard]] const Result* find(const Result& wanted) const {
        for (const Result& r : results)
            if (r.scene == wanted.scene && r.knob == wanted.knob &&
                r.value == wanted.value && r.stamp == wanted.stamp)
                return &r;
        return nullptr;
    }
    void add(const Result& result) {
        results.push_back(result);
        std::string csv = examples::csv_line(columns);
        for (const Result& r : results) csv += examples::csv_line(cells_of(r));
        examples::save_text(path, csv);
    }
};

/// Measures all settings of one room.
template <typename R>
void measure(const std::string& name, const R& room, const examples::Options& options,
             const Request& request, Notebook& notebook) {
    const auto oracle =
        examples::find_oracle(name, room, request.size, request.truth, options);
    if (request.references) return;
    const auto tracer = make_path_tracer(room.scene);
    const bool quick = options.quality == examples::Quality::draft;
    for (const std::string& knob : knobs) {
        if (request.only != "all" && request.only != knob) continue;
        for (const Setting& setting : settings_of(knob, quick)) {
            const bool paths = setting.value.rfind("paths", 0) == 0;
            Result result{.scene = name, .knob = knob, .value = setting.value};
            std::vector<Image> runs;
            std::vector<double> seconds;
            const auto shoot = [&](std::uint64_t seed, int size) {
                PhotonMappingSettings photons = setting.photons;
                photons.caustics.seed = photons.general.seed = seed;
                photons.caustics.threads = photons.general.threads = options.threads;
                const RenderSettings picture{size, size, setting.rays, seed,
                                             options.threads};
                const double start = examples::processor_seconds();
                PhotonMapsT<float> maps;
                if (!paths) maps = make_photon_maps(room.scene, photons);
                const auto seen =
                    paths ? render(tracer, room.camera, picture)
                          : render(make_photon_mapper(room.scene, maps, photons),
                                   room.camera, picture);
                seconds.push_back(examples::processor_seconds() - start);
                result.bytes =
                    double(maps.caustics.tree.bytes() + maps.caustics.records.bytes() +
                           maps.general.tree.bytes() + maps.general.records.bytes());
                result.rays = double(seen.counts.rays()) / size / size;
                return seen.image;
            };
            // A small picture is the fingerprint: other code, other numbers, measured
            // anew.
            result.stamp =
                examples::hex_text(examples::hash_of(shoot(1, 6).pixels)).substr(0, 8) +
                "-" + std::to_string(request.size) + "-" +
                std::to_string(request.seeds) + "-" + std::to_string(oracle.rays);
            if (notebook.find(result)) continue;
            seconds.clear();
            for (int seed = 1; seed <= request.seeds; ++seed) {
                runs.push_back(shoot(std::uint64_t(seed), request.size));
                result.rmse += rmse(runs.back(), oracle.truth) / request.seeds;
                result.trimmed +=
                    trimmed_rel_mse(runs.back(), oracle.truth) / request.seeds;
                examples::stop_if_asked();
            }
            std::sort(seconds.begin(), seconds.end());
            result.seconds = std::max(seconds[seconds.size() / 2], 1e-6);
            const auto parts =
                examples::relative_split(runs, oracle.truth, oracle.noise);
            result.bias = parts.bias_squared;
            result.variance = parts.variance;
            const auto blocks =
                examples::relative_split(runs, oracle.truth, oracle.block_noise, 10);
            result.block = blocks.bias_squared + blocks.variance;
            result.flip = flip(runs[0], oracle.truth);
            notebook.add(result);
            if (!options.quiet) {
                std::printf("%-14s %-12s %-14s %8.3f s  relMSE %.3g\n", name.c_str(),
                            knob.c_str(), setting.value.c_str(), result.seconds,
                            result.error());
                std::fflush(stdout);
            }
        }
    }
}

/// The plots of one room, and the settings that no other beats in time *and* error.
void show(const std::string& name, const Notebook& notebook,
          const examples::Options& options) {
    std::vector<Result> of_room;
    std::map<std::string, std::size_t> last; // of each setting, the newest line
    for (const Result& r : notebook.results)
        if (r.scene == name) {
            const auto [place, fresh] =
                last.try_emplace(r.knob + "/" + r.value, of_room.size());
            if (fresh)
                of_room.push_back(r);
            else
                of_room[place->second] = r;
        }
    if (of_room.empty()) return;
    std::vector<examples::Row> best_rows; // seconds and error of the front
    std::sort(of_room.begin(), of_room.end(),
              [](const Result& a, const Result& b) { return a.seconds < b.seconds; });
    examples::Table front{.name = "trades-" + name + "-front",
                          .columns = {"s", "relMSE", "bias²", "blocks", "trimmed",
                                      "FLIP", "MB", "knob", "at"}};
    double best = std::numeric_limits<double>::infinity();
    for (const Result& r : of_room) {
        if (!(r.error() < best)) continue;
        best = r.error();
        best_rows.push_back({r.seconds, r.error()});
        front.rows.push_back({text(r.seconds, "%.3g"), text(r.error(), "%.2g"),
                              text(r.bias, "%.2g"), text(r.block, "%.2g"),
                              text(r.trimmed, "%.2g"), text(r.flip, "%.3f"),
                              text(r.bytes * 1e-6, "%.3g"), r.knob, r.value});
    }
    save_table(options.path(""), front);
    for (const std::string& knob : knobs) {
        std::string file = "trades-" + name + "-" + knob;
        std::replace(file.begin(), file.end(), ' ', '-');
        examples::Plot plot{.name = file,
                            .columns = {"processor seconds", knob, "path tracing",
                                        "no setting is better"},
                            .y_label = "relMSE",
                            .log_x = true,
                            .log_y = true};
        for (const bool paths : {false, true})
            for (const Result& r : of_room)
                if (r.knob == knob && (r.value.rfind("paths", 0) == 0) == paths)
                    plot.rows.push_back({r.seconds, paths ? nothing : r.error(),
                                         paths ? r.error() : nothing, nothing});
        if (plot.rows.empty()) continue;
        for (const auto& row : best_rows)
            plot.rows.push_back({row[0], nothing, nothing, row[1]});
        save_plot(options.path(""), plot);
    }
}

/// The same as JSON, with what a number depends on.
void save_json(const Notebook& notebook, const examples::Options& options,
               const Request& request) {
    std::string json = "{\n  \"version\": \"" + std::to_string(LJUS_VERSION_MAJOR) +
                       "." + std::to_string(LJUS_VERSION_MINOR) + "." +
                       std::to_string(LJUS_VERSION_PATCH) + "\",\n  \"compiler\": \"";
#ifdef __VERSION__
    json += __VERSION__;
#endif
    json += "\",\n  \"threads\": " + std::to_string(options.threads) +
            ",\n  \"size\": " + std::to_string(request.size) +
            ",\n  \"seeds\": " + std::to_string(request.seeds) + ",\n  \"results\": [";
    for (std::size_t i = 0; i < notebook.results.size(); ++i) {
        const auto cells = cells_of(notebook.results[i]);
        json += i == 0 ? "\n    {" : ",\n    {";
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const bool word = c < 3 || c + 1 == cells.size();
            json +=
                (c == 0 ? "\"" : ", \"") + columns[c] + "\": " + (word ? "\"" : "") +
                (cells[c].empty() && !word ? "null" : cells[c]) + (word ? "\"" : "");
        }
        json += "}";
    }
    examples::save_text(options.path("trades.json"), json + "\n  ]\n}\n");
}

} // namespace

/// Turns all knobs.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Request request;
        line.about("Every knob of the photon mapper: error against time and memory.");
        std::vector<std::string> words{"all"};
        words.insert(words.end(), knobs.begin(), knobs.end());
        line.add("--only", request.only, "Nothing but this knob", words);
        line.add("--size", request.size, "Side of the pictures in pixels", 4, 1000);
        line.add("--seeds", request.seeds, "Runs of each setting", 2, 1000);
        line.add("--truth", request.truth, "Rays a pixel of the references", 8,
                 100000000);
        line.add("--references", request.references, "Make the references only");
        const examples::Options options = line.parse();
        if (!line.given("--size")) request.size = options.pick(24, 64, 100);
        if (!line.given("--seeds")) request.seeds = options.pick(3, 6, 16);
        if (!line.given("--truth")) request.truth = options.pick(512, 32768, 262144);
        Notebook notebook{.path = options.path("trades.csv"),
                          .results = read_results(options.path("trades.csv"))};
        measure("four-glass", four_glass_room(), options, request, notebook);
        measure("all-materials", all_materials_room(), options, request, notebook);
        if (request.references) return;
        for (const char* name : {"four-glass", "all-materials"})
            show(name, notebook, options);
        save_json(notebook, options, request);
    });
}
