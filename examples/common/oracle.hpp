#pragma once

/// \file examples/common/oracle.hpp
/// \brief The common header of examples that measure errors. A reference picture is
/// rendered once and kept in files; the errors of other pictures are measured against
/// it.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/convergence.hpp"
#include "common/example.hpp"
#include "common/fingerprint.hpp"
#include "ljus/io/pfm.hpp"
#include "ljus/render/path_tracing.hpp"

namespace examples {

/// A reference picture with its accuracy.
struct Oracle {
    ljus::ImageT<double> truth{}; ///< The reference: the mean of all pieces.
    double noise = 0; ///< Variance of the reference, as its contribution to relMSE.
    double block_noise = 0; ///< The same for means of 10 x 10 pixels.
    int rays = 0;           ///< Rays per pixel in all pieces.
};

/// The reference picture of a room. It is rendered by path tracing without a limit on
/// depth, in eight pieces, whose variance gives the error of the reference.
///
/// The pieces are kept as files oracle-NAME-....pfm in the folder of the figures, where
/// other programs find them. The name of a file contains the fingerprint of a small
/// picture of the room. If the room or the path tracer has changed, the pieces are
/// therefore rendered again.
/// \param name     The name of the room, for the files.
/// \param room     A room with members `world` and `camera`.
/// \param size     Width and height in pixels.
/// \param rays     Rays per pixel, divided among the pieces.
/// \param options  Folder and threads; the seed is not used.
/// \return The reference.
template <typename Room>
[[nodiscard]] Oracle find_oracle(const std::string& name, const Room& room, int size,
                                 int rays, const Options& options) {
    constexpr int pieces = 8;
    const int part = std::max(1, rays / pieces);
    const ljus::PathTracer tracer(room.world);
    const auto shot = [&](int side, int samples, std::uint64_t seed) {
        return rendered(
                   "reference of " + name, tracer, room.camera,
                   {.width = side, .height = side, .samples = samples, .seed = seed},
                   options)
            .image;
    };
    const std::string stamp = hex_text(hash_of(shot(16, 4, 1).pixels)).substr(0, 8);

    Oracle oracle{.truth = ljus::make_image<double>(size, size), .rays = part * pieces};
    std::vector<ljus::Image> runs;
    for (int piece = 0; piece < pieces; ++piece) {
        const std::string path = options.path(
            "oracle-" + name + "-" + std::to_string(size) + "-" + std::to_string(part) +
            "-" + stamp + "-" + std::to_string(piece) + ".pfm");
        if (!std::filesystem::exists(path))
            ljus::save_pfm(shot(size, part, 9000 + std::uint64_t(piece)), path);
        runs.push_back(ljus::load_pfm(path));
        for (std::size_t i = 0; i < runs.back().pixels.size(); ++i)
            oracle.truth.pixels[i] +=
                ljus::RgbT<double>(runs.back().pixels[i]) / double(pieces);
    }
    oracle.noise = relative_split(runs, oracle.truth).variance / pieces;
    oracle.block_noise = relative_split(runs, oracle.truth, 0, 10).variance / pieces;
    return oracle;
}

/// Bias and variance of some pictures, as parts of their relMSE.
struct OracleErrors {
    ljus::BiasVariance pixels{}; ///< Pixel by pixel.
    ljus::BiasVariance blocks{}; ///< Errors of the means of 10 x 10 pixels.
};

/// The error of pictures of one renderer. The error of the reference is subtracted.
/// \param runs    At least 2 pictures of the size of the reference, with independent
///                seeds.
/// \param oracle  The reference.
[[nodiscard]] inline OracleErrors errors_against(const Oracle& oracle,
                                                 const std::vector<ljus::Image>& runs) {
    return {relative_split(runs, oracle.truth, oracle.noise),
            relative_split(runs, oracle.truth, oracle.block_noise, 10)};
}

} // namespace examples
