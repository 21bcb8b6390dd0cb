// smoke:
/// \file 23_flatland.cpp
/// \brief Chapter 23: sixty photons in a two-dimensional room, and where they are
/// stored.
// runs in the folder of its picture

#include <string>
#include <variant>

#include "common/drawing.hpp"
#include "flatland/photon_map.hpp"
#include "flatland/room.hpp"

using namespace flatland;
using examples::flat;

namespace {

/// The colour of a photon of each kind.
const char* color_of(ljus::PhotonKind kind) {
    if (kind == ljus::PhotonKind::direct) return examples::colors::blue;
    return kind == ljus::PhotonKind::caustic ? examples::colors::orange
                                             : examples::colors::green;
}

/// Draws the walls, the mirror, the disc and the lamp.
void draw_room(examples::Drawing& figure, const Scene& scene, const Circle& lamp) {
    for (const Object& object : scene.objects)
        if (const auto* wall = std::get_if<Segment>(&object.shape)) {
            const bool mirror = std::holds_alternative<Mirror>(object.material);
            draw_line(figure, {flat(wall->from), flat(wall->to)},
                      {.width = mirror ? 5.0 : 1.5});
        }
    draw_area(figure, circle(flat(room_disc.center), room_disc.radius),
              examples::colors::blue);
    draw_dot(figure, flat(lamp.center), lamp.radius * figure.scale,
             examples::colors::orange);
    draw_label(figure, {lamp.center.x - 0.12, lamp.center.y + 0.06}, "lamp");
    draw_label(figure, flat(room_disc.center), "glass");
    draw_label(figure, {0.87, 0.85}, "mirror");
}

} // namespace

/// Draws the paths of sixty photons.
int main() {
    const RoomSettings settings;
    const Scene scene = make_room(settings);
    examples::Drawing figure{.name = "flatland-room",
                             .description =
                                 "A room of the plane with the paths of 60 photons",
                             .low{-1.05, -0.06},
                             .high{1.05, 1.16},
                             .scale = 340};
    PhotonMap map;
    const double flux = 1; // of each photon; has no effect on the drawing
    for (int i = 0; i < 60; ++i) {
        auto stream = photon_stream({}, i);
        const PathState photon = emit_photon(scene, flux, stream);
        Vec2 last = photon.ray.origin;
        const auto at_vertex = [&](const PathState& path, const Vertex& vertex) {
            draw_line(figure, {flat(last), flat(vertex.point.position)},
                      {color_of(kind_of(path)), 0.8});
            store_photon(path, vertex, map);
            last = vertex.point.position;
        };
        trace_photon(scene, photon, stream, 1000, at_vertex);
    }
    for (const Photon& photon : map)
        draw_dot(figure, flat(photon.position), 3.5, color_of(photon.kind));
    draw_room(figure, scene, {settings.lamp, settings.lamp_size});
    save_drawing(".", figure);
}
