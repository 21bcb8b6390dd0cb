# Two bits a lane: each is taken twice.
ljus_break_it(NAME lanes-twice HEADER math/lanes.hpp TEST lanes
    FROM "& 0x0101010101010101u"
    TO   "& 0x8181818181818181u"
    CASES "lanes: those that say yes*")
