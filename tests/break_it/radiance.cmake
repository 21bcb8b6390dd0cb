# A filter whose integral is not 1 makes every picture darker or brighter.
ljus_break_it(NAME radiance-filter-integral HEADER image/filter.hpp TEST filter
    FROM "return scale * (std::exp(T(-2) * a * a) - at_radius);"
    TO   "return std::exp(T(-2) * a * a) - at_radius;"
    CASES "filter: weights are even*")

# Mitchell's filter without the part below 0.
ljus_break_it(NAME radiance-filter-lobe HEADER image/filter.hpp TEST filter
    FROM "(T(8) / T(7) - a) * (T(2) - a)"
    TO   "std::abs(T(8) / T(7) - a) * (T(2) - a)"
    CASES "filter: Mitchell's*")

# Places that are drawn by sizes and counted without a sign.
ljus_break_it(NAME radiance-filter-weight HEADER image/filter.hpp TEST filter
    FROM "T(filter_weight(filter, x) / density)"
    TO   "T(1)"
    CASES "filter: places drawn*")

# The tent drawn evenly over its width.
ljus_break_it(NAME radiance-filter-inversion HEADER image/filter.hpp TEST filter
    FROM "side * v / (T(1) + std::sqrt(T(1) - v))"
    TO   "side * v"
    CASES "filter: places drawn*")

# The density of a cell by its middle, which may lie at a zero of the filter.
ljus_break_it(NAME radiance-filter-middles HEADER image/filter.hpp TEST filter
    FROM "cdf[i] + size_at(i) + size_at(i + 1)"
    TO   "cdf[i] + std::abs(filter_weight(filter, (double(i) + 0.5) / double(cells) * filter_radius(filter)))"
    CASES "filter: places are drawn as often*")

# The whole picture moved by half a pixel.
ljus_break_it(NAME radiance-filter-middle HEADER image/filter.hpp TEST filter
    FROM ".place = T(0.5) + Vec2T<T>{x.x, y.x}"
    TO   ".place = Vec2T<T>{x.x, y.x}"
    CASES "filter: no filter moves*")

# The pixel loop forgets what a ray counts.
ljus_break_it(NAME radiance-filter-render HEADER render/render.hpp TEST filter
    FROM "return {radiance(renderer, ray, context), sample.weight};"
    TO   "return {radiance(renderer, ray, context), T(1)};"
    CASES "filter: a picture of a wave*")

# The cosine law and the inverse square law, where a lamp's point is drawn.
ljus_break_it(NAME radiance-cosine HEADER geometry/solid_angle.hpp TEST radiance
    FROM "distance2 / (cosine * area)"
    TO   "distance2 / area"
    CASES "radiance: the density*,radiance: what A sends*")
ljus_break_it(NAME radiance-inverse-square HEADER geometry/solid_angle.hpp TEST radiance
    FROM "distance2 / (cosine * area)"
    TO   "std::sqrt(distance2) / (cosine * area)"
    CASES "radiance: the density*")

# 2 pi, the solid angle, in place of pi, which has the cosine in it.
ljus_break_it(NAME radiance-exitance HEADER lights/area_light.hpp TEST radiance
    FROM "RgbT<T>{std::numbers::pi_v<T> * light.lamp.area"
    TO   "RgbT<T>{T(2) * std::numbers::pi_v<T> * light.lamp.area"
    CASES "radiance: a Lambertian lamp*")

# What comes later counts without the filter's weight.
ljus_break_it(NAME radiance-filter-later HEADER render/detail/sample_sums.hpp TEST render
    FROM "sample(weights_[i] * samples_[i]);"
    TO   "sample(samples_[i]);"
    CASES "render: answers that come later*")

# Rows as far apart as the picture is high: pixels that share their numbers.
ljus_break_it(NAME radiance-pixel-number HEADER render/render.hpp TEST render
    FROM "static_cast<std::uint64_t>(at.y) * static_cast<std::uint64_t>(picture.width)"
    TO   "static_cast<std::uint64_t>(at.y) * static_cast<std::uint64_t>(picture.height)"
    CASES "render: no ray of a picture*")

# The squares of samples without what the filter counts them.
ljus_break_it(NAME radiance-squares HEADER render/detail/sample_sums.hpp TEST render
    FROM "squares += sample * sample;"
    TO   "squares += RgbT<double>(samples_[i] * samples_[i]);"
    CASES "render: sums of samples*")

# Shadow photons of a map made by hand shine, if many samples ask together.
ljus_break_it(NAME radiance-later-kinds HEADER render/detail/caustics_batch.hpp TEST render
    FROM "places, estimate, light_kinds,"
    TO   "places, estimate, all_kinds,"
    CASES "render: of a caustics map*")
