// The file before the image.
// says: no matching function for call to .save_png

// [mistake]
#include <ljus/ljus.hpp>

int main() {
    const ljus::Image image = ljus::make_image(4, 4);
    save_png("picture.png", image);
}
// [mistake]
