# Rows of a machine's part that are traced as if they were the first ones: each strip
# shows the top of the picture.
ljus_break_it(NAME parallel-rows HEADER render/render.hpp TEST render
    FROM "const int y = region.y + row;"
    TO   "const int y = row;"
    CASES "render: rows that are*")

# Blocks in turns: two threads are given the same one where one had it.
ljus_break_it(NAME parallel-next HEADER parallel.hpp TEST parallel
    FROM "block = next++;"
    TO   "block = next++ / 2 * 2;"
    CASES "parallel: every block*")

# The last block with as many things as all others.
ljus_break_it(NAME parallel-last HEADER parallel.hpp TEST parallel
    FROM "total - first < size ? total : first + size"
    TO   "first + size"
    CASES "parallel: blocks cover*")

# Things that fill no whole block are forgotten.
ljus_break_it(NAME parallel-rest HEADER parallel.hpp TEST parallel
    FROM "(total % size != 0 ? 1 : 0)"
    TO   "0"
    CASES "parallel: blocks cover*")

# Which exception comes out is decided by chance.
ljus_break_it(NAME parallel-first-exception HEADER parallel.hpp TEST parallel
    FROM "if (block < failed_block) {"
    TO   "if (block != failed_block) {"
    CASES "parallel: of all exceptions*")

# A failure that nobody hears of.
ljus_break_it(NAME parallel-silent HEADER parallel.hpp TEST parallel
    FROM "if (loop.failure) std::rethrow_exception(loop.failure);"
    TO   ""
    CASES "parallel: of all exceptions*")

# One thread, whatever was asked for: the picture is the same.
ljus_break_it(NAME parallel-alone HEADER parallel.hpp TEST parallel
    FROM "if (threads > 1) {"
    TO   "if (threads > 1000000) {"
    CASES "parallel: more than one thread*")

# A loop that was stopped says that it is done.
ljus_break_it(NAME parallel-done HEADER parallel.hpp TEST parallel
    FROM "return loop.done >= count;"
    TO   "return loop.done >= 0;"
    CASES "parallel: false from progress*")

# Two threads tell of what is done at a time.
ljus_break_it(NAME parallel-two-tell HEADER parallel.hpp TEST parallel
    FROM "reporting || stop ||"
    TO   "stop ||"
    CASES "parallel: while one thread tells*")

# That progress says "go on" makes up for what a block threw.
ljus_break_it(NAME parallel-stop-forgotten HEADER parallel.hpp TEST parallel
    FROM "stop = stop || !go_on;"
    TO   "stop = !go_on;"
    CASES "parallel: what a block threw*")

# Stopped at the last block is taken for not finished.
ljus_break_it(NAME parallel-last-block HEADER parallel.hpp TEST parallel
    FROM "return loop.done >= count;"
    TO   "return !loop.stop;"
    CASES "parallel: false at the very last*")

# One stream of random numbers for all threads: whoever comes first draws first, and no
# picture can be made again.
ljus_break_it(NAME render-shared-stream HEADER render/render.hpp TEST render
    FROM "start_ray(stream, picture.seed, pixel, at.number, rays.pattern);"
    TO   "static std::uint64_t drawn = 0;
    start_ray(stream, picture.seed, drawn++, 0, rays.pattern);"
    CASES "render: rows that are*")

# Whoever said stop is asked again by each block that was under way.
ljus_break_it(NAME parallel-asked-again HEADER parallel.hpp TEST parallel
    FROM "if (reporting || stop || done <= reported) return;"
    TO   "if (reporting || done <= reported) return;"
    CASES "parallel: whoever said stop*")

# What ended while another thread was telling is told by nobody.
ljus_break_it(NAME parallel-last-word HEADER parallel.hpp TEST parallel
    FROM "loop.report(); // the last blocks"
    TO   "// the last blocks"
    CASES "parallel: what ended while*")

# A loop over things takes all threads, tells nobody and cannot be stopped.
ljus_break_it(NAME parallel-each-options HEADER parallel.hpp TEST parallel
    FROM "parallel_blocks(block_count(all, block), run, options)"
    TO   "parallel_blocks(block_count(all, block), run)"
    CASES "parallel: a loop over things*")

# A region is cut out one column beside where it is.
ljus_break_it(NAME render-region-column HEADER render/render.hpp TEST render
    FROM "for (int x = begin; x < end; ++x)"
    TO   "for (int x = begin + 1; x < end; ++x)"
    CASES "render: a region is that part*")
