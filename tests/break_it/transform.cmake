# A mirrored triangle turned inside out.
ljus_break_it(NAME transform-mirror HEADER geometry/transform.hpp TEST transform
    FROM "mirrored ? triangle.v3 : triangle.v2"
    TO   "triangle.v2"
    CASES "transform: a flat shape*")

ljus_break_it(NAME transform-order HEADER geometry/transform.hpp TEST transform
    FROM "outer.linear * inner.translation + outer.translation"
    TO   "inner.translation + outer.translation"
    CASES "transform: a product*")

ljus_break_it(NAME transform-sense HEADER geometry/transform.hpp TEST transform
    FROM "glm::cross(k, e)"
    TO   "glm::cross(e, k)"
    CASES "transform: each kind*")
