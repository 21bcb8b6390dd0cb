#pragma once

/// \file save_picture.hpp
/// \brief Saves a picture in the format that the extension of its name gives.

#include <filesystem>
#include <string>

#include "exr_files.hpp"
#include "ljus/io/hdr.hpp"
#include "ljus/io/pfm.hpp"
#include "ljus/io/png.hpp"

namespace examples {

/// The extension of a file in small letters, such as ".pfm".
[[nodiscard]] inline std::string type_of(const std::string& path) {
    std::string type = std::filesystem::path(path).extension().string();
    for (char& c : type)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return type;
}

/// Whether the extension of a file is that of EXR.
[[nodiscard]] inline bool is_exr(const std::string& path) {
    return type_of(path) == ".exr";
}

/// Saves a picture as PFM, HDR or EXR, which hold radiance, or else as PNG.
/// \param image     The picture, in linear colours.
/// \param path      The file, whose extension gives the format.
/// \param exposure  Exposure of a PNG file, in stops.
template <std::floating_point T>
void save_picture(const ljus::ImageT<T>& image, const std::string& path,
                  double exposure) {
    const std::string kind = type_of(path);
    if (kind == ".pfm")
        ljus::save_pfm(image, path);
    else if (kind == ".hdr")
        ljus::save_hdr(image, path);
    else if (is_exr(path))
        save_exr(image, path);
    else
        ljus::save_png(image, path, {.exposure = exposure});
}

} // namespace examples
