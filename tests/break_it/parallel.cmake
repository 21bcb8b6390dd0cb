# Two threads tell of what is done at a time.
ljus_break_it(NAME parallel-two-tell HEADER parallel.hpp TEST parallel
    FROM "reporting || stopped ||"
    TO   "stopped ||"
    CASES "parallel: while one thread tells*")

# That progress says "go on" makes up for what a block threw.
ljus_break_it(NAME parallel-stop-forgotten HEADER parallel.hpp TEST parallel
    FROM "stop = stop || stopped;"
    TO   "stop = stopped;"
    CASES "parallel: what a block threw*")

# Stopped at the last block is taken for not finished.
ljus_break_it(NAME parallel-last-block HEADER parallel.hpp TEST parallel
    FROM "return done >= count;"
    TO   "return !stopped;"
    CASES "parallel: false at the very last*")
