# What is lost on the way in only: the directions cannot be exchanged.
ljus_break_it(NAME compensated_glossy-one-way HEADER materials/compensated_glossy.hpp TEST compensated_glossy
    FROM "const T again = out * in / loss.mean"
    TO   "const T again = T(0) * out + in"
    CASES "full glossy: light goes*")

# The mean forgotten: what comes back is less than what was lost.
ljus_break_it(NAME compensated_glossy-mean HEADER materials/compensated_glossy.hpp TEST compensated_glossy
    FROM "out * in / loss.mean * std::numbers::inv_pi_v<T>"
    TO   "out * in * std::numbers::inv_pi_v<T>"
    CASES "full glossy: white*,full glossy: smooth*")

# One reflection in place of two and more: light comes back that no facet reflected.
ljus_break_it(NAME compensated_glossy-series HEADER optics/energy_loss.hpp TEST compensated_glossy
    FROM "return reflectance * reflectance * (T(1) - loss) /"
    TO   "return (T(1) - loss) /"
    CASES "full glossy: it is the gloss*")

# The second lobe drawn, and not in the density.
ljus_break_it(NAME compensated_glossy-pdf HEADER materials/compensated_glossy.hpp TEST compensated_glossy
    FROM "return chance * first +
           (T(1) - chance) * detail::pdf_lost(gloss.loss, std::abs(wi.z));"
    TO   "return first;"
    CASES "full glossy: samples*")

# All cells of the table as likely as each other: the density of other directions.
ljus_break_it(NAME energy_loss-pdf HEADER optics/energy_loss.hpp TEST compensated_glossy
    FROM "return (loss.below[cell + 1] - loss.below[cell]) * cos_theta *"
    TO   "return (T(0) * loss.below[cell] + T(1) / T(loss.cells)) * cos_theta *"
    CASES "full glossy: samples*")

# A table in the cosine itself: too coarse at the horizon.
ljus_break_it(NAME energy_loss-place HEADER optics/energy_loss.hpp TEST compensated_glossy
    FROM "return std::sqrt(std::min(x, T(1))) * T(EnergyLossT<T>::cells);"
    TO   "return std::min(x, T(1)) * T(EnergyLossT<T>::cells);"
    CASES "facet loss*")

# Even in the cosine within a cell, where the density says even in its square.
ljus_break_it(NAME energy_loss-cell HEADER optics/energy_loss.hpp
    TEST compensated_glossy
    FROM "low * low + share * (high - low) * (high + low)"
    TO   "(low + share * (high - low)) * (low + share * (high - low))"
    CASES "facet loss: a cosine is drawn*")

# The two lobes are taken as if nothing were lost: right, but noisier.
ljus_break_it(NAME compensated_glossy-chance HEADER materials/compensated_glossy.hpp
    TEST compensated_glossy
    FROM "const T first = (T(1) - lost) * max_component(gloss.mean);"
    TO   "const T first = max_component(gloss.mean);"
    CASES "full glossy: the first reflection*")
