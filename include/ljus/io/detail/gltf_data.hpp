#pragma once

/// \file ljus/io/detail/gltf_data.hpp
/// \brief Reads the numbers of a glTF file from its buffers, by buffer views and
/// accessors.

#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include "ljus/io/detail/parse.hpp"
#include "ljus/io/detail/parse_json.hpp"
#include "ljus/io/file.hpp"

namespace ljus::detail {

// The largest size of all buffers, in bytes.
inline constexpr std::size_t max_gltf_bytes = std::size_t(1) << 30;

// The largest number of accessor elements that are read for one file, and the largest
// number of elements of an accessor without bytes, which are all 0.
inline constexpr long long max_gltf_elements = 1LL << 25, max_gltf_zeros = 1LL << 20;

// The bytes of a text in base64. Blanks and = are ignored.
inline Bytes from_base64(std::string_view text, const JsonField& field) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrs"
                                         "tuvwxyz0123456789+/";
    Bytes bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        if (c == '=' || is_blank(c) || c == '\n' || c == '\r') continue;
        const std::size_t value = letters.find(c);
        if (value == letters.npos)
            refuse(field, "has a letter that base64 does not have");
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<unsigned char>(bits >> count));
    }
    return bytes;
}

// What a URI means, in which %20 stands for a blank.
inline std::string decoded(std::string_view uri) {
    std::string plain;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const char* const digits = uri.data() + i + 1;
        unsigned code = 0;
        const bool coded =
            uri[i] == '%' && i + 2 < uri.size() &&
            std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2;
        plain += coded ? static_cast<char>(code) : uri[i];
        i += coded ? 2 : 0;
    }
    return plain;
}

// The path of the file that a URI names.
inline std::string path_of_uri(const JsonField& field) {
    const std::string& uri = text(field);
    if (uri.find("://") != uri.npos)
        refuse(field, "is an address; only files beside this one are read");
    return path_beside(field.file, decoded(uri));
}

// Reads an index into a list of `count` entries, which messages call `list`.
inline std::size_t index_in(const JsonField& field, std::size_t count,
                            std::string_view list) {
    if (count == 0)
        refuse(field, join({"names one of ", list, ", but there are none"}));
    return static_cast<std::size_t>(
        whole_number(field, 0, static_cast<long long>(count) - 1));
}

// A glTF file: its JSON and, in a .glb file, the bytes that follow.
struct GltfFile {
    const std::string& name;
    nlohmann::json json{};
    Bytes chunk{};
    bool has_chunk = false;

    GltfFile(const Bytes& bytes, const std::string& file) : name(file) {
        const std::string_view all(reinterpret_cast<const char*>(bytes.data()),
                                   bytes.size());
        if (!all.starts_with("glTF")) {
            json = parse_json(all, name);
            return;
        }
        const auto word = [&](std::size_t at) {
            return std::size_t(unsigned_value(all.substr(at, 4)));
        };
        if (bytes.size() < 20) refuse_file(name, "it ends within its head of 20 bytes");
        if (word(4) != 2)
            refuse_file(name, join({"it is a binary glTF file of version ",
                                    std::to_string(word(4)), "; only 2 is known"}));
        if (word(8) > bytes.size())
            refuse_file(name,
                        join({"its head says that it has ", std::to_string(word(8)),
                              " bytes, but it has ", std::to_string(bytes.size())}));
        for (std::size_t at = 12; at + 8 <= word(8);) {
            const std::size_t size = word(at), kind = word(at + 4), from = at + 8;
            if (size > word(8) - from)
                refuse_file(name, join({"its chunk at byte ", std::to_string(at),
                                        " says that it has ", std::to_string(size),
                                        " bytes, but ", std::to_string(word(8) - from),
                                        " are left"}));
            if (at == 12 && kind != 0x4e4f534a)
                refuse_file(name, "its first chunk must be JSON");
            if (at == 12) json = parse_json(all.substr(from, size), name);
            if (at > 12 && kind == 0x004e4942 && !has_chunk) {
                chunk.assign(bytes.begin() + std::ptrdiff_t(from),
                             bytes.begin() + std::ptrdiff_t(from + size));
                has_chunk = true;
            }
            at = from + size;
        }
    }

    [[nodiscard]] JsonField root() const { return {json, name, json}; }
    // Reads a number that must be an index into the list of this name in the file.
    [[nodiscard]] std::size_t number_in(const JsonField& field,
                                        const char* list) const {
        const auto all = find(root(), list);
        return index_in(field, all ? list_size(*all) : 0, list);
    }
    [[nodiscard]] JsonField named(const JsonField& field, const char* list) const {
        return entry(member(root(), list), number_in(field, list));
    }
};

// A size or an offset in bytes; 0 if it is missing.
inline std::size_t size_field(const JsonField& field, std::string_view name) {
    const auto found = find(field, name);
    return found ? static_cast<std::size_t>(whole_number(*found, 0, 1LL << 40)) : 0;
}

class GltfData {
public:
    explicit GltfData(const GltfFile& file) : file_(file) {}

    // The bytes of a buffer view.
    std::string_view view(const JsonField& field) {
        const JsonField is = file_.named(field, "bufferViews");
        const JsonField buffer = member(is, "buffer");
        const std::string_view bytes = buffer_of(buffer);
        const std::size_t from = size_field(is, "byteOffset");
        const auto size = static_cast<std::size_t>(
            whole_number(member(is, "byteLength"), 1, 1LL << 40));
        if (from > bytes.size() || size > bytes.size() - from)
            refuse(is, join({"has bytes ", std::to_string(from), " to ",
                             std::to_string(from + size), " of a buffer of ",
                             std::to_string(bytes.size())}));
        return bytes.substr(from, size);
    }
    // The bytes to which a URI refers: those of a file, or data within the URI.
    Bytes bytes_of(const JsonField& uri, std::size_t most) {
        const std::string& is = text(uri);
        if (!is.starts_with("data:")) return load_file(path_of_uri(uri), most);
        const std::size_t comma = is.find(',');
        if (comma == is.npos || !is.substr(0, comma).ends_with(";base64"))
            refuse(uri, "holds its data in another way than base64");
        return from_base64(decoded(std::string_view(is).substr(comma + 1)), uri);
    }

    // The numbers of an accessor, element by element; normalized integers become
    // fractions. `types` are the allowed types of an element. `size` receives the count
    // of numbers in an element.
    std::vector<double> numbers(const JsonField& field,
                                std::initializer_list<std::string_view> types,
                                std::size_t& size) {
        const JsonField is = file_.named(field, "accessors");
        const JsonField type = member(is, "type");
        require_one_of(type, types);
        size =
            text(type) == "SCALAR" ? 1 : static_cast<std::size_t>(text(type)[3] - '0');
        const long long count = whole_number(member(is, "count"), 1, max_gltf_elements);
        elements_ += count;
        if (elements_ > max_gltf_elements)
            refuse(is, join({"is one too many: all elements of accessors, as often as "
                             "they are used, must be at most ",
                             to_text(max_gltf_elements)}));
        const auto view = find(is, "bufferView");
        if (!view && count > max_gltf_zeros)
            refuse_value(member(is, "count"),
                         join({"at most ", to_text(max_gltf_zeros),
                               ", because there is no bufferView"}));
        const auto all = static_cast<std::size_t>(count);
        const Component component = component_of(is);
        std::vector<double> result;
        if (view) {
            const JsonField stride = file_.named(*view, "bufferViews");
            read(is, *view, component, all, size, size_field(stride, "byteStride"),
                 [&](double value) { result.push_back(value); });
        } else {
            result.assign(all * size, 0);
        }
        if (const auto sparse = find(is, "sparse"))
            replace(*sparse, component, all, size, result);
        return result;
    }

private:
    struct Component {
        std::size_t size;
        char kind; // i: signed, u: unsigned, f: float
        bool normalized;
    };
    static Component component_of(const JsonField& is) {
        const auto normalized = find(is, "normalized");
        const bool fraction = normalized && normalized->value == true;
        const JsonField type = member(is, "componentType");
        switch (whole_number(type, 0, 65535)) {
        case 5120:
            return {1, 'i', fraction};
        case 5121:
            return {1, 'u', fraction};
        case 5122:
            return {2, 'i', fraction};
        case 5123:
            return {2, 'u', fraction};
        case 5125:
            return {4, 'u', fraction};
        case 5126:
            return {4, 'f', false};
        default:
            refuse_value(type, "5120, 5121, 5122, 5123, 5125 or 5126");
        }
    }
    static double number(std::string_view bytes, const Component& is) {
        const double value = binary_number(bytes.substr(0, is.size), is.kind);
        if (!is.normalized) return value;
        const double range = std::ldexp(1, 8 * static_cast<int>(is.size));
        return is.kind == 'i' ? std::max(value / (range / 2 - 1), -1.0)
                              : value / (range - 1);
    }
    // Reads `count` elements from the view `in`, from the byteOffset of `is` on, and
    // calls use(number) for each number.
    template <typename Use>
    void read(const JsonField& is, const JsonField& in, const Component& component,
              std::size_t count, std::size_t size, std::size_t stride, Use use) {
        const std::string_view bytes = view(in);
        const std::size_t element = size * component.size;
        if (stride == 0) stride = element;
        if (stride < element)
            refuse(is, join({"has elements of ", std::to_string(element),
                             " bytes, but the next one begins after ",
                             std::to_string(stride), " bytes"}));
        const std::size_t from = size_field(is, "byteOffset");
        if (from > bytes.size() || bytes.size() - from < element ||
            (bytes.size() - from - element) / stride < count - 1)
            refuse(is,
                   join({"has ", std::to_string(count), " elements of ",
                         std::to_string(element), " bytes, which do not fit into the ",
                         std::to_string(bytes.size()), " bytes of its view"}));
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < size; ++k)
                use(number(bytes.substr(from + i * stride + k * component.size),
                           component));
    }
    // Replaces the elements that a sparse accessor lists.
    void replace(const JsonField& sparse, const Component& component, std::size_t all,
                 std::size_t size, std::vector<double>& result) {
        const auto count = static_cast<std::size_t>(
            whole_number(member(sparse, "count"), 1, static_cast<long long>(all)));
        const JsonField indices = member(sparse, "indices");
        const JsonField values = member(sparse, "values");
        std::vector<std::size_t> at;
        Component index = component_of(indices);
        if (index.kind != 'u') refuse(indices, "are no unsigned whole numbers");
        index.normalized = false;
        read(indices, member(indices, "bufferView"), index, count, 1, 0,
             [&](double value) {
                 if (value >= double(all))
                     refuse(indices,
                            join({"have the number ", to_text(value), " among ",
                                  std::to_string(all), " elements"}));
                 at.push_back(static_cast<std::size_t>(value));
             });
        std::size_t next = 0;
        read(values, member(values, "bufferView"), component, count, size, 0,
             [&](double value) {
                 result[at[next / size] * size + next % size] = value;
                 ++next;
             });
    }
    std::string_view buffer_of(const JsonField& field) {
        const std::size_t number = file_.number_in(field, "buffers");
        const JsonField is = file_.named(field, "buffers");
        const auto [known, fresh] = buffers_.try_emplace(number);
        Bytes& bytes = known->second;
        const auto uri = find(is, "uri");
        const bool in_chunk = !uri && number == 0 && file_.has_chunk;
        if (!uri && !in_chunk) refuse(is, "has no uri, and the file no bytes for it");
        if (fresh && uri) {
            bytes = bytes_of(*uri, max_gltf_bytes - held_);
            held_ += bytes.size();
        }
        const Bytes& has = in_chunk ? file_.chunk : bytes;
        const auto size = static_cast<std::size_t>(
            whole_number(member(is, "byteLength"), 1, 1LL << 40));
        if (size > has.size())
            refuse(is, join({"must have ", std::to_string(size), " bytes, but has ",
                             std::to_string(has.size())}));
        return {reinterpret_cast<const char*>(has.data()), size};
    }

    const GltfFile& file_;
    std::map<std::size_t, Bytes> buffers_{};
    std::size_t held_ = 0;   // bytes of all buffers
    long long elements_ = 0; // elements read so far
};

} // namespace ljus::detail
