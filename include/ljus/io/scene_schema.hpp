#pragma once

/// \file ljus/io/scene_schema.hpp
/// \brief A JSON schema of scene files.

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <nlohmann/json.hpp>

#include "ljus/io/load_json.hpp"

namespace ljus {

/// \defgroup scene_schema The schema of scene files
/// \brief The rules of load_json() in a form that editors understand. The schema needs
/// the package nlohmann-json. Page: \ref ch_scene_files.
/// \{

namespace detail {

/// One kind of object in scene files, such as a light, and a table of its members for
/// each type. The member `type` chooses the table, unless there is only one.
struct JsonGroup {
    std::string_view name;           // name in the schema
    std::string_view heading, text;  // words on the page of the book
    JsonMembers shared{};            // members of all tables
    std::vector<JsonTable> tables{}; // a single one has no `type`
};

[[nodiscard]] inline std::vector<JsonGroup> scene_groups() {
    const auto one = [](std::string_view name, std::string_view heading,
                        std::string_view text, JsonMembers members) {
        return JsonGroup{name, heading, text, {}, {{{}, {}, members}}};
    };
    static constexpr auto rows = material_rows<float>();
    JsonGroup materials{"material", "Materials",
                        "Each has a name of its own, by which objects call it.",
                        JsonMembers(&type_row, 1)};
    std::apply(
        [&](const auto&... row) {
            (materials.tables.push_back({row.name, row.text, row.members}), ...);
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
                schema = {{"const", table.name}};
            schema["description"] = row.text;
            if (Json preset = default_of(row); !preset.is_null())
                schema["default"] = std::move(preset);
            properties[std::string(row.name)] = std::move(schema);
            if (!row.optional) required.push_back(row.name);
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

/// The schema of a group: an object fits if it fits one of the tables.
[[nodiscard]] inline nlohmann::ordered_json group_schema(const JsonGroup& group) {
    if (group.tables.size() == 1) return object_schema(group.tables[0], group.shared);
    auto choices = nlohmann::ordered_json::array();
    for (const JsonTable& table : group.tables)
        choices.push_back(object_schema(table, group.shared));
    return {{"oneOf", std::move(choices)}};
}

} // namespace detail

/// The JSON schema (draft 7) of scene files, for editors and validators. It is made
/// from the tables that load_json() uses.
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

/// \}

} // namespace ljus
