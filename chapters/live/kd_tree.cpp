// Live: a k-d tree of photons on a floor, and a search in it.
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "ljus/accel/kd_tree.hpp"
#include "ljus/math/random.hpp"

namespace {

using ljus::Vec3;

struct Range {
    std::size_t first = 0, last = 0;
};

struct Figure {
    ljus::KdTree tree;
    std::vector<float> places;         ///< x and y of each photon.
    std::vector<float> boxes;          ///< Of cut().
    std::vector<std::int32_t> offered; ///< Photons in the order of the search.
    std::vector<float> reaches;        ///< How far it reached after each.
    int boxes_asked = 0;
};
std::unique_ptr<Figure> figure;

/// Photons on the unit square: some anywhere, most in the rings of a caustic.
std::vector<Vec3> photons(int set, int count) {
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
        auto stream = random_stream(9, ljus::Pass::user, 0, std::uint64_t(i));
        const auto u = next_2d(stream);
        Vec3 p(u, 0);
        if (set == 1 && i % 4 != 0) {
            const auto v = next_2d(stream), w = next_2d(stream);
            const bool small = i % 4 == 1;
            const float angle = 2 * std::numbers::pi_v<float> * v.x;
            const float spread = 0.02f * (w.x + w.y + v.y - 1.5f);
            const float radius = (small ? 0.08f : 0.26f) + spread;
            const Vec3 middle = small ? Vec3(0.8f, 0.22f, 0) : Vec3(0.4f, 0.55f, 0);
            p = middle + radius * Vec3(std::cos(angle), std::sin(angle), 0);
        }
        points.push_back(p);
    }
    return points;
}

/// The ranges of the tree after some halvings; a range of 16 points is a leaf.
void ranges(std::vector<Range>& out, const Range& range, int halvings) {
    if (halvings == 0 || range.last - range.first <= 16) return out.push_back(range);
    const std::size_t middle = range.first + (range.last - range.first) / 2;
    ranges(out, {range.first, middle}, halvings - 1);
    ranges(out, {middle, range.last}, halvings - 1);
}

} // namespace

extern "C" {

/// Builds the tree.
/// \return x and y of each photon, in the tree's order.
[[gnu::used]] const float* build(int set, int count) {
    figure = std::make_unique<Figure>();
    const std::vector<Vec3> points = photons(set, count);
    figure->tree = ljus::KdTree(std::span<const Vec3>(points));
    for (const Vec3& p : figure->tree.points()) {
        figure->places.push_back(p.x);
        figure->places.push_back(p.y);
    }
    return figure->places.data();
}

/// The ranges after some halvings: first and last photon, then the corners of the box.
[[gnu::used]] int cut(int halvings) {
    std::vector<Range> all;
    const std::vector<Vec3>& points = figure->tree.points();
    ranges(all, {0, points.size()}, halvings);
    figure->boxes.clear();
    for (const Range& range : all) {
        Vec3 low = points[range.first], high = low;
        for (std::size_t i = range.first; i < range.last; ++i) {
            low = glm::min(low, points[i]);
            high = glm::max(high, points[i]);
        }
        for (const float x : {float(range.first), float(range.last), low.x, low.y,
                              high.x, high.y})
            figure->boxes.push_back(x);
    }
    return static_cast<int>(all.size());
}
[[gnu::used]] const float* cut_boxes() { return figure->boxes.data(); }

/// Searches the k nearest photons within a radius, and writes down the way.
/// \return How many photons' distances were computed.
[[gnu::used]] int search(double x, double y, int k, double radius) {
    std::vector<ljus::Neighbor> found(static_cast<std::size_t>(k));
    ljus::Nearest best{.found = found, .limit2 = radius * radius};
    figure->offered.clear();
    figure->reaches.clear();
    figure->boxes_asked = 0;
    const auto reach = [&] {
        return float(std::sqrt(best.count == found.size() ? found[0].distance2
                                                          : best.limit2));
    };
    figure->tree.walk(
        Vec3(x, y, 0),
        [&](std::uint32_t index, double distance2) {
            if (best.reaches(distance2)) best.take({distance2, index});
            figure->offered.push_back(std::int32_t(index));
            figure->reaches.push_back(reach());
        },
        [&](double distance2) {
            ++figure->boxes_asked;
            return best.reaches(distance2);
        });
    return static_cast<int>(figure->offered.size());
}
/// The photons of the search, in its order.
[[gnu::used]] const std::int32_t* search_order() { return figure->offered.data(); }
/// How far the search reached after each of them.
[[gnu::used]] const float* search_reach() { return figure->reaches.data(); }
[[gnu::used]] int search_boxes() { return figure->boxes_asked; }

[[gnu::used]] int checks() { return 8; }
[[gnu::used]] double check(int i) {
    auto kept = std::move(figure); // the page goes on with its own
    build(i % 2, 2000);
    const double number = i < 2 ? cut(4) : search(0.3, 0.6, i < 4 ? 50 : 7, 1);
    const double found = i < 6 ? number : double(figure->reaches.back());
    figure = std::move(kept);
    return found;
}

/// Sines and cosines of two C libraries place the photons of the rings.
[[gnu::used]] double tolerance() { return 1e-6; }

} // extern "C"
