#pragma once

/// \file ljus/io/detail/parse_json.hpp
/// \brief A JSON parser that refuses duplicate members, deep nesting and numbers that
/// are not finite.

#include <nlohmann/json.hpp>

#include "ljus/io/detail/json_field.hpp"

namespace ljus::detail {

// The deepest nesting of lists and objects.
inline constexpr std::size_t max_json_depth = 32;

// The limit for one file: this many numbers, or a quarter as many lists, objects and
// members, which take more memory.
inline constexpr std::size_t max_json_values = std::size_t(1) << 23;

// Receives the events of nlohmann's parser and builds the value.
struct JsonBuilder {
    using number_integer_t = nlohmann::json::number_integer_t;
    using number_unsigned_t = nlohmann::json::number_unsigned_t;
    using number_float_t = nlohmann::json::number_float_t;

    std::string_view source;             // the whole file, for counting lines
    const std::string& file;             // name of the file
    nlohmann::json root{};               // the value that is built
    std::vector<nlohmann::json*> open{}; // the enclosing lists and objects
    nlohmann::json* member = nullptr;    // the current member, if the innermost is an
                                         // object
    std::size_t room = max_json_values;  // the rest of the limit

    bool null() { return put(nullptr); }
    bool boolean(bool value) { return put(value); }
    bool number_integer(number_integer_t value) { return put(value); }
    bool number_unsigned(number_unsigned_t value) { return put(value); }
    bool number_float(number_float_t value, const std::string&) { return put(value); }
    bool string(std::string& value) { return put(std::move(value)); }
    bool binary(nlohmann::json::binary_t&) { return false; }
    bool start_object(std::size_t) { return begin(nlohmann::json::object()); }
    bool start_array(std::size_t) { return begin(nlohmann::json::array()); }
    bool end_object() { return end(); }
    bool end_array() { return end(); }

    bool key(std::string& name) {
        take(4);
        auto& members = open.back()->get_ref<nlohmann::json::object_t&>();
        const auto [at, fresh] = members.try_emplace(std::move(name));
        member = &at->second;
        if (!fresh) refuse_file(file, path() + " appears twice");
        return true;
    }

    template <typename Exception>
    bool parse_error(std::size_t position, const std::string& token,
                     const Exception& error) {
        std::size_t line = 1;
        std::size_t column = 0;
        for (const char c : source.substr(0, position)) {
            column = c == '\n' ? 0 : column + 1;
            line += c == '\n' ? 1 : 0;
        }
        std::string why = error.what();
        std::string_view right; // what would be right
        if (error.id == 406) {  // a number beyond the range of double
            why = path() + " is " + token;
            right = "; it must be finite";
        } else { // "... while parsing value - unexpected end of input"
            why.erase(0, why.find(" - ") + 3);
            if (why.starts_with("invalid literal") &&
                why.find("expected") == std::string::npos)
                right = "; a value is a number, a text in quotation marks, a list, an "
                        "object, true, false or null";
        }
        for (char& c : why)
            if (static_cast<unsigned char>(c) >= 0x80) c = '?';
        refuse_file(file, join({"line ", std::to_string(line), ", column ",
                                std::to_string(column == 0 ? 1 : column), ": ",
                                shown(why, 160), right}));
    }

private:
    // The path of the next value.
    std::string path() const {
        if (open.empty()) return "the file";
        const nlohmann::json& last = *open.back();
        if (last.is_object()) return path_within(root, *member).value_or("");
        return join({path_within(root, last).value_or(""), "[",
                     std::to_string(last.size()), "]"});
    }

    void take(std::size_t cost) {
        if (room < cost)
            refuse_file(
                file,
                join({"it has more than ", std::to_string(max_json_values),
                      " numbers, or a quarter as many lists, objects and members; put "
                      "large meshes into files of their own"}));
        room -= cost;
    }

    bool put(nlohmann::json value) {
        take(1);
        place(std::move(value));
        return true;
    }

    nlohmann::json* place(nlohmann::json&& value) {
        if (open.empty()) return &(root = std::move(value));
        if (open.back()->is_array()) {
            open.back()->push_back(std::move(value));
            return &open.back()->back();
        }
        return &(*member = std::move(value));
    }

    bool begin(nlohmann::json value) {
        take(4);
        if (open.size() == max_json_depth)
            refuse_file(file,
                        join({shown(path(), 96), " is nested too deeply; at most ",
                              std::to_string(max_json_depth), " levels are allowed"}));
        open.push_back(place(std::move(value)));
        return true;
    }

    bool end() {
        open.pop_back();
        return true;
    }
};

// Parses JSON. The name of the file is for messages, such as "scene.json: line 3,
// column 7: unexpected end of input; expected '}'."
[[nodiscard]] inline nlohmann::json parse_json(std::string_view source,
                                               const std::string& file) {
    source = plain_text(source, file);
    if (source.find_first_not_of(" \t\r\n") == std::string_view::npos)
        refuse_file(file, "the file is empty");
    JsonBuilder builder{.source = source, .file = file};
    nlohmann::json::sax_parse(source.begin(), source.end(), &builder);
    return std::move(builder.root);
}

} // namespace ljus::detail
