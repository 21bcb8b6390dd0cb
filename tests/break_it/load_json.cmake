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
    FROM [["absorption", {JsonKind::vector, 0,]]
    TO   [["absorption", {JsonKind::vector, -1e12,]]
    COMPILED
    CASES "load_json: the numbers that the table*")

# A film that says where it hangs and not how it grows thicker is an even one.
ljus_break_it(NAME json-film-level HEADER io/detail/json_materials.hpp TEST load_json
    FROM [[in.has("scale") || in.has("level") || in.has("up")]]
    TO   [[in.has("scale") || in.has("up")]]
    CASES "load_json: panes*")

# Each picture is counted alone.
ljus_break_it(NAME json-pictures-limit HEADER io/detail/json_textures.hpp TEST load_json
    FROM "pixels += static_cast<long long>(image.pixels.size());"
    TO   "pixels = static_cast<long long>(image.pixels.size());"
    CASES "load_json: the pictures of all*")

# Each full gloss computes its own table.
ljus_break_it(NAME json-loss-tables HEADER io/detail/json_materials.hpp TEST load_json
    FROM "if (shared.losses.size() == max_loss_tables)"
    TO   "if (false)"
    CASES "load_json: full gloss*")

# A mesh file that is named again is read again.
ljus_break_it(NAME json-mesh-once HEADER io/detail/json_objects.hpp TEST load_json
    FROM "if (!reading.named.same_reading(named)) continue;"
    TO   "if (reading.named.settings.scale > 0) continue;"
    CASES "load_json: a mesh file is read once*")

# A file takes the memory of as many skies as it names.
ljus_break_it(NAME json-environments HEADER io/detail/json_lights.hpp TEST load_json
    FROM "if (!std::get<std::vector<EnvironmentLightT<T>>>(scene.lights).empty())"
    TO   "if (false)"
    CASES "load_json: an environment*")
# The path of an entry is that of the one behind it.
ljus_break_it(NAME json-path HEADER io/detail/json_field.hpp TEST load_json
    FROM "path + \"[\" + std::to_string(index) + \"]\";"
    TO   "path + \"[\" + std::to_string(index + 1) + \"]\";"
    CASES "load_json: an error names*")

# A file that is placed at first is placed wherever it is named again.
ljus_break_it(NAME json-mesh-unplaced HEADER io/detail/json_objects.hpp TEST load_json
    FROM "for (const MeshT<T>& mesh : reading.unplaced) copy(mesh);"
    TO   ""
    CASES "load_json: a mesh file is placed*")

# A closed tube is an open one.
ljus_break_it(NAME json-cylinder-ends HEADER io/detail/json_objects.hpp TEST load_json
    FROM [[if (in.word("ends") == "closed")]]
    TO   "if (false)"
    CASES "load_json: quads? boxes*")

# A group dims the lights and leaves the objects bright.
ljus_break_it(NAME json-lamp-groups HEADER io/detail/json_objects.hpp TEST load_json
    FROM "factor * in.vector(\"emission\")"
    TO   "in.vector(\"emission\")"
    CASES "load_json: groups of lamps*")

# Words that share a few letters are proposed.
ljus_break_it(NAME nearest-word-far HEADER io/nearest_word.hpp TEST nearest_word
    FROM "word.size() / 3"
    TO   "word.size()"
    CASES "nearest word: what is near*")
