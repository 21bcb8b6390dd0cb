# Floats alone decide: near the border of the ball they decide wrongly.
ljus_break_it(NAME wide-kd-tree-float HEADER photons/point_block.hpp TEST wide_kd_tree
    FROM "if (!holds(distance2(points[std::size_t(i)], center)))"
    TO   "if (false)"
    CASES "wide_kd_tree: every search*")

# No margin for the five roundings of a float distance.
ljus_break_it(NAME wide-kd-tree-margin HEADER photons/point_block.hpp TEST wide_kd_tree
    FROM "constexpr double margin = 8 * double(Numbers::epsilon());"
    TO   "constexpr double margin = 0;"
    CASES "wide_kd_tree: the ball is closed*")

# The smallest floats taken at their word.
ljus_break_it(NAME wide-kd-tree-tiny HEADER photons/point_block.hpp TEST wide_kd_tree
    FROM "constexpr double tiny = 4 * double(Numbers::min());"
    TO   "constexpr double tiny = 0;"
    CASES "wide_kd_tree: the smallest*")

# An open ball.
ljus_break_it(NAME wide-kd-tree-border HEADER photons/point_block.hpp TEST wide_kd_tree
    FROM "return open ? d2 < limit2 : d2 <= limit2;"
    TO   "return d2 < limit2;"
    CASES "wide_kd_tree: the ball is closed*")

# Below a box, its far side is asked in place of the near one.
ljus_break_it(NAME wide-kd-tree-side HEADER photons/wide_kd_shape.hpp TEST wide_kd_tree
    FROM "x < low ? low : x"
    TO   "x < low ? high : x"
    CASES "wide_kd_tree: every search*")

# Of the ones that are hard to tell apart, all: the k-th is then too far.
ljus_break_it(NAME wide-kd-tree-kth HEADER photons/wide_kd_search.hpp TEST wide_kd_tree
    FROM "static_cast<std::uint32_t>(k - sure - 1)"
    TO   "static_cast<std::uint32_t>(ties - 1)"
    CASES "wide_kd_tree: every search*")

# The median of a sample taken for that of all.
ljus_break_it(NAME wide-kd-tree-rank HEADER photons/wide_kd_build.hpp TEST wide_kd_tree
    FROM "rank -= front;"
    TO   ""
    CASES "wide_kd_tree: each range*")

# NaN and infinity let in.
ljus_break_it(NAME wide-kd-tree-not-finite HEADER photons/wide_kd_build.hpp TEST wide_kd_tree
    FROM [[require_finite("a point of the k-d tree", points[i]);]]
    TO   ""
    CASES "wide_kd_tree: a point that*")

# A select that guesses only, and never bisects.
ljus_break_it(NAME wide-kd-tree-select HEADER photons/lane_select.hpp TEST lane_select
    FROM "if (up_to_low + 1 == k)"
    TO   "if (up_to_low + 2 == k)"
    CASES "lane_select: what sorting*")

# The children that were left open are forgotten.
ljus_break_it(NAME wide-kd-tree-open HEADER photons/wide_kd_walk.hpp TEST wide_kd_tree
    FROM "if (open[size].children != 0) ++size;"
    TO   ""
    CASES "wide_kd_tree: every search*")

# Another child is crossed off than the one that was looked at.
ljus_break_it(NAME wide-kd-tree-left HEADER photons/wide_kd_walk.hpp TEST wide_kd_tree
    FROM "at.left &= ~(1u << i);"
    TO   "at.left &= at.left - 1;"
    CASES "wide_kd_tree: every search*")

# More are let through than may be spared.
ljus_break_it(NAME wide-kd-tree-spare HEADER photons/lane_select.hpp TEST lane_select
    FROM "up_to_high <= k + spare"
    TO   "up_to_high <= k + 2 * spare"
    CASES "lane_select: what sorting*")

# The farthest of those that were let through is left out.
ljus_break_it(NAME wide-kd-tree-thin HEADER photons/wide_kd_search.hpp TEST wide_kd_tree
    FROM "kept += x <= bound;"
    TO   "kept += x < least;"
    CASES "wide_kd_tree: every search*")
