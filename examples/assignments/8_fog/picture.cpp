// Assignment 8: a lamp in the night, and the shadow of a black ball in the fog. The fog
// is thin on the left and dense in the middle; on the right it scatters forwards.
#include <answer.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include "ljus/image/image.hpp"
#include "ljus/io/png.hpp"

using namespace answer;

// The length of a ray: up to the ball, or 12 if it misses the ball.
static double sight(const Night& night, const Ray& ray) {
    const Vec3 to = night.ball - ray.origin;
    const double b = dot(to, ray.direction);
    const double square = night.radius * night.radius - dot(to, to) + b * b;
    return square > 0 ? b - std::sqrt(square) : 12;
}

int main(int count, char** arguments) {
    const std::string file = count > 1 ? arguments[1] : "assignment-8.png";
    const int samples = count > 2 ? std::stoi(arguments[2]) : 64;
    constexpr int size = 200;
    const Fog fogs[]{{0, 0.01}, {0, 0.4}, {0, 0.1, 0.7}};
    const double exposures[]{130, 45, 20}; // to show all three
    ljus::Image image = ljus::make_image(3 * size, size);
    auto stream = ljus::random_stream(1, ljus::Pass::user, 0, 0);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < 3 * size; ++x) {
            const Night night{fogs[x / size], {-0.6, 1.2, 6}, 1, {0.3, 0.4, 5.6}, 0.4};
            const double across = (x % size + 0.5) / size - 0.5;
            const double up = 0.5 - (y + 0.5) / size;
            const Ray ray{{0, 0, 0}, normalize(Vec3{across, up, 1})};
            double light = 0;
            for (int i = 0; i < samples; ++i)
                light +=
                    scattered_once(night, ray, sight(night, ray), stream) / samples;
            pixel(image, x, y) =
                float(exposures[x / size] * light) * ljus::Rgb{1, 0.85f, 0.6f};
        }
    ljus::save_png(image, file);
}
