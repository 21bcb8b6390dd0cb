#pragma once

/// \file tests/support/mesh_bytes.hpp
/// \brief Writes meshes as bytes in the formats PLY and STL.

#include <bit>
#include <string>

#include "ljus/accel/mesh_data.hpp"
#include "ljus/io/file.hpp"
#include "ljus/math/require.hpp"

namespace ljus_test {

using ljus::Bytes;
using ljus::MeshData;

/// Appends the lowest `size` bytes of a number, lowest byte first or, with `big`, last.
inline void add_number(Bytes& bytes, std::uint64_t bits, int size, bool big = false) {
    for (int i = 0; i < size; ++i)
        bytes.push_back(
            static_cast<unsigned char>(bits >> 8 * (big ? size - 1 - i : i)));
}
inline void add_float(Bytes& bytes, float value, bool big = false) {
    add_number(bytes, std::bit_cast<std::uint32_t>(value), 4, big);
}
inline Bytes text_bytes(const std::string& text) {
    return {text.begin(), text.end()};
}
inline std::string text_of(const Bytes& bytes) {
    return {bytes.begin(), bytes.end()};
}

inline std::string text_of(const ljus::Vec3& v) {
    return ljus::to_text(v.x) + " " + ljus::to_text(v.y) + " " + ljus::to_text(v.z);
}

/// The bytes of a PLY file, in ascii or in binary of either byte order. It has normals
/// if the mesh has some.
inline Bytes ply_bytes(const MeshData& data, const std::string& format) {
    const bool text = format == "ascii", big = format == "binary_big_endian";
    std::string head = "ply\nformat " + format +
                       " 1.0\ncomment a mesh\nelement vertex " +
                       std::to_string(data.positions.size()) +
                       "\nproperty float x\nproperty float y\nproperty float z\n";
    if (!data.normals.empty())
        head += "property float nx\nproperty float ny\nproperty float nz\n";
    Bytes bytes =
        text_bytes(head + "element face " + std::to_string(data.triangles.size()) +
                   "\nproperty list uchar int vertex_indices\nend_header\n");
    const auto add = [&](const ljus::Vec3& v) {
        for (int k = 0; k < 3; ++k) add_float(bytes, v[k], big);
    };
    const auto add_text = [&](const std::string& more) {
        bytes.insert(bytes.end(), more.begin(), more.end());
    };
    for (std::size_t i = 0; i < data.positions.size(); ++i) {
        if (text) {
            add_text(text_of(data.positions[i]) +
                     (data.normals.empty() ? "" : " " + text_of(data.normals[i])) +
                     "\n");
            continue;
        }
        add(data.positions[i]);
        if (!data.normals.empty()) add(data.normals[i]);
    }
    for (const auto& [a, b, c] : data.triangles) {
        if (text) {
            add_text("3 " + std::to_string(a) + " " + std::to_string(b) + " " +
                     std::to_string(c) + "\n");
            continue;
        }
        bytes.push_back(3);
        for (const std::uint32_t corner : {a, b, c}) add_number(bytes, corner, 4, big);
    }
    return bytes;
}

/// The bytes of an STL file, as text or in binary with a header of 80 bytes.
inline Bytes stl_bytes(const MeshData& data, bool text, std::string head = "") {
    head.resize(80, ' ');
    Bytes bytes = text_bytes(head);
    add_number(bytes, data.triangles.size(), 4);
    std::string lines = "solid a mesh\n";
    for (const auto& triangle : data.triangles) {
        lines += "facet normal 0 0 0\n outer loop\n";
        bytes.insert(bytes.end(), 12, 0);
        for (const std::uint32_t corner : triangle) {
            lines += "  vertex " + text_of(data.positions[corner]) + "\n";
            for (int k = 0; k < 3; ++k) add_float(bytes, data.positions[corner][k]);
        }
        lines += " endloop\nendfacet\n";
        add_number(bytes, 0, 2);
    }
    return text ? text_bytes(lines + "endsolid\n") : bytes;
}

/// The area of all triangles together.
inline double area_of(const MeshData& data) {
    double sum = 0;
    for (const auto& [a, b, c] : data.triangles) {
        const glm::dvec3 from(data.positions[a]);
        sum += glm::length(glm::cross(glm::dvec3(data.positions[b]) - from,
                                      glm::dvec3(data.positions[c]) - from)) /
               2;
    }
    return sum;
}

/// The message with which a call refuses its argument; "nothing" if the call succeeds.
template <typename Call>
std::string refusal_of(Call call) {
    try {
        (void)call();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "nothing";
}

} // namespace ljus_test
