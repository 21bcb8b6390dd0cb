# The rows around the poles count as much as those at the horizon.
ljus_break_it(NAME environment-solid-angle HEADER lights/environment.hpp TEST environment
    FROM "(below(y + 1) - below(y)) / width"
    TO   "(below(0 * y + height) - below(0)) / height / width"
    CASES "environment: the density*")

# Straight down, 1 - cos is 2 up to its last digits.
ljus_break_it(NAME environment-nadir HEADER lights/environment.hpp TEST environment
    FROM "const bool down = 2 * at.y >= rows;"
    TO   "const bool down = false;"
    CASES "environment: a bright spot*")

# What is turned beyond the edge of the picture stays there.
ljus_break_it(NAME environment-seam HEADER lights/environment.hpp TEST environment
    FROM "turns -= std::floor(turns);"
    TO   "turns = std::clamp(turns, T(0), T(1));"
    CASES "environment: where each*")

# Rays and photons turn the sky in opposite directions.
ljus_break_it(NAME environment-rotation HEADER lights/environment.hpp TEST environment
    FROM "+ T(0.5) + light.turn"
    TO   "+ T(0.5) - light.turn"
    CASES "environment: directions are drawn*")

# The sky shines from below.
ljus_break_it(NAME environment-arrival HEADER lights/environment.hpp TEST environment
    FROM "return {-wi, radiance / pdf};"
    TO   "return {wi, radiance / pdf};"
    CASES "environment: photons through*")

# Photons of dark directions are as strong as those of bright ones are many.
ljus_break_it(NAME environment-photon-flux HEADER lights/environment.hpp TEST environment
    FROM "return {-wi, radiance / pdf};"
    TO   "return {-wi, T(4) * std::numbers::pi_v<T> * radiance + T(0) * pdf};"
    CASES "environment: a caustic*")

# Power is what falls on a square metre.
ljus_break_it(NAME environment-power HEADER lights/environment.hpp TEST environment
    FROM "return detail::disc_area(light.around.radius) * light.sum;"
    TO   "return light.sum;"
    CASES "environment: the density*")

# Shadow rays end within the scene, and nothing far away casts a shadow.
ljus_break_it(NAME environment-shadow HEADER lights/environment.hpp TEST environment
    FROM "from + T(2) * light.around.radius * wi"
    TO   "from + T(0.1) * light.around.radius * wi"
    CASES "environment: a sun of one pixel*")

# The strength is forgotten.
ljus_break_it(NAME environment-strength HEADER lights/environment.hpp TEST environment
    FROM "radiance *= light.strength;"
    TO   "radiance *= T(1);"
    CASES "environment: a matt floor*")

# The gradient upside down.
ljus_break_it(NAME environment-gradient HEADER lights/environment.hpp TEST environment
    FROM "horizon + sine * (zenith - horizon)"
    TO   "zenith + sine * (horizon - zenith)"
    CASES "environment: a gradient*")

# A black picture gives 0/0.
ljus_break_it(NAME environment-black HEADER image/image.hpp TEST environment
    FROM "black = black && is_black(c);"
    TO   "black = false;"
    CASES "environment: what is no sky*")

# Nothing is said about a room with a window.
ljus_break_it(NAME environment-window HEADER inspect/scene_remarks.hpp TEST environment
    FROM "sky > 0 && sky < 0.25"
    TO   "sky > 0.25"
    CASES "environment: it is said*")
