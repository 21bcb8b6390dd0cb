# The cosine of the angle between the directions for that between their azimuths: the
# report's program.
ljus_break_it(NAME oren_nayar-azimuth HEADER materials/oren_nayar.hpp TEST oren_nayar
    FROM "wi.x * wo.x + wi.y * wo.y)"
    TO   "glm::dot(wi, wo))"
    CASES "oren_nayar: the azimuths*,oren_nayar: the albedo*")

# The variant with 0.57, which imitates light from facet to facet.
ljus_break_it(NAME oren_nayar-variant HEADER materials/oren_nayar.hpp TEST oren_nayar
    FROM "T(0.33)"
    TO   "T(0.57)"
    CASES "oren_nayar: the albedo*")

ljus_break_it(NAME oren_nayar-missing-pi HEADER materials/oren_nayar.hpp TEST oren_nayar
    FROM "std::numbers::inv_pi_v<T> * oren_nayar_ratio(surface.sigma, wo, wi)"
    TO   "oren_nayar_ratio(surface.sigma, wo, wi)"
    CASES "oren_nayar: the albedo*")

# The larger angle's tangent: the division by the wrong cosine.
ljus_break_it(NAME oren_nayar-tangent HEADER materials/oren_nayar.hpp TEST oren_nayar
    FROM "std::max(std::abs(wi.z), std::abs(wo.z))"
    TO   "std::min(std::abs(wi.z), std::abs(wo.z))"
    CASES "oren_nayar: within 64*")
