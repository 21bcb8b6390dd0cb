# Floats alone decide: near the border of the ball they decide wrongly.
ljus_break_it(NAME wide-kd-tree-float HEADER accel/detail/kd_tree8_walk.hpp TEST kd_tree8
    FROM "if (!holds(distance2(points[std::size_t(i)], center)))"
    TO   "if (false)"
    CASES "kd_tree8: every search*")

# No margin for the five roundings of a float distance.
ljus_break_it(NAME wide-kd-tree-margin HEADER accel/detail/kd_tree8_walk.hpp TEST kd_tree8
    FROM "constexpr double margin = 8 * double(Numbers::epsilon());"
    TO   "constexpr double margin = 0;"
    CASES "kd_tree8: the ball is closed*")

# The smallest floats taken at their word.
ljus_break_it(NAME wide-kd-tree-tiny HEADER accel/detail/kd_tree8_walk.hpp TEST kd_tree8
    FROM "constexpr double tiny = 4 * double(Numbers::min());"
    TO   "constexpr double tiny = 0;"
    CASES "kd_tree8: the smallest*")

# An open ball.
ljus_break_it(NAME wide-kd-tree-border HEADER accel/detail/kd_tree8_walk.hpp TEST kd_tree8
    FROM "return open ? d2 < limit2 : d2 <= limit2;"
    TO   "return d2 < limit2;"
    CASES "kd_tree8: the ball is closed*")

# Below a box, its far side is asked in place of the near one.
ljus_break_it(NAME wide-kd-tree-side HEADER accel/detail/kd_tree8_walk.hpp TEST kd_tree8
    FROM "x < low ? low : x"
    TO   "x < low ? high : x"
    CASES "kd_tree8: every search*")

# Of the ones that are hard to tell apart, all: the k-th is then too far.
ljus_break_it(NAME wide-kd-tree-kth HEADER accel/detail/kd_tree8_results.hpp TEST kd_tree8
    FROM "static_cast<std::uint32_t>(k - sure - 1)"
    TO   "static_cast<std::uint32_t>(ties - 1)"
    CASES "kd_tree8: every search*")

# The median of a sample taken for that of all.
ljus_break_it(NAME wide-kd-tree-rank HEADER accel/detail/kd_tree8_build.hpp TEST kd_tree8
    FROM "rank -= front;"
    TO   ""
    CASES "kd_tree8: each range*")

# The same in the lists of a large tree's upper ranges.
ljus_break_it(NAME wide-kd-tree-list-rank HEADER accel/detail/kd_tree8_build.hpp TEST kd_tree8
    FROM "band.size(), rank - front, axis);"
    TO   "band.size(), rank / 8, axis);"
    CASES "kd_tree8: each range*")

# NaN and infinity let in.
ljus_break_it(NAME wide-kd-tree-not-finite HEADER accel/detail/kd_tree8_build.hpp TEST kd_tree8
    FROM [[require_finite("a point of the k-d tree", point);]]
    TO   ""
    CASES "kd_tree8: a point that*")

# A select that guesses only, and never bisects.
ljus_break_it(NAME wide-kd-tree-select HEADER accel/detail/lane_select.hpp TEST lane_select
    FROM "if (up_to_low + 1 == k)"
    TO   "if (up_to_low + 2 == k)"
    CASES "lane_select: what sorting*")

# The children that were left open are forgotten.
ljus_break_it(NAME wide-kd-tree-open HEADER accel/detail/kd_tree8_walk.hpp TEST kd_tree8
    FROM "left = open[level].left;"
    TO   "left = 0;"
    CASES "kd_tree8: every search*")

# Another child is crossed off than the one that was looked at.
ljus_break_it(NAME wide-kd-tree-left HEADER accel/detail/kd_tree8_walk.hpp TEST kd_tree8
    FROM "Results::nearest_first ? ~(1u << i) : left - 1;"
    TO   "left - 1;"
    CASES "kd_tree8: every search*")

# More are let through than may be spared.
ljus_break_it(NAME wide-kd-tree-spare HEADER accel/detail/lane_select.hpp TEST lane_select
    FROM "up_to_high <= k + spare"
    TO   "up_to_high <= k + 2 * spare"
    CASES "lane_select: what sorting*")

# The farthest of those that were let through is left out.
ljus_break_it(NAME wide-kd-tree-thin HEADER accel/detail/kd_tree8_results.hpp TEST kd_tree8
    FROM "kept += x <= bound;"
    TO   "kept += x < least;"
    CASES "kd_tree8: every search*")

# Many balls at once: the blocks of those that were searched before.
ljus_break_it(NAME wide-kd-tree-balls HEADER accel/detail/kd_tree8_walk.hpp TEST kd_tree8
    FROM "found.blocks.clear();"
    TO   "(void)0;"
    CASES "kd_tree8: many balls*")

# Many balls at once: the root is asked again in place of its children.
ljus_break_it(NAME wide-kd-tree-levels HEADER accel/detail/kd_tree8_walk.hpp TEST kd_tree8
    FROM "std::swap(found.here, found.below);"
    TO   "(void)0;"
    CASES "kd_tree8: many balls*")

# A radius that is none finds points, of one ball and of many at once.
ljus_break_it(NAME wide-kd-tree-no-radius HEADER accel/detail/kd_tree8_walk.hpp TEST kd_tree8
    FROM "if (!(radius >= T(0))) return {};"
    TO   "(void)0;"
    CASES "kd_tree8: a ball without*")

# The last range ends at a whole block, beyond the points.
ljus_break_it(NAME wide-kd-tree-range HEADER accel/kd_tree8.hpp TEST kd_tree8
    FROM "std::min(size(),"
    TO   "std::max(size(),"
    CASES "kd_tree8: each range*")

# Both pivots are the same number, which is not that of the rank.
ljus_break_it(NAME wide-kd-tree-outside HEADER accel/detail/kd_tree8_build.hpp
    TEST kd_tree8
    FROM "if (!inside || low != high) select"
    TO   "if (low != high) select"
    CASES "kd_tree8: each range*")

# One neighbour, however far away.
ljus_break_it(NAME wide-kd-tree-one HEADER accel/kd_tree8.hpp TEST kd_tree8
    FROM "const auto one = nearest(center, radius);"
    TO   "const auto one = nearest(center);"
    CASES "kd_tree8: every search*")
