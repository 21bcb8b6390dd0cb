# Frisvad's older construction takes no sign: it fails below the horizon.
ljus_break_it(NAME frame-sign HEADER math/frame.hpp TEST frame
    FROM "std::copysign(T(1), n.z)"
    TO   "T(1)")

# A forgotten minus makes the tangent lean the wrong way.
ljus_break_it(NAME frame-tangent HEADER math/frame.hpp TEST frame
    FROM "-sign * n.x}"
    TO   "sign * n.x}")

# To the world with the parts in the wrong order.
ljus_break_it(NAME frame-to-world HEADER math/frame.hpp TEST frame
    FROM "v.x * frame.tangent + v.y * frame.bitangent"
    TO   "v.y * frame.tangent + v.x * frame.bitangent"
    CASES "frame: to the world and back*")

# The side of the equator by its sign of zero: without that, frames jump there.
ljus_break_it(NAME frame-equator HEADER math/frame.hpp TEST frame
    FROM "std::copysign(T(1), n.z)"
    TO   "(n.z > T(0) ? T(1) : T(-1))"
    CASES "frame: on the equator*")
