#pragma once

/// \file ljus/io/detail/json_field.hpp
/// \brief A value of a JSON file with its path, for error messages.

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "ljus/io/file.hpp"
#include "ljus/io/nearest_word.hpp"

namespace ljus::detail {

struct JsonField {
    const nlohmann::json& value;
    const std::string& file;    // the name of the file, for messages
    const nlohmann::json& root; // the whole file
};

// A value as a message shows it.
[[nodiscard]] inline std::string shown_value(const nlohmann::json& value) {
    // A large value is described, not printed.
    if (value.is_object()) return "an object";
    if (value.is_array() && value.size() > 4)
        return join({"a list of ", std::to_string(value.size()), " entries"});
    for (const auto& part : value)
        if (part.is_structured()) return "a list";
    return shown(value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

// The path of a member, such as "a.b", or "a["b c"]" if its name is not a plain word.
[[nodiscard]] inline std::string path_of_member(std::string path,
                                                std::string_view name) {
    const bool plain = !name.empty() && name.size() <= 48 &&
                       std::all_of(name.begin(), name.end(), [](char c) {
                           return is_word_letter(c) || c == '-';
                       });
    if (!plain) return join({path, "[\"", shown(std::string(name)), "\"]"});
    if (!path.empty()) path += '.';
    return path.append(name);
}

// The path of a value within `whole`, whose own path is `path`; nothing if the value is
// not there. Paths are searched for when a message needs one; they are not kept while
// reading.
[[nodiscard]] inline std::optional<std::string>
path_within(const nlohmann::json& whole, const nlohmann::json& value,
            const std::string& path = "") {
    if (&whole == &value) return path;
    std::size_t index = 0;
    for (auto part = whole.begin(); part != whole.end(); ++part, ++index) {
        if (&*part != &value && !part->is_structured()) continue;
        const std::string next = whole.is_object()
                                     ? path_of_member(path, part.key())
                                     : path + "[" + std::to_string(index) + "]";
        if (auto found = path_within(*part, value, next)) return found;
    }
    return std::nullopt;
}
[[nodiscard]] inline std::string path_of(const JsonField& field) {
    return path_within(field.root, field.value).value_or("");
}

// Throws an error about a path: "scene.json: objects[3].radius is missing." `why`
// completes the sentence, without the full stop.
[[noreturn]] inline void refuse_path(const JsonField& field, const std::string& path,
                                     std::string_view why) {
    refuse_file(field.file, join({path.empty() ? "the file" : path, " ", why}));
}
[[noreturn]] inline void refuse(const JsonField& field, std::string_view why) {
    refuse_path(field, path_of(field), why);
}

// Throws an error about a value: "scene.json: objects[3].radius is -1; it must be above
// 0."
[[noreturn]] inline void refuse_value(const JsonField& field, std::string_view right) {
    refuse(field, join({"is ", shown_value(field.value), "; it must be ", right}));
}

// Throws an error about a field. The reason is the text of another exception.
[[noreturn]] inline void refuse_for(const JsonField& field,
                                    const std::exception& error) {
    std::string_view why = error.what();
    if (why.ends_with('.')) why.remove_suffix(1);
    refuse(field, join({"cannot be used: ", why}));
}

// The result of a call. If it throws std::invalid_argument, for instance because T
// cannot hold a number, the error is reported for the field.
template <typename Call>
auto made_of(const JsonField& field, Call call) {
    try {
        return call();
    } catch (const std::invalid_argument& error) {
        refuse_for(field, error);
    }
}

// A list of at most `most` names, such as "a, b or c", where `last` is "or".
[[nodiscard]] inline std::string in_a_row(const std::vector<std::string>& names,
                                          std::string_view last,
                                          std::size_t most = 12) {
    const std::size_t count = std::min(names.size(), most);
    std::string row;
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0 && i + 1 == names.size())
            row.append(" ").append(last).append(" ");
        else if (i > 0)
            row.append(", ");
        row.append(shown(names[i]));
    }
    return count < names.size() ? row.append(", ...") : row;
}

// Names in the order in which messages list them.
using JsonNames = std::span<const std::string_view>;

[[nodiscard]] inline const std::string& text(const JsonField& field) {
    if (!field.value.is_string()) refuse_value(field, "a text in quotation marks");
    return field.value.get_ref<const std::string&>();
}

// Throws an error about an unknown name of a field, and proposes the nearest known
// name: "objects[3].radios is not known; did you mean radius? The ...".
[[noreturn]] inline void refuse_name(const JsonField& field, std::string_view name,
                                     const std::vector<std::string>& known) {
    const std::string near = nearest_word(name, known);
    const std::string list = in_a_row(known, "and", known.size());
    refuse(field, near.empty() ? "is not known; the fields here are " + list
                               : join({"is not known; did you mean ", near,
                                       "? The fields here are ", list}));
}
// Throws an error about an unknown word, and proposes the nearest known one.
[[noreturn]] inline void refuse_word(const JsonField& field,
                                     const std::vector<std::string>& known,
                                     const std::string& right) {
    const std::string near = nearest_word(text(field), known);
    if (near.empty()) refuse_value(field, right);
    refuse(field, join({"is ", shown_value(field.value), "; did you mean \"",
                        shown(near), "\"? It must be ", right}));
}

// A member of an object, if it exists.
[[nodiscard]] inline std::optional<JsonField> find(const JsonField& field,
                                                   std::string_view name) {
    // Objects have few members: comparing all is faster than a search in their tree.
    if (const auto* all = field.value.get_ptr<const nlohmann::json::object_t*>())
        for (const auto& [known, value] : *all)
            if (known == name) return JsonField{value, field.file, field.root};
    return std::nullopt;
}

// A required member.
[[nodiscard]] inline JsonField member(const JsonField& field, std::string_view name) {
    if (!field.value.is_object()) refuse_value(field, "an object");
    if (const auto found = find(field, name)) return *found;
    refuse_path(field, path_of_member(path_of(field), name), "is missing");
}

[[nodiscard]] inline JsonField entry(const JsonField& field, std::size_t i) {
    return {field.value[i], field.file, field.root};
}

[[nodiscard]] inline std::size_t list_size(const JsonField& field) {
    if (!field.value.is_array()) refuse_value(field, "a list");
    return field.value.size();
}

// The entries of a list; none if there is no list.
[[nodiscard]] inline std::vector<JsonField>
entries(const std::optional<JsonField>& list) {
    std::vector<JsonField> all;
    for (std::size_t i = 0; list && i < list_size(*list); ++i)
        all.push_back(entry(*list, i));
    return all;
}

inline void require_one_of(const JsonField& field, JsonNames names) {
    if (is_one_of(text(field), names)) return;
    const std::vector<std::string> known(names.begin(), names.end());
    refuse_word(field, known, in_a_row(known, "or", known.size()));
}

// A number within [low, high]; `right` is the range in words.
[[nodiscard]] inline double number(const JsonField& field, double low, double high,
                                   std::string_view right) {
    if (!field.value.is_number()) refuse_value(field, "a number");
    const double value = field.value.get<double>();
    if (!(value >= low && value <= high)) refuse_value(field, right);
    return value;
}

// A whole number within [low, high], at most 2^53.
[[nodiscard]] inline long long whole_number(const JsonField& field, long long low,
                                            long long high) {
    const std::string right =
        join({"a whole number within [", to_text(low), ", ", to_text(high), "]"});
    const double value =
        number(field, static_cast<double>(low), static_cast<double>(high), right);
    if (value != std::floor(value)) refuse_value(field, right);
    return static_cast<long long>(value);
}

// The path of the file that a field names.
[[nodiscard]] inline std::string path_beside(const JsonField& field) {
    return path_beside(field.file, text(field));
}

} // namespace ljus::detail
