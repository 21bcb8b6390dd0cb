#pragma once

/// \file ljus/io/detail/picture_colors.hpp
/// \brief Finds out how the bytes of a PNG, JPEG or BMP file become linear sRGB.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ljus/image/color.hpp"
#include "ljus/io/detail/picture_damage.hpp"
#include "ljus/io/detail/srgb_primaries.hpp"
#include "ljus/io/file.hpp"

namespace ljus::detail {

inline constexpr Primaries p3_primaries{0.68, 0.32, 0.265,  0.69,
                                        0.15, 0.06, 0.3127, 0.329};
inline constexpr Primaries adobe_primaries{0.64, 0.33, 0.21,   0.71,
                                           0.15, 0.06, 0.3127, 0.329};
inline constexpr Primaries rec2020_primaries{0.708, 0.292, 0.17,   0.797,
                                             0.131, 0.046, 0.3127, 0.329};

// How the bytes of a picture become linear sRGB: by a curve for each channel, then by a
// matrix.
struct ByteColors {
    std::string says{}; // what declares the colours, for a message
    std::optional<glm::dmat3> matrix{glm::dmat3{1}}; // none if they are not read
    std::array<std::array<double, 256>, 3> linear{};

    ByteColors() {
        decode_by([](double x, std::size_t) { return srgb_decode(x); });
    }
    // Lets curve(x, k) be the linear light of the encoded value x of channel k.
    template <typename Curve>
    void decode_by(Curve curve) {
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < 256; ++i)
                linear[k][i] = std::clamp(curve(double(i) / 255, k), 0.0, 1.0);
    }
    void decode_by_gamma(double gamma) {
        decode_by([&](double x, std::size_t) { return std::pow(x, gamma); });
    }
};

// A colour profile (ICC.1:2022): a header of 128 bytes, then a list of tags.
class ColorProfile {
public:
    explicit ColorProfile(const Bytes& bytes) : bytes_(bytes) {}

    // The colours of a profile that consists of curves and, but for grey, a matrix. Of
    // those that consist of tables only sRGB is read, known by its name.
    [[nodiscard]] ByteColors colors() const {
        ByteColors colors;
        const std::string known = shown(name());
        colors.says = known.empty() ? "its colour profile"
                                    : join({"its colour profile '", known, "'"});
        const bool valid = stands_at(bytes_, 36, "acsp");
        const bool grey = valid && stands_at(bytes_, 16, "GRAYXYZ ");
        const bool rgb = valid && stands_at(bytes_, 16, "RGB ");
        if (rgb && tag("rXYZ") == 0 && known.find("sRGB") != std::string::npos)
            return colors;
        const std::array curves =
            grey ? std::array{tag("kTRC"), tag("kTRC"), tag("kTRC")}
                 : std::array{tag("rTRC"), tag("gTRC"), tag("bTRC")};
        colors.decode_by([&](double x, std::size_t k) { return decode(curves[k], x); });
        if (rgb)
            colors.matrix =
                to_srgb(glm::dmat3{column("rXYZ"), column("gXYZ"), column("bXYZ")});
        for (const auto& values : colors.linear)
            if (!(grey || rgb) || !(values.front() < values.back()))
                colors.matrix.reset();
        return colors;
    }

private:
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

    [[nodiscard]] glm::dvec3 column(std::string_view name) const {
        const std::size_t at = tag(name);
        return {fixed(at + 8), fixed(at + 12), fixed(at + 16)};
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
            return std::pow(std::max(a * x + b, 0.0), g) + (kind == 2 ? c : e);
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

// The colours of a PNG file. If several chunks describe them, cICP counts before iCCP,
// sRGB, and gAMA with cHRM (PNG 3, section 4.3). inflate(data, size) unpacks a profile.
template <typename Inflate>
ByteColors png_colors(const Bytes& file, Inflate inflate) {
    std::size_t by_number = 0, profile = 0, profile_size = 0, srgb = 0, primaries = 0;
    double gamma = 0;
    find_png_chunk(file, [&](std::string_view name, std::size_t at, std::size_t size) {
        if (name == "cICP" && size == 4) by_number = at;
        if (name == "iCCP") profile = at, profile_size = size;
        if (name == "sRGB") srgb = at;
        if (name == "cHRM" && size == 32) primaries = at;
        if (name == "gAMA" && size == 4) gamma = png_number(file, at) / 1e5;
        return name == "IDAT";
    });
    ByteColors colors;
    if (by_number != 0) {
        // The numbers of primaries, curve and matrix, and 1 for the full range (ITU-T
        // H.273). Read are the primaries of sRGB, Rec. 2020 and Display P3, and the
        // curve of sRGB and the linear one.
        colors.says = "its cICP chunk";
        const std::size_t space = byte_at(file, by_number);
        const std::size_t curve = byte_at(file, by_number + 1);
        if (curve == 8) colors.decode_by_gamma(1);
        if (space == 9) colors.matrix = to_srgb(rec2020_primaries);
        if (space == 12) colors.matrix = to_srgb(p3_primaries);
        if ((space != 1 && space != 9 && space != 12) || (curve != 8 && curve != 13) ||
            byte_at(file, by_number + 2) != 0 || byte_at(file, by_number + 3) != 1)
            colors.matrix.reset();
    } else if (profile != 0) {
        // The profile follows its name and one byte for the method of packing.
        std::size_t name = 0;
        while (name < profile_size && file[profile + name] != 0) ++name;
        const std::size_t head = name + 2;
        const Bytes bytes = head < profile_size ? inflate(file.data() + profile + head,
                                                          profile_size - head)
                                                : Bytes{};
        return ColorProfile(bytes).colors();
    } else if (srgb == 0) {
        // 1/2.2 means sRGB in files without an sRGB chunk.
        if (gamma > 0 && std::abs(gamma - 0.45455) >= 0.005)
            colors.decode_by_gamma(1 / gamma);
        Primaries xy = srgb_primaries; // the file begins with white
        for (std::size_t k = 0; k < xy.size() && primaries != 0; ++k)
            xy[(k + 6) % 8] = png_number(file, primaries + 4 * k) / 1e5;
        colors.matrix = to_srgb(xy);
        colors.says = "its cHRM chunk";
    }
    return colors;
}

// The colours of a JPEG file. A profile is cut into numbered segments. Cameras declare
// Adobe RGB in their EXIF data only.
inline ByteColors jpeg_colors(const Bytes& file) {
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
    if (!whole.empty()) return ColorProfile(whole).colors();
    ByteColors colors;
    if (!adobe) return colors;
    colors.decode_by_gamma(563 / 256.0);
    colors.matrix = to_srgb(adobe_primaries);
    return colors;
}

// The colours of a BMP file. The header may give primaries and a gamma, or a profile.
inline ByteColors bmp_colors(const Bytes& file) {
    const std::size_t head = BmpHead(file).size;
    const std::size_t kind = bmp_number(file, 70, 4);
    ByteColors colors;
    if (head < 108) return colors;
    if (kind == 0x4d424544u) { // MBED
        const std::size_t at = 14 + bmp_number(file, 126, 4);
        const std::size_t size = bmp_number(file, 130, 4);
        const bool whole = head >= 124 && at <= file.size() && size <= file.size() - at;
        const auto first = file.begin() + static_cast<std::ptrdiff_t>(whole ? at : 0);
        const auto count = static_cast<std::ptrdiff_t>(whole ? size : 0);
        return ColorProfile(Bytes(first, first + count)).colors();
    }
    if (kind == 0x4c494e4bu) { // LINK
        colors.says = "the colour profile that it names";
        colors.matrix.reset();
    }
    if (kind != 0) return colors; // sRGB, or the default of Windows
    Primaries xy = srgb_primaries;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto number = [&](std::size_t i) {
            return static_cast<double>(bmp_number(file, 74 + 12 * k + 4 * i, 4));
        };
        const double sum = number(0) + number(1) + number(2);
        if (sum == 0) return colors; // most programs leave them 0
        xy[2 * k] = number(0) / sum;
        xy[2 * k + 1] = number(1) / sum;
    }
    // Some programs write 2.2 and others 1/2.2, which means sRGB.
    const double number = static_cast<double>(bmp_number(file, 110, 4)) / 65536;
    const double gamma = number < 1 ? 1 / number : number; // infinite without one
    if (std::isfinite(gamma) && std::abs(gamma - 2.2) >= 0.05)
        colors.decode_by_gamma(gamma);
    colors.matrix = to_srgb(xy);
    colors.says = "its header";
    return colors;
}

} // namespace ljus::detail
