#pragma once

/// \file same_picture.hpp
/// \brief Finds out whether two programs make the same picture, by comparing their
/// settings as text.

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

/// A text that identifies a picture: all its settings and the hash of its scene.
/// Slices, checkpoints and ranks carry this text. If two texts differ, the pictures
/// differ.
/// \param settings    Names and values, as CommandLine::values() returns them.
/// \param scene_hash  FilesRead::hash() of the files of the scene; 0 if the program
///                    makes the scene itself.
/// \return One line "name: value" for each setting.
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

/// The first difference between two pictures, in words.
/// \param is     The picture_text() of a picture.
/// \param right  The text that it should have.
/// \return A clause such as "its seed is 2, and not 1"; empty if the texts are equal.
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
    return is == right ? "" : "its settings differ";
}

/// Refuses to resume the checkpoint of another picture.
/// \param checkpoint  The path of the checkpoint.
/// \param is          The picture_text() in the checkpoint.
/// \param right       The picture_text() of the picture that is to be made.
/// \throws std::invalid_argument  with the first setting that differs.
inline void require_same_picture(const std::string& checkpoint, const std::string& is,
                                 const std::string& right) {
    if (const std::string why = difference(is, right); !why.empty())
        throw std::invalid_argument("'" + checkpoint +
                                    "' is of another picture: " + why);
}

} // namespace examples
