#pragma once

/// \file ljus/io/detail/picture_colors.hpp
/// \brief Finds out whether a PNG, JPEG or BMP file declares a colour space other than
/// sRGB.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ljus/image/color.hpp"
#include "ljus/io/detail/picture_damage.hpp"
#include "ljus/io/file.hpp"

namespace ljus::detail {

// A colour profile (ICC.1:2022): a header of 128 bytes, then a list of tags.
class ColorProfile {
public:
    explicit ColorProfile(const Bytes& bytes) : bytes_(bytes) {}

    // Whether the colours are approximately those of sRGB. A gamma of 2.2 counts as
    // sRGB.
    [[nodiscard]] bool is_srgb() const {
        if (!stands_at(bytes_, 36, "acsp")) return false;
        if (stands_at(bytes_, 16, "GRAY")) return has_srgb_curve("kTRC");
        if (!stands_at(bytes_, 16, "RGB ")) return false;
        // A profile without primaries consists of tables; only its name is checked.
        if (tag("rXYZ") == 0) return name().find("sRGB") != std::string::npos;
        // The primaries of sRGB, adapted to D50, the white of profiles.
        return has_primary("rXYZ", {0.4361, 0.2225, 0.0139}) &&
               has_primary("gXYZ", {0.3851, 0.7169, 0.0971}) &&
               has_primary("bXYZ", {0.1431, 0.0606, 0.7141}) &&
               has_srgb_curve("rTRC") && has_srgb_curve("gTRC") &&
               has_srgb_curve("bTRC");
    }

    // The name of the profile, up to its first character that is not ASCII.
    [[nodiscard]] std::string name() const {
        const std::size_t at = tag("desc");
        if (at == 0) return {};
        const bool wide = stands_at(bytes_, at, "mluc"); // UTF-16
        const std::size_t first = wide ? at + number(at + 24, 4) : at + 12;
        const std::size_t size = number(at + (wide ? 20 : 8), 4);
        std::string text;
        for (std::size_t i = wide ? 1 : 0; i < size && text.size() < 100;
             i += wide ? 2 : 1)
            if (const std::size_t byte = byte_at(bytes_, first + i))
                text += static_cast<char>(byte);
            else
                break;
        return text;
    }

private:
    [[nodiscard]] std::uint32_t number(std::size_t at, std::size_t bytes) const {
        return static_cast<std::uint32_t>(number_in(bytes_, at, bytes));
    }

    // A signed fixed-point number with 16 fraction bits.
    [[nodiscard]] double fixed(std::size_t at) const {
        return static_cast<std::int32_t>(number(at, 4)) / 65536.0;
    }

    // The index of a tag's data; 0 without that tag.
    [[nodiscard]] std::size_t tag(std::string_view name) const {
        for (std::size_t i = 0, at = 132; i < number(128, 4) && at < bytes_.size();
             ++i, at += 12)
            if (stands_at(bytes_, at, name)) return number(at + 4, 4);
        return 0;
    }

    [[nodiscard]] bool has_primary(std::string_view name,
                                   const std::array<double, 3>& xyz) const {
        const std::size_t at = tag(name);
        for (std::size_t k = 0; k < 3; ++k)
            if (!(std::abs(fixed(at + 8 + 4 * k) - xyz[k]) < 0.01)) return false;
        return true;
    }

    [[nodiscard]] bool has_srgb_curve(std::string_view name) const {
        for (const double x : {0.25, 0.5, 0.75})
            if (!(std::abs(decode(tag(name), x) - srgb_decode(x)) < 0.01)) return false;
        return true;
    }

    // The linear light that a curve gives for an encoded value; 0 if the type of the
    // curve is unknown.
    [[nodiscard]] double decode(std::size_t curve, double x) const {
        if (stands_at(bytes_, curve, "para")) {
            const std::size_t kind = number(curve + 8, 2);
            std::array<double, 7> p{1, 1}; // g, a, b, c, d, e, f of ICC.1
            constexpr std::array<std::size_t, 5> count{1, 3, 4, 5, 7};
            if (kind >= count.size()) return 0;
            for (std::size_t k = 0; k < count[kind]; ++k)
                p[k] = fixed(curve + 12 + 4 * k);
            const auto [g, a, b, c, d, e, f] = p;
            if (kind >= 3 && x < d) return c * x + f;
            return std::pow(a * x + b, g) + (kind == 2 ? c : e);
        }
        if (!stands_at(bytes_, curve, "curv")) return 0;
        const std::size_t entries = number(curve + 8, 4);
        if (entries == 0) return x;
        if (entries == 1) return std::pow(x, number(curve + 12, 2) / 256.0);
        const double place = x * static_cast<double>(entries - 1);
        const auto entry = static_cast<std::size_t>(place);
        const auto value = [&](std::size_t i) {
            return number(curve + 12 + 2 * i, 2) / 65535.0;
        };
        return std::lerp(value(entry), value(entry + 1), place - double(entry));
    }

    const Bytes& bytes_;
};

// The words of a message for a profile whose colours are not those of sRGB; empty for
// sRGB.
inline std::string other_profile(const Bytes& bytes) {
    const ColorProfile profile(bytes);
    if (profile.is_srgb()) return {};
    const std::string name = shown(profile.name());
    return name.empty() ? "its colour profile"
                        : join({"its colour profile '", name, "'"});
}

// Names the chunk of a PNG file that declares a colour space other than sRGB; empty
// if there is none. If several chunks describe colours, cICP counts before iCCP, sRGB
// and cHRM (PNG 3, section 4.3). inflate(data, size) unpacks a profile.
template <typename Inflate>
std::string png_other_colors(const Bytes& file, Inflate inflate) {
    std::size_t by_number = 0, profile = 0, profile_size = 0, srgb = 0, primaries = 0;
    find_png_chunk(file, [&](std::string_view name, std::size_t at, std::size_t size) {
        if (name == "cICP") by_number = at;
        if (name == "iCCP") profile = at, profile_size = size;
        if (name == "sRGB") srgb = at;
        if (name == "cHRM" && size == 32) primaries = at;
        return name == "IDAT";
    });
    if (by_number != 0) {
        // The bytes are the numbers of primaries and curve, a matrix, and full range.
        const bool is_srgb = byte_at(file, by_number) == 1 &&
                             byte_at(file, by_number + 1) == 13 &&
                             byte_at(file, by_number + 3) == 1;
        return is_srgb ? "" : "its cICP chunk";
    }
    if (profile != 0) {
        // The profile follows its name and one byte for the method of packing.
        std::size_t name = 0;
        while (name < profile_size && file[profile + name] != 0) ++name;
        const std::size_t head = name + 2;
        return other_profile(head < profile_size ? inflate(file.data() + profile + head,
                                                           profile_size - head)
                                                 : Bytes{});
    }
    if (srgb != 0 || primaries == 0) return {};
    std::array<double, 6> xy{};
    for (std::size_t k = 0; k < xy.size(); ++k) // after the white point
        xy[k] = png_number(file, primaries + 8 + 4 * k) / 1e5;
    return are_srgb_primaries(xy) ? "" : "its cHRM chunk";
}

// Names the part of a JPEG file that declares a colour space other than sRGB; empty
// if there is none. A profile is cut into numbered segments. Cameras declare Adobe RGB
// in their EXIF data only.
inline std::string jpeg_other_colors(const Bytes& file) {
    std::array<Bytes, 256> parts;
    bool adobe = false;
    constexpr std::string_view profile{"ICC_PROFILE\0", 12};
    find_jpeg_segment(file, [&](unsigned char kind, std::size_t at) {
        const std::size_t end =
            at - 2 + byte_at(file, at - 2) * 256 + byte_at(file, at - 1);
        if (kind == 0xe1 && stands_at(file, at, {"Exif\0\0", 6}))
            adobe = adobe || Tiff(file, at + 6).is_adobe_rgb();
        if (kind == 0xe2 && stands_at(file, at, profile) && end <= file.size() &&
            at + 14 < end)
            parts[file[at + 12]].assign(
                file.begin() + static_cast<std::ptrdiff_t>(at + 14),
                file.begin() + static_cast<std::ptrdiff_t>(end));
        return false;
    });
    Bytes whole;
    for (const Bytes& part : parts) whole.insert(whole.end(), part.begin(), part.end());
    if (!whole.empty()) return other_profile(whole);
    return adobe ? "its EXIF data" : "";
}

// Names the part of a BMP file that declares a colour space other than sRGB; empty if
// there is none. The header may give primaries and a gamma, or a profile.
inline std::string bmp_other_colors(const Bytes& file) {
    const std::size_t head = BmpHead(file).size;
    const std::size_t kind = bmp_number(file, 70, 4);
    if (head < 108) return {};
    if (kind == 0x4d424544u) { // MBED
        const std::size_t at = 14 + bmp_number(file, 126, 4);
        const std::size_t size = bmp_number(file, 130, 4);
        if (head < 124 || at > file.size() || size > file.size() - at)
            return "its damaged colour profile";
        const auto first = file.begin() + static_cast<std::ptrdiff_t>(at);
        return other_profile(Bytes(first, first + static_cast<std::ptrdiff_t>(size)));
    }
    if (kind == 0x4c494e4bu) return "the colour profile that it names"; // LINK
    if (kind != 0) return {}; // sRGB, or the default of Windows
    std::array<double, 9> xyz{};
    for (std::size_t k = 0; k < xyz.size(); ++k)
        xyz[k] = static_cast<double>(bmp_number(file, 74 + 4 * k, 4));
    std::array<double, 6> xy{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double sum = xyz[3 * k] + xyz[3 * k + 1] + xyz[3 * k + 2];
        if (sum == 0) return {}; // most programs leave them 0
        xy[2 * k] = xyz[3 * k] / sum;
        xy[2 * k + 1] = xyz[3 * k + 1] / sum;
    }
    const double gamma = static_cast<double>(bmp_number(file, 110, 4)) / 65536;
    const bool is_srgb =
        are_srgb_primaries(xy) && (gamma == 0 || std::abs(gamma - 2.2) < 0.05);
    return is_srgb ? "" : "its header";
}

} // namespace ljus::detail
