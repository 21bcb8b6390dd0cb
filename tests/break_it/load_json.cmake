# Lists and objects cost no more than numbers.
ljus_break_it(NAME json-values HEADER io/detail/parse_json.hpp TEST load_json
    FROM "        take(4);
        if (open.size() == max_json_depth)"
    TO   "        if (open.size() == max_json_depth)"
    CASES "load_json: so many values*")
