// Assignment 7: the light of a low sun in a cup, in passes of 500 photons. One pass is
// on the left, the mean of ten in the middle, and the mean of all on the right.
#include <answer.hpp>

#include <string>

#include "ljus/image/image.hpp"
#include "ljus/io/png.hpp"

using namespace answer;

int main(int count, char** arguments) {
    const std::string file = count > 1 ? arguments[1] : "assignment-7.png";
    const int passes = count > 2 ? std::stoi(arguments[2]) : 500;
    constexpr int size = 200;
    std::vector<Vec2> points;
    for (int i = 0; i < size * size; ++i)
        points.push_back({2.1f * (float(i % size) + 0.5f) / size - 1.05f,
                          1.05f - 2.1f * (float(int(i / size)) + 0.5f) / size});
    ljus::Image image = ljus::make_image(3 * size, size);
    Progress progress{.radius = 0.15f};
    const auto show = [&](int column) {
        for (int i = 0; i < size * size && !progress.mean.empty(); ++i) {
            const Vec2 at = points[static_cast<std::size_t>(i)];
            const double light = progress.mean[static_cast<std::size_t>(i)];
            pixel(image, column * size + i % size, i / size) =
                dot(at, at) > 1 ? ljus::Rgb{0.02f}
                                : float(light) * ljus::Rgb{0.3f, 0.2f, 0.1f};
        }
    };
    const auto more = [&](int number_of_passes) {
        run(progress, number_of_passes, [&](float radius, int number) {
            return photon_pass(cup_of_light(), points, radius, 500, number);
        });
    };
    more(1);
    show(0);
    more(9);
    show(1);
    more(passes - 10);
    show(2);
    ljus::save_png(image, file);
}
