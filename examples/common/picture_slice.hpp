#pragma once

/// \file picture_slice.hpp
/// \brief Saves some rows of a picture in a file, a *slice*, and merges such files.
/// Machines without a connection can thus render one picture.
///
/// The file of a slice has the header of \ref binary_file, with the number of the
/// slice, the count of slices and the bytes per channel. Then follow the size of the
/// whole picture, exposure, cost, settings as JSON text, and the rows from the top.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "command_line.hpp"
#include "ljus/io/binary_file.hpp"
#include "ljus/path/renderer.hpp"
#include "ljus/render/render.hpp"
#include "picture_cost.hpp"
#include "same_picture.hpp"

namespace examples {

/// The number of a slice: 3/16 is the third of 16, 16/16 the last.
struct SliceNumber {
    int number = 0; ///< From 1 on; 0 if the picture is not sliced.
    int count = 0;  ///< The number of slices.
};

/// The largest number of slices of a picture.
inline constexpr int max_slices = 65536;

/// The number of a slice as text: "3/16".
[[nodiscard]] inline std::string slice_text(const SliceNumber& slice) {
    return std::to_string(slice.number) + "/" + std::to_string(slice.count);
}

/// Reads the number of a slice.
/// \param text  A text such as "3/16".
/// \throws std::invalid_argument  if the text has another form.
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

/// The rows of a slice. If there are more slices than rows, some slices have no rows.
/// \param slice   The number of the slice.
/// \param width   Width of the whole picture, in pixels.
/// \param height  Height of the whole picture, in pixels.
[[nodiscard]] inline ljus::PixelRegion rows_of(const SliceNumber& slice, int width,
                                               int height) {
    const auto begin = [&](long long number) {
        return static_cast<int>(height * number / slice.count);
    };
    const int first = begin(slice.number - 1);
    return {0, first, width, begin(slice.number) - first};
}

/// Rows of a picture, and everything that identifies the picture.
struct PictureSlice {
    SliceNumber slice{};    ///< Number of the slice.
    int width = 0;          ///< Width of the whole picture.
    int height = 0;         ///< Height of the whole picture.
    bool wide = false;      ///< Whether the picture was rendered in double.
    double exposure = 0;    ///< Exposure of a PNG file of the picture, in stops.
    std::string settings{}; ///< The scene, its hash, and every setting, as JSON.
    ljus::Counts counts{};  ///< Cost of the rows.
    double seconds = 0;     ///< Time of photons and rows.
    std::vector<ljus::RgbT<double>> pixels{}; ///< The rows, from the top.
};

inline constexpr ljus::FileFormat slice_format{"ljus picturepart", 1};

// Calls `each` with each number between the header and the text of the settings.
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

/// Saves a slice, as save_file() does.
/// \param path  The file.
/// \param part  The slice.
inline void save_slice(const std::string& path, const PictureSlice& part) {
    using ljus::put_number;
    ljus::Bytes bytes = ljus::file_front(slice_format, std::uint32_t(part.slice.number),
                                         std::uint32_t(part.slice.count),
                                         std::uint32_t(part.wide ? 8 : 4));
    put_number(bytes, std::uint32_t(part.width));
    put_number(bytes, std::uint32_t(part.height));
    each_slice_number(part, [&](const auto& number) { put_number(bytes, number); });
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

// Whether a text can be the settings of a slice. It must be a JSON object, and not
// nested so deeply that writing it would overflow the stack.
inline bool are_settings(const std::string& text) {
    bool shallow = true;
    const auto json = nlohmann::json::parse(
        text,
        [&shallow](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
            shallow = shallow && depth < 16;
            return shallow;
        },
        false);
    return shallow && json.is_object();
}

/// Loads a slice.
/// \param path  The file.
/// \return The slice, bit for bit as it was saved.
/// \throws std::runtime_error  with path and reason, if the file is cut short, damaged,
///         of another version, or not a slice.
[[nodiscard]] inline PictureSlice load_slice(const std::string& path) {
    ljus::FileReader file = ljus::open_file(path, std::size_t(1) << 34, slice_format);
    PictureSlice part;
    part.slice.number = static_cast<int>(file.take<std::uint32_t>());
    part.slice.count = static_cast<int>(file.take<std::uint32_t>());
    const auto channel = file.take<std::uint32_t>();
    constexpr std::size_t numbers = 2 * 4 + 11 * 8 + 8;
    file.position = ljus::file_front_bytes;
    if (file.left() < numbers) file.refuse("it ends in the middle of its header");

    // A file with a valid checksum can still hold impossible numbers.
    const auto width = file.take<std::uint32_t>();
    const auto height = file.take<std::uint32_t>();
    each_slice_number(
        part, [&]<typename Number>(Number& number) { number = file.take<Number>(); });
    const auto letters = file.take<std::uint64_t>();
    constexpr auto most = static_cast<std::uint32_t>(ljus::max_pixels);
    const bool sized = width >= 1 && height >= 1 && width <= most / height;
    const bool numbered = part.slice.number >= 1 && part.slice.count <= max_slices &&
                          part.slice.number <= part.slice.count;
    if (!sized || !numbered || (channel != 4 && channel != 8) || letters > file.left())
        file.refuse("its numbers are not those of a slice");
    part.width = int(width);
    part.height = int(height);
    part.wide = channel == 8;
    const auto text = file.bytes.begin() + std::ptrdiff_t(file.position);
    part.settings.assign(text, text + std::ptrdiff_t(letters));
    file.position += letters;
    if (!std::isfinite(part.exposure) || !are_settings(part.settings))
        file.refuse("its settings are not those of a slice");
    const ljus::PixelRegion rows = rows_of(part.slice, part.width, part.height);
    const std::size_t pixels =
        std::size_t(width) * static_cast<std::size_t>(rows.height);
    if (file.left() != 3 * channel * pixels)
        file.refuse("its " + std::to_string(file.bytes.size()) +
                    " bytes do not match its picture's size");
    part.pixels.resize(pixels);
    for (ljus::RgbT<double>& color : part.pixels)
        color = part.wide ? file.take_vector<ljus::RgbT<double>>()
                          : ljus::RgbT<double>(file.take_vector<ljus::Rgb>());
    return part;
}

// The first setting in which two slices differ, in words; empty if they are of the same
// picture.
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

/// A picture merged from slices.
struct MergedPicture {
    ljus::ImageT<double> image{}; ///< All rows.
    bool wide = false;            ///< Whether the picture was rendered in double.
    double exposure = 0;          ///< Exposure of a PNG file, in stops.
    std::string settings{}; ///< All settings, and the cost of all slices, as JSON.
};

/// Merges slices into one picture.
/// \param paths  The files of the slices, in any order.
/// \return The picture, bit for bit as one process would have rendered it.
/// \throws std::runtime_error  with one sentence if a slice is missing, given twice, of
///         another picture, or unreadable.
[[nodiscard]] inline MergedPicture merge_slices(const std::vector<std::string>& paths) {
    if (paths.empty()) throw std::runtime_error("there is no slice to merge");
    const auto fail = [](const std::string& why) { throw std::runtime_error(why); };
    struct Named {
        std::string path;
        PictureSlice part;
    };
    // Memory for the picture is allocated only when all slices are there, because a
    // small file may declare any size.
    std::map<int, Named> parts;
    const PictureSlice* known = nullptr;
    for (const std::string& path : paths) {
        PictureSlice part = load_slice(path);
        if (known != nullptr && part.slice.count != known->slice.count)
            fail("'" + path + "' is slice " + slice_text(part.slice) + " and '" +
                 paths.front() + "' " + slice_text(known->slice) +
                 ": slices of one picture have one count");
        if (known != nullptr)
            if (const std::string why = difference(*known, part); !why.empty())
                fail("'" + path + "' is of another picture than '" + paths.front() +
                     "': " + why);
        Named& there = parts[part.slice.number];
        if (!there.path.empty())
            fail("'" + there.path + "' and '" + path + "' are both slice " +
                 slice_text(part.slice) + "; give one of them");
        there = {path, std::move(part)};
        if (known == nullptr) known = &there.part;
    }
    const PictureSlice& first = *known;
    std::string missing;
    int holes = 0;
    for (int number = 1; number <= first.slice.count; ++number)
        if (!parts.contains(number) && ++holes <= 10)
            missing +=
                (holes == 1 ? " " : ", ") + slice_text({number, first.slice.count});
    if (holes > 0)
        fail("of " + std::to_string(first.slice.count) + " slices " +
             std::to_string(holes) + (holes == 1 ? " is" : " are") +
             " missing:" + missing + (holes > 10 ? ", ..." : "") +
             "; render with --slice what is missing, and nothing else");
    MergedPicture merged{ljus::make_image<double>(first.width, first.height),
                         first.wide, first.exposure};
    ljus::Counts counts;
    double seconds = 0;
    auto to = merged.image.pixels.begin();
    for (const auto& [number, slice] : parts) {
        to = std::copy(slice.part.pixels.begin(), slice.part.pixels.end(), to);
        counts += slice.part.counts;
        seconds += slice.part.seconds;
    }
    auto json = nlohmann::ordered_json::parse(first.settings);
    json["slices"] = first.slice.count;
    json["cost"] = cost_json(counts, seconds);
    merged.settings = json.dump(2) + "\n";
    return merged;
}

} // namespace examples
