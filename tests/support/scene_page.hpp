#pragma once

/// \file support/scene_page.hpp
/// \brief Writes the tables of load_json() as Markdown: the reference part of
/// chapters/scene_files.md.

#include <cstdio>
#include <map>
#include <string>

#include "ljus/io/scene_schema.hpp"

namespace ljus_test {

using namespace ljus::detail;

/// An example of an object, with all required members and those that have an example,
/// as JSON on one line.
inline std::string example_of(const JsonTable& table, JsonMembers shared) {
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
inline std::string code_lines(std::string_view example) {
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

/// The allowed values of a member, in words. The page explains colour, point and
/// direction.
inline std::string value_text(const JsonValue& value) {
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
                     std::to_string(static_cast<long long>(value.low)), ", ",
                     std::to_string(static_cast<long long>(value.high)), "]"});
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

/// A default as a person writes it: 0 for 0.0, and no more than four digits.
inline std::string written(const nlohmann::ordered_json& value) {
    if (value.is_array()) {
        std::string text;
        for (const auto& one : value) text += (text.empty() ? "" : ", ") + written(one);
        return "[" + text + "]";
    }
    if (!value.is_number()) return value.dump();
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value.get<double>());
    return text;
}

/// The rows of a table, in Markdown.
inline std::string member_rows(JsonMembers members) {
    std::string text = "| member | value | default | what it is |\n|---|---|---|---|\n";
    for (const JsonMember& row : members) {
        const auto preset = default_of(row);
        text += join({"| `", row.name, "` | ", value_text(row.value), " | ",
                      !row.optional      ? "needed"
                      : preset.is_null() ? "none"
                                         : written(preset),
                      " | ", row.text, " |\n"});
    }
    return text;
}

/// All tables in Markdown, each with an example. A type with the same members as an
/// earlier type refers to that type.
inline std::string scene_tables() {
    std::string page;
    for (const JsonGroup& group : scene_groups()) {
        page += join({"## ", group.heading, " {#ch_scene_files_", group.name, "}\n\n",
                      group.text, "\n\n"});
        if (!group.shared.empty()) page += member_rows(group.shared) + "\n";
        std::map<std::string, std::string_view> first; // the first type with these rows
        for (const JsonTable& table : group.tables) {
            if (!table.name.empty())
                page += join({"### `", table.name, "`\n\n", table.text});
            const std::string rows = member_rows(table.members);
            const auto [same, is_new] = first.emplace(rows, table.name);
            if (!is_new) {
                page += join({"; members as of `", same->second, "`\n\n"});
                continue;
            }
            if (!table.name.empty()) page += "\n\n";
            page += rows + "\n";
            if (group.name != "scene")
                page += code_lines(example_of(table, group.shared));
        }
    }
    return page;
}

} // namespace ljus_test
