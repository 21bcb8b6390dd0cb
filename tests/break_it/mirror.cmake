# A cosine on top of the delta: mirrors that go dark at the rim.
ljus_break_it(NAME mirror-cosine HEADER materials/mirror.hpp TEST mirror
    FROM "specular_sample(reflect(wo), mirror.reflectance)"
    TO   "specular_sample(reflect(wo), mirror.reflectance * std::abs(wo.z))")
