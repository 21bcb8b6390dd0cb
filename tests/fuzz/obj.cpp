/// \file tests/fuzz/obj.cpp
/// \brief OBJ files, and behind the letter 0x01 the materials that they name.

#include "fuzz.hpp"

#include "ljus/io/load_obj.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string all(reinterpret_cast<const char*>(data), size);
    const std::size_t end = std::min(all.find('\x01'), size);
    const std::size_t rest = std::min(end + 1, size);
    const fuzz::MemoryFile materials(data + rest, size - rest);
    const std::string text = "mtllib " + materials.path() + "\n" + all.substr(0, end);
    fuzz::refused_or_done([&] {
        using namespace ljus;
        const auto loaded = read_obj(text, "fuzz.obj", {.normals = ObjNormals::smooth});
        for (const auto& part : loaded.parts) {
            const Ray ray{.origin{0.1f, 0.2f, 9}, .direction{0, 0, -1}};
            const auto hit = intersect(ray, part.mesh);
            fuzz::require_that(!hit || hit->part < part.mesh.size(), "a hit is a part");
            fuzz::require_that(std::isfinite(area(part.mesh)), "an area is finite");
        }
        Scene<Shapes<Mesh>, Materials<Lambertian, Glass, Mirror>> scene;
        add_obj(scene, loaded);
    });
    return 0;
}
