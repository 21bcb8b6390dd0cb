/// \file keep_picture.cpp
/// \brief Writes a PNG as a JPEG of at most so many bytes, in the best quality that fits.
///
/// Usage: keep_picture IN.png OUT.jpg BYTES

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <vector>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#if __has_include(<stb/stb_image.h>)
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#else
#include <stb_image.h>
#include <stb_image_write.h>
#endif

int main(int argc, char** argv) {
    if (argc != 4) {
        std::fputs("usage: keep_picture IN.png OUT.jpg BYTES\n", stderr);
        return 2;
    }
    const auto most = static_cast<std::size_t>(std::atol(argv[3]));
    int width = 0, height = 0, channels = 0;
    unsigned char* pixels = stbi_load(argv[1], &width, &height, &channels, 3);
    if (!pixels) {
        std::fprintf(stderr, "keep_picture: cannot read %s: %s.\n", argv[1],
                     stbi_failure_reason());
        return 1;
    }
    std::vector<unsigned char> file;
    const auto append = [](void* to, void* data, int size) {
        auto& bytes = *static_cast<std::vector<unsigned char>*>(to);
        const auto* from = static_cast<unsigned char*>(data);
        bytes.insert(bytes.end(), from, from + size);
    };
    for (int quality = 90; quality >= 40; quality -= 5) {
        file.clear();
        stbi_write_jpg_to_func(append, &file, width, height, 3, pixels, quality);
        if (file.size() <= most) break;
    }
    stbi_image_free(pixels);
    if (file.size() > most) {
        std::fprintf(stderr, "keep_picture: %s does not fit into %s bytes.\n", argv[1],
                     argv[3]);
        return 1;
    }
    std::ofstream out(argv[2], std::ios::binary);
    out.write(reinterpret_cast<const char*>(file.data()),
              static_cast<std::streamsize>(file.size()));
    out.close();
    if (out) return 0;
    std::fprintf(stderr, "keep_picture: cannot write %s.\n", argv[2]);
    return 1;
}
