#pragma once

/// \file exr_files.hpp
/// \brief Reads and writes EXR files in programs that were built with OpenEXR. In other
/// programs the same functions throw an error that says so.

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ljus/image/image.hpp"

#ifdef LJUS_HAS_OPENEXR
#include "ljus/io/exr.hpp"
#endif

namespace examples {

/// The extensions of the pictures that a program can write.
[[nodiscard]] inline std::vector<std::string> picture_types() {
#ifdef LJUS_HAS_OPENEXR
    return {".png", ".hdr", ".pfm", ".exr"};
#else
    return {".png", ".hdr", ".pfm"};
#endif
}

#ifdef LJUS_HAS_OPENEXR

using ljus::load_exr;
using ljus::load_exr_layers;
using ljus::save_exr;
using ljus::save_exr_layers;

/// Adds EXR pictures to the files that a reader of mesh files can read.
template <typename Files>
[[nodiscard]] auto with_exr(Files files) {
    return ljus::WithExr{std::move(files)};
}

#else

/// Throws an error that says that the program was built without OpenEXR.
/// \throws std::runtime_error  always.
[[noreturn]] inline void no_exr(const std::string& path) {
    throw std::runtime_error("'" + path +
                             "' is an EXR file, and this program was built without "
                             "OpenEXR: install it (libopenexr-dev) and build again");
}

template <std::floating_point T = float>
ljus::ImageT<T> load_exr(const std::string& path) {
    no_exr(path);
}

template <std::floating_point T = float>
std::vector<ljus::LayerT<T>> load_exr_layers(const std::string& path) {
    no_exr(path);
}

template <std::floating_point T>
void save_exr(const ljus::ImageT<T>&, const std::string& path) {
    no_exr(path);
}

template <std::floating_point T>
void save_exr_layers(const std::vector<ljus::LayerT<T>>&, const std::string& path) {
    no_exr(path);
}

template <typename Files>
[[nodiscard]] Files with_exr(Files files) {
    return files;
}

#endif

} // namespace examples
