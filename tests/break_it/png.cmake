# Divided by its largest value: a lamp that comes into view darkens the room.
ljus_break_it(NAME png-maximum HEADER io/png.hpp TEST png
    FROM "const double scale = std::exp2(options.exposure);"
    TO   "double most = 0;
    for (const RgbT<T>& c : image.pixels)
        most = std::fmax(most, std::fmax(c.x, std::fmax(c.y, c.z)));
    const double scale = std::exp2(options.exposure) / most;"
    CASES "png: a bright lamp*")
