# Lists and objects cost no more than numbers.
ljus_break_it(NAME json-values HEADER io/detail/parse_json.hpp TEST load_json
    FROM "        take(4);
        if (open.size() == max_json_depth)"
    TO   "        if (open.size() == max_json_depth)"
    CASES "load_json: so many values*")

# The last of the names that are shown for the last of all.
ljus_break_it(NAME json-last-name HEADER io/detail/json_field.hpp TEST load_json
    FROM "if (i > 0 && i + 1 == names.size())"
    TO   "if (i > 0 && i + 1 == count)"
    CASES "load_json: counts are right*")

# Absorption below 0 would make light.
ljus_break_it(NAME json-absorption HEADER io/detail/json_materials.hpp TEST load_json
    FROM [[vector_field(member(field, "absorption"), 0,]]
    TO   [[vector_field(member(field, "absorption"), -1e12,]]
    CASES "load_json: the numbers that the table*")

# A film that says where it hangs and not how it grows thicker is an even one.
ljus_break_it(NAME json-film-level HEADER io/detail/json_materials.hpp TEST load_json
    FROM [[in.has("scale") || in.has("level") || in.has("up")]]
    TO   [[in.has("scale") || in.has("up")]]
    CASES "load_json: panes*")
