#pragma once

/// \file layer_options.hpp
/// \brief The layers of `render --layers`: their names, and their files.

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ljus/io/nearest_word.hpp"
#include "ljus/render/layers.hpp"
#include "program_files.hpp"
#include "save_picture.hpp"

namespace examples {

/// The name of a layer within the name of a file, such as "albedo" or "Z".
template <std::floating_point T>
[[nodiscard]] std::string short_name(const ljus::LayerT<T>& layer) {
    return layer.name.empty() ? layer.channels.front() : layer.name;
}

/// The layers of --layers.
/// \param text  Words separated by commas: normal, albedo, depth, position, object,
///              light-paths, or NAME=CLASS for the light of a class of paths.
/// \throws std::invalid_argument  for an unknown word, an invalid class, or a name that
///         occurs twice.
[[nodiscard]] inline ljus::LayerSettings layer_settings(const std::string& text) {
    ljus::LayerSettings which;
    const std::vector<std::pair<std::string, bool ljus::LayerSettings::*>> surfaces{
        {"normal", &ljus::LayerSettings::normal},
        {"albedo", &ljus::LayerSettings::albedo},
        {"depth", &ljus::LayerSettings::depth},
        {"position", &ljus::LayerSettings::position},
        {"object", &ljus::LayerSettings::object}};
    const auto add_paths = [&](const ljus::PathLayer& layer) {
        (void)ljus::light_path_expression(layer.paths); // throws if invalid
        which.paths.push_back(layer);
    };
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        const std::string word = text.substr(at, end - at);
        at = end + 1;
        const std::size_t equals = word.find('=');
        const auto known = std::find_if(surfaces.begin(), surfaces.end(),
                                        [&](const auto& s) { return s.first == word; });
        if (known != surfaces.end()) {
            which.*known->second = true;
        } else if (word == "light-paths") {
            for (const ljus::PathLayer& layer : ljus::light_path_layers())
                add_paths(layer);
        } else if (equals != std::string::npos && equals > 0 &&
                   word.find_first_not_of("abcdefghijklmnopqrstuvwxyz"
                                          "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_") ==
                       equals) {
            add_paths({word.substr(0, equals), word.substr(equals + 1)});
        } else {
            std::vector<std::string> words{"light-paths"};
            for (const auto& surface : surfaces) words.push_back(surface.first);
            const std::string near = ljus::nearest_word(word, words);
            throw std::invalid_argument(
                "--layers has the word '" + word + "'; " +
                (near.empty() ? "it" : "did you mean " + near + "? It") +
                " may have normal, albedo, depth, position, object, light-paths and "
                "NAME=CLASS, as in glass=ES+.*L");
        }
    }
    std::vector<std::string> names;
    for (const ljus::Layer& layer : ljus::make_layers<float>(which, 1, 1)) {
        const std::string name = short_name(layer);
        if (std::find(names.begin(), names.end(), name) != names.end())
            throw std::invalid_argument("--layers has two layers with the name '" +
                                        name + "'; each must have one of its own");
        names.push_back(name);
    }
    return which;
}

/// The file of a layer if the picture is not an EXR file, such as "room.albedo.pfm" for
/// "room.png".
template <std::floating_point T>
[[nodiscard]] std::string layer_file(const std::string& picture,
                                     const ljus::LayerT<T>& layer) {
    return std::filesystem::path(picture)
        .replace_extension("." + short_name(layer) + ".pfm")
        .string();
}

/// Saves a picture and its layers: as one EXR file, or as a picture and a PFM file for
/// each layer.
/// \param image     The picture.
/// \param layers    Its layers.
/// \param path      The file of the picture.
/// \param exposure  Exposure of a PNG file, in stops.
template <std::floating_point T>
void save_with_layers(const ljus::ImageT<T>& image, std::vector<ljus::LayerT<T>> layers,
                      const std::string& path, double exposure) {
    if (is_exr(path)) {
        layers.push_back({.image = image});
        return save_exr_layers(layers, path);
    }
    save_picture(image, path, exposure);
    for (const ljus::LayerT<T>& layer : layers)
        ljus::save_pfm(layer.image, layer_file(path, layer));
}

} // namespace examples
