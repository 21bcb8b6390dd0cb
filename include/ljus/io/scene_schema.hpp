#pragma once

/// \file ljus/io/scene_schema.hpp
/// \brief What a scene file may contain, as a JSON schema and as tables for people.

#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <nlohmann/json.hpp>

#include "ljus/io/load_json.hpp"

namespace ljus {

/// \defgroup scene_schema The schema of scene files
/// \brief Optional (nlohmann-json): the tables by which load_json() reads, in the form
/// that editors and people read. Page: \ref ch_scene_files.
/// \{

namespace detail {

/// Tables of one kind: one of them is chosen by `type`, or there is only one.
struct JsonGroup {
    std::string_view name;           // in the schema
    std::string_view heading, text;  // on the page
    JsonMembers shared{};            // members of all tables
    std::vector<JsonTable> tables{}; // without `type`, if there is only one
};

/// All tables of scene files.
[[nodiscard]] inline std::vector<JsonGroup> scene_groups() {
    const auto one = [](std::string_view name, std::string_view heading,
                        std::string_view text, JsonMembers members) {
        return JsonGroup{name, heading, text, {}, {{{}, {}, {}, members}}};
    };
    static constexpr auto rows = material_rows<float>();
    JsonGroup materials{"material", "Materials",
                        "Each has a name of its own, by which objects call it.",
                        JsonMembers(&material_type, 1)};
    std::apply(
        [&](const auto&... row) {
            (materials.tables.push_back({row.name, row.also, row.text, row.members}),
             ...);
        },
        rows);
    return {
        one("scene", "The file", "An object with these members.", scene_members),
        one("image", "Image", "The size of the picture.", image_members),
        one("camera", "Camera", "Where the eye is, and what it sees.", camera_members),
        one("lens", "Lens", "A member of the camera: ljus::with_lens().", lens_members),
        std::move(materials),
        {"object",
         "Objects",
         "Shapes, each with a material.",
         object_shared,
         {std::begin(object_tables), std::end(object_tables)}},
        one("transform", "Transform",
            "A member of an object. It is scaled, then turned, then displaced.",
            transform_members),
        one("rotate", "Rotate", "A member of a transform.", rotate_members),
        {"light",
         "Lights",
         "Lights that are no objects.",
         light_shared,
         {std::begin(light_tables), std::end(light_tables)}},
        one("gradient", "Gradient", "A member of an environment.", gradient_members),
        {"fog",
         "Fog",
         "What scatters light in a region: ljus::Fog. No irradiance is gathered in it.",
         fog_shared,
         {std::begin(fog_tables), std::end(fog_tables)}}};
}

/// Three numbers, one for each component.
[[nodiscard]] inline nlohmann::ordered_json list_schema(nlohmann::ordered_json items,
                                                        int count) {
    return {{"type", "array"},
            {"items", std::move(items)},
            {"minItems", count},
            {"maxItems", count}};
}

/// The schema of a value, without its description.
[[nodiscard]] inline nlohmann::ordered_json value_schema(const JsonValue& value) {
    using Json = nlohmann::ordered_json;
    const auto reference = [](std::string_view name) -> Json {
        if (name == "points") return value_schema(point_value);
        if (name == "triples")
            return list_schema({{"type", "integer"}, {"minimum", 0}}, 3);
        if (name == "places") {
            const double most = max_length;
            return list_schema(
                {{"type", "number"}, {"minimum", -most}, {"maximum", most}}, 12);
        }
        if (name == "factor") return value_schema({JsonKind::number, 0, 1e9});
        return {{"$ref", std::string("#/definitions/").append(name)}};
    };
    const Json within{
        {"type", "number"}, {"minimum", value.low}, {"maximum", value.high}};
    switch (value.kind) {
    case JsonKind::text:
        return {{"type", "string"}};
    case JsonKind::remark:
        return {{"type", {"string", "null"}}};
    case JsonKind::word:
        return {{"enum", value.words}};
    case JsonKind::number:
        if (value.or_zero) return {{"anyOf", {{{"const", 0}}, within}}};
        return within;
    case JsonKind::length:
        return {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", value.high}};
    case JsonKind::whole:
        return {{"type", "integer"}, {"minimum", value.low}, {"maximum", value.high}};
    case JsonKind::pair:
        return list_schema(within, 2);
    case JsonKind::vector:
        return list_schema(within, 3);
    case JsonKind::direction: {
        Json list = list_schema(within, 3);
        list["contains"] = {{"not", {{"const", 0}}}};
        return list;
    }
    case JsonKind::scale:
        return {{"anyOf", {within, list_schema(within, 3)}}};
    case JsonKind::object:
        return reference(value.of);
    case JsonKind::list:
        return {{"type", "array"}, {"items", reference(value.of)}};
    case JsonKind::named:
        break;
    }
    return {{"type", "object"}, {"additionalProperties", reference(value.of)}};
}

/// The default of a member; null if it has none.
[[nodiscard]] inline nlohmann::ordered_json default_of(const JsonMember& row) {
    if (row.value.kind == JsonKind::word && row.optional)
        return row.value.words.front();
    if (std::isnan(row.preset)) return nullptr;
    const std::size_t count = row.value.kind == JsonKind::pair     ? 2
                              : row.value.kind == JsonKind::vector ? 3
                                                                   : 1;
    if (count == 1) return row.preset;
    return std::vector<double>(count, row.preset);
}

/// The schema of an object.
[[nodiscard]] inline nlohmann::ordered_json object_schema(const JsonTable& table,
                                                          JsonMembers shared) {
    using Json = nlohmann::ordered_json;
    Json properties = Json::object(), required = Json::array(), all = Json::array();
    const auto having = [](std::string_view name) {
        return Json{{"required", Json::array({name})}};
    };
    for (const JsonMembers members : {shared, table.members})
        for (const JsonMember& row : members) {
            Json schema = value_schema(row.value);
            if (row.name == "type" && !table.name.empty())
                schema = table.also.empty()
                             ? Json{{"const", table.name}}
                             : Json{{"enum", Json::array({table.name, table.also})}};
            schema["description"] = row.text;
            if (Json preset = default_of(row); !preset.is_null())
                schema["default"] = std::move(preset);
            properties[std::string(row.name)] = schema;
            if (row.also.empty()) {
                if (!row.optional) required.push_back(row.name);
                continue;
            }
            properties[std::string(row.also)] = schema;
            if (row.optional)
                all.push_back({{"not", {{"required", {row.name, row.also}}}}});
            else
                all.push_back(
                    {{"oneOf", Json::array({having(row.name), having(row.also)})}});
        }
    if (!table.one_of.empty()) {
        Json choices = Json::array();
        for (const std::string_view name : table.one_of)
            choices.push_back(having(name));
        all.push_back({{"oneOf", std::move(choices)}});
    }
    Json schema{{"type", "object"}};
    if (!table.text.empty()) schema["description"] = table.text;
    schema["properties"] = std::move(properties);
    schema["required"] = std::move(required);
    if (!all.empty()) schema["allOf"] = std::move(all);
    schema["additionalProperties"] = false;
    return schema;
}

/// The schema of a group: that of one of its tables.
[[nodiscard]] inline nlohmann::ordered_json group_schema(const JsonGroup& group) {
    if (group.tables.size() == 1) return object_schema(group.tables[0], group.shared);
    auto choices = nlohmann::ordered_json::array();
    for (const JsonTable& table : group.tables)
        choices.push_back(object_schema(table, group.shared));
    return {{"oneOf", std::move(choices)}};
}

/// An object with its needed members and those of an example, as JSON on one line.
[[nodiscard]] inline std::string example_of(const JsonTable& table,
                                            JsonMembers shared) {
    std::string text =
        table.name.empty() ? "" : join({"\"type\": \"", table.name, "\""});
    for (const JsonMembers members : {shared, table.members})
        for (const JsonMember& row : members)
            if (!row.example.empty())
                text +=
                    join({text.empty() ? "\"" : ", \"", row.name, "\": ", row.example});
    return join({"{", text, "}"});
}

/// An example as code in Markdown, in lines of at most 80 columns.
[[nodiscard]] inline std::string code_lines(std::string_view example) {
    std::string code;
    while (!example.empty()) {
        std::size_t end = example.size();
        const std::size_t comma = example.rfind(", \"", 76);
        if (end > 76 && comma != example.npos) end = comma + 2;
        code += join({code.empty() ? "    " : "     ", example.substr(0, end)});
        if (code.back() == ' ') code.pop_back();
        code += "\n";
        example.remove_prefix(end);
    }
    return code + "\n";
}

/// What a value may be, in words; the page explains colour, point and direction.
[[nodiscard]] inline std::string value_text(const JsonValue& value) {
    const auto with = [&](std::string_view kind) {
        return value.right.empty() ? std::string(kind) : join({kind, " ", value.right});
    };
    switch (value.kind) {
    case JsonKind::text:
        return "text";
    case JsonKind::remark:
        return "text or null";
    case JsonKind::word:
        return in_a_row({value.words.begin(), value.words.end()}, "or",
                        value.words.size());
    case JsonKind::number:
        return value.or_zero ? std::string(value.right) : with("number");
    case JsonKind::length:
        return "number above 0, " + std::string(value.right);
    case JsonKind::whole:
        return join({"whole number within [",
                     to_text(static_cast<long long>(value.low)), ", ",
                     to_text(static_cast<long long>(value.high)), "]"});
    case JsonKind::pair:
        return with("two numbers");
    case JsonKind::vector:
        return value.right == color_value.right   ? "colour"
               : value.right == point_value.right ? "point"
                                                  : with("three numbers");
    case JsonKind::direction:
        return "direction";
    case JsonKind::scale:
        return with("one or three numbers");
    case JsonKind::object:
        return "object";
    case JsonKind::list:
        return "list";
    case JsonKind::named:
        break;
    }
    return "object";
}

/// The rows of a table for people.
[[nodiscard]] inline std::string member_rows(JsonMembers members) {
    std::string text = "| member | value | default | what it is |\n|---|---|---|---|\n";
    for (const JsonMember& row : members) {
        const auto preset = default_of(row);
        const std::string names = row.also.empty()
                                      ? join({"`", row.name, "`"})
                                      : join({"`", row.name, "` or `", row.also, "`"});
        text += join({"| ", names, " | ", value_text(row.value), " | ",
                      !row.optional      ? "needed"
                      : preset.is_null() ? "none"
                                         : preset.dump(),
                      " | ", row.text, " |\n"});
    }
    return text;
}

} // namespace detail

/// The JSON schema (draft 7) of scene files, for editors and checkers. It follows from
/// the tables of the reader.
/// \return JSON, indented.
[[nodiscard]] inline std::string scene_schema() {
    using Json = nlohmann::ordered_json;
    Json definitions = Json::object(), schema;
    for (const detail::JsonGroup& group : detail::scene_groups())
        if (group.name == "scene")
            schema = detail::group_schema(group);
        else
            definitions[std::string(group.name)] = detail::group_schema(group);
    Json whole{{"$schema", "http://json-schema.org/draft-07/schema#"},
               {"title", "A scene file of Ljus"}};
    whole.update(schema);
    whole["definitions"] = std::move(definitions);
    return whole.dump(1) + "\n";
}

/// The same tables in Markdown, each with an example. A type that has the members of
/// an earlier one refers to it.
/// \return The reference part of the page \ref ch_scene_files.
[[nodiscard]] inline std::string scene_tables() {
    std::string page;
    for (const detail::JsonGroup& group : detail::scene_groups()) {
        page += detail::join({"## ", group.heading, " {#ch_scene_files_", group.name,
                              "}\n\n", group.text, "\n\n"});
        if (!group.shared.empty()) page += detail::member_rows(group.shared) + "\n";
        std::map<std::string, std::string_view> first; // of the types with these rows
        for (const detail::JsonTable& table : group.tables) {
            if (!table.name.empty())
                page += detail::join(
                    {"### `", table.name, "`", table.also.empty() ? "" : " or `",
                     table.also, table.also.empty() ? "" : "`", "\n\n", table.text});
            const std::string rows = detail::member_rows(table.members);
            const auto [same, is_new] = first.emplace(rows, table.name);
            if (!is_new) {
                page += detail::join({"; members as of `", same->second, "`\n\n"});
                continue;
            }
            if (!table.name.empty()) page += "\n\n";
            page += rows + "\n";
            if (group.name != "scene")
                page += detail::code_lines(detail::example_of(table, group.shared));
        }
    }
    return page;
}

/// \}

} // namespace ljus
