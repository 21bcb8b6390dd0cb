ljus_break_it(NAME scene-material HEADER scene/scene.hpp TEST scene
    FROM "type++ == id.type && id.index < array.size()"
    TO   "type++ == id.type && id.index <= array.size()"
    CASES "scene: every bad input*")

# An object that is dark has the number of a light.
ljus_break_it(NAME scene-no-light HEADER scene/world.hpp TEST scene
    FROM "object.light = no_light;"
    TO   "object.light = static_cast<std::uint32_t>(lights_.size());"
    CASES "scene: an object knows*")
