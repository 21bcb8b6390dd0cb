ljus_break_it(NAME scene-material HEADER scene/scene.hpp TEST scene
    FROM "place++ == id.type && id.index < array.size()"
    TO   "place++ == id.type && id.index <= array.size()"
    CASES "scene: every bad input*")

# An object that is dark has the number of a light.
ljus_break_it(NAME scene-no-light HEADER scene/scene.hpp TEST scene
    FROM "? detail::no_light"
    TO   "? static_cast<std::uint32_t>(lights.size())"
    CASES "scene: an object knows*")
