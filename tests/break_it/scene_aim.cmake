# The weight of a photon in the cone, as if all photons were sent into it.
ljus_break_it(NAME scene-aim-part HEADER photons/scene_aim.hpp TEST scene_aim
    FROM "inside ? part * pdf_uniform_cone"
    TO   "inside ? pdf_uniform_cone"
    CASES "scene aim: a far point light*")

# A photon that was sent anywhere, and lies in the cone by chance, has the same density.
ljus_break_it(NAME scene-aim-inside HEADER photons/scene_aim.hpp TEST scene_aim
    FROM "inside = glm::dot(apart, apart) <= T(2) * cone.one_minus_cos;"
    TO   "inside = false && apart == apart;"
    CASES "scene aim: spots*")

# All photons go into the cone: what lies outside is dark.
ljus_break_it(NAME scene-aim-outside HEADER photons/scene_aim.hpp TEST scene_aim
    FROM "if (inside) {
        u.x /= part;"
    TO   "if (inside || !inside) {
        u.x /= part;"
    CASES "scene aim: what lies outside*")

# The light emits alike in all directions of the cone.
ljus_break_it(NAME scene-aim-density HEADER photons/scene_aim.hpp TEST scene_aim
    FROM "flux_leaving(light, point) * (emitted / drawn)"
    TO   "flux_leaving(light, point) * (T(0.25) * std::numbers::inv_pi_v<T> / drawn)"
    CASES "scene aim: far lamps*,scene aim: spots*")

# A far lamp belongs to the scene, whose sphere is then as large as its distance.
ljus_break_it(NAME scene-aim-far-lamp HEADER photons/scene_aim.hpp TEST scene_aim
    FROM "<= lamp.radius + matt.radius"
    TO   ">= 0"
    CASES "scene aim: the sphere*,scene aim: far lamps*")

# The sphere of the box, not of the objects.
ljus_break_it(NAME scene-aim-box HEADER photons/scene_aim.hpp TEST scene_aim
    FROM ".radius = 0};"
    TO   ".radius = glm::distance(box.low, box.high) / 2};"
    CASES "scene aim: the sphere*")

# A light is aimed wherever the cone is narrower than its emission.
ljus_break_it(NAME scene-aim-pays HEADER photons/scene_aim.hpp TEST scene_aim
    FROM "if (!(sum > squares)) return std::nullopt;"
    TO   "if (!(sum > 0)) return 1.0;"
    CASES "scene aim: spots*")

# A light within the scene is aimed as well.
ljus_break_it(NAME scene-aim-within HEADER photons/scene_aim.hpp TEST scene_aim
    FROM "if (cone.one_minus_cos == T(2)) return std::nullopt;"
    TO   "if (cone.one_minus_cos == T(2)) return 1.0;"
    CASES "scene aim: lights within*")

# Lights are chosen by all of their flux, most of which flies past the scene.
ljus_break_it(NAME scene-aim-choice HEADER photons/scene_aim.hpp TEST scene_aim
    FROM "* part.value_or(1.0);"
    TO   "* (part ? 1.0 : 1.0);"
    CASES "scene aim: lights are chosen*")

# Shares that the caller gives are taken for powers.
ljus_break_it(NAME scene-aim-given HEADER photons/tracing.hpp TEST scene_aim
    FROM "pass.light_shares.empty() && !pass.equal_lights"
    TO   "true"
    CASES "scene aim: lights are chosen*")

# A photon without flux is followed, and leaves shadow photons.
ljus_break_it(NAME scene-aim-black HEADER photons/tracing.hpp TEST scene_aim
    FROM "if (is_black(sent.photon.flux)) {"
    TO   "if (false && is_black(sent.photon.flux)) {"
    CASES "scene aim: no photon leaves*")

# If one light is aimed, all are.
ljus_break_it(NAME scene-aim-all HEADER photons/scene_aim.hpp TEST scene_aim
    FROM "!is_aimed.empty() && is_aimed[number]"
    TO   "!is_aimed.empty()"
    CASES "scene aim: lights are chosen*")
