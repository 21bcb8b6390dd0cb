# The noise that is left in the mean of the runs passes for bias.
ljus_break_it(NAME metrics-bias HEADER inspect/metrics.hpp TEST metrics
    FROM "glm::dot(shift, shift) / 3.0 - variances[i] / count"
    TO   "glm::dot(shift, shift) / 3.0"
    CASES "metrics: *")

# Divided by M where one of the M differences is used up by the mean.
ljus_break_it(NAME metrics-variance HEADER inspect/metrics.hpp TEST metrics
    FROM "variances[i] = squares / (count - 1.0)"
    TO   "variances[i] = squares / count"
    CASES "metrics: *")

# The square of r + epsilon, as some tools have it.
ljus_break_it(NAME metrics-epsilon HEADER inspect/metrics.hpp TEST metrics
    FROM "return (x - r) * (x - r) / (r * r + epsilon);"
    TO   "return (x - r) * (x - r) / ((r + epsilon) * (r + epsilon));"
    CASES "metrics: their formulas*")

# The pixels that are best are left out.
ljus_break_it(NAME metrics-trimmed HEADER inspect/metrics.hpp TEST metrics
    FROM "errors.erase(end, errors.end());"
    TO   "errors.erase(errors.begin(), errors.begin() + worst);"
    CASES "metrics: *")

# The last block, which is narrower, divided by what it lacks.
ljus_break_it(NAME metrics-narrow HEADER image/image.hpp TEST metrics
    FROM "std::min(size, image.width - x * size)"
    TO   "size"
    CASES "metrics: *")

# All rays of a pixel with the numbers of the first: nothing is gained by more.
ljus_break_it(NAME rays-alike HEADER render/render.hpp TEST rays_per_pixel
    FROM "static_cast<std::uint64_t>(ray));"
    TO   "static_cast<std::uint64_t>(0 * ray));"
    CASES "rays_per_pixel: sixteen times*")
