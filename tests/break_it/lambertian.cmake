# The missing 1/pi.
ljus_break_it(NAME lambertian-missing-pi HEADER materials/lambertian.hpp TEST lambertian
    FROM "return surface.albedo * std::numbers::inv_pi_v<T>;"
    TO   "return surface.albedo;")

# The cosine counted twice: a third of the light of every bounce is lost.
ljus_break_it(NAME lambertian-doubled-cosine HEADER materials/lambertian.hpp
    TEST lambertian
    FROM "next->weight = surface.albedo;"
    TO   "next->weight = surface.albedo * std::abs(next->wi.z);"
    CASES "lambertian: samples*")

# A wall that glows on its back.
ljus_break_it(NAME lambertian-side HEADER materials/material.hpp TEST lambertian
    FROM "wi.z = std::copysign(wi.z, wo.z);"
    TO   ""
    CASES "lambertian: samples*")
