# Facets without their fourth power: more of them than the surface has room for.
ljus_break_it(NAME microfacet-power HEADER optics/microfacet.hpp TEST microfacet
    FROM "return std::numbers::inv_pi_v<T> / (size * size);"
    TO   "return std::numbers::inv_pi_v<T> / size;"
    CASES "microfacet: seen from above*")

# Shadowing by slopes that are not squared.
ljus_break_it(NAME microfacet-smith HEADER optics/microfacet.hpp TEST microfacet
    FROM "alpha * alpha * (w.x * w.x"
    TO   "alpha * (w.x * w.x"
    CASES "microfacet: the facets that are seen*")

# A cap that begins at the horizon: facets drawn as they are seen from above.
ljus_break_it(NAME microfacet-cap HEADER optics/microfacet.hpp TEST microfacet
    FROM "const T t = u.y * (T(1) + w.z);"
    TO   "const T t = u.y;"
    CASES "microfacet: visible normals*")

# The middle without its scale: grazing directions have none.
ljus_break_it(NAME microfacet-middle HEADER optics/microfacet.hpp TEST microfacet
    FROM "return glm::normalize(sum / max_component(glm::abs(sum)));"
    TO   "return glm::normalize(sum);"
    CASES "microfacet: the middle*")

# The mirror direction of a ray that travels the other way: under the surface.
ljus_break_it(NAME glossy-direction HEADER materials/glossy.hpp TEST glossy
    FROM "reflect(-out, h)"
    TO   "reflect(out, h)"
    CASES "glossy: the smoother*")

# Jacobian 4 in place of 2 times the root: half of the light.
ljus_break_it(NAME glossy-half HEADER materials/glossy.hpp TEST glossy
    FROM "const T f = ggx_distribution(alpha, h) / (T(2) * shadowed);"
    TO   "const T f = ggx_distribution(alpha, h) / (T(4) * shadowed);"
    CASES "glossy: white*")

# A pdf that forgets that facets hide each other.
ljus_break_it(NAME glossy-pdf HEADER materials/glossy.hpp TEST glossy
    FROM "(T(2) * (out.z + detail::ggx_lambda(alpha, out)));"
    TO   "(T(4) * out.z);"
    CASES "glossy: samples*")

# Shadowing of one way only: no reciprocity.
ljus_break_it(NAME glossy-reciprocity HEADER materials/glossy.hpp TEST glossy
    FROM "const T shadowed = out.z * r_in + in.z * r_out;"
    TO   "const T shadowed = out.z * in.z + in.z * r_out;"
    CASES "glossy: light goes*")

# The other side dark.
ljus_break_it(NAME glossy-side HEADER materials/glossy.hpp TEST glossy
    FROM "in.z = std::copysign(in.z, wo.z);"
    TO   ""
    CASES "glossy: samples*")

# A mirror that is darker from below.
ljus_break_it(NAME glossy-below HEADER materials/glossy.hpp TEST glossy
    FROM "detail::facet_reflectance(gloss.reflectance, std::min(out.z, T(1)))"
    TO   "detail::facet_reflectance(gloss.reflectance, wo.z)"
    CASES "glossy: a mirror from below*")

# Facets that reflect nothing make a sample of nothing.
ljus_break_it(NAME glossy-black HEADER materials/glossy.hpp TEST glossy
    FROM "if (is_black(weight)) return std::nullopt;"
    TO   ""
    CASES "glossy: black facets*")

# Broad gloss taken for a mirror.
ljus_break_it(NAME glossy-nearly HEADER materials/material.hpp TEST glossy
    FROM "typical->pdf > T(1)"
    TO   "typical->pdf > T(0.1)"
    CASES "glossy: nearly*")

# Gloss on a matt ground taken for a mirror.
ljus_break_it(NAME glossy-matt HEADER materials/material.hpp TEST glossy
    FROM " || has(lobes(m), Lobes::diffuse)) return false;"
    TO   ") return false;"
    CASES "glossy: nearly*")
