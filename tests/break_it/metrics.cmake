# The scatter of one run in place of that of the mean.
ljus_break_it(NAME block-statistics-mean HEADER inspect/metrics.hpp
    TEST block_statistics
    FROM "squares / (count - 1.0) / count"
    TO   "squares / (count - 1.0)"
    CASES "block_statistics: three runs*")

# Divided by M where one of the M differences is used up by the mean.
ljus_break_it(NAME block-statistics-count HEADER inspect/metrics.hpp
    TEST block_statistics
    FROM "squares / (count - 1.0) / count"
    TO   "squares / count / count"
    CASES "block_statistics: three runs*")
