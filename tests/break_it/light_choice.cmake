# A light without power at the end must not be chosen.
ljus_break_it(NAME light-choice-power HEADER scene/world.hpp TEST light_choice
    FROM "std::upper_bound"
    TO   "std::lower_bound"
    CASES "light choice: a light without power*")
