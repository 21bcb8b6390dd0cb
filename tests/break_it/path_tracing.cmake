# One light of several is asked, but answers for all.
ljus_break_it(NAME path-tracing-light-choice HEADER render/path_tracing.hpp
    TEST path_tracing
    FROM "chosen.probability;"
    TO   "T(1);"
    CASES "path tracing: two lamps*")

# A lamp that is met counts in full, though shadow rays have counted it.
ljus_break_it(NAME path-tracing-emission-weight HEADER render/path_tracing.hpp
    TEST path_tracing
    FROM "balance(path.bsdf_pdf, pdf_of_light(tracer, path.from, hit, at))"
    TO   "T(1)"
    CASES "path tracing: in a furnace every*")

# The last surface's lamp, seen by nobody but its shadow ray, which is weighed down.
ljus_break_it(NAME path-tracing-last-surface HEADER render/camera_path.hpp
    TEST path_tracing
    FROM "!scattered || (last && scattered->sample.specular)"
    TO   "!scattered || last"
    CASES "path tracing: in a furnace every*")

# Radiance leaves glass unchanged: only light that starts in the glass notices.
ljus_break_it(NAME path-tracing-n2 HEADER materials/glass.hpp TEST path_tracing
    FROM "transport == Transport::radiance ? eta * eta : T(1)"
    TO   "transport == Transport::radiance ? T(1) : T(1)"
    CASES "path tracing: a lamp embedded*")

# The way through glass is not measured.
ljus_break_it(NAME path-tracing-medium HEADER render/path_tracing.hpp TEST path_tracing
    FROM "path.throughput *= transmittance(path.medium, met->distance) * met->arrives();"
    TO   ""
    CASES "path tracing: a slab*")
