/// \file compare.cpp
/// \brief Measures how much a picture differs from a reference: ljus-compare.
///
///     ljus-compare picture.pfm reference.pfm
///     ljus-compare picture.pfm reference.pfm --map flip --out map.png
///     ljus-compare seed1.pfm reference.pfm --pieces seed2.pfm seed3.pfm

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/error_map.hpp"
#include "common/plot.hpp"
#include "common/program_files.hpp"
#include "common/save_picture.hpp"
#include "ljus/image/hdr_flip.hpp"
#include "ljus/inspect/metrics.hpp"
#include "ljus/io/hdr.hpp"
#include "ljus/io/load_image.hpp"
#include "ljus/io/pfm.hpp"
#include "ljus/io/png.hpp"

namespace {

using namespace ljus;
using Map = ImageT<double>;
using examples::text;

/// The options of this program, without those that all programs share.
struct Request {
    std::string image;
    std::string reference;
    std::vector<std::string> pieces{};
    std::string map = "none";
    std::string blocks{};
    int block = 10;
    double epsilon = default_epsilon;
    double trimmed = 0.01;
    double exposure = 0;
    double ppd = 67.0;
    double range = 0;
    bool json = false;
};

/// A picture that can be compared.
Image load(const std::string& path) {
    const std::string type = examples::type_of(path);
    const Image image = type == ".pfm"   ? load_pfm(path)
                        : type == ".hdr" ? load_hdr(path)
                        : type == ".exr" ? examples::load_exr(path)
                                         : load_image(path);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (is_finite(image.pixels[i])) continue;
        const auto width = static_cast<std::size_t>(image.width);
        throw std::runtime_error("the pixel in column " + std::to_string(i % width) +
                                 ", row " + std::to_string(i / width) + " of '" + path +
                                 "' is not finite, so that no error can be measured");
    }
    return image;
}

/// Refuses pictures of different size, with a sentence that names both files.
void require_alike(const Image& a, const std::string& a_path, const Image& b,
                   const std::string& b_path) {
    if (a.width == b.width && a.height == b.height) return;
    const auto size = [](const Image& image) {
        return std::to_string(image.width) + " x " + std::to_string(image.height);
    };
    throw std::runtime_error("'" + a_path + "' has " + size(a) + " pixels and '" +
                             b_path + "' " + size(b) +
                             ": they must have the same size");
}

/// The mean over pixels and channels.
double level_of(const Image& image) {
    double sum = 0;
    for (const Rgb& c : image.pixels) sum += double(c.x) + double(c.y) + double(c.z);
    return sum / 3 / double(image.pixels.size());
}

/// The errors of a picture, in the order in which they are printed.
struct Errors {
    double mean = 0;     ///< Mean of the picture.
    double truth = 0;    ///< Mean of the reference.
    double rmse = 0;     ///< Result of rmse().
    double relative = 0; ///< Result of rel_mse().
    double trimmed = 0;  ///< Result of trimmed_rel_mse().
    double block = 0;    ///< Result of block_error().
    double flip = 0;     ///< Result of flip(), for the picture as a screen shows it.
    double hdr_flip = 0; ///< Result of hdr_flip().

    /// Difference of the means in per cent of the reference; NaN if that is black.
    [[nodiscard]] double per_cent() const {
        return truth == 0 ? std::numeric_limits<double>::quiet_NaN()
                          : 100 * (mean - truth) / truth;
    }
};

Errors errors_of(const Image& image, const Image& reference, const Request& request) {
    const auto seen = [&request](const Image& picture) {
        Image result = picture;
        for (Rgb& c : result.pixels) c *= float(std::exp2(request.exposure));
        return result;
    };
    return {.mean = level_of(image),
            .truth = level_of(reference),
            .rmse = rmse(image, reference),
            .relative = rel_mse(image, reference, request.epsilon),
            .trimmed =
                trimmed_rel_mse(image, reference, request.trimmed, request.epsilon),
            .block = block_error(image, reference, request.block, request.epsilon),
            .flip = flip(seen(image), seen(reference), request.ppd),
            .hdr_flip = hdr_flip(image, reference, request.ppd)};
}

void print(const Errors& errors, const Request& request, const Image& image) {
    const std::string per_cent = text(errors.per_cent(), "%+.2f %%");
    std::printf("%s against %s, %d x %d pixels\n", request.image.c_str(),
                request.reference.c_str(), image.width, image.height);
    std::printf("  %-16s %-12.5g reference %.5g, difference %s\n", "mean", errors.mean,
                errors.truth,
                per_cent.empty() ? "unknown: it is black" : per_cent.c_str());
    std::printf("  %-16s %.5g\n", "RMSE", errors.rmse);
    std::printf("  %-16s %-12.5g epsilon %g\n", "relMSE", errors.relative,
                request.epsilon);
    std::printf("  %-16s %-12.5g without the worst %g %% of the pixels\n", "trimmed",
                errors.trimmed, 100 * request.trimmed);
    std::printf("  %-16s %-12.5g means of %d x %d pixels\n", "block error",
                errors.block, request.block, request.block);
    std::printf("  %-16s %-12.5g exposure %g, %g pixels a degree\n", "FLIP",
                errors.flip, request.exposure, request.ppd);
    std::printf("  %-16s %-12.5g the worst of all exposures\n", "HDR-FLIP",
                errors.hdr_flip);
}

void print_json(const Errors& errors, const Request& request) {
    const std::string per_cent = text(errors.per_cent(), "%.6g");
    std::printf("{\"mean\": %.9g, \"reference_mean\": %.9g, \"per_cent\": %s, "
                "\"rmse\": %.9g, \"rel_mse\": %.9g, \"epsilon\": %.9g, "
                "\"trimmed_rel_mse\": %.9g, \"block_error\": %.9g, \"block\": %d, "
                "\"flip\": %.9g, \"exposure\": %.9g, \"ppd\": %.9g, "
                "\"hdr_flip\": %.9g}\n",
                errors.mean, errors.truth, per_cent.empty() ? "null" : per_cent.c_str(),
                errors.rmse, errors.relative, request.epsilon, errors.trimmed,
                errors.block, request.block, errors.flip, request.exposure, request.ppd,
                errors.hdr_flip);
}

/// The probability that a mean of normally distributed numbers is off by more than `z`
/// standard errors, on either side. The standard error is estimated from the same
/// numbers, which gives Student's distribution.
/// \param z     The number of standard errors, above 0.
/// \param runs  How many numbers, at least 2.
double chance_beyond(double z, std::size_t runs) {
    const double freedom = double(runs) - 1;
    constexpr int steps = 1000; // steps of the midpoint rule, from 0 to z
    double inside = 0;
    for (int i = 0; i < steps; ++i) {
        const double t = z * (i + 0.5) / steps;
        inside += z / steps * std::pow(1 + t * t / freedom, -(freedom + 1) / 2);
    }
    const double scale =
        std::exp(std::lgamma((freedom + 1) / 2) - std::lgamma(freedom / 2)) /
        std::sqrt(freedom * std::numbers::pi);
    return 1 - 2 * scale * inside;
}

/// Compares the mean of several runs with the reference, block by block, and finds the
/// blocks that differ by more than their noise.
void blocks(const Image& image, const Image& reference, const Request& request) {
    std::vector<Image> runs{image};
    for (const std::string& path : request.pieces) {
        runs.push_back(load(path));
        require_alike(runs.back(), path, image, request.image);
    }
    const BlockStatistics found = block_statistics(runs, request.block);
    const Map truth = block_means(reference, request.block);
    std::vector<std::string> lines;
    int beyond = 0, count = 0;
    double worst = 0, errors = 0;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const double mean = pixel(found.mean, x, y)[c];
                const double right = pixel(truth, x, y)[c];
                const double sure = pixel(found.standard_error, x, y)[c];
                const double off = mean - right;
                const double z = off == 0 ? 0 : off / sure; // infinite without noise
                ++count;
                if (std::abs(z) > 3) ++beyond;
                worst = std::max(worst, std::abs(z));
                errors += sure * sure;
                lines.push_back(examples::csv_line(
                    {std::to_string(x), std::to_string(y), std::string(1, "rgb"[c]),
                     text(mean, "%.9g"), text(sure, "%.9g"), text(right, "%.9g"),
                     text(z, "%.4g")}));
            }
    if (!request.json)
        std::printf("  %-16s %zu runs, %d x %d blocks of three channels: standard "
                    "error %.4g;\n  %-16s %d of %d are off by more than 3 of their "
                    "own, where noise alone makes %.1f; the worst by %.3g\n",
                    "blocks", runs.size(), truth.width, truth.height,
                    std::sqrt(errors / count), "", beyond, count,
                    count * chance_beyond(3, runs.size()), worst);
    if (request.blocks.empty()) return;
    std::string table = "x,y,channel,mean,standard error,reference,z\n";
    for (const std::string& line : lines) table += line;
    examples::save_text(request.blocks, table);
}

/// A map of numbers, and the colours in which it is drawn.
void save_map(const Image& image, const Image& reference, const Request& request,
              const std::string& path) {
    Map map = make_image<double>(image.width, image.height);
    const bool signs = request.map == "difference";
    double high = 1;
    if (request.map == "flip") {
        map = hdr_flip_map(image, reference, request.ppd);
    } else {
        std::vector<double> sizes;
        for (std::size_t i = 0; i < map.pixels.size(); ++i) {
            const RgbT<double> r(reference.pixels[i]), x(image.pixels[i]);
            const double y = luminance(r), base = std::sqrt(y * y + request.epsilon);
            double value = (luminance(x) - y) / base;
            if (!signs) {
                value = 0;
                for (int c = 0; c < 3; ++c)
                    value += (x[c] - r[c]) * (x[c] - r[c]) /
                             (r[c] * r[c] + request.epsilon) / 3;
                value = std::sqrt(value);
            }
            map.pixels[i] = RgbT<double>(value);
            sizes.push_back(std::abs(value));
        }
        // 99 % of the numbers are within the range of the colours.
        const auto most = sizes.begin() + std::ptrdiff_t(0.99 * double(sizes.size()));
        std::nth_element(sizes.begin(), most, sizes.end());
        high = *most > 0 ? *most : 1;
    }
    if (request.range > 0) high = request.range;
    save_png(error_picture(map, signs ? examples::Ramp::signs : examples::Ramp::heat,
                           signs ? -high : 0, high),
             path);
}

void body(examples::CommandLine& line) {
    Request request;
    line.about("How much a picture differs from a reference. PFM, HDR and EXR files "
               "hold radiance; others, such as PNG, are converted to linear first.");
    line.without({"--quality", "--seed", "--threads", "--width", "--height", "--rays"});
    line.add_positional("PICTURE", request.image, "The picture");
    line.add_positional("REFERENCE", request.reference, "The truth");
    line.file_types({".png"});
    line.add("--epsilon", request.epsilon,
             "Of relMSE: radiance squared; 0: (0.1 times the reference's mean)^2", 0,
             1e12);
    line.add("--trimmed", request.trimmed, "Fraction of the pixels left out", 0, 0.5);
    line.add("--block", request.block, "Side of a block in pixels", 1, 65536);
    line.add("--exposure", request.exposure, "Of FLIP, in stops", -100, 100);
    line.add("--ppd", request.ppd, "Pixels per degree, for FLIP", 1, 1000);
    line.add("--pieces", request.pieces,
             "More runs like PICTURE with other seeds: each block's standard error");
    line.add("--blocks", request.blocks, "CSV file for the blocks' means and errors");
    line.add(
        "--map", request.map,
        "Map of the errors, written to --out (error-map.png): FLIP, relative to the\n"
        "reference, or which pixels are brighter and which darker",
        {"none", "flip", "relative", "difference"});
    line.add("--range", request.range,
             "Range of the map's colours; 0: chosen by the errors", 0, 1e12);
    line.add("--json", request.json, "One line of JSON");
    const examples::Options options = line.parse();
    if (!request.blocks.empty() && request.pieces.empty())
        throw std::invalid_argument("--blocks needs --pieces: one run alone gives no "
                                    "standard error");
    const std::string map_path =
        options.path(options.file.empty() ? "error-map.png" : options.file);
    if (line.given("--out") && request.map == "none") request.map = "flip";
    if (line.given("--range") && request.map == "none")
        throw std::invalid_argument("--range needs --map: it is that of its colours");
    std::vector<std::string> pictures = request.pieces;
    pictures.insert(pictures.end(), {request.image, request.reference});
    examples::require_outputs({{"--out", request.map != "none" ? map_path : ""},
                               {"--blocks", request.blocks}},
                              pictures);

    const Image image = load(request.image);
    const Image reference = load(request.reference);
    require_alike(image, request.image, reference, request.reference);
    if (request.epsilon == 0) {
        const double dark = 0.1 * level_of(reference);
        request.epsilon = dark != 0 ? dark * dark : default_epsilon;
    }
    const Errors errors = errors_of(image, reference, request);
    if (request.json)
        print_json(errors, request);
    else if (!options.quiet)
        print(errors, request, image);
    if (!request.pieces.empty()) blocks(image, reference, request);
    if (request.map == "none") return;
    save_map(image, reference, request, map_path);
    if (!options.quiet && !request.json) std::printf("  %s\n", map_path.c_str());
}

} // namespace

/// Compares two pictures.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, body);
}
