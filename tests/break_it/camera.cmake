# The full angle in place of its half.
ljus_break_it(NAME camera-half-angle HEADER scene/camera.hpp TEST camera
    FROM "std::numbers::pi_v<W> / W(360)"
    TO   "std::numbers::pi_v<W> / W(180)"
    CASES "camera: two Cornell boxes*")

# y counts from the top.
ljus_break_it(NAME camera-upside-down HEADER scene/camera.hpp TEST camera
    FROM "(T(height) / T(2) - pixel.y)"
    TO   "(pixel.y - T(height) / T(2))"
    CASES "camera: the picture's middle*")
