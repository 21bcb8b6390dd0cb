// Live: the colours of a soap film, and what of each wavelength it reflects. Thickness
// and wavelength are in nm, angles in degrees.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <ljus/image/color.hpp>
#include <ljus/optics/film_color.hpp>

namespace {

using Rgb = ljus::RgbT<double>;

constexpr double degree = std::numbers::pi / 180, water = 1.33;
constexpr int columns = 200, waves = 181;
std::array<unsigned char, 4 * std::max(columns, waves)> row;
std::array<float, waves> shares;

/// The colour, as bright as the film's mean at this angle.
/// \param way  0: by the spectrum, 1: integrated beforehand, 2: three wavelengths.
Rgb color(int way, double cosine, double thickness) {
    const auto reflected = [&] {
        if (way == 0) return ljus::film_spectral(cosine, water, thickness);
        if (way == 1) return ljus::film_preintegrated(cosine, water, thickness);
        return ljus::film_three(cosine, water, thickness);
    };
    return ljus::into_gamut(reflected()) * (0.35 / ljus::thick_film(cosine, water));
}

void put(int column, const Rgb& rgb) {
    unsigned char* pixel = &row[4 * std::size_t(column)];
    for (int i = 0; i < 3; ++i) pixel[i] = ljus::srgb_byte(rgb[i]);
    pixel[3] = 255;
}

} // namespace

extern "C" {

/// One row of 200 pixels of RGBA: films from no thickness to `thickest`.
[[gnu::used]] const unsigned char* strip(int way, double angle, double thickest) {
    const double cosine = std::cos(angle * degree);
    for (int i = 0; i < columns; ++i)
        put(i, color(way, cosine, thickest * (i + 0.5) / columns));
    return row.data();
}

/// One pixel of RGBA: the colour of one film.
[[gnu::used]] const unsigned char* swatch(int way, double angle, double thickness) {
    put(0, color(way, std::cos(angle * degree), thickness));
    return row.data();
}

/// One row of 181 pixels: the colour of each wavelength from 380 to 740, by 2.
[[gnu::used]] const unsigned char* rainbow() {
    for (int i = 0; i < waves; ++i) {
        const auto eye = ljus::cie_observer(380.0 + 2 * i);
        put(i, ljus::into_gamut(0.5 * ljus::xyz_to_rgb(eye)));
    }
    return row.data();
}

/// What is reflected of each of these wavelengths.
[[gnu::used]] const float* reflectance(double angle, double thickness) {
    const double cosine = std::cos(angle * degree);
    for (int i = 0; i < waves; ++i)
        shares[std::size_t(i)] =
            float(ljus::thin_film(cosine, water, thickness, 380.0 + 2 * i).reflected);
    return shares.data();
}

/// What is reflected of white light, as the eye weighs it.
[[gnu::used]] double luminance_reflected(double angle, double thickness) {
    return ljus::luminance(
        ljus::film_spectral(std::cos(angle * degree), water, thickness));
}

/// What a very thick film reflects.
[[gnu::used]] double mean_reflected(double angle) {
    return ljus::thick_film(std::cos(angle * degree), water);
}

[[gnu::used]] int checks() {
    return 10 + 3 + 1;
}

[[gnu::used]] double check(int number) {
    if (number < 10) return luminance_reflected(8.0 * number, 10 + 150.0 * number);
    if (number == 13) return double(reflectance(30, 400)[90]);
    strip(number - 10, 30, 1500);
    double sum = 0;
    for (const unsigned char byte : row) sum += byte;
    return sum;
}

/// Sines and exponentials of two C libraries differ in their last digit, and so may
/// some byte by 1.
[[gnu::used]] double tolerance() {
    return 1e-5;
}

} // extern "C"
