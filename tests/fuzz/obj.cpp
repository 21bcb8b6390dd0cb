/// \file tests/fuzz/obj.cpp
/// \brief OBJ files, and behind the letter 0x01 the materials that they name.

#include "fuzz_mesh.hpp"

#include "ljus/io/load_obj.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string all(reinterpret_cast<const char*>(data), size);
    const std::size_t end = std::min(all.find('\x01'), size);
    const std::size_t rest = std::min(end + 1, size);
    const fuzz::MemoryFile materials(data + rest, size - rest);
    const std::string text = "mtllib " + materials.path() + "\n" + all.substr(0, end);
    fuzz::read_mesh([&](const ljus::MeshFileSettings& settings) {
        return ljus::read_obj(text, "fuzz.obj", settings);
    });
    return 0;
}
