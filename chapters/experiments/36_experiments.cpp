// smoke: --quality draft --seeds 3 --only radius
/// \file chapters/experiments/36_experiments.cpp
/// \brief Chapter 36: the experiments behind its tables and plots: every setting of the
/// photon mapper, varied. Error against time and memory, the cost of halving the time,
/// and the settings that no other beats.
///
/// Each finished setting is a line of trades-notebook.json and is not
/// measured again, so that a run can be stopped and continued. ./scripts/trades builds
/// and runs it.

#include <cstdio>
#include <limits>
#include <map>
#include <optional>

#include <ljus/ljus.hpp>
#include <ljus/scenes/cornell_box.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/command_line.hpp"
#include "experiments/claims.hpp"
#include "experiments/sweep.hpp"
#include "experiments/trade_tables.hpp"

using namespace ljus;

namespace {

using examples::Setting;
using examples::text;

// --- The rooms -----------------------------------------------------------------------

/// A ball of glass in a closed grey room, below a small lamp: most of the bright region
/// is one caustic.
template <std::floating_point T>
Room<CornellSceneT<T>> make_caustic() {
    CornellSceneT<T> scene;
    const auto white = scene.add(LambertianT<T>{.albedo = RgbT<T>{T(0.5)}});
    const Vec3T<T> corner{T(-1), T(0), T(-1)}, x{T(2), T(0), T(0)}, y{T(0), T(2), T(0)},
        z{T(0), T(0), T(4)};
    scene.add(QuadT<T>{corner, z, x}, white);     // floor
    scene.add(QuadT<T>{corner + y, x, z}, white); // ceiling
    scene.add(QuadT<T>{corner, x, y}, white);     // back
    scene.add(QuadT<T>{corner + z, y, x}, white); // front
    scene.add(QuadT<T>{corner, y, z}, white);     // left
    scene.add(QuadT<T>{corner + x, z, y}, white); // right
    scene.add(QuadT<T>{.corner{T(-0.7), T(1.98), T(-0.6)},
                       .edge_u{T(0.3), T(0), T(0)},
                       .edge_v{T(0), T(0), T(0.3)}},
              scene.add(LambertianT<T>{.albedo = RgbT<T>{T(0)}}), RgbT<T>{T(50)});
    scene.add(SphereT<T>{.center{T(0), T(0.5), T(0)}, .radius = T(0.35)},
              scene.add(GlassT<T>{.index = T(1.5)}));
    return {World(std::move(scene)), look_at(ViewT<T>{.position{T(0), T(1.3), T(2.8)},
                                                      .target{T(0.1), T(0.25), T(0)},
                                                      .up{T(0), T(1), T(0)},
                                                      .vfov_degrees = T(36)})};
}

// --- The knobs -----------------------------------------------------------------------

/// In the order of the chapter.
const std::vector<std::string> knobs{
    "preset",   "rays",        "sampling",    "shadow-rays",  "direct",
    "glass",    "depth",       "roulette",    "photons",      "radius",
    "nearest",  "kernel",      "numbers",     "budget",       "skip",
    "indirect", "gather-rays", "gather-tile", "gather-reach", "irradiance-every",
    "precision"};

/// The settings of one knob, as they are put together: each is the middle, changed.
struct Around {
    Setting middle;
    float unit; ///< Half of the room's width, the unit of radii.
    int size;   ///< Of the pictures.
    bool full;  ///< A wider range than in a draft.
    std::vector<Setting> all{};

    /// The middle's settings of photons and rays.
    PhotonMappingSettings& s() { return middle.recipe.settings; }

    /// Adds a setting. `change` gets it, and its settings of photons and rays.
    template <typename Change>
    void add(const std::string& value, double x, Change change) {
        all.push_back(middle);
        all.back().value = value;
        all.back().x = x;
        change(all.back(), all.back().recipe.settings);
    }
    /// Adds one for each number, which `change` gets as well.
    template <typename Number = int, typename Change>
    void numbers(const std::vector<Number>& values, Change change) {
        for (const Number n : values)
            add(text(double(n), "%.6g"), double(n),
                [&](Setting& one, PhotonMappingSettings& how) { change(one, how, n); });
    }
    /// Adds one for each word; `change` gets its index in the list.
    template <typename Change>
    void words(const std::vector<std::string>& values, Change change) {
        for (std::size_t i = 0; i < values.size(); ++i)
            add(values[i], 0, [&](Setting& one, PhotonMappingSettings& how) {
                change(one, how, static_cast<int>(i));
            });
    }
};

/// Whole ways to make a picture.
void add_presets(Around& to) {
    for (const auto& recipe : examples::recipes(to.size, to.size))
        to.add(recipe.name, 0, [&](Setting& one, auto&) { one.recipe = recipe; });
    to.words({"paths", "report"}, [&](Setting& one, auto& how, int report) {
        one.paths = report == 0;
        if (one.paths) return;
        how = {.max_depth = 4, .roulette_depth = 5};
        how.caustics.photons = to.full ? 100000 : 10000;
        how.caustics_estimate.radius = 0.01f * to.unit;
    });
}

/// Rays through a pixel, of photon mapping and of path tracing.
void add_rays(Around& to) {
    for (const int n : {1, 4, 16, 64}) {
        if (n > 16 && !to.full) continue;
        to.add(std::to_string(n), n, [n](Setting& one, auto&) { one.recipe.rays = n; });
        to.add("paths " + std::to_string(n), n, [n](Setting& one, auto&) {
            one.recipe.rays = n;
            one.paths = true;
        });
    }
}

/// Adds the settings of a knob that turns rays and paths.
void add_path_knob(Around& to, const std::string& knob) {
    if (knob == "preset") add_presets(to);
    if (knob == "rays") add_rays(to);
    if (knob == "sampling")
        to.words({"random", "jittered", "multi-jittered", "sobol"},
                 [](Setting& one, auto&, int i) { one.sampling = Sampling(i); });
    if (knob == "shadow-rays")
        to.numbers({1, 2, 4, 9},
                   [](Setting&, auto& how, int n) { how.shadow_rays = n; });
    if (knob == "direct")
        to.words({"sampled", "analytic", "mis"},
                 [](Setting&, auto& how, int i) { how.direct = DirectLight(i); });
    if (knob == "glass")
        to.words({"one way", "both ways"},
                 [](Setting&, auto& how, int i) { how.split_glass = i == 1; });
    if (knob == "depth")
        to.numbers({1, 2, 3, 4, 6, 8}, [](Setting&, auto& how, int depth) {
            how.max_depth = depth;
            how.roulette_depth = depth + 1;
        });
    if (knob == "roulette")
        to.numbers({1, 2, 4, 8, 16},
                   [](Setting&, auto& how, int from) { how.roulette_depth = from; });
    if (knob == "precision")
        to.words({"float", "double"},
                 [](Setting& one, auto&, int i) { one.in_double = i == 1; });
}

/// Adds the settings of a knob that turns the photons of caustics.
void add_caustics_knob(Around& to, const std::string& knob) {
    to.middle.of_maps = true;
    if (knob == "photons")
        to.numbers(to.full ? std::vector{1000, 10000, 100000, 300000}
                           : std::vector{1000, 10000, 100000},
                   [](Setting&, auto& how, int n) { how.caustics.photons = n; });
    if (knob == "radius")
        to.numbers<float>({0.0125f, 0.025f, 0.05f, 0.1f, 0.2f, 0.4f},
                          [&](Setting&, auto& how, float r) {
                              how.caustics_estimate.radius = r * to.unit;
                          });
    if (knob == "nearest") {
        to.s().caustics_estimate.radius = to.unit;
        to.numbers({4, 16, 64, 256}, [](Setting&, auto& how, int k) {
            how.caustics_estimate.nearest = std::size_t(k);
        });
    }
    if (knob == "kernel")
        to.words({"box", "cone", "gaussian", "epanechnikov", "biweight"},
                 [](Setting&, auto& how, int i) {
                     how.caustics_estimate.kernel = Kernel(i);
                 });
    if (knob == "numbers")
        to.words({"random", "sobol"}, [](Setting&, auto& how, int i) {
            how.caustics.numbers = PhotonSampling(i);
        });
    if (knob == "budget")
        to.words(
            {"as seen", "equal", "flux", "area", "brightness"},
            [](Setting&, auto& how, int i) { how.caustic_budget = CausticBudget(i); });
    to.middle.of_maps = false;
}

/// Adds the settings of a knob that turns direct and indirect light from the general
/// map.
void add_general_knob(Around& to, const std::string& knob) {
    if (knob == "skip") {
        to.s().direct = DirectLight::sampled;
        to.s().general.photons = to.full ? 300000 : 30000;
        to.words({"none", "report", "any", "enough"},
                 [](Setting&, auto& how, int i) { how.skip.rule = SkipRule(i); });
    }
    if (knob == "indirect") {
        to.s().general.photons = to.full ? 60000 : 20000;
        to.words({"rays", "map", "photons", "gather", "cache", "none"},
                 [](Setting&, auto& how, int i) { how.indirect = IndirectLight(i); });
    }
    if (knob.rfind("gather", 0) == 0 || knob == "irradiance-every") {
        // What gathers needs precomputed irradiance.
        to.middle.recipe = examples::recipes(to.size, to.size)[1];
        to.s().general.photons = to.full ? 60000 : 20000;
    }
    if (knob == "gather-rays")
        to.numbers({4, 9, 25, 64},
                   [](Setting&, auto& how, int n) { how.gather.rays = n; });
    if (knob == "gather-tile")
        to.numbers({1, 2, 3, 5, 8},
                   [](Setting&, auto& how, int n) { how.gather.tile = n; });
    if (knob == "gather-reach")
        to.numbers<float>({0.125f, 0.25f, 0.5f, 1.0f, 2.0f},
                          [](Setting&, auto& how, float a) { how.gather.reach = a; });
    if (knob == "irradiance-every")
        to.numbers({2, 6, 16, 64},
                   [](Setting&, auto& how, int n) { how.irradiance.every = n; });
}

/// The settings of one knob, around a middle.
/// \param knob  Which.
/// \param unit  Half of the room's width, the unit of radii.
/// \param size  Of the pictures.
/// \param full  Farther than in a draft.
std::vector<Setting> settings_of(const std::string& knob, float unit, int size,
                                 bool full) {
    Around around{.middle = {.knob = knob}, .unit = unit, .size = size, .full = full};
    around.middle.recipe.rays = full ? 16 : 4;
    PhotonMappingSettings& s = around.s();
    s = preset_settings(Preset::exact, size, size);
    s.caustics.photons = s.general.photons = full ? 30000 : 10000;
    s.caustics_estimate.radius = 0.05f * unit;
    s.general_estimate.radius = 0.15f * unit;
    add_path_knob(around, knob);
    add_caustics_knob(around, knob);
    add_general_knob(around, knob);
    return around.all;
}

/// The options of this program, besides the common ones.
struct Request {
    std::string only = "all"; ///< A knob.
    int size = 40;            ///< Side of the pictures.
    int seeds = 0;            ///< Pictures by each setting.
    int truth = 0;            ///< Rays per pixel of the references.
    bool references = false;  ///< Only those.
    bool check = false;       ///< Fail if a claim of the book does not hold.
};

/// A sweep of all rooms. It goes over them twice: first it only counts what is not in
/// the notebook yet, so that the bar can show the time that is left.
struct Sweep {
    const examples::Options& options;
    const Request& request;
    examples::Notebook notebook;
    std::optional<examples::ProgressBar> bar{}; ///< None: it counts.
    double done = 0, all = 0;                   ///< As examples::cost_of() has it.
    std::map<std::string, std::string> stamps{};
    std::vector<examples::Claim> claims{}; ///< Of promises.
    examples::Table references{.name = "trades-references",
                               .columns = {"room", "rays per pixel", "its own relMSE",
                                           "of blocks", "least relMSE measured",
                                           "its standard error over the root of that"}};
    examples::Table promises{.name = "trades-promises",
                             .columns = {"room", "promised", "chosen", "pictures",
                                         "time, s", "noise", "bias", "estimated relMSE",
                                         "measured relMSE"}};

    /// Some work is done, or when counting, there is some.
    void add(double cost) {
        (bar ? done : all) += cost;
        if (bar) (void)(*bar)(static_cast<long long>(1000 * done / all), 1000);
    }
};

// --- Promises ------------------------------------------------------------------------

/// Promises some seconds, and two errors, three times each: were they kept?
/// \return The smallest error that was measured.
template <typename Room>
double promises(Sweep& sweep, const std::string& name, const Room& room,
                const examples::Oracle& oracle) {
    constexpr int runs = 3;
    const examples::Options& options = sweep.options;
    const double seconds = options.pick(0.6, 3.0, 10.0);
    double least = std::numeric_limits<double>::infinity();
    for (const examples::Promise& promise :
         {examples::Promise{.seconds = seconds}, {.error = 0.03}, {.error = 0.01}}) {
        const bool timed = promise.seconds > 0;
        double took = 0, noise = 0, bias = 0, unsure = 0, error = 0;
        std::string chosen, pictures;
        for (int run = 0; run < runs && sweep.bar; ++run) {
            const double begin = examples::processor_seconds();
            const auto kept = keep(
                room.world, room.camera,
                {.width = oracle.truth.width,
                 .height = oracle.truth.height,
                 .seed = options.seed + std::uint64_t(run),
                 .threads = options.threads},
                promise, [begin] { return examples::processor_seconds() - begin; },
                true, [](const auto&) {});
            chosen += (run > 0 ? " / " : "") + kept.recipe.name;
            pictures += (run > 0 ? " / " : "") + std::to_string(kept.pictures);
            took += kept.seconds / runs;
            noise += kept.noise / runs;
            bias += kept.forecast().bias / runs;
            unsure += kept.forecast().unsure / runs;
            error += (rel_mse(kept.rendered.image, oracle.truth) - oracle.noise) / runs;
        }
        sweep.add(timed ? runs * seconds : 2.0 * runs);
        if (!sweep.bar) continue;
        least = std::min(least, error);
        sweep.promises.rows.push_back(
            {name, timed ? text(seconds) + " s" : text(promise.error), chosen, pictures,
             text(took, "%.2f"), text(noise, "%.2g"),
             text(bias, "%.2g") + " ± " + text(unsure, "%.1g"),
             text(noise + bias, "%.2g"), text(error, "%.2g")});
        sweep.claims.push_back(
            {timed ? "the seconds are kept: their part of those promised"
                   : "the error " + text(promise.error) + " is kept: its part of it",
             name, timed ? took / seconds : error / promise.error, timed ? 0.8 : 0,
             1.2});
    }
    return least;
}

/// Tries the promises of a room, and reports the accuracy of its reference: its
/// standard error beside the root of the smallest error that was measured by it.
template <typename Room>
void try_promises(Sweep& sweep, const std::string& name, const Room& room,
                  const examples::Oracle& oracle) {
    double least = promises(sweep, name, room, oracle);
    if (!sweep.bar) return;
    for (const auto& line : sweep.notebook.lines)
        if (line.scene == name) least = std::min(least, line.error());
    sweep.references.rows.push_back(
        {name, std::to_string(oracle.rays), text(oracle.noise, "%.2g"),
         text(oracle.block_noise, "%.2g"), text(least, "%.2g"),
         text(100 * std::sqrt(oracle.noise / least), "%.0f %%")});
}

/// Makes the reference of a room, if references are what is asked for.
/// \return Whether they are.
template <typename Room>
bool makes_reference(const Sweep& sweep, const std::string& name, const Room& room) {
    const Request& request = sweep.request;
    if (!request.references || !sweep.bar) return request.references;
    const auto oracle =
        examples::find_oracle(name, room, request.size, request.truth, sweep.options);
    save_reference(sweep.options.path(""), name, oracle, sweep.notebook.conditions);
    return true;
}

/// The reference of a room, if there is one.
std::optional<examples::Oracle> reference_of(const Sweep& sweep,
                                             const std::string& name) {
    return examples::find_reference(
        name, sweep.request.size,
        {sweep.options.out, LJUS_SOURCE_FOLDER "/examples/data"});
}

/// Goes over a room in which only promises are tried.
template <typename Room>
void go_over(Sweep& sweep, const std::string& name, const Room& room) {
    if (makes_reference(sweep, name, room) || sweep.request.only != "all") return;
    const auto oracle = reference_of(sweep, name);
    if (oracle)
        try_promises(sweep, name, room, *oracle);
    else if (sweep.bar)
        std::fprintf(stderr,
                     "no promise is tried in the room %s: --references makes the "
                     "reference that it has not\n",
                     name.c_str());
}

/// Goes over all settings of one room, and its promises.
/// \param make  Makes the room, in float and in double.
/// \param unit  Half of its width.
template <typename Make>
void go_over(Sweep& sweep, const std::string& name, const Make& make, float unit) {
    const examples::Options& options = sweep.options;
    const Request& request = sweep.request;
    const auto room = make(float{});
    const auto room_in_double = make(double{});
    if (makes_reference(sweep, name, room)) return;
    const auto oracle = reference_of(sweep, name);
    if (!oracle)
        throw std::runtime_error("there is no reference of the room " + name +
                                 ": make it by --references with that --size.");
    for (const std::string& knob : knobs) {
        if (request.only != "all" && request.only != knob) continue;
        for (const Setting& setting :
             settings_of(knob, unit, request.size,
                         options.quality != examples::Quality::draft)) {
            // The curves of whole methods end at their bias: in report quality it must
            // not drown in noise.
            examples::Measuring how{request.size, request.seeds, options.threads};
            if (knob == "preset") how.seeds *= options.pick(1, 16, 16);
            const auto either = [&](const auto& work) {
                setting.in_double ? work(room_in_double) : work(room);
            };
            std::string& stamp = sweep.stamps[name + " " + knob + " " + setting.value];
            if (stamp.empty())
                either(
                    [&](const auto& r) { stamp = stamp_of(r, setting, *oracle, how); });
            examples::Measured line{name, knob, setting.value, setting.x};
            line.stamp = stamp;
            if (sweep.notebook.find(line)) continue;
            if (sweep.bar)
                either([&](const auto& r) {
                    measure(line, r, setting, *oracle, how, sweep.notebook);
                });
            sweep.add(cost_of(setting, how));
        }
    }
    if (request.only != "all") return;
    try_promises(sweep, name, room, *oracle);
}

} // namespace

/// Turns all knobs.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Request request;
        line.about("Every knob of the photon mapper: error against time and memory.");
        std::vector<std::string> words{"all"};
        words.insert(words.end(), knobs.begin(), knobs.end());
        line.add("--only", request.only, "Measure only this knob", words);
        line.add("--size", request.size, "Side of the pictures in pixels", 4, 1000);
        line.add("--seeds", request.seeds, "Pictures per setting", 3, 1000);
        line.add("--truth", request.truth, "Rays per pixel of the references", 8,
                 100000000);
        line.add("--references", request.references, "Make only the references");
        line.add("--check", request.check, "Fail if a claim of the book does not hold");
        const examples::Options options = line.parse();
        if (!line.given("--seeds")) request.seeds = options.pick(3, 5, 16);
        if (!line.given("--truth")) request.truth = options.pick(4096, 262144, 262144);
        const std::string side = std::to_string(request.size);
        const std::string seeds =
            request.references ? "parts with seeds of their own"
                               : std::to_string(request.seeds) + " seeds from 1 on";
        const std::string conditions = examples::conditions(
            options, seeds + ", pictures of " + side + " x " + side);
        Sweep sweep{
            options, request,
            examples::open_notebook(options.path("trades-notebook.json"), conditions)};
        sweep.promises.notes = {conditions};
        for (const bool measures : {false, true}) {
            if (measures) sweep.bar.emplace("the sweep", options.quiet);
            go_over(
                sweep, "cornell", [](auto t) { return cornell_box<decltype(t)>(); }, 1);
            go_over(
                sweep, "caustic", [](auto t) { return make_caustic<decltype(t)>(); },
                1);
            go_over(
                sweep, "report", [](auto t) { return four_glass_room<decltype(t)>(); },
                5);
            go_over(sweep, "matt", matt_cornell_box());
            go_over(sweep, "final", final_room());
            go_over(sweep, "materials", all_materials_room());
        }
        sweep.bar.reset(); // it wipes its line
        if (request.references) return;
        save_trades(options.path(""), sweep.notebook, {"cornell", "caustic", "report"},
                    knobs);
        if (request.only != "all") return;
        save_table(options.path(""), sweep.promises);
        save_table(options.path(""), sweep.references);
        auto claims = examples::judge(sweep.notebook);
        claims.insert(claims.end(), sweep.claims.begin(), sweep.claims.end());
        save_claims(options.path(""), claims, conditions);
        for (const auto& claim : claims) {
            if (claim.holds()) continue;
            std::fprintf(stderr, "%s\n", claim.sentence().c_str());
            if (request.check)
                throw std::runtime_error(
                    "the sweep does not show what the book says: " + claim.sentence());
        }
    });
}
