# A cell without weight is chosen at u = 0.
ljus_break_it(NAME piecewise-constant-empty HEADER math/piecewise_constant.hpp
    TEST piecewise_constant
    FROM "std::upper_bound(sums.begin(), sums.end(), place)"
    TO   "std::lower_bound(sums.begin(), sums.end(), place)"
    CASES "piecewise_constant: the ends*")

# What is left of u is not stretched over the cell.
ljus_break_it(NAME piecewise-constant-within HEADER math/piecewise_constant.hpp
    TEST piecewise_constant
    FROM "(place - begin) / (*end - begin)"
    TO   "place / (*end + 0 * begin)"
    CASES "piecewise_constant: even numbers*")

# The probability of a cell and of all before it in the row.
ljus_break_it(NAME piecewise-constant-probability HEADER math/piecewise_constant.hpp
    TEST piecewise_constant
    FROM "(row[column] - before) / density.rows.back()"
    TO   "row[column] / density.rows.back() + 0 * before"
    CASES "piecewise_constant: the probability*")
