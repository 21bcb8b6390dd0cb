# Photons shine through the surface that they lie on.
ljus_break_it(NAME photon-dots-side HEADER inspect/photon_dots.hpp TEST photon_dots
    FROM "if (photon_side(photon.direction, normal) != photon_side(ray.direction, normal))"
    TO   "if (false)"
    CASES "photon dots: a photon is seen on the side*")

# All dots, whatever stands in front of them.
ljus_break_it(NAME photon-dots-depth HEADER inspect/photon_dots.hpp TEST photon_dots
    FROM "std::abs(hit->at.t - T(1)) > T(1e-3)"
    TO   "false"
    CASES "photon dots: what stands in front*")

# A dot is as large as the reach of its cone.
ljus_break_it(NAME photon-dots-cone HEADER inspect/photon_dots.hpp TEST photon_dots
    FROM "T(1) - distance / radius"
    TO   "T(1) - distance * distance / (radius * radius)"
    CASES "photon dots: a dot is a cone*")

# The emission's back is as bright as its front.
ljus_break_it(NAME photon-dots-lamp HEADER path/next_vertex.hpp TEST photon_dots
    FROM "wo.z > T(0) && !is_black(object.emission)"
    TO   "!is_black(object.emission)"
    CASES "photon dots: the drawing*")

# A picture is taken to be as high as it is wide.
ljus_break_it(NAME photon-dots-height HEADER inspect/photon_dots.hpp TEST photon_dots
    FROM "place->y < T(height)"
    TO   "place->y < T(width)"
    CASES "photon dots: in pictures that are wider*")
