# Normals of the geometry, not of the visible side.
ljus_break_it(NAME first-hit-side HEADER render/first_hit.hpp TEST first_hit
    FROM "std::copysign(T(0.5), vertex->wo.z) * vertex->frame.normal"
    TO   "T(0.5) * vertex->frame.normal"
    CASES "first hit: normals face the eye*")
