#pragma once

/// \file examples/common/oracle.hpp
/// \brief The common header of examples that measure errors: a reference that is
/// rendered once and kept in files, and the error of pictures against it.

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

/// A reference picture, and how accurate it is.
struct Oracle {
    ljus::ImageT<double> truth{}; ///< The mean of all pieces.
    double noise = 0;             ///< Its own variance, as its contribution to relMSE.
    double block_noise = 0;       ///< The same of its blocks of 10 x 10 pixels.
    int rays = 0;                 ///< Rays per pixel in all pieces.
};

/// The reference picture of a room: path tracing without a limit on depth, in eight
/// pieces whose variance gives its error.
///
/// The pieces are kept as oracle-NAME-....pfm beside the figures, where the next
/// program finds them. Their names hold the fingerprint of a small picture of the room,
/// so that they are rendered again if the room or the path tracer has changed.
/// \param name     The name of the room, for the files.
/// \param room     With a `world` and a `camera`.
/// \param size     Width and height in pixels.
/// \param rays     Rays per pixel, divided among the pieces.
/// \param options  Folder and threads; the seed is the oracle's own.
/// \return The truth.
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
    ljus::BiasVariance blocks{}; ///< Of the means of 10 x 10 pixels.
};

/// The error of pictures of one renderer; that of the reference is subtracted.
/// \param runs    At least 2, of independent seeds and the reference's size.
/// \param oracle  The reference.
[[nodiscard]] inline OracleErrors errors_against(const Oracle& oracle,
                                                 const std::vector<ljus::Image>& runs) {
    return {relative_split(runs, oracle.truth, oracle.noise),
            relative_split(runs, oracle.truth, oracle.block_noise, 10)};
}

} // namespace examples
