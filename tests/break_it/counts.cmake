# What the depth cuts is not counted: by the path tracer,
ljus_break_it(NAME counts-cut-traced HEADER render/path_tracing.hpp TEST counts
    FROM "if (detail::cut_if(path.depth > settings.max_depth, context.counts)) break;"
    TO   "if (path.depth > settings.max_depth) break;"
    CASES "counts: what the depth cuts*")

# at mirrors,
ljus_break_it(NAME counts-cut-mirrors HEADER render/path_tracing.hpp TEST counts
    FROM "cut_if(!is_black(path.throughput), context.counts);"
    TO   ""
    CASES "counts: what the depth cuts*")

# or is counted though a map answers for it.
ljus_break_it(NAME counts-cut-mapped HEADER render/photon_mapping.hpp TEST counts
    FROM "detail::cut_if(has(parts, plan.open), context.counts);"
    TO   "detail::cut_if(true, context.counts);"
    CASES "counts: what the depth cuts*")
