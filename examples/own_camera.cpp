/// \file own_camera.cpp
/// \brief Renders the report's room through a fisheye, a camera of the reader's own.
// runs in the folder of its picture

#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "own_camera.hpp"

/// Renders the report's room into own_camera.png.
int main() {
    using namespace ljus;
    const auto room = final_room();
    const reader::Fisheye eye{
        .at = look_at({.position{1, 0, 0}, .target{2, 0, 0}, .up{0, 0, 1}})};
    const PhotonMapper mapper(room.world);
    save_png(render(mapper, eye, {.width = 320, .height = 320, .samples = 49}).image,
             "own_camera.png");
}
