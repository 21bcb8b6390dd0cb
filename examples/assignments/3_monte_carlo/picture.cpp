// Assignment 3: a floor seen from above, under a dim sky with one lamp. From left to
// right it is sampled by uniform directions, by cosine-weighted directions, and by both
// cosine-weighted and cone directions with the balance heuristic.
#include <answer.hpp>

#include <string>

#include "ljus/io/png.hpp"

using namespace answer;

int main(int count, char** arguments) {
    const std::string file = count > 1 ? arguments[1] : "assignment-3.png";
    constexpr int rays = 16;
    const Vec3 lamp{0, 0, 2};
    const float radius = 0.5f;
    ljus::Image image = ljus::make_image(480, 320);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const int way = x / 160;
            const Vec3 point{float(x % 160 - 80) / 40, float(160 - y) / 40, 0};
            const Vec3 to_lamp = lamp - point;
            const float sine = radius / length(to_lamp);
            const Cone cone{normalize(to_lamp), std::sqrt(1 - sine * sine)};
            const Sky sky = [&](const Vec3& d) {
                return dot(d, cone.axis) > cone.cosine ? 4.0 : 0.05 + 0.1 * d.x * d.x;
            };
            auto stream =
                ljus::random_stream(1, ljus::Pass::user, 0,
                                    static_cast<std::uint64_t>(y * image.width + x));
            double sum = 0;
            for (int i = 0; i < rays; ++i) {
                const Vec2 a = next_2d(stream), b = next_2d(stream);
                if (way == 0) sum += irradiance_uniform(sky, a);
                if (way == 1) sum += irradiance_cosine(sky, a);
                if (way == 2) sum += irradiance_both(sky, cone, a, b);
            }
            pixel(image, x, y) = ljus::Rgb{float(sum / rays)};
        }
    ljus::save_png(image, file);
}
