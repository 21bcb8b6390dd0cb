// Live: figure 1, the report's whole renderer in its final room.
//
// One instance for the page adds up what others have rendered, or renders itself; each
// worker has an instance with photon maps of its own, so that the noise of the maps
// falls with the number of workers, too.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <ljus/image/color.hpp>
#include <ljus/inspect/estimate.hpp>
#include <ljus/inspect/metrics.hpp>
#include <ljus/inspect/photon_dots.hpp>
#include <ljus/path/light_transport.hpp>
#include <ljus/render/photon_mapping.hpp>
#include <ljus/render/render.hpp>
#include <ljus/scenes/report_rooms.hpp>

namespace {

using Scene = ljus::ReportSceneT<float>;
using World = ljus::World<Scene>;
using Mapper = ljus::PhotonMapper<World>;

// --- The two passes

ljus::Camera camera;
std::optional<World> world;
std::optional<Mapper> mapper; // of the world
std::string carried; // a light path expression; none: all paths
ljus::Counts counts;
ljus::Image rendered;

// Calls f with the renderer that carries the chosen paths.
template <typename F>
auto with_renderer(const F& f) {
    if (carried.empty()) return f(*mapper);
    return f(ljus::OnlyPaths(*mapper, carried));
}

// The room, with another index of its balls of glass.
World with_index(const World& room, double index) {
    Scene scene;
    scene.materials = room.materials();
    for (auto& glass : std::get<std::vector<ljus::Glass>>(scene.materials))
        glass.index = static_cast<float>(index);
    std::size_t type = 0;
    const auto add = [&](const auto& shapes) {
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            const auto& object = room.objects()[type][i];
            scene.add(shapes[i], object.material, object.emission);
        }
        ++type;
    };
    std::apply([&](const auto&... shapes) { (add(shapes), ...); }, room.shapes());
    return ljus::World(std::move(scene));
}

ljus::RenderSettings picture(int width, int height, double seed) {
    return {.width = width,
            .height = height,
            .samples = 1,
            .seed = static_cast<std::uint64_t>(seed)};
}

// --- The sum of all that was rendered, with its error

struct Pixel {
    std::array<ljus::Estimate, 3> channels{};
};
int sum_width = 0;
int sum_height = 0;
std::vector<Pixel> sums;
std::vector<float> input;   // some rows of a rendered picture
std::vector<float> preview; // a small picture, for rows that were not rendered yet
int preview_width = 0;
std::vector<unsigned char> bytes;

double channel(const ljus::Rgb& color, std::size_t number) {
    return number == 0 ? color.x : number == 1 ? color.y : color.z;
}

// --- Numbers and letters for the page

std::string text;
std::vector<float> dots;

void print(const char* format, auto... values) {
    char line[256];
    std::snprintf(line, sizeof line, format, values...);
    text += line;
}

} // namespace

extern "C" {

/// Makes the photon maps. `index` is that of the three clear balls of glass; 0: their
/// own. `indirect` counts IndirectLight's rays, map, photons, none.
/// Returns how many photons the caustics map holds.
[[gnu::used]] double prepare(double photons, double radius, int depth, double index,
                             int indirect, double seed) {
    using Who = ljus::IndirectLight;
    constexpr std::array who{Who::rays, Who::map, Who::photons, Who::none};
    mapper.reset();
    world.emplace(ljus::final_room().world);
    if (index > 0) world.emplace(with_index(*world, index));
    ljus::PhotonMappingSettings settings;
    settings.max_depth = depth;
    settings.split_glass = true;
    settings.indirect = who[static_cast<std::size_t>(indirect)];
    for (auto* pass : {&settings.caustics, &settings.general}) {
        pass->photons = static_cast<long long>(photons);
        pass->seed = static_cast<std::uint64_t>(seed);
        pass->shadow_photons = false;
    }
    settings.caustics_estimate.radius = static_cast<float>(radius);
    settings.general_estimate.radius = static_cast<float>(3 * radius);
    mapper.emplace(*world, settings);
    return double(mapper->maps().caustics.records.size());
}

/// The camera at a distance from the room's middle; angles in degrees, 0 and 0 straight
/// in front of it, as in the report.
[[gnu::used]] void view(double yaw, double pitch, double distance) {
    const double a = yaw * std::numbers::pi / 180, b = pitch * std::numbers::pi / 180;
    const ljus::Vec3 middle{6, 0, 0};
    const ljus::Vec3 way{-std::cos(a) * std::cos(b), std::sin(a) * std::cos(b),
                         std::sin(b)};
    camera = look_at(ljus::View{.position = middle + float(distance) * way,
                                     .target = middle,
                                     .up{0, 0, 1},
                                     .vfov_degrees = 53.130102f});
}

/// Which paths count, a bit each: 1 lamps that are seen, 2 direct light, 4 caustics,
/// 8 light from two diffuse surfaces and more, 16 what is seen in mirrors and glass.
[[gnu::used]] void carry(int classes) {
    constexpr std::array endings{"L", "DL", "DS+L", "D.*D.*L"};
    const char* const eye = (classes & 16) != 0 ? "ES*" : "E";
    carried.clear();
    if (classes == 31) return;
    for (std::size_t i = 0; i < endings.size(); ++i)
        if ((classes >> i & 1) != 0)
            carried.append(carried.empty() ? "" : "|").append(eye).append(endings[i]);
    if (carried.empty()) carried = "E"; // no path of light
}

/// Renders some rows, one ray a pixel: three floats each. rays() says what it took.
[[gnu::used]] const float* render_rows(int width, int height, double seed, int first,
                                       int last) {
    rendered = with_renderer([&](const auto& renderer) {
        auto some =
            ljus::render_region(renderer, camera, picture(width, height, seed),
                                {0, first, width, last - first});
        counts = some.counts;
        return some.image;
    });
    return &rendered.pixels[0].x;
}
[[gnu::used]] double rays() {
    return double(counts.rays());
}

/// The photons of the caustics map that the camera sees: x and y in pixels, and a
/// colour, five floats each. Returns how many.
[[gnu::used]] int find_dots(int width, int height) {
    dots.clear();
    const ljus::PhotonMap& caustics = mapper->maps().caustics;
    const std::size_t count = caustics.records.size();
    const std::size_t step = count / 20000 + 1;
    for (std::size_t i = 0; i < count; i += step) {
        const auto record = caustics.records[i];
        const ljus::Photon photon{.position = caustics.tree.point(i),
                                  .direction = record.direction,
                                  .flux = record.flux};
        const auto place =
            photon_in_sight(*world, camera, photon, width, height);
        if (!place) continue;
        const ljus::Rgb color = dot_color(photon);
        dots.insert(dots.end(), {place->x, place->y, color.x, color.y, color.z});
    }
    return static_cast<int>(dots.size() / 5);
}
[[gnu::used]] const float* dot_places() {
    return dots.data();
}

/// One ray of a pixel, vertex by vertex, as a text of JSON: what, the letters, the
/// value (throughput or radiance), the pdf, and the place in the picture, if any.
[[gnu::used]] const char* explain(int width, int height, double seed, int x, int y) {
    ljus::PathLog log;
    ljus::Counts ignored;
    const auto one = picture(width, height, seed);
    const ljus::PictureRays ray(one);
    (void)ljus::trace_pixel(*mapper, camera, ray, {x, y, 0}, ignored, log);
    text = "[";
    for (const ljus::PathLogLine& line : log.lines) {
        const ljus::Vec3 position(line.position);
        const auto place = project(camera, position, width, height);
        text.append(text.size() > 1 ? ",\n" : "\n").append("{\"what\":\"");
        text.append(line.what).append("\",\"path\":\"").append(line.path);
        print("\",\"value\":[%.6g,%.6g,%.6g],\"pdf\":%.6g", line.value.x, line.value.y,
              line.value.z, line.pdf);
        print(",\"position\":[%.4g,%.4g,%.4g]", line.position.x, line.position.y,
              line.position.z);
        if (place) print(",\"place\":[%.2f,%.2f]", double(place->x), double(place->y));
        text += "}";
    }
    text += "]";
    return text.c_str();
}

/// Begins a sum of pictures.
[[gnu::used]] void begin(int width, int height) {
    sum_width = width;
    sum_height = height;
    const auto pixels = static_cast<std::size_t>(width * height);
    sums.assign(pixels, {});
    bytes.assign(4 * pixels, 255);
}

/// Where rendered rows are put before they are added.
[[gnu::used]] float* input_of(int floats) {
    input.resize(static_cast<std::size_t>(floats));
    return input.data();
}

/// Adds the rows of the input to the sum.
[[gnu::used]] void add_rows(int first, int last) {
    const auto begin = static_cast<std::size_t>(first * sum_width);
    const auto count = static_cast<std::size_t>((last - first) * sum_width);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            add(sums[begin + i].channels[c], double(input[3 * i + c]));
}

/// Takes the input as a small picture of the whole.
[[gnu::used]] void take_preview(int width) {
    preview = input;
    preview_width = width;
}

/// The picture so far, in bytes for the page.
[[gnu::used]] const unsigned char* show(double exposure) {
    const int preview_height = preview_width * sum_height / sum_width;
    for (int y = 0; y < sum_height; ++y)
        for (int x = 0; x < sum_width; ++x) {
            const auto i = static_cast<std::size_t>(y * sum_width + x);
            const auto small = static_cast<std::size_t>(y * preview_height /
                                                            sum_height * preview_width +
                                                        x * preview_width / sum_width);
            for (std::size_t c = 0; c < 3; ++c) {
                const ljus::Estimate& sum = sums[i].channels[c];
                const bool known = sum.count > 0 || 3 * small + c >= preview.size();
                const double radiance =
                    known ? sum.mean : double(preview[3 * small + c]);
                bytes[4 * i + c] = ljus::srgb_byte(exposure * radiance);
            }
        }
    return bytes.data();
}

/// The relMSE that the spread of the samples lets expect: of the noise, for nobody
/// knows the bias here. -1 while a pixel has less than two samples.
[[gnu::used]] double error() {
    double sum = 0;
    for (const Pixel& pixel : sums)
        for (const ljus::Estimate& channel : pixel.channels) {
            if (channel.count < 2) return -1;
            const double mean2 = channel.mean * channel.mean;
            sum += variance(channel) / channel.count / (mean2 + ljus::default_epsilon);
        }
    return sum / double(3 * sums.size());
}

[[gnu::used]] int checks() {
    return 9;
}

/// A tiny picture of 12 x 12 pixels: means of its channels; photons; rays; one pixel.
[[gnu::used]] double check(int number) {
    if (number == 0) {
        view(10, 5, 12);
        carry(31);
        (void)prepare(3000, 0.3, 8, 0, 0, 5);
        (void)render_rows(12, 12, 7, 0, 12);
    }
    if (number < 3) {
        double sum = 0;
        for (const ljus::Rgb& color : rendered.pixels)
            sum += channel(color, static_cast<std::size_t>(number));
        return sum / double(rendered.pixels.size());
    }
    if (number == 3) return double(mapper->maps().caustics.records.size());
    if (number == 4) return rays();
    const ljus::Rgb& color = pixel(rendered, 4 + number % 2, 7);
    if (number < 7) return color.x;
    carry(number == 7 ? 4 : 2); // caustics; direct light
    (void)render_rows(12, 12, 7, 0, 12);
    double sum = 0;
    for (const ljus::Rgb& one : rendered.pixels) sum += ljus::luminance(one);
    return sum;
}

/// Sines of two C libraries differ in their last digit, and a path's bounces multiply
/// the difference.
[[gnu::used]] double tolerance() {
    return 1e-4;
}

} // extern "C"
