/// \file journey.cpp
/// \brief The journey of one camera ray, or of one photon, through the library: the
/// functions that it enters, in order. ./scripts/journey compiles this with
/// -finstrument-functions, runs it and reads what it prints.
//
//     journey camera-ray     one vertex with its shadow ray, and the next step
//     journey photon         a photon is emitted, stored and scattered

#include <cstdio>
#include <cstring>

#include <ljus/ljus.hpp>

using namespace ljus;

namespace {

bool recording = false;

using Room = Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass>>;

/// The scene of the README's first program.
World<Room> first_picture() {
    Room scene;
    const auto grey = scene.add(Lambertian{.albedo = Rgb{0.7f}});
    const auto glass = scene.add(Glass{.index = 1.5f});
    scene.add(Quad{.corner{-6, 0, 4}, .edge_u{12, 0, 0}, .edge_v{0, 0, -12}}, grey);
    scene.add(Sphere{.center{0, 1.2f, 0}, .radius = 1}, glass);
    scene.add(Sphere{.center{-3, 5, -2}, .radius = 0.5f}, grey, Rgb{50});
    return World(std::move(scene));
}

/// Whether a path tracer's ray found light by a shadow ray.
bool send_ray(const PathTracer<World<Room>>& tracer, std::uint64_t path) {
    auto stream = random_stream(1, Pass::camera, 0, path);
    Counts counts;
    auto context = context_of(stream, counts);
    const Ray ray{.origin{-2, 3, 6},
                  .direction = glm::normalize(Vec3{-0.2f, -0.6f, -1})};
    recording = true;
    const Rgb found = radiance(tracer, ray, context);
    recording = false;
    return counts.shadow_rays == 1 && !is_black(found);
}

/// Whether a photon was stored and scattered.
bool send_photon(const World<Room>& world, std::uint64_t path) {
    const PhotonPassSettings pass{.max_bounces = 1, .shadow_photons = false};
    auto stream = random_stream(1, Pass::general_photons, 0, path);
    detail::PhotonBlockT<float> block;
    recording = true;
    const EmittedPhotonT<float> photon = emit(world, world.light_choice(), stream);
    detail::trace_photon(world, MapType::general, {photon}, pass, stream, block);
    recording = false;
    return block.photons.size() == 1 && !is_black(block.audit.cut);
}

} // namespace

/// Called by every function of the library as it is entered.
extern "C" [[gnu::no_instrument_function]] void __cyg_profile_func_enter(void* callee,
                                                                         void*) {
    if (recording) std::printf("> %p\n", callee);
}
/// Called as it is left.
extern "C" [[gnu::no_instrument_function]] void __cyg_profile_func_exit(void*, void*) {
    if (recording) std::printf("<\n");
}

int main(int argc, char** argv) {
    const bool photon = argc > 1 && std::strcmp(argv[1], "photon") == 0;
    const World<Room> world = first_picture();
    const PathTracer tracer(world, {.max_depth = 1});
    for (std::uint64_t path = 0; path < 1000; ++path) {
        std::printf("new\n"); // discards the record of a path of another kind
        if (photon ? send_photon(world, path) : send_ray(tracer, path)) return 0;
    }
    return 1;
}
