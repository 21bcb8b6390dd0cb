# Divided by its largest value: a lamp that comes into view darkens the room.
ljus_break_it(NAME png-maximum HEADER io/png.hpp TEST png
    FROM "const double scale = std::exp2(options.exposure);"
    TO   "double most = 0;
    for (const RgbT<T>& c : image.pixels)
        most = std::fmax(most, std::fmax(c.x, std::fmax(c.y, c.z)));
    const double scale = std::exp2(options.exposure) / most;"
    CASES "png: a bright lamp*")

# The encoder goes on without the memory that it asked for.
ljus_break_it(NAME png-no-memory HEADER io/detail/stb_memory.hpp TEST png
    FROM "throw std::bad_alloc();"
    TO   "return nullptr;"
    CASES "png: an encoder*")
