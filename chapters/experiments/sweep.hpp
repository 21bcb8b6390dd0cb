#pragma once

/// \file chapters/experiments/sweep.hpp
/// \brief Settings that are measured against a reference, one after the other: a run
/// that was stopped continues where it was.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "common/fingerprint.hpp"
#include "common/oracle.hpp"
#include "common/plot.hpp"
#include "common/promised_picture.hpp"
#include "ljus/image/flip.hpp"
#include "ljus/render/path_tracing.hpp"

namespace examples {

/// One combination of all settings.
struct Setting {
    std::string knob{};  ///< What is turned.
    std::string value{}; ///< How far, in words.
    double x = 0;        ///< Abscissa, for slopes; 0: none.
    Recipe recipe{};     ///< All of it.
    ljus::Sampling sampling = ljus::Sampling::multi_jittered; ///< Within a pixel.
    bool paths = false;     ///< The path tracer instead.
    bool in_double = false; ///< The whole scene in double.
    bool of_maps = false;   ///< Also measure the noise due to photons.
};

/// What a setting brought. All errors are parts of relMSE, with the reference's own
/// noise taken off, but for RMSE, the trimmed one and FLIP.
struct Measured {
    std::string scene{};   ///< Which room.
    std::string knob{};    ///< What was turned.
    std::string value{};   ///< How far.
    double x = 0;          ///< The same as a number.
    double seconds = 0;    ///< Processor time of a picture, the median.
    double photons = 0;    ///< Those of the photon maps.
    double megabytes = 0;  ///< Of the photon maps.
    double rays = 0;       ///< Traced for a pixel.
    double rmse = 0;       ///< Mean over the seeds.
    double bias = 0;       ///< Its square.
    double bias_error = 0; ///< Standard error of that.
    double noise = 0;      ///< Of one picture.
    double maps = 0;       ///< The variance due to photons; 0: not measured.
    double block = 0;      ///< Of the means of 10 x 10 pixels.
    double trimmed = 0;    ///< Without the worst hundredth.
    double flip = 0;       ///< Of the first seed.
    std::string stamp{};   ///< Of all that decides it.

    /// All of it.
    [[nodiscard]] double error() const { return std::max(bias + noise, 1e-9); }
};
/// \cond
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Measured, scene, knob, value, x, seconds, photons,
                                   megabytes, rays, rmse, bias, bias_error, noise, maps,
                                   block, trimmed, flip, stamp)
/// \endcond

/// What numbers depend on, for the top of files.
/// \param options  Threads.
/// \param more     Further words, as "4 seeds".
[[nodiscard]] inline std::string conditions(const Options& options,
                                            const std::string& more) {
    std::string text =
        "Ljus " + std::to_string(LJUS_VERSION_MAJOR) + "." +
        std::to_string(LJUS_VERSION_MINOR) + "." + std::to_string(LJUS_VERSION_PATCH) +
        ", " + more + ", threads " +
        std::to_string(options.threads > 0 ? options.threads
                                           : int(std::thread::hardware_concurrency()));
#ifdef LJUS_BUILD_FLAGS
    text += ", flags " LJUS_BUILD_FLAGS;
#endif
#ifdef __VERSION__
    text += ", compiler " __VERSION__;
#endif
    std::ifstream processors("/proc/cpuinfo"); // where there is such a file
    for (std::string line; std::getline(processors, line);)
        if (line.rfind("model name", 0) == 0) {
            text += ", on" + line.substr(line.find(':') + 1);
            break;
        }
    return text;
}

/// What has been measured so far, in a file.
struct Notebook {
    std::string path{};            ///< Of a JSON file.
    std::string conditions{};      ///< Of this run.
    std::vector<Measured> lines{}; ///< In the order of measuring.

    /// The same setting, measured by the same code with the same numbers.
    [[nodiscard]] const Measured* find(const Measured& wanted) const {
        for (const Measured& line : lines)
            if (line.scene == wanted.scene && line.knob == wanted.knob &&
                line.value == wanted.value && line.stamp == wanted.stamp)
                return &line;
        return nullptr;
    }

    /// All settings of a knob; an older measurement gives way to a newer one.
    [[nodiscard]] std::vector<Measured> of(const std::string& scene,
                                           const std::string& knob) const {
        std::vector<Measured> found;
        for (const Measured& line : lines) {
            if (line.scene != scene || line.knob != knob) continue;
            const auto same = [&](const Measured& m) { return m.value == line.value; };
            const auto old = std::find_if(found.begin(), found.end(), same);
            if (old == found.end())
                found.push_back(line);
            else
                *old = line;
        }
        return found;
    }

    /// Adds a line, and saves all of them.
    void add(const Measured& line) {
        lines.push_back(line);
        const nlohmann::json json{{"conditions", conditions}, {"lines", lines}};
        save_text(path, json.dump(1) + "\n");
    }
};

/// Opens a notebook, with what is in it.
/// \param path        The file; it need not be there.
/// \param conditions  Of this run.
[[nodiscard]] inline Notebook open_notebook(const std::string& path,
                                            const std::string& conditions) {
    Notebook notebook{path, conditions};
    if (!std::filesystem::exists(path)) return notebook;
    const ljus::Bytes bytes = ljus::load_file(path, std::size_t(1) << 26);
    const auto json =
        nlohmann::json::parse(bytes.begin(), bytes.end(), nullptr, false, false);
    if (json.is_discarded() || !json.contains("lines"))
        throw std::runtime_error(path + " is no notebook of trades; remove it.");
    for (const auto& line : json["lines"])
        if (line.contains("bias_error")) // else by an older program
            notebook.lines.push_back(line);
    return notebook;
}

/// The reference of a room: one in the folder of the figures, or else the one that the
/// project has.
/// \param name    Of the room.
/// \param size    Width and height.
/// \param folders Where to look, the first one first.
/// \return None if there is none.
[[nodiscard]] inline std::optional<Oracle>
find_reference(const std::string& name, int size,
               const std::vector<std::string>& folders) {
    const std::string file = "reference-" + name + "-" + std::to_string(size);
    for (const std::string& folder : folders) {
        const std::string path = folder + "/" + file;
        if (!std::filesystem::exists(path + ".pfm")) continue;
        const ljus::Image image = ljus::load_pfm(path + ".pfm");
        const ljus::Bytes bytes = ljus::load_file(path + ".json", 1 << 16);
        const auto json = nlohmann::json::parse(bytes.begin(), bytes.end());
        Oracle oracle{.truth = ljus::make_image<double>(image.width, image.height),
                      .noise = json.at("noise"),
                      .block_noise = json.at("noise_of_blocks"),
                      .rays = json.at("rays")};
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            oracle.truth.pixels[i] = ljus::RgbT<double>(image.pixels[i]);
        return oracle;
    }
    return std::nullopt;
}

/// Saves a reference, with its own noise.
/// \param folder      Where to.
/// \param name        Of the room.
/// \param oracle      The reference.
/// \param conditions  What it depends on.
inline void save_reference(const std::string& folder, const std::string& name,
                           const Oracle& oracle, const std::string& conditions) {
    const std::string path =
        folder + "/reference-" + name + "-" + std::to_string(oracle.truth.width);
    save_pfm(oracle.truth, path + ".pfm");
    const nlohmann::ordered_json json{{"rays", oracle.rays},
                                      {"noise", oracle.noise},
                                      {"noise_of_blocks", oracle.block_noise},
                                      {"conditions", conditions}};
    save_text(path + ".json", json.dump(1) + "\n");
}

/// A picture by a setting.
/// \param room      Scene and camera.
/// \param setting   How.
/// \param picture   Size, seed, threads.
/// \param map_seed  Of the photons.
template <typename Room>
[[nodiscard]] auto shoot_setting(const Room& room, const Setting& setting,
                                 ljus::RenderSettings picture, std::uint64_t map_seed) {
    using T = typename std::remove_cvref_t<decltype(room.world)>::Scalar;
    picture.sampling = setting.sampling;
    if (!setting.paths)
        return shoot(room.world, room.camera, setting.recipe, picture,
                     processor_seconds, map_seed);
    Shot<T> shot;
    picture.samples = setting.recipe.rays;
    const double begin = processor_seconds();
    shot.rendered = render(
        ljus::PathTracer(room.world, {.max_depth = setting.recipe.settings.max_depth}),
        room.camera, picture);
    shot.rest = processor_seconds() - begin;
    return shot;
}

/// How a setting is measured.
struct Measuring {
    int size = 40;   ///< Width and height of the pictures.
    int seeds = 4;   ///< Pictures, at least 3.
    int threads = 0; ///< 0: all that there are.
};

/// About how long a setting will take, for the time that is left of a sweep: a pixel's
/// rays and a map's photons have a price each in every room.
/// \return Processor seconds of the machine that it was fitted on.
[[nodiscard]] inline double cost_of(const Setting& setting, const Measuring& how) {
    const auto& settings = setting.recipe.settings;
    const double pixels = double(how.size) * how.size;
    const double ray = setting.paths ? 1.1e-6 : 3e-6;
    const double photons = double(settings.caustics.photons) +
                           (settings.indirect == ljus::IndirectLight::rays
                                ? 0.0
                                : double(settings.general.photons));
    const double one = pixels * ray * setting.recipe.rays +
                       (setting.paths ? 0 : 0.01 + 8e-7 * photons);
    return one * how.seeds * (setting.of_maps ? 2 : 1);
}

/// A picture converted to float.
template <typename T>
[[nodiscard]] ljus::Image in_float(const ljus::ImageT<T>& picture) {
    ljus::Image image{picture.width, picture.height, {}};
    for (const auto& color : picture.pixels) image.pixels.push_back(ljus::Rgb(color));
    return image;
}

/// What a setting is known by: a small picture is its fingerprint, so that by other
/// code or other numbers it is measured anew.
template <typename Room>
[[nodiscard]] std::string stamp_of(const Room& room, const Setting& setting,
                                   const Oracle& oracle, const Measuring& how) {
    const auto seen = shoot_setting(
        room, setting, {.width = 6, .height = 6, .seed = 1, .threads = how.threads}, 1);
    stop_if_asked();
    return hex_text(hash_of(in_float(seen.rendered.image).pixels)) + "-" +
           std::to_string(how.size) + "-" + std::to_string(how.seeds) + "-" +
           std::to_string(oracle.rays);
}

/// Measures one setting.
/// \param line      Where, what and its stamp; gets the rest.
/// \param room      Scene and camera.
/// \param setting   What is measured.
/// \param oracle    The reference.
/// \param how       Size, seeds, threads.
/// \param notebook  Gets the line.
template <typename Room>
void measure(Measured line, const Room& room, const Setting& setting,
             const Oracle& oracle, const Measuring& how, Notebook& notebook) {
    const auto shot = [&](int size, int seed, int map_seed) {
        const ljus::RenderSettings picture{.width = size,
                                           .height = size,
                                           .seed = std::uint64_t(seed),
                                           .threads = how.threads};
        auto seen = shoot_setting(room, setting, picture, std::uint64_t(map_seed));
        stop_if_asked();
        return seen;
    };
    std::vector<ljus::Image> runs, of_maps;
    std::vector<double> seconds, photons;
    for (int seed = 1; seed <= how.seeds; ++seed) {
        const auto seen = shot(how.size, seed, seed);
        seconds.push_back(seen.photons + seen.rest);
        photons.push_back(seen.photons);
        line.megabytes = seen.bytes * 1e-6;
        line.rays = double(seen.rendered.counts.rays()) / how.size / how.size;
        runs.push_back(in_float(seen.rendered.image));
        line.rmse += rmse(runs.back(), oracle.truth) / how.seeds;
        line.trimmed += trimmed_rel_mse(runs.back(), oracle.truth) / how.seeds;
        if (setting.of_maps)
            of_maps.push_back(in_float(shot(how.size, 1, 1000 + seed).rendered.image));
    }
    for (auto* times : {&seconds, &photons}) std::sort(times->begin(), times->end());
    line.seconds = std::max(seconds[seconds.size() / 2], 1e-6);
    line.photons = photons[photons.size() / 2];
    const auto parts = relative_split(runs, oracle.truth, oracle.noise);
    const auto blocks = relative_split(runs, oracle.truth, oracle.block_noise, 10);
    line.bias = parts.bias_squared;
    line.bias_error = relative_bias_error(runs, oracle.truth);
    line.noise = parts.variance;
    line.block = blocks.bias_squared + blocks.variance;
    if (setting.of_maps) line.maps = relative_split(of_maps, oracle.truth).variance;
    line.flip = flip(runs[0], oracle.truth);
    notebook.add(line);
}

} // namespace examples
