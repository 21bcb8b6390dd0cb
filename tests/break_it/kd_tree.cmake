# The report's range query: a cube, not a ball.
ljus_break_it(NAME kd-tree-cube HEADER accel/neighbor.hpp TEST kd_tree
    FROM "return x2 + y2 + z2;"
    TO   "return std::max({x2, y2, z2});"
    CASES "kd_tree: the ball is closed*")

# Where two halves touch, the centre is in both, and equal points lie on either side.
ljus_break_it(NAME kd-tree-equal-keys HEADER accel/kd_tree.hpp TEST kd_tree
    FROM "if (reaches(to_high))"
    TO   "if ((to_high > 0 || !low_first) && reaches(to_high))"
    CASES "kd_tree: every search*")

# A box without its far end.
ljus_break_it(NAME kd-tree-box HEADER accel/kd_tree.hpp TEST kd_tree
    FROM "box.high = glm::max(box.high, points[point_ids_[i]]);"
    TO   ""
    CASES "kd_tree: every search*")

# An open ball in the walk, a closed one at the point: points on the border are found on
# one side of a plane and not on the other.
ljus_break_it(NAME kd-tree-border HEADER accel/kd_tree.hpp TEST kd_tree
    FROM "return distance2 <= limit2; });"
    TO   "return distance2 < limit2; });"
    CASES "kd_tree: the ball is closed*")

# The axes in turn would do for a cloud; the same axis for ever makes searches slow.
ljus_break_it(NAME kd-tree-one-axis HEADER accel/neighbor.hpp TEST kd_tree
    FROM "if (size.x >= size.y && size.x >= size.z) return 0;"
    TO   "if (true) return 0;"
    CASES "kd_tree: no set*")

# Ties that count as nearer: each of a thousand equal points is tried.
ljus_break_it(NAME kd-tree-ties HEADER accel/neighbor.hpp TEST kd_tree
    FROM "distance2 < found[0].distance2"
    TO   "distance2 <= found[0].distance2"
    CASES "kd_tree: no set*")

# Differences in float: near the border of the ball they decide wrongly.
ljus_break_it(NAME kd-tree-float HEADER accel/neighbor.hpp TEST kd_tree
    FROM "double(a.x) - double(b.x)"
    TO   "double(a.x - b.x)"
    CASES "kd_tree: every search*")

# A square forgets the sign.
ljus_break_it(NAME kd-tree-negative-radius HEADER accel/kd_tree.hpp TEST kd_tree
    FROM "if (!(radius >= T(0))) return;"
    TO   ""
    CASES "kd_tree: a ball without*")

# NaN and infinity let in.
ljus_break_it(NAME kd-tree-not-finite HEADER accel/kd_tree.hpp TEST kd_tree
    FROM [[require_finite("a point of the k-d tree", point);]]
    TO   ""
    CASES "kd_tree: a point that*")

ljus_break_it(NAME kd-tree-any-negative-radius HEADER accel/kd_tree.hpp TEST kd_tree
    FROM "if (!(radius >= T(0))) return false;"
    TO   ""
    CASES "kd_tree: a ball without*")
