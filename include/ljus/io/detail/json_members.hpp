#pragma once

/// \file ljus/io/detail/json_members.hpp
/// \brief Tables of the members that objects of a scene file may have. Objects are
/// checked by these tables.

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <span>

#include <nlohmann/json.hpp>

#include "ljus/io/detail/json_field.hpp"
#include "ljus/math/vector.hpp"

namespace ljus::detail {

// Kinds of values. Every number of a value lies within [low, high].
enum class JsonKind : std::uint8_t {
    text,      // in quotation marks
    remark,    // a text for people, or null
    word,      // one of `words`
    number,    // a number; see JsonValue::or_zero
    length,    // a number above 0
    whole,     // a whole number
    pair,      // two numbers
    vector,    // three numbers
    direction, // three numbers that are not all 0
    scale,     // a number, or three
    object,    // an object with members of its own
    list,      // a list of objects
    named      // an object whose members have any names
};

// A kind of value with its limits. The text `right` completes "it must be".
struct JsonValue {
    JsonKind kind;
    double low = 0, high = 0;
    std::string_view right{};
    JsonNames words{};
    std::string_view of{}; // the name of its table, for an object or a list
    bool or_zero = false;  // whether 0 is allowed though it is below `low`
};

// A member of an object. It is required unless it is `optional` or has a default, which
// is `preset`, for a vector in each component. The default of a word is the first of
// its words.
struct JsonMember {
    std::string_view name;
    JsonValue value;
    std::string_view text;    // meaning and unit
    std::string_view example; // JSON; empty: left out of the example
    bool optional = false;
    double preset = std::numeric_limits<double>::quiet_NaN();
};
using JsonMembers = std::span<const JsonMember>;

// Makes a required member.
constexpr JsonMember needed(std::string_view name, const JsonValue& value,
                            std::string_view text, std::string_view example) {
    return {name, value, text, example};
}
constexpr JsonMember optional(std::string_view name, const JsonValue& value,
                              std::string_view text, std::string_view example = {}) {
    return {name, value, text, example, true};
}
constexpr JsonMember preset(std::string_view name, const JsonValue& value,
                            double number, std::string_view text,
                            std::string_view example = {}) {
    return {name, value, text, example, true, number};
}

inline constexpr double max_length = 1e9;
inline constexpr double max_radiance = 1e12;

// Kinds of values that several tables use.
inline constexpr JsonValue text_value{JsonKind::text};
inline constexpr JsonValue remark_value{JsonKind::remark};
inline constexpr JsonValue fraction_value{JsonKind::number, 0, 1, "within [0, 1]"};
inline constexpr JsonValue roughness_value{.kind = JsonKind::number,
                                           .low = 0.01,
                                           .high = 1,
                                           .right = "0 or within [0.01, 1]",
                                           .or_zero = true};
inline constexpr JsonValue color_value{JsonKind::vector, 0, 1, "within [0, 1]"};
inline constexpr JsonValue light_value{JsonKind::vector, 0, max_radiance,
                                       "within [0, 1e12]"};
inline constexpr JsonValue point_value{JsonKind::vector, -max_length, max_length,
                                       "within [-1e9, 1e9]"};
inline constexpr JsonValue direction_value{JsonKind::direction, -max_length, max_length,
                                           "within [-1e9, 1e9]"};
inline constexpr JsonValue length_value{JsonKind::length, -max_length, max_length,
                                        "at most 1e9"};
inline constexpr JsonValue factor_value{JsonKind::number, 1e-9, 1e9,
                                        "within [1e-9, 1e9]"};
inline constexpr JsonValue angle_value{JsonKind::number, -360, 360,
                                       "within [-360, 360] degrees"};

// Members of several kinds of objects.
inline constexpr JsonMember center_row =
    needed("center", point_value, "its centre", "[0, 1, 0]");
inline constexpr JsonMember radius_row =
    needed("radius", length_value, "its radius", "0.5");
inline constexpr JsonMember low_row =
    needed("low", point_value, "least x, y and z", "[0, 0, 0]");
inline constexpr JsonMember high_row =
    needed("high", point_value, "greatest x, y and z", "[1, 2, 1]");

inline void check_number(const JsonField& field, const JsonValue& value) {
    if (value.kind == JsonKind::whole)
        (void)whole_number(field, static_cast<long long>(value.low),
                           static_cast<long long>(value.high));
    else
        (void)number(field, value.or_zero ? 0 : value.low, value.high, value.right);
    const double found = field.value.get<double>();
    if (value.or_zero && found > 0 && found < value.low)
        refuse_value(field, value.right);
    if (value.kind == JsonKind::length && !(found > 0)) refuse_value(field, "above 0");
}

inline void check_numbers(const JsonField& field, const JsonValue& value,
                          std::size_t count, std::string_view right) {
    if (list_size(field) != count) refuse_value(field, right);
    bool all_zero = true;
    for (std::size_t i = 0; i < count; ++i) {
        check_number(entry(field, i), value);
        all_zero = all_zero && field.value[i].get<double>() == 0;
    }
    if (value.kind == JsonKind::direction && all_zero)
        refuse_value(field, "a vector that is not 0");
}

inline void check_value(const JsonField& field, const JsonValue& value) {
    switch (value.kind) {
    case JsonKind::text:
        (void)text(field);
        break;
    case JsonKind::remark:
        if (!field.value.is_null()) (void)text(field);
        break;
    case JsonKind::word:
        require_one_of(field, value.words);
        break;
    case JsonKind::number:
    case JsonKind::length:
    case JsonKind::whole:
        check_number(field, value);
        break;
    case JsonKind::pair:
        check_numbers(field, value, 2, "a list of two numbers");
        break;
    case JsonKind::vector:
    case JsonKind::direction:
        check_numbers(field, value, 3, "a list of three numbers");
        break;
    case JsonKind::scale:
        if (field.value.is_number())
            check_number(field, value);
        else
            check_numbers(field, value, 3, "a number or a list of three numbers");
        break;
    case JsonKind::list:
        (void)list_size(field);
        break;
    case JsonKind::object:
    case JsonKind::named:
        if (!field.value.is_object()) refuse_value(field, "an object");
    }
}

// An object whose members are those of its tables.
class JsonMembersOf {
public:
    // Checks all members. The table `shared` is common to several kinds of objects.
    JsonMembersOf(const JsonField& field, JsonMembers own, JsonMembers shared = {})
        : field_(field), tables_{shared, own} {
        if (!field.value.is_object()) refuse_value(field, "an object");
        for (auto part = field.value.begin(); part != field.value.end(); ++part)
            if (row_of(part.key()) == nullptr)
                refuse_name({*part, field.file, field.root}, part.key(), names());
        for (const JsonMembers& table : tables_)
            for (const JsonMember& row : table) {
                if (const auto found = find(field_, row.name))
                    check_value(*found, row.value);
                else if (!row.optional)
                    (void)member(field_, row.name); // throws: the member is missing
            }
    }

    [[nodiscard]] const JsonField& field() const noexcept { return field_; }
    [[nodiscard]] bool has(std::string_view name) const {
        return find(field_, name).has_value();
    }
    // A member; throws if it is missing.
    [[nodiscard]] JsonField operator[](std::string_view name) const {
        return member(field_, name);
    }
    // A member's number, or its default.
    [[nodiscard]] double number(std::string_view name) const {
        const JsonMember& row = *row_of(name);
        const auto found = find(field_, name);
        return found ? found->value.get<double>() : row.preset;
    }
    // The three numbers of a member; a single number or default is used three times.
    [[nodiscard]] glm::dvec3 vector(std::string_view name) const {
        const JsonMember& row = *row_of(name);
        const auto found = find(field_, name);
        if (!found) return glm::dvec3(row.preset);
        const nlohmann::json& value = found->value;
        if (value.is_number()) return glm::dvec3(value.get<double>());
        return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
    }
    // The word that a member has, or the first of its possible words.
    [[nodiscard]] std::string word(std::string_view name) const {
        const JsonMember& row = *row_of(name);
        const auto found = find(field_, name);
        return found ? text(*found) : std::string(row.value.words.front());
    }

private:
    [[nodiscard]] const JsonMember* row_of(std::string_view name) const {
        for (const JsonMembers& table : tables_)
            for (const JsonMember& row : table)
                if (row.name == name) return &row;
        return nullptr;
    }
    [[nodiscard]] std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const JsonMembers& table : tables_)
            for (const JsonMember& row : table) all.emplace_back(row.name);
        return all;
    }

    JsonField field_;
    std::array<JsonMembers, 2> tables_;
};

// A kind of object. Its name is the value of the object's `type`, or the name of the
// member that holds the object.
struct JsonTable {
    std::string_view name;
    std::string_view text;
    JsonMembers members;
    JsonNames one_of{}; // members of which an object has exactly one
};

// The member that names the table of an object.
inline constexpr JsonMember type_row =
    needed("type", text_value, "one of the types below", {});

// The table that the `type` of an object names.
[[nodiscard]] inline const JsonTable& table_of(std::span<const JsonTable> tables,
                                               const JsonField& object) {
    const JsonField type = member(object, "type");
    std::vector<std::string> names;
    for (const JsonTable& table : tables) {
        if (text(type) == table.name) return table;
        names.emplace_back(table.name);
    }
    refuse_word(type, names, in_a_row(names, "or", names.size()));
}

// The entry of a map that a field names. Messages call the map `what`.
template <typename Entry>
const Entry& entry_named(const JsonField& field,
                         const std::map<std::string, Entry>& map,
                         std::string_view what) {
    const auto known = map.find(text(field));
    if (known != map.end()) return known->second;
    std::vector<std::string> names;
    for (const auto& [name, value] : map) names.push_back(name);
    refuse_word(field, names, join({"one of the ", what, " ", in_a_row(names, "or")}));
}

// The groups of lamps by name, each with the factor by which its light is multiplied.
struct LampGroups {
    std::map<std::string, double> factors{};

    explicit LampGroups(const JsonMembersOf& scene) {
        if (!scene.has("lamp_groups")) return;
        const JsonField groups = scene["lamp_groups"];
        for (const auto& [name, value] : groups.value.items())
            factors[name] =
                number({value, groups.file, groups.root}, 0, 1e9, "within [0, 1e9]");
    }
    // The factor of an object or a light, by its member lamp_group; 1 if it has none.
    [[nodiscard]] double factor(const JsonMembersOf& in) const {
        if (!in.has("lamp_group")) return 1;
        const JsonField group = in["lamp_group"];
        if (factors.empty())
            refuse_value(group, "a name of lamp_groups, which the file lacks");
        return entry_named(group, factors, "lamp_groups");
    }
};
inline constexpr JsonMember lamp_group_row =
    optional("lamp_group", text_value, "a name of lamp_groups, which dims it");

} // namespace ljus::detail
