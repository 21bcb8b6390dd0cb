# The report's program: the flux times the cosine that the density already holds.
ljus_break_it(NAME emission-cosine HEADER photons/photon_path.hpp TEST emission
    FROM ".flux = photon.flux / chosen.probability,"
    TO   ".flux = photon.flux * sample_cosine_hemisphere(u_direction).z /
                    chosen.probability,"
    CASES "emission: photons of a quad*")

# Directions uniform over the hemisphere, at unchanged flux.
ljus_break_it(NAME emission-uniform HEADER lights/area_light.hpp TEST emission
    FROM "sample_cosine_hemisphere(u)"
    TO   "sample_uniform_hemisphere(u)"
    CASES "emission: photons of a quad*")

# A light that is chosen rarely must be paid for it.
ljus_break_it(NAME emission-probability HEADER photons/photon_path.hpp TEST emission
    FROM "photon.flux / chosen.probability"
    TO   "photon.flux"
    CASES "emission: lights are chosen*")

# A room of light that shines outwards.
ljus_break_it(NAME emission-inside-out HEADER lights/area_light.hpp TEST emission
    FROM "}();
    if (light.lamp.inside_out) point.normal = -point.normal;"
    TO   "}();"
    CASES "emission: a room*")

# The report's program: aimed photons as if they had been sent everywhere.
ljus_break_it(NAME aim-weight HEADER photons/aiming.hpp TEST emission
    FROM "(emitted / (pdf * u.probability))"
    TO   "(T(1) / u.probability)"
    CASES "emission: aimed at a sphere*")

# The density of the chosen cone alone, without the choice.
ljus_break_it(NAME aim-choice HEADER photons/aiming.hpp TEST emission
    FROM "aimed.pdf *= at.size / chosen->sum;"
    TO   ""
    CASES "emission: where cones overlap*")

# The cosine at the lamp, forgotten: right for a point light only.
ljus_break_it(NAME aim-cosine HEADER lights/area_light.hpp TEST emission
    FROM "cosine * std::numbers::inv_pi_v<T>"
    TO   "std::numbers::inv_pi_v<T>"
    CASES "emission: aimed at a sphere*")

# Within the bound of its target a lamp needs its whole hemisphere.
ljus_break_it(NAME aim-inside HEADER lights/area_light.hpp TEST emission
    FROM "return {point.normal, T(1)};"
    TO   "return {point.normal, T(0.5)};"
    CASES "emission: a lamp within*")

# Each wall around a lamp is a target of its own, and photons count for all of them.
ljus_break_it(NAME aim-walls HEADER photons/aiming.hpp TEST emission
    FROM "if (at.at_all && !at_all.empty()) at.size = T(0);"
    TO   ""
    CASES "emission: aimed photons bring*")

# A target takes the place of the one before with its share, but u is not stretched: the
# first ones are chosen too often, and the others never.
ljus_break_it(NAME aim-stretch HEADER photons/aiming.hpp TEST emission
    FROM "u_target = (u_target - share) / (T(1) - share);"
    TO   ""
    CASES "emission: where cones overlap*")

# A sun whose rays start within the ball that they should reach.
ljus_break_it(NAME emission-sun-plane HEADER lights/light.hpp TEST emission
    FROM "Vec3T<T>{disc.x, disc.y, -back}"
    TO   "Vec3T<T>{disc.x, disc.y, T(0)}"
    CASES "emission: a sun*")

# A spot light as bright at its rim as in its middle, at the flux of the one that fades.
ljus_break_it(NAME emission-spot-rim HEADER lights/spot_light.hpp TEST emission
    FROM "return light.outer - std::sqrt(beyond);"
    TO   "return light.outer - beyond / both;"
    CASES "emission: a spot light*")

# Aimed at by a sun, a disc is paid for its own area only.
ljus_break_it(NAME aim-sun HEADER photons/aiming.hpp TEST emission
    FROM "disc_area(bound.radius)}"
    TO   "bound.radius * bound.radius}"
    CASES "emission: aimed photons bring*")

# The plain way to aim: as if the light sent all of its flux into half of the sphere.
ljus_break_it(NAME emission-aim-at-ball HEADER photons/aiming.hpp TEST emission
    FROM "power(light) * (cone.one_minus_cos / T(2))"
    TO   "power(light) * cone.one_minus_cos"
    CASES "emission: aimed at one ball*")

# Photons that a sun aims downstream start within the scene.
ljus_break_it(NAME emission-sun-start HEADER lights/light.hpp TEST emission
    FROM "glm::dot(center - around.center, direction) + around.radius"
    TO   "around.radius"
    CASES "emission: a sun's photons start*")

# A target without a size comes first: 0/0.
ljus_break_it(NAME emission-no-size HEADER photons/aiming.hpp TEST emission
    FROM "if (!(at.size > T(0))) continue;"
    TO   ""
    CASES "emission: what has no size*")

# A spot by its even part: photons go beside the target.
ljus_break_it(NAME aim-spot-inner HEADER lights/spot_light.hpp TEST emission
    FROM "return {light.direction, light.outer};"
    TO   "return {light.direction, light.inner};"
    CASES "emission: a spot that is wider*")

# What is matt and a mirror at once has no caustic.
ljus_break_it(NAME aim-mixtures HEADER photons/aiming.hpp TEST emission
    FROM "has(lobes(m), Lobes::specular)"
    TO   "lobes(m) == Lobes::specular"
    CASES "emission: what is mirror or glass*")

# The point that says where on a light says where to.
ljus_break_it(NAME emission-point-direction HEADER lights/point_light.hpp TEST emission
    FROM "sample_uniform_sphere(u)"
    TO   "sample_uniform_sphere(Vec2T<T>{T(0.25), T(0.25)})"
    CASES "emission: one point of the square*")

# The light of number 300 is told as that of number 44.
ljus_break_it(NAME emission-light-number HEADER photons/photon_path.hpp TEST emission
    FROM "static_cast<std::uint16_t>(chosen.light)"
    TO   "static_cast<std::uint8_t>(chosen.light)"
    CASES "emission: a photon knows its light*")
