# Transparency that does not know of the mirror: the report's program, up to 1.6.
ljus_break_it(NAME mixture-energy HEADER materials/mixture.hpp TEST mixture
    FROM ".refract = specular * entering * mixture.transparency"
    TO   ".refract = specular * mixture.transparency"
    CASES "mixture: the report's thin glass*,mixture: what is in the furnace*")

# The matt part below the boundary lets all light out: no reciprocity, too bright.
ljus_break_it(NAME mixture-way-out HEADER materials/mixture.hpp TEST mixture
    FROM "const T in = T(1) - detail::boundary_reflectance(mixture, wi);"
    TO   "const T in = T(1);"
    CASES "mixture: samples*,mixture: coated*")

# Total reflection ignored for a material without specularity.
ljus_break_it(NAME mixture-total-ignored HEADER materials/mixture.hpp TEST mixture
    FROM "transparent && f >= T(1) ? T(1) : mixture.specularity * f"
    TO   "mixture.specularity * f"
    CASES "mixture: inside*")

ljus_break_it(NAME mixture-squared-index HEADER materials/mixture.hpp TEST mixture
    FROM "transport == Transport::radiance ? eta * eta : T(1)"
    TO   "T(1)"
    CASES "mixture: radiance*,mixture: at their ends*")

# The probability of the choice forgotten in the density.
ljus_break_it(NAME mixture-choice HEADER materials/mixture.hpp TEST mixture
    FROM "return share.diffuse / share.sum() * pdf_cosine_lobe"
    TO   "return pdf_cosine_lobe"
    CASES "mixture: samples*")

# A matt part so dark beside its gloss that its density is 0, which means a delta.
ljus_break_it(NAME mixture-density HEADER materials/mixture.hpp TEST mixture
    FROM "if (!(matt->pdf > T(0))) matt.reset();"
    TO   ""
    CASES "mixture: what is sampled and no delta*")

# What is thinner than air reflects as well.
ljus_break_it(NAME mixture-lobes-thin HEADER materials/mixture.hpp TEST mixture
    FROM "(mixture.index < T(1) || mixture.index > T(1));"
    TO   "(mixture.index > T(1));"
    CASES "mixture: it reports*")
