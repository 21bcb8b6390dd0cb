// Live: a ray among balls in the plane z = 0, and the nodes that a search visits.
#include <array>
#include <cstdint>
#include <vector>

#include <ljus/accel/bvh.hpp>
#include <ljus/geometry/box.hpp>
#include <ljus/geometry/sphere.hpp>
#include <ljus/math/random.hpp>

namespace {

constexpr int most = 64; // balls
std::vector<ljus::Sphere> balls;
ljus::Bvh tree;

std::array<float, 3 * most> ball_numbers;
std::array<float, 7 * 2 * most> node_numbers;
std::array<std::int32_t, 2 * most> visited;
std::array<std::int32_t, 2 * most> asked; // a ball, and the nodes visited by then
int asked_count = 0;
ljus::NearestHit nearest;

void offer(std::uint32_t ball, ljus::Ray& ray) {
    if (const auto t = ljus::intersect(ray, balls[ball]))
        nearest.offer({.t = *t}, ball, ray);
}

ljus::Ray flat_ray(double x, double y, double to_x, double to_y) {
    const ljus::Vec3 from{x, y, 0}, to{to_x, to_y, 0};
    return {.origin = from, .direction = glm::normalize(to - from)};
}

} // namespace

extern "C" {

/// Balls in a square of 100 by 100, and the tree over them.
/// \return The number of nodes.
[[gnu::used]] int build(int count) {
    balls.clear();
    std::vector<ljus::Box> boxes;
    auto stream = ljus::random_stream(5, ljus::Pass::user, 0, 0);
    for (int i = 0; i < count && i < most; ++i) {
        const ljus::Vec2 at = 92.0f * ljus::next_2d<float>(stream) + 4.0f;
        const float radius = 1.2f + 2.4f * ljus::next_1d<float>(stream);
        balls.push_back({.center = {at, 0}, .radius = radius});
        boxes.push_back(ljus::bounds(balls.back()));
    }
    tree = ljus::Bvh(boxes, {.leaf_size = 2, .threads = 1});
    return int(tree.nodes().size());
}

/// Three numbers per ball: x, y, radius.
[[gnu::used]] const float* ball_data() {
    for (std::size_t i = 0; i < balls.size(); ++i) {
        ball_numbers[3 * i] = balls[i].center.x;
        ball_numbers[3 * i + 1] = balls[i].center.y;
        ball_numbers[3 * i + 2] = balls[i].radius;
    }
    return ball_numbers.data();
}

/// Seven numbers per node: its box (low x, low y, high x, high y), its first child or
/// primitive, its count of primitives, and its depth.
[[gnu::used]] const float* node_data() {
    node_numbers[6] = 0;
    for (std::size_t i = 0; i < tree.nodes().size(); ++i) {
        const auto& node = tree.nodes()[i];
        float* to = &node_numbers[7 * i];
        to[0] = node.box.low.x;
        to[1] = node.box.low.y;
        to[2] = node.box.high.x;
        to[3] = node.box.high.y;
        to[4] = float(node.first);
        to[5] = float(node.count);
        if (node.count == 0) // children stand behind their parents
            for (const auto child : {node.first, node.first + 1})
                node_numbers[7 * child + 6] = to[6] + 1;
    }
    return node_numbers.data();
}

/// Sends a ray through the tree.
/// \return How many nodes it visits; see way(), asked_balls() and hit().
[[gnu::used]] int shoot(double x, double y, double to_x, double to_y) {
    int count = 0;
    asked_count = 0;
    nearest = {};
    tree.closest(
        flat_ray(x, y, to_x, to_y),
        [&](std::uint32_t slot, ljus::Ray& ray) {
            const std::uint32_t ball = tree.primitive_ids()[slot];
            asked[2 * std::size_t(asked_count)] = std::int32_t(ball);
            asked[2 * std::size_t(asked_count) + 1] = count;
            ++asked_count;
            offer(ball, ray);
        },
        [&](std::uint32_t node) {
            visited[std::size_t(count++)] = std::int32_t(node);
        });
    return count;
}

/// The nodes that the last ray has visited, in order.
[[gnu::used]] const std::int32_t* way() {
    return visited.data();
}

/// The balls that it was tested with: each with the number of nodes visited until then.
[[gnu::used]] const std::int32_t* asked_balls() {
    return asked.data();
}

[[gnu::used]] int asked_number() {
    return asked_count;
}

/// The ball that the last ray hits; -1: none.
[[gnu::used]] int hit() {
    return nearest.found ? int(nearest.number) : -1;
}

/// How far it is to the hit.
[[gnu::used]] double distance() {
    return double(nearest.at.t);
}

/// The distance to the nearest hit if all balls are asked in turn.
[[gnu::used]] double distance_by_loop(double x, double y, double to_x, double to_y) {
    nearest = {};
    ljus::Ray ray = flat_ray(x, y, to_x, to_y);
    for (std::uint32_t i = 0; i < balls.size(); ++i) offer(i, ray);
    return distance();
}

[[gnu::used]] int checks() {
    return 3 * 20 + 1;
}

[[gnu::used]] double check(int number) {
    const int nodes = build(40);
    if (number == 60) return nodes;
    const int ray = number / 3;
    const double x = 2, y = 5.0 * ray, to_x = 98, to_y = 90 - 4.0 * ray;
    if (number % 3 == 2) return 1 + distance_by_loop(x, y, to_x, to_y);
    const int count = shoot(x, y, to_x, to_y);
    return number % 3 == 0 ? 1 + distance() : 100 * count + asked_count;
}

/// Float, rounded to the same bits.
[[gnu::used]] double tolerance() {
    return 0;
}

} // extern "C"
