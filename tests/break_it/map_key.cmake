# A map of another scene is used in silence.
ljus_break_it(NAME map-key-scene HEADER io/light_map_file.hpp TEST map_key
    FROM "if (file.take<std::uint64_t>() != key.scene)"
    TO   "if ((void)file.take<std::uint64_t>(), false)"
    CASES "map_key: the map of a scene*")

# ... or one that was made with other settings.
ljus_break_it(NAME map-key-settings HEADER io/light_map_file.hpp TEST map_key
    FROM "if (file.take<std::uint64_t>() != key.settings)"
    TO   "if ((void)file.take<std::uint64_t>(), false)"
    CASES "map_key: the map of a scene*")

# Lights are forgotten: brighter ones have the same key.
ljus_break_it(NAME map-key-lights HEADER radiosity/light_map.hpp TEST map_key
    FROM "hash.add(light);"
    TO   "(void)light;"
    CASES "map_key: whatever a scene*")

# A mirror and a matt surface of the same numbers are one.
ljus_break_it(NAME map-key-types HEADER math/field_hash.hpp TEST map_key
    FROM "*c != '\\0'; ++c) add(*c);"
    TO   "*c == '\\0'; ++c) add(*c);"
    CASES "map_key: materials of equal members*")

# How long a list is does not count.
ljus_break_it(NAME map-key-sizes HEADER math/field_hash.hpp TEST map_key
    FROM "add(std::uint64_t(v.size()));"
    TO   ""
    CASES "map_key: the hash*")

# The seed of the form factors is forgotten.
ljus_break_it(NAME map-key-seed HEADER radiosity/radiosity.hpp TEST map_key
    FROM "factors.closed, factors.seed, solve.solver"
    TO   "factors.closed, solve.solver"
    CASES "map_key: settings that change a light*")
