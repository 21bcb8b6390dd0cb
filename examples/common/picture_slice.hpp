#pragma once

/// \file picture_slice.hpp
/// \brief Some rows of a picture as a file, and such files put together: how a picture
/// is rendered by machines that know nothing of each other.
///
/// A file of a slice is 16 letters that say what it is; version, number and count of
/// the slices, bytes of a channel and a checksum; then the size of the whole, exposure,
/// cost, settings as JSON text, and the rows from the top, every number with all its
/// bits, lowest byte first. It is written whole or not at all (save_file()).

#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "command_line.hpp"
#include "ljus/io/binary_file.hpp"
#include "ljus/path/renderer.hpp"
#include "ljus/render/render.hpp"
#include "picture_cost.hpp"
#include "same_picture.hpp"

namespace examples {

/// Which of how many slices: 3/16 is the third, 16/16 the last.
struct SliceNumber {
    int number = 0; ///< From 1 on; 0 if the picture is not sliced.
    int count = 0;  ///< How many there are.
};

/// The most slices of a picture.
inline constexpr int max_slices = 65536;

/// "3/16".
[[nodiscard]] inline std::string slice_text(const SliceNumber& slice) {
    return std::to_string(slice.number) + "/" + std::to_string(slice.count);
}

/// The number of "3/16".
/// \param text  What the user gave.
/// \return The number.
/// \throws std::invalid_argument  if it is no slice.
[[nodiscard]] inline SliceNumber slice_of(const std::string& text) {
    const auto numbers = two_numbers(text, '/');
    if (!numbers || numbers->first < 1 || numbers->first > numbers->second ||
        numbers->second > max_slices)
        throw std::invalid_argument("--slice is '" + text +
                                    "'; it must be K/N, from 1/N to N/N, with N at "
                                    "most " +
                                    std::to_string(max_slices));
    return {numbers->first, numbers->second};
}

/// The rows of a slice: with more slices than rows some have none.
/// \param slice   Which one.
/// \param height  Of the whole picture.
// [rows]
[[nodiscard]] inline ljus::RowRange rows_of(const SliceNumber& slice, int height) {
    const auto begin = [&](long long number) {
        return static_cast<int>(height * number / slice.count);
    };
    return {begin(slice.number - 1), begin(slice.number)};
}
// [rows]

/// A part of a picture, and all that tells whose part it is.
struct PictureSlice {
    SliceNumber slice{};    ///< Which part.
    int width = 0;          ///< Of the whole picture.
    int height = 0;         ///< Of the whole picture.
    bool wide = false;      ///< Rendered in double.
    double exposure = 0;    ///< Of a PNG file of the whole, in stops.
    std::string settings{}; ///< JSON: scene, its hash, and every setting.
    ljus::Counts counts{};  ///< What its rows cost.
    double seconds = 0;     ///< Photons and rows.
    std::vector<ljus::RgbT<double>> pixels{}; ///< Its rows, from the top.
};

namespace detail {

inline constexpr ljus::FileFormat slice_format{"ljus picturepart", 1};

// Calls `each` with every number between the header and the settings' text.
template <typename Slice, typename Each>
void each_slice_number(Slice& part, Each each) {
    each(part.exposure);
    each(part.seconds);
    for (auto* count :
         {&part.counts.camera_rays, &part.counts.bounce_rays, &part.counts.shadow_rays,
          &part.counts.map_queries, &part.counts.map_photons, &part.counts.skipped_rays,
          &part.counts.skipped_bounces, &part.counts.rejected, &part.counts.cut_paths})
        each(*count);
}

} // namespace detail

/// Saves a slice: whole, or not at all.
/// \param path  The file; an older one is replaced at the very end.
/// \param part  The slice.
inline void save_slice(const std::string& path, const PictureSlice& part) {
    using ljus::put_number;
    ljus::Bytes bytes = ljus::file_front(
        detail::slice_format, std::uint32_t(part.slice.number),
        std::uint32_t(part.slice.count), std::uint32_t(part.wide ? 8 : 4));
    put_number(bytes, std::uint32_t(part.width));
    put_number(bytes, std::uint32_t(part.height));
    detail::each_slice_number(part,
                              [&](const auto& number) { put_number(bytes, number); });
    put_number(bytes, std::uint64_t(part.settings.size()));
    bytes.insert(bytes.end(), part.settings.begin(), part.settings.end());
    for (const ljus::RgbT<double>& color : part.pixels)
        if (part.wide)
            ljus::put_vector(bytes, color);
        else
            ljus::put_vector(bytes, ljus::Rgb(color));
    ljus::put_checksum(bytes);
    ljus::save_file(path, bytes);
}

/// Loads a slice.
/// \param path  The file.
/// \return The slice, bit by bit as it was saved.
/// \throws std::runtime_error  with path and reason: what is cut short, damaged, of
///         another version or no slice is refused.
[[nodiscard]] inline PictureSlice load_slice(const std::string& path) {
    ljus::FileReader file =
        ljus::open_file(path, std::size_t(1) << 34, detail::slice_format);
    PictureSlice part;
    part.slice.number = static_cast<int>(file.take<std::uint32_t>());
    part.slice.count = static_cast<int>(file.take<std::uint32_t>());
    const auto channel = file.take<std::uint32_t>();
    constexpr std::size_t numbers = 2 * 4 + 11 * 8 + 8;
    file.position = ljus::file_front_bytes;
    if (file.left() < numbers) file.refuse("it ends in the middle of its header");

    // What has the right checksum and yet no sense was made to mislead.
    const auto width = file.take<std::uint32_t>();
    const auto height = file.take<std::uint32_t>();
    detail::each_slice_number(
        part, [&]<typename Number>(Number& number) { number = file.take<Number>(); });
    const auto letters = file.take<std::uint64_t>();
    constexpr auto most = static_cast<std::uint32_t>(ljus::max_pixels);
    const bool sized = width >= 1 && height >= 1 && width <= most / height;
    const bool numbered = part.slice.number >= 1 && part.slice.count <= max_slices &&
                          part.slice.number <= part.slice.count;
    if (!sized || !numbered || (channel != 4 && channel != 8) || letters > file.left())
        file.refuse("its numbers are none that a slice can have");
    part.width = int(width);
    part.height = int(height);
    part.wide = channel == 8;
    const auto text = file.bytes.begin() + std::ptrdiff_t(file.position);
    part.settings.assign(text, text + std::ptrdiff_t(letters));
    file.position += letters;
    const ljus::RowRange rows = rows_of(part.slice, part.height);
    const std::size_t pixels =
        std::size_t(width) * static_cast<std::size_t>(rows.last - rows.first);
    if (file.left() != 3 * channel * pixels)
        file.refuse("its " + std::to_string(file.bytes.size()) +
                    " bytes do not go with its picture's size");
    part.pixels.resize(pixels);
    for (ljus::RgbT<double>& color : part.pixels)
        color = part.wide ? file.take_vector<ljus::RgbT<double>>()
                          : ljus::RgbT<double>(file.take_vector<ljus::Rgb>());
    return part;
}

namespace detail {

// Why a slice is not of the picture of another one: the first setting that differs, or
// nothing.
inline std::string difference(const PictureSlice& a, const PictureSlice& b) {
    if (a.settings == b.settings)
        return a.width == b.width && a.height == b.height && a.wide == b.wide &&
                       a.exposure == b.exposure
                   ? ""
                   : "size, precision or exposure";
    const auto x = nlohmann::ordered_json::parse(a.settings, nullptr, false);
    const auto y = nlohmann::ordered_json::parse(b.settings, nullptr, false);
    const auto lines_of = [](const nlohmann::ordered_json& settings) {
        std::string lines;
        for (const auto& [key, value] : settings.items())
            lines += key + ": " + value.dump() + "\n";
        return lines;
    };
    return examples::difference(lines_of(y), lines_of(x));
}

} // namespace detail

/// A whole picture of slices.
struct MergedPicture {
    ljus::ImageT<double> image{}; ///< All rows.
    bool wide = false;            ///< Rendered in double.
    double exposure = 0;          ///< Of a PNG file, in stops.
    std::string settings{};       ///< JSON, with the cost of all slices.
};

/// Puts slices together.
/// \param paths  Their files, in any order.
/// \return The picture, every number as one process would have made it.
/// \throws std::runtime_error  with one sentence if a slice is missing, there twice, of
///         another picture, or cannot be read.
// [merge]
[[nodiscard]] inline MergedPicture merge_slices(const std::vector<std::string>& paths) {
    if (paths.empty()) throw std::runtime_error("there is no slice to merge");
    const PictureSlice first = load_slice(paths.front());
    const auto fail = [](const std::string& why) { throw std::runtime_error(why); };
    MergedPicture merged{ljus::make_image<double>(first.width, first.height),
                         first.wide, first.exposure};
    std::vector<std::string> of(static_cast<std::size_t>(first.slice.count));
    ljus::Counts counts;
    double seconds = 0;
    for (const std::string& path : paths) {
        const PictureSlice part = load_slice(path);
        if (part.slice.count != first.slice.count)
            fail("'" + path + "' is slice " + slice_text(part.slice) + " and '" +
                 paths.front() + "' " + slice_text(first.slice) +
                 ": slices of one picture have one count");
        if (const std::string why = detail::difference(first, part); !why.empty())
            fail("'" + path + "' is of another picture than '" + paths.front() +
                 "': " + why);
        std::string& there = of[static_cast<std::size_t>(part.slice.number - 1)];
        if (!there.empty())
            fail("'" + there + "' and '" + path + "' are both slice " +
                 slice_text(part.slice) + "; give one of them");
        there = path;
        const auto begin = std::ptrdiff_t(rows_of(part.slice, part.height).first);
        std::copy(part.pixels.begin(), part.pixels.end(),
                  merged.image.pixels.begin() + begin * part.width);
        counts += part.counts;
        seconds += part.seconds;
    }
    std::string missing;
    int holes = 0;
    for (std::size_t i = 0; i < of.size(); ++i)
        if (of[i].empty() && ++holes <= 10)
            missing += (holes == 1 ? " " : ", ") +
                       slice_text({static_cast<int>(i) + 1, first.slice.count});
    if (holes > 0)
        fail("of " + std::to_string(first.slice.count) + " slices " +
             std::to_string(holes) + (holes == 1 ? " is" : " are") +
             " missing:" + missing + (holes > 10 ? ", ..." : "") +
             "; render with --slice what is missing, and nothing else");
    auto json = nlohmann::ordered_json::parse(first.settings);
    json["slices"] = first.slice.count;
    json["cost"] = cost_json(counts, seconds);
    merged.settings = json.dump(2) + "\n";
    return merged;
}
// [merge]

} // namespace examples
