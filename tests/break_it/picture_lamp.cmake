# Points are uniform over the lamp, as if all pixels were equally bright.
ljus_break_it(NAME picture_lamp-pdf HEADER lights/picture_light.hpp TEST picture_lamp
    FROM "return static_cast<T>(double(detail::brightness(radiance)) /"
    TO   "return static_cast<T>(double(detail::brightness(radiance) > 0 ? 5.0 : 5.0) /"
    CASES "picture lamp: the density*,picture lamp: shadow rays*")

# All photons carry the same colour.
ljus_break_it(NAME picture_lamp-flux HEADER lights/picture_light.hpp TEST picture_lamp
    FROM "return std::numbers::pi_v<T> / pdf_of_point(light, radiance) * radiance;"
    TO   "return power(light);"
    CASES "picture lamp: points*,picture lamp: photons*")

# The picture is upside down for who looks at it.
ljus_break_it(NAME picture_lamp-upside HEADER lights/picture_light.hpp TEST picture_lamp
    FROM "cell(T(1) - uv.y, light.picture.height)"
    TO   "cell(uv.y, light.picture.height)"
    CASES "picture lamp: who looks*")

# The corners beside a disc shine as well.
ljus_break_it(NAME picture_lamp-corners HEADER lights/picture_light.hpp TEST picture_lamp
    FROM "return !light.round || glm::dot(from_middle, from_middle) <= T(1);"
    TO   "return !light.round || glm::dot(from_middle, from_middle) <= T(9);"
    CASES "picture lamp: shadow rays*")

# The power of a disc is that of its square.
ljus_break_it(NAME picture_lamp-circle HEADER lights/picture_light.hpp TEST picture_lamp
    FROM "sum += part * RgbT<double>(there);"
    TO   "sum += RgbT<double>(there);"
    CASES "picture lamp: the density*")

# The lamp shines on its other side.
ljus_break_it(NAME picture_lamp-side HEADER lights/picture_light.hpp TEST picture_lamp
    FROM ".normal = inside_out ? -normal(shape) : normal(shape)"
    TO   ".normal = inside_out ? normal(shape) : -normal(shape)"
    CASES "picture lamp: photons*")

# A path that meets the lamp finds the mean of the picture.
ljus_break_it(NAME picture_lamp-met HEADER path/next_vertex.hpp TEST picture_lamp
    FROM "vertex.object.emission = radiance_at(*lamp, vertex.uv);"
    TO   "(void)lamp;"
    CASES "picture lamp: who looks*")

# For the weights, shadow rays are uniform over the lamp.
ljus_break_it(NAME picture_lamp-weights HEADER path/direct_light.hpp TEST picture_lamp
    FROM "return pdf_towards(*picture, from, lamp.point, lamp.uv);"
    TO   "return T(9) * pdf_towards(*picture, from, lamp.point, lamp.uv);"
    CASES "picture lamp: paths*")

# Aimed photons carry the mean colour of the lamp.
ljus_break_it(NAME picture_lamp-aimed HEADER photons/aiming.hpp TEST picture_lamp
    FROM "flux_leaving(light, point) * (emitted / (pdf * u.probability))"
    TO   "power(light) * (emitted / (pdf * u.probability))"
    CASES "picture lamp: aimed*")

# Photons from afar as well.
ljus_break_it(NAME picture_lamp-afar HEADER photons/scene_aim.hpp TEST picture_lamp
    FROM "flux_leaving(light, point) * (emitted / drawn)"
    TO   "power(light) * (emitted / drawn)"
    CASES "picture lamp: aimed*")

# A texture over a lamp hides the last pixel of its picture.
ljus_break_it(NAME picture_lamp-textured HEADER materials/textured.hpp TEST picture_lamp
    FROM "return emission_picture(m.base);"
    TO   "static auto other = emission_picture(m.base); other.pixels.back() = other.pixels[0]; return other;"
    CASES "picture lamp: a normal map*")

# Every object with a picture is said to be dark.
ljus_break_it(NAME picture_lamp-remark HEADER inspect/scene_remarks.hpp TEST picture_lamp
    FROM "shows && object.light == no_light ? 1 : 0"
    TO   "shows ? 1 : 0"
    CASES "picture lamp: one without*")
