#include <doctest/doctest.h>

#include <cstring>
#include <type_traits>

#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "support/rooms.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

/// Whether two lists hold the same bytes.
template <typename List>
bool same_bytes(const List& a, const List& b) {
    using V = typename List::value_type;
    static_assert(std::is_trivially_copyable_v<V>);
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (std::memcmp(&a[i], &b[i], sizeof(V)) != 0) return false;
    return true;
}

/// Whether two maps hold the same numbers; a record has padding, so not by bytes.
template <typename T>
bool same_map(const PhotonMapT<T>& a, const PhotonMapT<T>& b) {
    if (!same_bytes(a.tree.blocks(), b.tree.blocks()) ||
        !same_bytes(a.tree.point_ids(), b.tree.point_ids()) ||
        a.records.size() != b.records.size())
        return false;
    for (std::size_t i = 0; i < a.records.size(); ++i) {
        const auto x = a.records[i];
        const auto y = b.records[i];
        if (std::memcmp(&x.direction, &y.direction, sizeof(x.direction)) != 0 ||
            std::memcmp(&x.flux, &y.flux, sizeof(x.flux)) != 0 || x.light != y.light ||
            x.kind != y.kind)
            return false;
    }
    return true;
}

bool same_audit(const FluxAudit& a, const FluxAudit& b) {
    return std::memcmp(&a, &b, sizeof(FluxAudit)) == 0;
}

template <typename T>
PhotonMappingSettings settings_with(std::uint64_t seed, int threads) {
    PhotonMappingSettings settings;
    settings.indirect = IndirectLight::map;
    settings.caustics = {.photons = 5000, .seed = seed, .threads = threads};
    settings.general = {.photons = 5000, .seed = seed, .threads = threads};
    return settings;
}

bool same_counts(const Counts& a, const Counts& b) {
    return std::memcmp(&a, &b, sizeof(Counts)) == 0;
}

} // namespace

TEST_CASE_TEMPLATE("determinism: the same seed gives the same bytes on any number of "
                   "threads",
                   T, float, double) {
    const auto room = make_room<T>(Ball::mixture, Lamp::sphere, 2);
    const CameraT<T> camera = room_camera<T>();
    const PhotonMapper mapper(room, settings_with<T>(7, 1));
    const auto& maps = mapper.maps();
    CHECK_FALSE(maps.caustics.empty());
    CHECK_FALSE(maps.general.empty());
    const auto picture = [](int threads, std::uint64_t seed) {
        return RenderSettings{
            .width = 37, .height = 23, .samples = 3, .seed = seed, .threads = threads};
    };
    const PathTracer tracer(room);
    const auto traced = render(tracer, camera, picture(1, 5));
    const auto mapped = render(mapper, camera, picture(1, 5));
    for (const int threads : {1, 2, 3, 4}) {
        CAPTURE(threads);
        const PhotonMapper twin(room, settings_with<T>(7, threads));
        const auto& again = twin.maps();
        CHECK(same_map(maps.caustics, again.caustics));
        CHECK(same_map(maps.general, again.general));
        CHECK(same_audit(maps.caustics_audit, again.caustics_audit));
        CHECK(same_audit(maps.general_audit, again.general_audit));
        const auto one = render(tracer, camera, picture(threads, 5));
        const auto two = render(mapper, camera, picture(threads, 5));
        CHECK(same_bytes(traced.image.pixels, one.image.pixels));
        CHECK(same_bytes(mapped.image.pixels, two.image.pixels));
        CHECK(same_counts(traced.counts, one.counts));
        CHECK(same_counts(mapped.counts, two.counts));
    }

    // Another seed is another picture, pixel by pixel; so is another iteration.
    const auto other = render(tracer, camera, picture(2, 6));
    std::size_t equal = 0;
    for (std::size_t i = 0; i < other.image.pixels.size(); ++i)
        equal += other.image.pixels[i] == traced.image.pixels[i] ? 1 : 0;
    CHECK(equal < other.image.pixels.size() / 50);
    CHECK_FALSE(same_map(maps.caustics,
                         PhotonMapper(room, settings_with<T>(8, 1)).maps().caustics));
    auto next = settings_with<T>(7, 1);
    next.caustics.iteration = 1;
    CHECK_FALSE(same_map(maps.caustics, PhotonMapper(room, next).maps().caustics));
}

TEST_CASE("determinism: the two photon passes draw different numbers") {
    const ClosedRoom room = make_room<float>(Ball::mirror, Lamp::point, 1);
    const auto general = trace_photons(room, MapType::general, {.photons = 100});
    const auto caustics = trace_photons(room, MapType::caustics, {.photons = 100});
    for (const Photon& a : general.photons)
        for (const Photon& b : caustics.photons) CHECK_FALSE(a.position == b.position);
}

TEST_CASE("determinism: float and double render the same room") {
    const auto picture = RenderSettings{
        .width = 12, .height = 12, .samples = 100, .seed = 3, .threads = 1};
    const auto single = make_room<float>(Ball::glass, Lamp::quad, 1);
    const auto a = render(PathTracer(single), room_camera<float>(), picture).image;
    const auto room = make_room<double>(Ball::glass, Lamp::quad, 1);
    const auto b = render(PathTracer(room), room_camera<double>(), picture).image;
    double x = 0, y = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        x += double(a.pixels[i].y);
        y += b.pixels[i].y;
    }
    // The same random numbers except for their last bits: closer than two seeds.
    CHECK(x == doctest::Approx(y).epsilon(0.02));
}
