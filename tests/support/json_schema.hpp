#pragma once

/// \file support/json_schema.hpp
/// \brief Checks JSON against a JSON schema, with the keywords that the schema of scene
/// files uses.

#include <cmath>
#include <stdexcept>
#include <string>

#include <nlohmann/json.hpp>

namespace ljus_test {

/// Whether a value is valid by a part of a schema.
/// \param root  The whole schema, for references.
/// \throws std::runtime_error  for an unknown keyword.
inline bool valid(const nlohmann::json& value, const nlohmann::json& schema,
                  const nlohmann::json& root) {
    const auto type_is = [&](const std::string& type) {
        if (type == "object") return value.is_object();
        if (type == "array") return value.is_array();
        if (type == "string") return value.is_string();
        if (type == "null") return value.is_null();
        if (type == "number") return value.is_number();
        if (type == "integer")
            return value.is_number() &&
                   std::floor(value.get<double>()) == value.get<double>();
        throw std::runtime_error("type " + type);
    };
    const auto count = [&](const nlohmann::json& parts) {
        int good = 0;
        for (const auto& part : parts) good += valid(value, part, root);
        return good;
    };
    for (const auto& [word, rule] : schema.items()) {
        bool good = true;
        if (word == "$schema" || word == "title" || word == "description" ||
            word == "default" || word == "definitions") {
            continue;
        } else if (word == "$ref") {
            const std::string path = rule.get<std::string>().substr(1);
            good = valid(value, root.at(nlohmann::json::json_pointer(path)), root);
        } else if (word == "type") {
            if (rule.is_string()) {
                good = type_is(rule.get<std::string>());
            } else {
                good = false;
                for (const auto& one : rule) good = good || type_is(one);
            }
        } else if (word == "const") {
            good = value == rule;
        } else if (word == "enum") {
            good = false;
            for (const auto& one : rule) good = good || value == one;
        } else if (word == "minimum") {
            good = !value.is_number() || value.get<double>() >= rule.get<double>();
        } else if (word == "exclusiveMinimum") {
            good = !value.is_number() || value.get<double>() > rule.get<double>();
        } else if (word == "maximum") {
            good = !value.is_number() || value.get<double>() <= rule.get<double>();
        } else if (word == "minItems") {
            good = !value.is_array() || value.size() >= rule.get<std::size_t>();
        } else if (word == "maxItems") {
            good = !value.is_array() || value.size() <= rule.get<std::size_t>();
        } else if (word == "items") {
            if (value.is_array())
                for (const auto& item : value) good = good && valid(item, rule, root);
        } else if (word == "contains") {
            good = !value.is_array();
            if (value.is_array())
                for (const auto& item : value) good = good || valid(item, rule, root);
        } else if (word == "required") {
            if (value.is_object())
                for (const auto& name : rule)
                    good = good && value.contains(name.get<std::string>());
        } else if (word == "properties") {
            if (value.is_object())
                for (const auto& [name, part] : rule.items())
                    if (value.contains(name))
                        good = good && valid(value[name], part, root);
        } else if (word == "additionalProperties") {
            if (value.is_object())
                for (const auto& [name, part] : value.items()) {
                    if (schema.contains("properties") &&
                        schema["properties"].contains(name))
                        continue;
                    good = good && (rule.is_boolean() ? rule.get<bool>()
                                                      : valid(part, rule, root));
                }
        } else if (word == "allOf") {
            good = count(rule) == int(rule.size());
        } else if (word == "anyOf") {
            good = count(rule) > 0;
        } else if (word == "oneOf") {
            good = count(rule) == 1;
        } else if (word == "not") {
            good = !valid(value, rule, root);
        } else {
            throw std::runtime_error("keyword " + word);
        }
        if (!good) return false;
    }
    return true;
}

} // namespace ljus_test
