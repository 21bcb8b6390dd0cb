# Rays by the variance and not by its root.
ljus_break_it(NAME adaptive-root HEADER render/adaptive.hpp TEST adaptive
    FROM "wanted[i] = scale * std::sqrt(parts[i].variance);"
    TO   "wanted[i] = scale * parts[i].variance;"
    CASES "adaptive: rays are shared*")

# Parts that have enough already count as if they had an error still.
ljus_break_it(NAME adaptive-settled HEADER render/adaptive.hpp TEST adaptive
    FROM "error += part.pixels * part.variance / part.rays;"
    TO   "error += 0;"
    CASES "adaptive: rays are shared*")

# The error of one ray in place of that of their mean.
ljus_break_it(NAME adaptive-mean HEADER render/adaptive.hpp TEST adaptive
    FROM "std::max(block.rays, 1);"
    TO   "1;"
    CASES "adaptive: it stops at the target*")

# Absolute in place of relative: dark pixels do not count.
ljus_break_it(NAME adaptive-relative HEADER render/adaptive.hpp
    TEST adaptive
    FROM "variance / (mean * mean + epsilon)"
    TO   "variance / epsilon"
    CASES "adaptive: it stops at the target*")

# The same rays again in each batch: nothing is learned from them.
ljus_break_it(NAME adaptive-seed HEADER render/adaptive.hpp TEST adaptive
    FROM "if (batch > 0)"
    TO   "if (batch < 0)"
    CASES "adaptive: it stops at the target*")

# The first rays decide, and are counted as well.
ljus_break_it(NAME adaptive-forgotten HEADER render/adaptive.hpp TEST adaptive
    FROM "sums.pixels.assign(sums.pixels.size(), {});"
    TO   ""
    CASES "adaptive: in two stages*")

# The limit for the mean is not kept.
ljus_break_it(NAME adaptive-limit HEADER render/adaptive.hpp TEST adaptive
    FROM "spare -= cost * blocks[i].wanted;"
    TO   ""
    CASES "adaptive: the limit for the mean*")

# A pixel's own rays decide as well, and are averaged.
ljus_break_it(NAME adaptive-own-rays HEADER render/adaptive.hpp TEST adaptive
    FROM "if (u == x && v == y) continue;"
    TO   ""
    CASES "adaptive: choosing by the rays*")

# All rays or none: the root of the variance is not asked how many.
ljus_break_it(NAME adaptive-disagreement HEADER render/adaptive.hpp
    TEST adaptive
    FROM "rule.more * std::min(part, 1.0)"
    TO   "part < 1 ? 0 : rule.more"
    CASES "adaptive: as many more rays*")

# The variance around a block of the rays' squares alone.
ljus_break_it(NAME adaptive-around HEADER render/adaptive.hpp TEST adaptive
    FROM "(squares - mean * sum)"
    TO   "squares"
    CASES "adaptive: the variance of the first rays*")

# The rows beside a band do not decide.
ljus_break_it(NAME adaptive-band HEADER render/adaptive.hpp TEST adaptive
    FROM "band < all ? 1 : 0"
    TO   "0"
    CASES "adaptive: a picture in bands*")

# Roulette without the division: the report's program lost light like this.
ljus_break_it(NAME depth-roulette HEADER path/path_state.hpp TEST recursion_depth
    FROM "throughput /= probability;"
    TO   ""
    CASES "recursion_depth: roulette loses*")

# One surface fewer than was asked for.
ljus_break_it(NAME depth-limit HEADER render/path_tracing.hpp TEST recursion_depth
    FROM "if (detail::cut_if(path.depth > settings.max_depth, context.counts)) break;"
    TO   "if (detail::cut_if(path.depth >= settings.max_depth, context.counts)) break;"
    CASES "recursion_depth: a limit*")

# One surface fewer on a path of the photon mapper.
ljus_break_it(NAME depth-photons HEADER render/photon_mapping.hpp TEST recursion_depth
    FROM "while (path.depth < settings.max_depth) {"
    TO   "while (path.depth + 1 < settings.max_depth) {"
    CASES "recursion_depth: the depth of*")

# A last batch that there are not rays enough for.
ljus_break_it(NAME adaptive-last-batch HEADER render/adaptive.hpp
    TEST adaptive
    FROM "std::floor(spare / cost * (1 + 1e-9))"
    TO   "std::ceil(spare / cost)"
    CASES "adaptive: batches fit*")

# A stage that is left out, because rays that will be forgotten reach the target.
ljus_break_it(NAME adaptive-second-stage HEADER render/adaptive.hpp TEST adaptive
    FROM "estimate() <= rule.target && !rule.two_stage"
    TO   "estimate() <= rule.target"
    CASES "adaptive: of two stages the second*")

# Rounding in a share of rays is a batch more.
ljus_break_it(NAME adaptive-rounding HEADER render/adaptive.hpp
    TEST adaptive
    FROM "std::ceil(lacking / rule.more - 1e-6)"
    TO   "std::ceil(lacking / rule.more)"
    CASES "adaptive: batches fit*")

# A target that cannot be met any more takes rays away.
ljus_break_it(NAME adaptive-target-missed HEADER render/adaptive.hpp TEST adaptive
    FROM "if (target > 0 && allowed > 0)"
    TO   "if (target > 0)"
    CASES "adaptive: rays are shared out*")

# Progress goes up only when a round is over.
ljus_break_it(NAME adaptive-progress HEADER render/adaptive.hpp TEST adaptive
    FROM "traced + rays * double(done) / double(of)"
    TO   "traced + double(done) / double(of)"
    CASES "adaptive: progress goes up*")

# The filter's weight counts once in the squares.
ljus_break_it(NAME adaptive-weights HEADER render/detail/sample_sums.hpp TEST adaptive
    FROM "squares += sample * sample;"
    TO   "squares += sample * RgbT<double>(samples_[i]);"
    CASES "adaptive: a sample counts with its weight*")
