/// \file own_renderer.cpp
/// \brief Renders the report's room by ambient occlusion, a renderer of the reader's
/// own.
// runs in the folder of its picture

#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "own_renderer.hpp"

/// Renders the report's room into own_renderer.png.
int main() {
    using namespace ljus;
    const auto room = final_room();
    const reader::AmbientOcclusion open(room.world, 2.0f);
    save_png(
        render(open, room.camera, {.width = 320, .height = 320, .samples = 49}).image,
        "own_renderer.png");
}
