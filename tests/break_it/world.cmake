# On a tie the later object would win.
ljus_break_it(NAME world-tie HEADER scene/world.hpp TEST world
    FROM "!(found->t < ray.t_max)"
    TO   "!(found->t <= ray.t_max)"
    CASES "world: on a tie*")

# An array that grew without add() is taken, and there is room for its boxes.
ljus_break_it(NAME world-grown-array HEADER scene/world.hpp TEST world
    FROM "list.size() == objects_[type].size()"
    TO   "(boxes.resize(list.size()), next = boxes.begin(), true)"
    CASES "world: what was changed in place*")
