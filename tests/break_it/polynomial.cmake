# A quartic whose extrema are not looked at: two roots between them are lost.
ljus_break_it(NAME polynomial-extrema HEADER math/polynomial.hpp TEST polynomial
    FROM "if (ends.at[ends.count - 1] < u && u < T(1)) ends.add(u);"
    TO   "(void)u;"
    CASES "polynomial: no root is lost*")

# A double root that rounding lifts off the axis.
ljus_break_it(NAME polynomial-touch HEADER math/polynomial.hpp TEST polynomial
    FROM "if (!crossed && !crosses && is_zero(value)) result.add(ends.at[i]);"
    TO   ""
    CASES "polynomial: no root is lost*")

# One change of sign, and a second root at the end of the interval.
ljus_break_it(NAME polynomial-end HEADER math/polynomial.hpp TEST polynomial
    FROM "if (changes > 1 || at_end)"
    TO   "if (changes > 1)"
    CASES "polynomial: no root is lost*")

# Without the bracket Newton's method leaves the interval.
ljus_break_it(NAME polynomial-bracket HEADER math/polynomial.hpp TEST polynomial
    FROM "a <= newton && newton <= b && shorter ? newton : a + (b - a) / T(2)"
    TO   "newton"
    CASES "polynomial: no root is lost*")

ljus_break_it(NAME polynomial-derivative HEADER math/polynomial.hpp TEST polynomial
    FROM "T(N) * (p.c[i + 1] - p.c[i])"
    TO   "(p.c[i + 1] - p.c[i])"
    CASES "polynomial: value and derivative*")

ljus_break_it(NAME polynomial-first-touch HEADER math/polynomial.hpp TEST polynomial
    FROM "if (value <= touch && before < u && u < T(1)) return u;"
    TO   ""
    CASES "polynomial: the first change*")

# Only a touch that rounding does not lift off.
ljus_break_it(NAME polynomial-lifted-touch HEADER math/polynomial.hpp TEST polynomial
    FROM "if (value <= touch && before < u"
    TO   "if (value <= T(0) && before < u"
    CASES "polynomial: a touch is met*")

# A step of Newton's may leave the upper end.
ljus_break_it(NAME polynomial-upper-end HEADER math/polynomial.hpp TEST polynomial
    FROM "newton <= b && shorter"
    TO   "shorter"
    CASES "polynomial: a root at an end*")
