/// \file compare.cpp
/// \brief Measures how much a picture differs from a reference: ljus-compare.
///
///     ljus-compare picture.pfm reference.pfm
///     ljus-compare picture.pfm reference.pfm --out map.png
///     ljus-compare seed1.pfm reference.pfm --pieces seed2.pfm seed3.pfm

#include <algorithm>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "common/error_map.hpp"
#include "common/program_files.hpp"
#include "common/save_picture.hpp"
#include "ljus/image/hdr_flip.hpp"
#include "ljus/inspect/estimate.hpp"
#include "ljus/inspect/metrics.hpp"
#include "ljus/io/load_image.hpp"

using namespace ljus;

namespace {

/// A picture of finite radiances.
Image load(const std::string& path) {
    const std::string type = examples::type_of(path);
    const Image image = type == ".pfm"   ? load_pfm(path)
                        : type == ".hdr" ? load_hdr(path)
                        : type == ".exr" ? examples::load_exr(path)
                                         : load_image(path);
    for (int i = 0; i < int(image.pixels.size()); ++i)
        if (!is_finite(image.pixels[std::size_t(i)]))
            throw std::runtime_error(
                "the pixel in column " + std::to_string(i % image.width) + ", row " +
                std::to_string(i / image.width) + " of '" + path + "' is not finite");
    return image;
}

/// All measures of a picture and of its other runs, by their names.
nlohmann::ordered_json measures(const std::vector<Image>& runs, const Image& reference,
                                double epsilon) {
    const Image& image = runs.front();
    const auto level = [](const Image& of) { // the mean over pixels and channels
        const auto mean = block_means(of, std::max(of.width, of.height)).pixels[0];
        return (mean.x + mean.y + mean.z) / 3;
    };
    const double mean = level(image), right = level(reference);
    if (epsilon == 0) epsilon = right == 0 ? default_epsilon : 0.01 * right * right;
    nlohmann::ordered_json all{
        {"mean", mean},
        {"reference mean", right},
        {"RMSE", rmse(image, reference)},
        {"relMSE", rel_mse(image, reference, epsilon)},
        {"epsilon", epsilon},
        {"trimmed relMSE", trimmed_rel_mse(image, reference, 0.01, epsilon)},
        {"block relMSE", block_error(image, reference, 10, epsilon)},
        {"FLIP", flip(image, reference)},
        {"HDR-FLIP", hdr_flip(image, reference)}};
    if (right != 0) all["difference %"] = 100 * (mean - right) / right;
    if (runs.size() < 2) return all;
    const auto off = block_deviations(runs, reference);
    all["block means"] = off.size();
    all["off by 3 errors"] =
        std::count_if(off.begin(), off.end(), [](double errors) { return errors > 3; });
    all["by noise alone"] = double(off.size()) * chance_beyond(3, double(runs.size()));
    return all;
}

void body(examples::CommandLine& line) {
    std::string path, truth;
    std::vector<std::string> pieces;
    double epsilon = default_epsilon;
    bool json = false;
    line.about("How much a picture differs from a reference. PFM, HDR and EXR files "
               "hold radiance; others, such as PNG, are converted to linear first. "
               "--out NAME.png draws a map of HDR-FLIP.");
    line.without({"--quality", "--seed", "--threads", "--width", "--height", "--rays"});
    line.add_positional("PICTURE", path, "The picture");
    line.add_positional("REFERENCE", truth, "The truth");
    line.file_types({".png"});
    line.add("--epsilon", epsilon, "Of relMSE; 0: (0.1 times the reference's mean)^2",
             0, 1e12);
    line.add("--pieces", pieces, "Runs with other seeds, which tell bias from noise");
    line.add("--json", json, "One line of JSON");
    const examples::Options options = line.parse();
    const bool draws = line.given("--out");
    const std::string map =
        options.path(options.file.empty() ? "error-map.png" : options.file);
    pieces.insert(pieces.begin(), path);
    pieces.push_back(truth);
    examples::require_outputs({{"--out", draws ? map : ""}}, pieces);

    std::vector<Image> runs;
    for (const std::string& file : pieces) runs.push_back(load(file));
    const Image reference = std::move(runs.back());
    runs.pop_back();
    const auto found = measures(runs, reference, epsilon);
    if (json) {
        std::puts(found.dump().c_str());
    } else if (!options.quiet) {
        std::printf("%s against %s, %d x %d pixels\n", path.c_str(), truth.c_str(),
                    reference.width, reference.height);
        for (const auto& [name, value] : found.items())
            std::printf("  %-16s %.5g\n", name.c_str(), value.get<double>());
    }
    if (!draws) return;
    save_png(error_picture(hdr_flip_map(runs.front(), reference), examples::Ramp::heat,
                           0, 1),
             map);
    if (!options.quiet && !json) std::printf("  %s\n", map.c_str());
}

} // namespace

/// Compares two pictures.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, body);
}
