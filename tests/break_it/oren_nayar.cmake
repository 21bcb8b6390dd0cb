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
    FROM "std::numbers::inv_pi_v<T> *
                             detail::oren_nayar_ratio(surface.sigma, wo, wi)"
    TO   "detail::oren_nayar_ratio(surface.sigma, wo, wi)"
    CASES "oren_nayar: the albedo*")

# The larger angle's tangent: the division by the wrong cosine.
ljus_break_it(NAME oren_nayar-tangent HEADER materials/oren_nayar.hpp TEST oren_nayar
    FROM "std::max(std::abs(wi.z), std::abs(wo.z))"
    TO   "std::min(std::abs(wi.z), std::abs(wo.z))"
    CASES "oren_nayar: within 64*")

# The full model without the cube: too bright where the azimuths are opposed.
ljus_break_it(NAME rough_diffuse-cube HEADER materials/rough_diffuse.hpp TEST rough_diffuse
    FROM "cos_phi >= T(0) ? T(0) : steep * steep * steep"
    TO   "T(0)"
    CASES "rough_diffuse: within 64*")

# Fujii's term divided behind the normal too: the loss at the far side is too deep.
ljus_break_it(NAME rough_diffuse-fujii HEADER materials/rough_diffuse.hpp TEST rough_diffuse
    FROM "return s > T(0) ? s / larger_cosine(wo, wi) : std::max(s, T(-1));"
    TO   "return s / larger_cosine(wo, wi);"
    CASES "rough_diffuse: within 64*")

# EON without what it gives back: Fujii's second model, and darker than white.
ljus_break_it(NAME eon-nothing-back HEADER materials/eon.hpp TEST eon
    FROM "both * multiple_scattering(surface.albedo, ar * eon_mean_loss<T>);"
    TO   "T(0) * both * multiple_scattering(surface.albedo, ar * eon_mean_loss<T>);"
    CASES "eon: white returns*")

# The cut at the horizon forgotten in the density.
ljus_break_it(NAME eon-horizon HEADER materials/eon.hpp TEST eon
    FROM "std::numbers::inv_pi_v<T> / lobe.kept;"
    TO   "std::numbers::inv_pi_v<T>;"
    CASES "eon: the density integrates*")

# A Jacobian of lengths for one of solid angles.
ljus_break_it(NAME eon-jacobian HEADER materials/eon.hpp TEST eon
    FROM "std::max(T(0), v.z) * jacobian * jacobian"
    TO   "std::max(T(0), v.z) * jacobian"
    CASES "eon: directions agree*")

# Divided by a cosine of which nothing is left.
ljus_break_it(NAME oren_nayar-horizon HEADER materials/oren_nayar.hpp TEST oren_nayar
    FROM "epsilon * epsilon)"
    TO   "T(0) * epsilon)"
    CASES "oren_nayar: finite where*")

# The full model of 1994 where it is below 0: light is taken away.
ljus_break_it(NAME rough_diffuse-negative HEADER materials/rough_diffuse.hpp
    TEST rough_diffuse
    FROM "surface.albedo * (ratios.single + ratios.twice * surface.albedo), T(0));"
    TO   "surface.albedo * (ratios.single + ratios.twice * surface.albedo), T(-1));"
    CASES "rough_diffuse: light is never*")

# Fujii's second model at roughness 1, by a rounding below 0.
ljus_break_it(NAME rough_diffuse-fon-border HEADER materials/rough_diffuse.hpp
    TEST rough_diffuse
    FROM "std::max(s, T(-1));"
    TO   "s;"
    CASES "rough_diffuse: light is never*")

# Black is sampled, and its path goes on with nothing.
ljus_break_it(NAME eon-black HEADER materials/eon.hpp TEST eon
    FROM "|| is_black(surface.albedo)) return std::nullopt;"
    TO   ") return std::nullopt;"
    CASES "eon: black has no sample*")

# The fit of the lobe leans to the wrong side, straight on.
ljus_break_it(NAME eon-pole HEADER materials/eon.hpp TEST eon
    FROM "lobe.d = std::min(lobe.d, T(0));"
    TO   ";"
    CASES "eon: what is lost*")
