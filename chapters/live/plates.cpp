// Live: Veach's plates by three ways to find a lamp, sample by sample.
#include <array>
#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include "experiments/veach_plates.hpp"
#include "ljus/image/color.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/render.hpp"

namespace {

using ljus::Rgb;
using Room = decltype(examples::veach_plates());
using Tracer = ljus::PathTracer<decltype(Room::world)>;

constexpr int width = 156, height = 104, ways = 3;
constexpr std::size_t pixels = std::size_t(width) * height;
constexpr std::array settings{
    ljus::PathTracingSettings{.max_depth = 1, .sample_lights = false},
    ljus::PathTracingSettings{.max_depth = 1,
                              .heuristic = ljus::MisHeuristic::shadow_rays},
    ljus::PathTracingSettings{.max_depth = 1}};

/// Keeps what shadow rays bring apart from what the path meets.
struct ShareLog {
    Rgb by_shadow_rays{0}, by_paths{0};
    void begin() noexcept {}
    void vertex(char, const ljus::Vec3&, const Rgb&, float) noexcept {}
    void term(std::string_view owner, std::string_view, const Rgb& value) noexcept {
        (owner == "shadow ray" ? by_shadow_rays : by_paths) += value;
    }
};

/// What is known of a pixel.
struct Sums {
    Rgb by_shadow_rays{0}, by_paths{0};
    double mean = 0, squares = 0; ///< Of the luminance: sums of x and x^2.
};

struct Figure {
    explicit Figure(Room of) : room(std::move(of)) {
        for (const auto& s : settings) tracers.emplace_back(room.world, s);
    }

    Room room;
    std::vector<Tracer> tracers; ///< Of the room: it stays where it is.
    std::vector<Sums> sums = std::vector<Sums>(ways * pixels);
    int row = 0;     ///< The next one.
    int samples = 0; ///< Finished, a pixel and way.
};
std::unique_ptr<Figure> figure;
std::array<unsigned char, 4 * ways * pixels> bytes; // one picture after the other

void write(std::size_t place, const Rgb& color) {
    for (int k = 0; k < 3; ++k)
        bytes[4 * place + std::size_t(k)] = ljus::srgb_byte(double(color[k]));
    bytes[4 * place + 3] = 255;
}

/// A pixel of the picture of one way.
std::size_t place_of(int way, int x, int y) {
    return std::size_t(way) * pixels + std::size_t(y * width + x);
}

/// How many samples the pixels of a row have.
int samples_of(int y) { return figure->samples + (y < figure->row ? 1 : 0); }

/// A row of one picture as bytes; with `shares` in two colours for who found the light.
void show_row(int way, int y, int samples, bool shares) {
    for (int x = 0; x < width; ++x) {
        const std::size_t place = place_of(way, x, y);
        const Sums& s = figure->sums[place];
        const float part = 1.0f / float(samples);
        const float rays = ljus::luminance(s.by_shadow_rays) * part;
        const float paths = ljus::luminance(s.by_paths) * part;
        write(place, shares ? rays * Rgb{0.25f, 0.55f, 1} + paths * Rgb{1, 0.45f, 0.1f}
                            : part * (s.by_shadow_rays + s.by_paths));
    }
}

} // namespace

extern "C" {

[[gnu::used]] int picture_width() { return width; }
[[gnu::used]] int picture_height() { return height; }
[[gnu::used]] int sample_count() { return figure->samples; }

/// Starts again, with the roughness of all plates times a factor.
[[gnu::used]] void restart(double factor) {
    auto roughness = examples::plate_roughness;
    for (float& r : roughness)
        r = std::min(1.0f, std::max(0.01f, r * float(factor)));
    figure = std::make_unique<Figure>(examples::veach_plates(roughness));
    bytes.fill(0);
}

/// One more sample for each pixel of a row, by each way.
/// \return The pictures, 4 bytes per pixel.
[[gnu::used]] const unsigned char* trace_row(int shares) {
    Figure& f = *figure;
    static const ljus::RenderSettings picture{
        .width = width, .height = height, .samples = 4096};
    static const ljus::PictureRays rays(picture);
    ljus::Counts counts;
    for (int way = 0; way < ways; ++way) {
        for (int x = 0; x < width; ++x) {
            ShareLog log;
            (void)ljus::trace_pixel(f.tracers[std::size_t(way)], f.room.camera, rays,
                                    {x, f.row, f.samples}, counts, log);
            Sums& s = f.sums[place_of(way, x, f.row)];
            s.by_shadow_rays += log.by_shadow_rays;
            s.by_paths += log.by_paths;
            const double l = double(ljus::luminance(log.by_shadow_rays + log.by_paths));
            s.mean += l;
            s.squares += l * l;
        }
        show_row(way, f.row, f.samples + 1, shares != 0);
    }
    if (++f.row == height) {
        f.row = 0;
        ++f.samples;
    }
    return bytes.data();
}

/// Writes the pictures again, after the choice of colours has changed.
[[gnu::used]] void show_all(int shares) {
    for (int way = 0; way < ways; ++way)
        for (int y = 0; y < height; ++y)
            if (samples_of(y) > 0) show_row(way, y, samples_of(y), shares != 0);
}

/// The standard deviation of one sample over the mean, around a pixel.
[[gnu::used]] double noise(int way, int x, int y) {
    double variance = 0, mean = 0, count = 0;
    for (int j = std::max(0, y - 2); j <= std::min(height - 1, y + 2); ++j)
        for (int i = std::max(0, x - 3); i <= std::min(width - 1, x + 3); ++i) {
            const Sums& s = figure->sums[place_of(way, i, j)];
            const double n = samples_of(j);
            if (n < 2) continue;
            variance += (s.squares - s.mean * s.mean / n) / (n - 1);
            mean += s.mean / n;
            count += 1;
        }
    return mean > 0 ? std::sqrt(variance * count) / mean : 0;
}

[[gnu::used]] int checks() { return 6; }
[[gnu::used]] double check(int i) {
    auto kept = std::move(figure); // the page goes on with its own
    restart(i < 3 ? 1 : 2);
    for (int k = 0; k < 2 * height; ++k) trace_row(0);
    double sum = 0;
    for (std::size_t k = 0; k < pixels; ++k)
        sum += figure->sums[std::size_t(i % 3) * pixels + k].mean;
    figure = std::move(kept);
    return sum / double(pixels);
}

/// Paths in float; a last digit of a sine moves each of them a little.
[[gnu::used]] double tolerance() { return 1e-5; }

} // extern "C"
