# On a tie the later object would win.
ljus_break_it(NAME query-tie HEADER scene/query.hpp TEST query
    FROM "!(found->t < ray.t_max)"
    TO   "!(found->t <= ray.t_max)"
    CASES "query: on a tie*")
