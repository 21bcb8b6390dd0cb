# A length in scene units, hidden in the code: at another size the picture is another one.
ljus_break_it(NAME extremes-epsilon HEADER geometry/surface_point.hpp TEST extremes
    FROM "T(2) * glm::dot(sizes(point.normal), point.error) + T(4) * last_place"
    TO   "T(1e-5)"
    CASES "extremes: at every power*")

# A light that is near is none: in a small room every light is near.
ljus_break_it(NAME extremes-near-light HEADER lights/light.hpp TEST extremes
    FROM "if (!(distance2 > T(0))) return std::nullopt;"
    TO   "if (!(distance2 > T(1e-6))) return std::nullopt;"
    CASES "extremes: lamps*")

# Far from the origin, float keeps silent.
ljus_break_it(NAME extremes-silence HEADER inspect/scene_remarks.hpp TEST extremes
    FROM "if (digits >= 3) {"
    TO   "if (digits >= 0) {"
    CASES "extremes: far*")

# A scene that is too large for float, and nobody says so.
ljus_break_it(NAME extremes-too-large HEADER inspect/scene_remarks.hpp TEST extremes
    FROM "reach = std::max(reach, max_component(far));"
    TO   ""
    CASES "extremes: from a millionth*")

# A surface counts as near by the size of all that there is: a far lamp makes any one near.
ljus_break_it(NAME extremes-camera-near HEADER inspect/scene_remarks.hpp TEST extremes
    FROM "if (height <= detail::leaving_distance(point))"
    TO   "if (height <= T(1e-6) * max_component(glm::abs(world.box().high)))"
    CASES "extremes: a camera in*")

# As many strips in a row as in a column, as in a picture that is square.
ljus_break_it(NAME extremes-strips HEADER render/render.hpp TEST extremes
    FROM "const int right = region.x + region.width;"
    TO   "const int right = region.x + region.height;"
    CASES "extremes: pictures of one*")
