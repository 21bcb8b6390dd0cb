# b^2 - ac, as textbooks have it: far away the two cancel.
ljus_break_it(NAME sphere-discriminant HEADER geometry/sphere.hpp TEST sphere
    FROM "const C discriminant = r * r - glm::dot(p, p);"
    TO   "const C discriminant = (b * b - a * (glm::dot(oc, oc) - r * r)) * inverse_a;"
    CASES "sphere: far away*")

# The smaller root straight from the formula cancels just above a surface.
ljus_break_it(NAME sphere-small-root HEADER geometry/sphere.hpp TEST sphere
    FROM "q != C(0) ? c / q : C(0);"
    TO   "(b - std::copysign(std::sqrt(a * discriminant), b)) * inverse_a;"
    CASES "sphere: just above*")

# A radius enters as its square only: -1 is as good as 1, if nobody asks.
ljus_break_it(NAME sphere-radius HEADER geometry/sphere.hpp TEST sphere
    FROM "&& r > C(0)"
    TO   ""
    CASES "sphere: invalid data*")

# From within, the first root lies behind: t_min must refuse it.
ljus_break_it(NAME sphere-t-min HEADER geometry/sphere.hpp TEST sphere
    FROM "ray.t_min <= enter && "
    TO   ""
    CASES "sphere: known hits")

ljus_break_it(NAME sphere-t-max HEADER geometry/sphere.hpp TEST sphere
    FROM " && leave <= t_max"
    TO   ""
    CASES "sphere: the range*")

# D is not asked to have unit length; here it is.
ljus_break_it(NAME sphere-direction-length HEADER geometry/sphere.hpp TEST sphere
    FROM "std::sqrt(a * discriminant)"
    TO   "std::sqrt(discriminant)"
    CASES "sphere: t is measured*")

# The line touches where the ray starts: 0/0.
ljus_break_it(NAME sphere-touch HEADER geometry/sphere.hpp TEST sphere
    FROM "q != C(0) ? c / q : C(0);"
    TO   "c / q;"
    CASES "sphere: the chord*")

ljus_break_it(NAME sphere-normal HEADER geometry/sphere.hpp TEST sphere
    FROM "glm::normalize(point - sphere.center)"
    TO   "(point - sphere.center)")

# A double beyond the range of float becomes infinity, and t_max is infinite by default.
ljus_break_it(NAME sphere-infinite-t HEADER geometry/sphere.hpp TEST sphere
    FROM "glm::min(ray.t_max, std::numeric_limits<T>::max())"
    TO   "ray.t_max"
    CASES "sphere: a hit*infinitely*")

# Two roots that are almost one, by the sign of q: they change places.
ljus_break_it(NAME sphere-order HEADER geometry/sphere.hpp TEST sphere
    FROM ".enter = glm::min(small, large), .leave = glm::max(small, large)"
    TO   ".enter = q > C(0) ? small : large, .leave = q > C(0) ? large : small"
    CASES "sphere: both ends of a chord*")

# An infinite radius, or a root beyond the range of the arithmetic.
ljus_break_it(NAME sphere-finite HEADER geometry/sphere.hpp TEST sphere
    FROM "if (!(std::abs(large) <= max && std::abs(small) <= max)) return std::nullopt;"
    TO   "(void)max;"
    CASES "sphere: both ends of a chord*,sphere: invalid data*")
