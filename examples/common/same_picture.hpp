#pragma once

/// \file same_picture.hpp
/// \brief Do two programs make the same picture? Its settings as a text, and the first
/// one that differs.

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fingerprint.hpp"
#include "ljus/io/file_beside.hpp"
#include "ljus/version.hpp"

namespace examples {

/// What a picture is made by: its settings, and of what. Slices, checkpoints and ranks
/// carry it; two that differ are not of one picture.
/// \param settings    Names and values, as CommandLine::values() returns them.
/// \param scene_hash  Of the files of the scene as they were read: FilesRead::hash();
///                    0: the scene is the program's own.
/// \return One line "name: value" for each.
[[nodiscard]] inline std::string
picture_text(const std::vector<std::pair<std::string, std::string>>& settings,
             std::uint64_t scene_hash = 0) {
    std::string text = "scene_hash: " + hex_text(scene_hash) +
                       "\nversion: " + std::to_string(LJUS_VERSION_MAJOR) + "." +
                       std::to_string(LJUS_VERSION_MINOR) + "." +
                       std::to_string(LJUS_VERSION_PATCH) + "\n";
    for (const auto& [name, value] : settings) text += name + ": " + value + "\n";
    return text;
}

/// Why two pictures are not the same.
/// \param is     Lines "name: value" of one.
/// \param right  Those of the one that it should be.
/// \return "its seed is 2, and not 1", for the first line that differs; or nothing.
[[nodiscard]] inline std::string difference(std::string_view is,
                                            std::string_view right) {
    const auto take_line = [](std::string_view& text) {
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        return line;
    };
    const auto value_in = [&](std::string_view text, std::string_view name) {
        while (!text.empty())
            if (const auto line = take_line(text); line.starts_with(name))
                return ljus::shown(std::string(line.substr(name.size())), 200);
        return std::string("nothing");
    };
    for (std::string_view rest : {right, is})
        while (!rest.empty()) {
            const std::string_view line = take_line(rest);
            const std::size_t end = std::min(line.find(": "), line.size());
            const std::string_view name = line.substr(0, end + 2);
            const std::string a = value_in(is, name), b = value_in(right, name);
            if (a != b)
                return "its " + ljus::shown(std::string(line.substr(0, end))) + " is " +
                       a + ", and not " + b;
        }
    return is == right ? "" : "its settings are others";
}

/// Refuses to go on with the checkpoint of another picture.
/// \param checkpoint  Its name.
/// \param is          The picture_text() in it.
/// \param right       That of the picture that is to be made.
/// \throws std::invalid_argument  with the first setting that differs.
inline void require_same_picture(const std::string& checkpoint, const std::string& is,
                                 const std::string& right) {
    if (const std::string why = difference(is, right); !why.empty())
        throw std::invalid_argument("'" + checkpoint +
                                    "' is of another picture: " + why);
}

} // namespace examples
