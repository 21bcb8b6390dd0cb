ljus_break_it(NAME scene-material HEADER scene/scene.hpp TEST scene
    FROM "place++ == id.type && id.index < array.size()"
    TO   "place++ == id.type && id.index <= array.size()"
    CASES "scene: every bad input*")
