// concept: photon_map
// alone: looks at the heap in operator new and delete
/// \file memory_test.cpp
/// \brief The most memory that photons, pixels, boxes and triangles take at a time.

#include <doctest/doctest.h>

#include <cstdlib> // which says whether this is glibc

#ifdef __GLIBC__
#if __GLIBC_PREREQ(2, 33) // has mallinfo2()

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <new>
#include <optional>
#include <string>

#include "ljus/accel/bvh.hpp"
#include "ljus/io/load_obj.hpp"
#include "ljus/io/load_stl.hpp"
#include "ljus/photons/photon_map.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/render/adaptive.hpp"
#include "ljus/scenes/mesh_formulas.hpp"
#include "support/mesh_bytes.hpp"
#include "support/rooms.hpp"
#include "support/within.hpp"

namespace {

std::atomic<long long> most{0};

/// The bytes that malloc() has given and that are not free again.
long long taken() {
    const auto heap = ::mallinfo2();
    return static_cast<long long>(heap.uordblks + heap.hblkhd);
}

/// Notes how much is taken, whenever a large piece comes or goes.
void look(std::size_t size) {
    if (size < 4096) return;
    const long long now = taken();
    for (long long old = most; now > old && !most.compare_exchange_weak(old, now);) {
    }
}

void* counted(void* memory, std::size_t size) {
    if (memory != nullptr) look(size);
    return memory;
}

void* required(void* memory, std::size_t size) {
    if (memory == nullptr) throw std::bad_alloc();
    return counted(memory, size);
}

void give(void* memory) noexcept {
    if (memory != nullptr) look(::malloc_usable_size(memory));
    std::free(memory);
}

/// The most bytes that are taken at a time while something is done, beyond those that
/// are taken before.
template <typename Work>
double peak_of(const Work& work) {
    const long long before = most = taken();
    work();
    return double(most - before);
}

} // namespace

void* operator new(std::size_t size) {
    return required(std::malloc(std::max(size, std::size_t(1))), size);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return counted(std::malloc(size), size);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto unit = std::size_t(alignment);
    return required(std::aligned_alloc(unit, (size + unit - 1) / unit * unit), size);
}
void operator delete(void* memory) noexcept {
    give(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    give(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    give(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    give(memory);
}

using namespace ljus;

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {

/// Bytes of the process in memory: now ("VmRSS:"), or at most ("VmHWM:").
double resident(const std::string& what) {
    std::ifstream in("/proc/self/status");
    std::string word;
    double kilobytes = 0;
    while (in >> word)
        if (word == what) in >> kilobytes;
    return 1024 * kilobytes;
}

/// The most memory that the process has while something is done, beyond what it has
/// before; nothing if the system does not tell.
template <typename Work>
std::optional<double> resident_peak_of(const Work& work) {
    ::malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5; // forgets the peak until now
    const double before = resident("VmRSS:");
    if (!(before > 0) || resident("VmHWM:") > before + 1e6) return std::nullopt;
    work();
    return resident("VmHWM:") - before;
}

} // namespace

// The first case: what others have freed would count.
TEST_CASE("memory: a photon takes some 60 bytes while its map is made") {
    const ljus_test::ClosedRoom room =
        ljus_test::make_room<float>(ljus_test::Ball::glass, ljus_test::Lamp::quad, 1);
    // By one thread: what two keep at a time depends on the load.
    const PhotonPassSettings pass{.photons = 1500000, .threads = 1};
    PhotonMap map;
    const auto peak = resident_peak_of([&] {
        map = detail::map_of_parts(
            detail::trace_parts(room, MapType::general, pass).parts, pass.threads);
    });
    REQUIRE(map.records.size() > 3000000);
    // What the heap keeps depends on the program: 54 bytes in one, 61 in another.
    if (peak) CHECK(*peak < 64.0 * double(map.records.size()));
    // What is foretold.
    const double mean = double(map.records.size()) / double(pass.photons);
    const double foretold = detail::expected_bytes<float>(pass.photons, mean);
    if (peak) CHECK(*peak == ljus_test::within(foretold, 0.2));
    // The tree of points that are kept by the caller.
    std::vector<Vec3> points(3000000);
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = {float(i % 1000), float(i % 777), float(i % 13)};
    KdTree8 tree;
    const auto built =
        resident_peak_of([&] { tree = KdTree8(std::span<const Vec3>(points), 1); });
    if (built) CHECK(*built < 30 * 3e6);
}

#endif

TEST_CASE("memory: a photon is never there twice while it is traced") {
    const ljus_test::ClosedRoom room =
        ljus_test::make_room<float>(ljus_test::Ball::glass, ljus_test::Lamp::quad, 1);
    const PhotonPassSettings pass{.photons = 300000, .threads = 1};
    detail::TracedPartsT<float> traced;
    const double tracing =
        peak_of([&] { traced = detail::trace_parts(room, MapType::general, pass); });
    const double photons = double(traced.stored);
    REQUIRE(photons > 300000);
    CHECK(tracing < 54 * photons); // 44 for each, and the photons of a round
    const PhotonMap map = detail::map_of_parts(std::move(traced.parts), pass.threads);
    CHECK(double(map.tree.bytes() + map.records.bytes()) < 50 * photons);
}

namespace {

/// A renderer of noise.
struct Noise {
    using Stream = RandomStream;
};
template <typename Context>
Rgb radiance(const Noise&, const Ray&, Context& context) {
    return Rgb{next_1d(context.stream)};
}

} // namespace

TEST_CASE("memory: adaptive rays add 24 bytes for each further pixel") {
    const auto peak = [](int height) {
        RenderSettings picture{.width = 300, .height = height, .samples = 6};
        picture.threads = 2;
        return peak_of([&] {
            (void)render_adaptive(
                Noise{}, Camera{}, picture,
                {.first = 2, .more = 4, .batches = 1, .disagreement = 0.3});
        });
    };
    const double small = peak(300), large = peak(1200);
    CHECK(large - small < 25.0 * 300 * 900);
    CHECK(small - 24.0 * 300 * 300 < 6e6); // the rows in work
}

TEST_CASE("memory: a box takes at most 104 bytes while its tree is built") {
    constexpr int count = 100'000;
    std::vector<Box> boxes;
    for (int i = 0; i < count; ++i) {
        const Vec3 corner{float(i), std::sin(float(i)), std::cos(1.3f * float(i))};
        boxes.push_back({corner, corner + 0.5f});
    }
    Bvh tree;
    const double peak =
        peak_of([&] { tree = Bvh(boxes, {.leaf_size = 1, .threads = 1}); });
    CHECK(tree.nodes().size() == 2 * count - 1); // the most that there can be
    CHECK(peak < 105.0 * count);
}

TEST_CASE("memory: a triangle takes at most 150 bytes while its file is read") {
    constexpr int side = 200;
    std::string text;
    const auto add = [&](const char* word, double x, double y, double z) {
        text.append(word).append(std::to_string(x)).append(" ");
        text.append(std::to_string(y)).append(" ").append(std::to_string(z)) += '\n';
    };
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x) {
            const double u = double(x) / side, v = double(y) / side;
            add("v ", u, v, 0.1 * std::sin(7 * u + v));
            add("vn ", 0, 0, 1);
            add("vt ", u, v, 0);
        }
    const auto corner = [](int number) {
        const std::string one = std::to_string(number);
        return " " + one + "/" + one + "/" + one;
    };
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const int a = y * (side + 1) + x + 1, b = a + 1, c = a + side + 1;
            text += "f" + corner(a) + corner(b) + corner(c) + "\n";
            text += "f" + corner(b) + corner(c + 1) + corner(c) + "\n";
        }
    LoadedMesh loaded;
    const double peak = peak_of([&] { loaded = read_obj(text, "hills.obj"); });
    REQUIRE(loaded.parts.size() == 1);
    const Mesh& mesh = loaded.parts[0].mesh;
    REQUIRE(mesh.size() == 2 * side * side);
    CHECK(peak < 150.0 * mesh.size());
    // Binary STL, where each triangle brings 50 bytes and its own corners.
    const Bytes bytes = ljus_test::stl_bytes(icosphere(Sphere{}, 6), false);
    LoadedMesh ball;
    const double with_file = peak_of([&] { ball = read_stl(bytes, "ball.stl"); });
    CHECK(ball.parts.at(0).mesh.data().positions.size() == 40962);
    CHECK(with_file < 150.0 * ball.parts.at(0).mesh.size());
}

#endif
#endif
