// smoke: --quality draft
/// \file chapters/drawings/34_drawings.cpp
/// \brief Chapter 34: a sum of floats by threads, and by blocks.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <ljus/math/random.hpp>
#include <ljus/parallel.hpp>

#include "common/command_line.hpp"
#include "common/drawing.hpp"

namespace {

using examples::Drawing;
namespace colors = examples::colors;

constexpr const char* thread_colors[] = {colors::blue, colors::orange, colors::green};

/// A part of the list, the thread that adds it up, and the sum.
struct Part {
    std::size_t first, last;
    int thread;
};

/// Sums of the parts in float, and of these sums in their order.
float sum_of(const std::vector<float>& values, const std::vector<Part>& parts) {
    float all = 0;
    for (const Part& part : parts) {
        float sum = 0;
        for (std::size_t i = part.first; i < part.last; ++i) sum += values[i];
        all += sum;
    }
    return all;
}

/// The list as a row of cells in the colours of the threads, with brackets around the
/// parts, and the sum.
void draw_row(Drawing& drawing, double y, const char* title,
              const std::vector<float>& values, const std::vector<Part>& parts) {
    const double cell = 0.36;
    draw_label(drawing, {-1.35, y + 0.17}, title);
    for (const Part& part : parts) {
        const char* color = thread_colors[part.thread];
        const double left = double(part.first) * cell + 0.02;
        const double right = double(part.last) * cell - 0.06;
        for (std::size_t i = part.first; i < part.last; ++i) {
            const double x = double(i) * cell;
            draw_area(drawing,
                      {{x, y}, {x + 0.3, y}, {x + 0.3, y + 0.32}, {x, y + 0.32}},
                      color);
            draw_line(
                drawing,
                {{x, y}, {x + 0.3, y}, {x + 0.3, y + 0.32}, {x, y + 0.32}, {x, y}},
                {.color = color, .width = 1});
        }
        draw_line(
            drawing,
            {{left, y - 0.06}, {left, y - 0.16}, {right, y - 0.16}, {right, y - 0.06}},
            {.color = color, .width = 2});
        draw_label(drawing, {(left + right) / 2, y - 0.33}, "+", color);
    }
    draw_label(drawing, {double(values.size()) * cell + 0.85, y + 0.17},
               examples::text(double(sum_of(values, parts)), "%.9g"));
}

/// The parts of a list: one for each thread.
std::vector<Part> by_thread(std::size_t count, std::size_t threads) {
    std::vector<Part> parts;
    for (std::size_t t = 0; t < threads; ++t)
        parts.push_back(
            {count * t / threads, count * (t + 1) / threads, static_cast<int>(t)});
    return parts;
}

/// Blocks of three, each taken by the thread that happens to be free.
std::vector<Part> by_block(std::size_t count, const std::vector<int>& takers) {
    std::vector<Part> parts;
    for (std::size_t block = 0; block < takers.size(); ++block)
        parts.push_back({3 * block, std::min(3 * block + 3, count), takers[block]});
    return parts;
}

const std::vector<int> takers_of_two{0, 1, 1, 0}, takers_of_three{2, 0, 1, 0};

/// A list whose sums by two threads, by three threads and by blocks differ, as those of
/// most long lists do.
std::vector<float> list_of(std::size_t count) {
    for (std::uint64_t seed = 1;; ++seed) {
        auto stream = ljus::random_stream(seed, ljus::Pass::user, 0, 0);
        std::vector<float> values;
        for (std::size_t i = 0; i < count; ++i)
            values.push_back(ljus::next_1d<float>(stream));
        const float two = sum_of(values, by_thread(count, 2));
        const float three = sum_of(values, by_thread(count, 3));
        const float blocks = sum_of(values, by_block(count, takers_of_two));
        if (two != three && two != blocks && three != blocks) return values;
    }
}

/// Twelve numbers, added up by two and by three threads in both ways.
void draw_sums(const std::string& folder) {
    Drawing drawing{.name = "parallel-sums",
                    .description = "Twelve numbers: parts of two and of three threads "
                                   "have different sums; blocks of three numbers have "
                                   "the same sum, whichever thread takes them",
                    .low{-2.75, -0.55},
                    .high{6.1, 4.2},
                    .scale = 82};
    const std::vector<float> values = list_of(12);
    draw_row(drawing, 3.6, "2 threads, parts", values, by_thread(12, 2));
    draw_row(drawing, 2.5, "3 threads, parts", values, by_thread(12, 3));
    draw_row(drawing, 1.2, "2 threads, blocks", values, by_block(12, takers_of_two));
    draw_row(drawing, 0.1, "3 threads, blocks", values, by_block(12, takers_of_three));
    save_drawing(folder, drawing);
}

} // namespace

/// Makes the chapter's drawing.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 34, many threads: a drawing.");
        const examples::Options options = line.parse({});
        draw_sums(options.path(""));
    });
}
