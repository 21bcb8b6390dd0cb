# The report's program: a square of cells, the remainder dropped.
ljus_break_it(NAME stratified-remainder HEADER math/sampling_pattern.hpp TEST stratified
    FROM "if (rays % i == 0) columns = i;"
    TO   "columns = i;"
    CASES "stratified: rooks stand*")

# The scramble alone favours some places.
ljus_break_it(NAME stratified-step HEADER math/sampling_pattern.hpp TEST stratified
    FROM "place = i + step;"
    TO   "place = i;"
    CASES "stratified: over the keys*")
