#pragma once

/// \file ljus/io/detail/gltf_reader.hpp
/// \brief Reads the meshes, cameras and lights of the nodes of a glTF scene.

#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "ljus/image/color.hpp"
#include "ljus/io/detail/gltf_data.hpp"
#include "ljus/io/detail/mesh_builder.hpp"
#include "ljus/io/detail/mesh_pictures.hpp"

namespace ljus::detail {

// The largest number of triangles; a mesh counts once for each node that places it.
inline constexpr long long max_gltf_triangles = 1LL << 23;

// The largest number of primitives, counted in the same way.
inline constexpr long long max_gltf_primitives = 1LL << 20;

// A roughness from a picture is rounded to a multiple of 1 over this number.
inline constexpr int roughness_steps = 8;

template <std::floating_point T>
class GltfReader {
public:
    GltfReader(const GltfFile& file, const MeshFileSettings& settings)
        : file_(file), data_(file), settings_(settings), mesh_(settings) {
        mesh_.report.unit = "triangle";
    }

    std::vector<MeshFacesT<T>> take_faces(LoadedMeshT<T>& loaded) {
        loaded_ = &loaded;
        check_kind();
        for (const std::size_t root : roots()) read_tree(root);
        std::vector<const MeshMaterial*> known{nullptr};
        for (const auto& [key, made] : materials_) {
            known.resize(std::max(known.size(), std::size_t(made.number) + 1));
            known[made.number] = &made.material;
        }
        std::vector<MeshFacesT<T>> parts = mesh_.take_faces(known);
        if (!parts.empty()) note_unused(); // which is not why there are no faces
        for (MeshFacesT<T>& part : parts)
            if (part.material.name.empty() && !part.colors.empty())
                part.material.diffuse = glm::dvec3(1);
        loaded.report = std::move(mesh_.report);
        return parts;
    }

    // The bytes of the picture of this name.
    Bytes picture(const std::string& name) {
        const auto known = pictures_.find(name);
        if (known == pictures_.end())
            refuse_file(name, "it has no source, or one that is not known: export the "
                              "file again with pictures in PNG or JPEG");
        const JsonField is = entry(member(file_.root(), "images"), known->second);
        if (const auto uri = find(is, "uri"))
            return data_.bytes_of(*uri, max_image_file);
        const std::string_view bytes = data_.view(member(is, "bufferView"));
        return {bytes.begin(), bytes.end()};
    }

private:
    // A material of the file, with the metal and the roughness that its picture gives.
    using Key = std::tuple<std::size_t, bool, int>;
    struct Made {
        std::uint32_t number;
        MeshMaterial material;
    };
    // The material of the triangles of a primitive.
    struct Surface {
        std::optional<JsonField> material{};
        std::size_t number = 0;
        double metal = 1, roughness = 1;
        const ImageT<T>* picture = nullptr; // of metal and roughness
        std::vector<double> uv{};           // uv for it
    };

    // Adds a note about a part of the file to the report. The number of notes is
    // limited, because finding the path of a part takes a search of the whole file.
    void note(const JsonField& field, std::string_view what) {
        constexpr std::size_t most = 100;
        std::vector<std::string>& notes = mesh_.report.notes;
        if (notes.size() == most) notes.push_back("further remarks are left out.");
        if (notes.size() > most) return;
        const auto name = find(field, "name");
        const bool named = name && name->value.is_string();
        what.remove_suffix(what.ends_with('.') ? 1 : 0); // of an error's sentence
        notes.push_back(
            join({path_of(field), named ? " (" + shown(text(*name)) + ") " : " ", what,
                  "."}));
    }

    // Refuses an unknown extension, and says how to export the file without it.
    void require_known(const JsonField& required, JsonNames known) {
        const std::string& name = text(required);
        if (is_one_of(name, known)) return;
        const auto has = [&](const char* word) { return name.find(word) != name.npos; };
        refuse(required,
               join({"is ", shown(name), ", which is not known: export the file again ",
                     has("_compression") ? "without compression of its meshes"
                     : has("_texture_")  ? "with pictures in PNG or JPEG"
                                         : "without it"}));
    }
    void check_kind() {
        const JsonField version = member(member(file_.root(), "asset"), "version");
        if (!text(version).starts_with("2."))
            refuse_value(version, "2.0, the version of glTF that is known");
        static constexpr std::string_view known[]{
            "KHR_lights_punctual",        "KHR_materials_emissive_strength",
            "KHR_materials_ior",          "KHR_materials_pbrSpecularGlossiness",
            "KHR_materials_transmission", "KHR_materials_unlit",
            "KHR_mesh_quantization",      "KHR_texture_transform"};
        const auto least = find(member(file_.root(), "asset"), "minVersion");
        if (least && text(*least) != "2.0")
            refuse_value(*least, "2.0, the version of glTF that is known");
        const auto is_choice = [](const std::string& name) {
            return name == "KHR_materials_variants"; // a mesh has its first material
        };
        for (const JsonField& name : entries(find(file_.root(), "extensionsRequired")))
            if (!is_choice(text(name))) require_known(name, known);
        // read_material() notes the extensions of materials.
        for (const JsonField& name : entries(find(file_.root(), "extensionsUsed")))
            if (is_choice(text(name)) || (!text(name).starts_with("KHR_materials_") &&
                                          !is_one_of(text(name), known)))
                note(name, join({"is ", shown(text(name)),
                                 ", which is not known: what it adds is left out"}));
    }

    // The top nodes of the scene; without scenes, the nodes that are no children.
    std::vector<std::size_t> roots() const {
        const JsonField root = file_.root();
        const auto scenes = find(root, "scenes");
        if (scenes && list_size(*scenes) > 0) {
            const auto which = find(root, "scene");
            return nodes_of(which ? file_.named(*which, "scenes") : entry(*scenes, 0),
                            "nodes");
        }
        const std::vector<JsonField> nodes = entries(find(root, "nodes"));
        std::set<std::size_t> inner;
        for (const JsonField& node : nodes)
            for (const std::size_t child : nodes_of(node, "children"))
                inner.insert(child);
        std::vector<std::size_t> found;
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (!inner.contains(i)) found.push_back(i);
        return found;
    }
    // The indices of the nodes that a list of `parent` names.
    std::vector<std::size_t> nodes_of(const JsonField& parent, const char* list) const {
        std::vector<std::size_t> found;
        for (const JsonField& number : entries(find(parent, list)))
            found.push_back(file_.number_in(number, "nodes"));
        return found;
    }
    // Reads a node and all nodes below it, without recursion.
    void read_tree(std::size_t root) {
        std::vector<std::pair<std::size_t, glm::dmat4>> open{{root, glm::dmat4(1)}};
        while (!open.empty()) {
            const auto [number, above] = open.back();
            open.pop_back();
            const JsonField node = entry(member(file_.root(), "nodes"), number);
            if (!seen_.insert(number).second)
                refuse(node, "is below two nodes, or below itself");
            const glm::dmat4 place = above * matrix_of(node);
            read_node(node, place);
            const std::vector<std::size_t> below = nodes_of(node, "children");
            for (std::size_t i = below.size(); i > 0; --i)
                open.push_back({below[i - 1], place});
        }
    }

    static std::vector<double> list_of(const JsonField& field, std::size_t count) {
        if (list_size(field) != count)
            refuse_value(field,
                         join({"a list of ", std::to_string(count), " numbers"}));
        std::vector<double> values;
        for (std::size_t i = 0; i < count; ++i)
            values.push_back(number(entry(field, i), -1e30, 1e30, "within 1e30"));
        return values;
    }
    static glm::dvec3 vector_of(const JsonField& field, const char* name,
                                const glm::dvec3& otherwise) {
        const auto found = find(field, name);
        if (!found) return otherwise;
        const std::vector<double> v = list_of(*found, 3);
        return {v[0], v[1], v[2]};
    }
    static double number_of(const JsonField& field, const char* name, double otherwise,
                            double low, double high) {
        const auto found = find(field, name);
        return found
                   ? number(*found, low, high,
                            join({"within [", to_text(low), ", ", to_text(high), "]"}))
                   : otherwise;
    }
    static glm::dmat4 matrix_of(const JsonField& node) {
        glm::dmat4 matrix(1);
        if (const auto field = find(node, "matrix")) {
            const std::vector<double> all = list_of(*field, 16);
            for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = all[std::size_t(i)];
            for (int i = 0; i < 4; ++i) // rounded by some programs
                if (const double last = i == 3 ? 1 : 0;
                    std::abs(std::exchange(matrix[i][3], last) - last) > 1e-5)
                    refuse_value(*field, "a matrix whose last row, every fourth "
                                         "number, is 0, 0, 0, 1");
            return matrix;
        }
        if (const auto field = find(node, "rotation")) {
            const std::vector<double> q = list_of(*field, 4);
            const double length = glm::length(glm::dvec4(q[0], q[1], q[2], q[3]));
            if (!(length > 0)) refuse_value(*field, "a quaternion that is not 0");
            const glm::dvec3 axis = glm::dvec3(q[0], q[1], q[2]) / length;
            for (int i = 0; i < 3; ++i) {
                glm::dvec3 unit(0); // rotation of v: v + 2 w (a x v) + 2 a x (a x v)
                unit[i] = 1;
                const glm::dvec3 twice = 2.0 * glm::cross(axis, unit);
                matrix[i] = {unit + q[3] / length * twice + glm::cross(axis, twice), 0};
            }
        }
        const glm::dvec3 scale = vector_of(node, "scale", glm::dvec3(1));
        for (int i = 0; i < 3; ++i) matrix[i] *= scale[i];
        matrix[3] = {vector_of(node, "translation", glm::dvec3(0)), 1};
        return matrix;
    }

    void read_node(const JsonField& node, const glm::dmat4& place) {
        if (const auto mesh = find(node, "mesh")) {
            const JsonField is = file_.named(*mesh, "meshes");
            ++mesh_.report.content.objects;
            if (find(node, "skin")) ++skins_;
            for (const JsonField& primitive : entries(member(is, "primitives")))
                read_primitive(primitive, place);
        }
        if (const auto camera = find(node, "camera"))
            read_camera(file_.named(*camera, "cameras"), place);
        if (const auto all = find(node, "extensions"))
            if (const auto has = find(*all, "KHR_lights_punctual"))
                read_light(member(*has, "light"), place);
    }

    void read_primitive(const JsonField& field, const glm::dmat4& place) {
        if (++mesh_.report.content.groups > max_gltf_primitives)
            refuse(field, join({"is one too many: nodes must place at most ",
                                to_text(max_gltf_primitives), " primitives"}));
        if (find(field, "targets")) ++morphs_;
        const auto mode_field = find(field, "mode");
        const long long mode = mode_field ? whole_number(*mode_field, 0, 6) : 4;
        if (mode < 4) return mesh_.report.add(MeshTrouble::no_face, triangles_ + 1);
        const JsonField attributes = member(field, "attributes");
        if (!find(attributes, "POSITION"))
            return note(field, "has no POSITION; it is left out");
        // A file that offers uncompressed data as well has accessors with a bufferView.
        if (const auto all = find(field, "extensions");
            all && find(*all, "KHR_draco_mesh_compression") &&
            !find(file_.named(member(attributes, "POSITION"), "accessors"),
                  "bufferView"))
            refuse(field, "is compressed by KHR_draco_mesh_compression, which is not "
                          "known: export the file again without it");
        const auto base = mesh_.counts();
        mesh_.place = triangles_ + 1;
        const std::size_t vertices = add_vertices(attributes, place);
        const Surface surface = surface_of(field, attributes, vertices);
        if (find(attributes, "TANGENT") && surface.material &&
            find(*surface.material, "normalTexture"))
            ++tangents_;
        const bool uv = mesh_.counts()[1] > base[1];
        const bool normals = mesh_.counts()[2] > base[2];

        std::vector<double> corners;
        if (const auto indices = find(field, "indices")) {
            std::size_t size = 0;
            corners = data_.numbers(*indices, {"SCALAR"}, size);
        }
        const std::size_t count = corners.empty() ? vertices : corners.size();
        const std::size_t faces =
            mode == 4 ? count / 3 : count - std::min(count, std::size_t(2));
        if (mode == 4 && count % 3 != 0)
            note(field, join({"has ", std::to_string(count),
                              " corners of triangles; the last ",
                              std::to_string(count % 3), " are left out"}));
        triangles_ += static_cast<long long>(faces);
        if (triangles_ > max_gltf_triangles)
            refuse(field, join({"is one too many: the file must have at most ",
                                to_text(max_gltf_triangles), " triangles"}));
        const bool turned = glm::determinant(glm::dmat3(place)) < 0;
        for (std::size_t i = 0; i < faces; ++i) {
            std::array<std::size_t, 3> at{3 * i, 3 * i + 1, 3 * i + 2};
            if (mode == 5) at = {i, i + 1 + i % 2, i + 2 - i % 2};
            if (mode == 6) at = {i + 1, i + 2, 0};
            if (turned) std::swap(at[1], at[2]);
            std::array<std::size_t, 3> vertex{};
            for (std::size_t k = 0; k < 3; ++k) {
                const double number = corners.empty() ? double(at[k]) : corners[at[k]];
                vertex[k] = number < double(vertices) && number >= 0
                                ? static_cast<std::size_t>(number)
                                : vertices;
            }
            mesh_.material = material_at(surface, vertex);
            for (const std::size_t v : vertex) {
                const auto from = [&](std::size_t list, bool has) {
                    return has && v < vertices
                               ? static_cast<std::uint32_t>(base[list] + v)
                               : no_number;
                };
                mesh_.add_corner(from(0, true), from(1, uv), from(2, normals));
            }
            mesh_.end_face();
            ++mesh_.place;
        }
    }
    // Adds positions, normals and colours; returns the number of vertices.
    std::size_t add_vertices(const JsonField& attributes, const glm::dmat4& place) {
        std::size_t size = 0;
        const auto colors = find(attributes, "COLOR_0");
        const std::vector<double> at =
            data_.numbers(member(attributes, "POSITION"), {"VEC3"}, size);
        const std::size_t count = at.size() / 3;
        std::vector<double> color;
        std::size_t channels = 3;
        if (colors) color = attribute(*colors, {"VEC3", "VEC4"}, count, channels);
        for (std::size_t i = 0; i < count; ++i) {
            const glm::dvec4 p{at[3 * i], at[3 * i + 1], at[3 * i + 2], 1};
            mesh_.add_position(glm::dvec3(place * p));
            if (!color.empty())
                mesh_.add_color({color[channels * i], color[channels * i + 1],
                                 color[channels * i + 2]});
        }
        if (const auto normals = find(attributes, "NORMAL")) {
            const std::vector<double> n = attribute(*normals, {"VEC3"}, count, size);
            // The inverse transpose times |determinant| exists even for a scale of 0.
            const glm::dmat3 m(place);
            const double side = glm::determinant(m) < 0 ? -1 : 1;
            const glm::dmat3 turn(side * glm::cross(m[1], m[2]),
                                  side * glm::cross(m[2], m[0]),
                                  side * glm::cross(m[0], m[1]));
            for (std::size_t i = 0; i < count; ++i)
                mesh_.add_normal(turn *
                                 glm::dvec3{n[3 * i], n[3 * i + 1], n[3 * i + 2]});
        }
        return count;
    }
    std::vector<double> attribute(const JsonField& field,
                                  std::initializer_list<std::string_view> types,
                                  std::size_t count, std::size_t& size) {
        std::vector<double> values = data_.numbers(field, types, size);
        if (values.size() / size != count)
            refuse(field, join({"has ", std::to_string(values.size() / size),
                                " elements, but there are ", std::to_string(count),
                                " positions"}));
        return values;
    }

    // The texture coordinates that a texture uses.
    std::vector<double> uv_of(const JsonField& texture, const JsonField& attributes,
                              std::size_t count) {
        const auto set = find(texture, "texCoord");
        const std::string name =
            "TEXCOORD_" + std::to_string(set ? whole_number(*set, 0, 31) : 0);
        std::size_t size = 0;
        const auto found = find(attributes, name);
        return found ? attribute(*found, {"VEC2"}, count, size) : std::vector<double>{};
    }
    Surface surface_of(const JsonField& primitive, const JsonField& attributes,
                       std::size_t count) {
        Surface surface;
        const auto field = find(primitive, "material");
        if (field) {
            surface.number = file_.number_in(*field, "materials");
            surface.material.emplace(file_.named(*field, "materials"));
            if (specular_glossiness(*surface.material)) {
                surface.metal = 0;
            } else if (const auto pbr =
                           find(*surface.material, "pbrMetallicRoughness")) {
                surface.metal = number_of(*pbr, "metallicFactor", 1, 0, 1);
                surface.roughness = number_of(*pbr, "roughnessFactor", 1, 0, 1);
                const auto texture = find(*pbr, "metallicRoughnessTexture");
                if (texture && settings_.pictures) {
                    surface.uv = uv_of(*texture, attributes, count);
                    if (!surface.uv.empty()) surface.picture = metal_picture(*texture);
                }
            }
        }
        const auto colors = field ? color_texture(*surface.material) : std::nullopt;
        // Without a picture the first set is kept, for pictures that a user may add.
        const std::vector<double> uv =
            uv_of(colors ? *colors : primitive, attributes, count);
        for (std::size_t i = 0; i < uv.size() / 2; ++i)
            mesh_.add_uv(uv[2 * i], 1 - uv[2 * i + 1]);
        return surface;
    }
    // The name of a texture's picture; that of the texture if it has none.
    std::string picture_of(const JsonField& texture) {
        const JsonField is = file_.named(member(texture, "index"), "textures");
        const auto source = find(is, "source");
        if (!source) return join({file_.name, ", ", path_of(is)});
        const std::size_t number = file_.number_in(*source, "images");
        const JsonField image = file_.named(*source, "images");
        const auto uri = find(image, "uri");
        std::string name =
            uri && !text(*uri).starts_with("data:")
                ? path_beside(file_.name, decoded(text(*uri)))
                : file_.name + ", images[" + std::to_string(number) + "]";
        pictures_.try_emplace(name, number);
        return name;
    }
    // Reads how a texture is looked up: its sampler, and its KHR_texture_transform,
    // where v increases downwards. Returns false if a part of them is ignored.
    bool read_lookup(const JsonField& texture, MeshMaterial& to) {
        bool whole = true;
        const JsonField is = file_.named(member(texture, "index"), "textures");
        if (const auto number = find(is, "sampler")) {
            const JsonField sampler = file_.named(*number, "samplers");
            constexpr int nearest = 9728, repeat = 10497;
            constexpr std::pair<int, PictureWrap> wraps[]{{repeat, PictureWrap::repeat},
                                                          {33071, PictureWrap::clamp},
                                                          {33648, PictureWrap::mirror}};
            const auto is_kind = [&](const char* name, int kind) {
                const auto found = find(sampler, name);
                return found ? found->value == kind : kind == repeat;
            };
            if (is_kind("magFilter", nearest)) to.filter = PictureFilter::nearest;
            whole = false;
            for (const auto& [kind, wrap] : wraps)
                if (is_kind("wrapS", kind) && is_kind("wrapT", kind)) {
                    to.wrap = wrap;
                    whole = true;
                }
        }
        const auto extensions = find(texture, "extensions");
        if (!extensions) return whole;
        const auto transform = find(*extensions, "KHR_texture_transform");
        if (!transform) return false;
        const auto pair = [&](const char* name, double otherwise) {
            const auto found = find(*transform, name);
            if (!found) return glm::dvec2(otherwise);
            const std::vector<double> v = list_of(*found, 2);
            return glm::dvec2(v[0], v[1]);
        };
        const glm::dvec2 scale = pair("scale", 1), offset = pair("offset", 0);
        const double angle = number_of(*transform, "rotation", 0, -1e6, 1e6);
        if (!(std::isnormal(scale.x) && std::isnormal(scale.y))) return false;
        const glm::dvec2 turn(std::cos(angle), std::sin(angle));
        to.map = {
            .scale = scale,
            .turn = turn,
            .offset{offset.x + turn.y * scale.y, 1 - turn.x * scale.y - offset.y}};
        return whole && !find(*transform, "texCoord");
    }
    // Reads the normal map and the holes of a material, after its base colour.
    void read_details(const JsonField& field, double alpha, MeshMaterial& material,
                      std::vector<std::string>& unused) {
        const auto texture = find(field, "normalTexture");
        const auto colors = color_texture(field);
        if (texture) {
            MeshMaterial lookup;
            const bool whole = read_lookup(*texture, lookup);
            if (!colors) {
                material.map = lookup.map;
                material.wrap = lookup.wrap;
                material.filter = lookup.filter;
            }
            const auto set = [](const std::optional<JsonField>& of) {
                const auto found = of ? find(*of, "texCoord") : std::nullopt;
                return found ? whole_number(*found, 0, 31) : 0;
            };
            if (set(colors) != set(texture) || !whole ||
                lookup.map.scale != material.map.scale ||
                lookup.map.turn != material.map.turn ||
                lookup.map.offset != material.map.offset ||
                lookup.wrap != material.wrap)
                unused.push_back("a normalTexture that lies otherwise");
            else
                material.normals = {picture_of(*texture), "a normalTexture"};
            if (number_of(*texture, "scale", 1, -1e6, 1e6) != 1)
                unused.push_back("scale of normalTexture");
        }
        const auto mode = find(field, "alphaMode");
        if (mode && text(*mode) == "MASK" && colors && alpha > 0) {
            material.mask = material.picture;
            material.cutoff = number_of(field, "alphaCutoff", 0.5, 0, 1e6) / alpha;
        } else if (mode && text(*mode) != "OPAQUE") {
            unused.push_back("alphaMode " + shown(text(*mode)));
        }
        if (material.emission != glm::dvec3(0) &&
            !(material.mask.name.empty() && material.normals.name.empty()))
            unused.push_back("holes and normals of what glows");
    }
    // The picture of metal (blue) and roughness (green); nullptr if it cannot be read.
    const ImageT<T>* metal_picture(const JsonField& texture) {
        const std::string name = picture_of(texture);
        const auto [known, fresh] = metal_pictures_.try_emplace(name);
        if (fresh) {
            try {
                known->second = decode_image<T>(picture(name), name, metal_pixels_);
                metal_pixels_ += static_cast<long long>(known->second.pixels.size());
            } catch (const std::runtime_error& wrong) {
                mesh_.report.notes.push_back(wrong.what());
            }
        }
        return known->second.pixels.empty() ? nullptr : &known->second;
    }
    // The number of the material of a triangle, by the corners of the triangle.
    std::uint32_t material_at(const Surface& surface,
                              const std::array<std::size_t, 3>& vertex) {
        if (!surface.material) return 0;
        double metal = surface.metal, roughness = surface.roughness;
        int step = -1;
        if (surface.picture != nullptr) {
            glm::dvec2 uv(0);
            for (const std::size_t v : vertex)
                if (2 * v + 1 < surface.uv.size())
                    uv += glm::dvec2(surface.uv[2 * v], surface.uv[2 * v + 1]) / 3.0;
            const RgbT<T> is = nearest(*surface.picture, uv);
            metal *= srgb_encode(double(is.z));
            step = static_cast<int>(
                std::lround(roughness * srgb_encode(double(is.y)) * roughness_steps));
            roughness = double(step) / roughness_steps;
        }
        const bool is_metal = metal >= 0.5;
        const Key key{surface.number, is_metal, is_metal ? step : -1};
        const auto known = materials_.find(key);
        if (known != materials_.end()) return known->second.number;
        const auto number = static_cast<std::uint32_t>(materials_.size() + 1);
        MeshMaterial material = read_material(*surface.material);
        if (material.name.empty())
            material.name = "materials[" + std::to_string(surface.number) + "]";
        if (is_metal) {
            material.illumination = 3;
            material.specular = material.diffuse;
            material.roughness = roughness < 0.01 ? 0 : roughness;
        } else if (std::exchange(gloss_noted_, true) == false) {
            mesh_.report.notes.push_back(
                "the gloss over the colour of what is no metal is left out.");
        }
        materials_.emplace(key, Made{number, std::move(material)});
        return number;
    }
    static RgbT<T> nearest(const ImageT<T>& image, const glm::dvec2& uv) {
        const auto at = [](double x, int size) {
            const double rest = x - std::floor(x); // NaN becomes 0
            return rest > 0 ? std::min(static_cast<int>(rest * size), size - 1) : 0;
        };
        return pixel(image, at(uv.x, image.width), at(uv.y, image.height));
    }

    // The name of a part of the file; empty if it has none.
    [[nodiscard]] static std::string name_of(const JsonField& field) {
        const auto name = find(field, "name");
        return name ? text(*name) : std::string();
    }

    // An older extension that stands in place of pbrMetallicRoughness.
    static std::optional<JsonField> specular_glossiness(const JsonField& material) {
        const auto all = find(material, "extensions");
        if (!all) return {};
        return find(*all, "KHR_materials_pbrSpecularGlossiness");
    }
    static std::optional<JsonField> color_texture(const JsonField& material) {
        if (const auto gloss = specular_glossiness(material))
            return find(*gloss, "diffuseTexture");
        const auto pbr = find(material, "pbrMetallicRoughness");
        return pbr ? find(*pbr, "baseColorTexture") : std::nullopt;
    }

    MeshMaterial read_material(const JsonField& field) {
        MeshMaterial material;
        material.diffuse = glm::dvec3(1);
        material.name = shown(name_of(field));
        std::vector<std::string> unused;
        double alpha = 1;
        const auto gloss = specular_glossiness(field);
        if (const auto pbr = gloss ? gloss : find(field, "pbrMetallicRoughness")) {
            if (const auto color =
                    find(*pbr, gloss ? "diffuseFactor" : "baseColorFactor")) {
                const std::vector<double> c = list_of(*color, 4);
                material.diffuse = glm::clamp(glm::dvec3{c[0], c[1], c[2]},
                                              glm::dvec3(0), glm::dvec3(1));
                alpha = c[3];
            }
            if (const auto texture = color_texture(field)) {
                const std::string name = gloss ? "diffuseTexture" : "baseColorTexture";
                material.picture = {picture_of(*texture), "a " + name};
                if (!read_lookup(*texture, material))
                    unused.push_back("a part of how " + name + " lies");
            }
            const double metal = number_of(*pbr, "metallicFactor", 1, 0, 1);
            if (metal > 0 && metal < 1)
                unused.push_back("a metallicFactor between 0 and 1");
            if (find(*pbr, "metallicRoughnessTexture"))
                unused.push_back("metallicRoughnessTexture within a triangle");
        }
        material.emission =
            glm::clamp(vector_of(field, "emissiveFactor", glm::dvec3(0)), 0.0, 1e12);
        for (const char* name : {"occlusionTexture", "emissiveTexture"})
            if (find(field, name)) unused.push_back(name);
        if (find(field, "emissiveTexture")) material.emission = glm::dvec3(0);
        read_details(field, alpha, material, unused);
        if (const auto all = find(field, "extensions"))
            read_extensions(*all, material, unused);
        if (!unused.empty() && noted_.insert(&field.value).second)
            note(field, join({"has what is not used: ", in_a_row(unused, "and")}));
        return material;
    }
    void read_extensions(const JsonField& all, MeshMaterial& material,
                         std::vector<std::string>& unused) {
        for (auto part = all.value.begin();
             all.value.is_object() && part != all.value.end(); ++part) {
            const JsonField is{*part, all.file, all.root};
            if (part.key() == "KHR_materials_emissive_strength") {
                material.emission = glm::min(
                    material.emission * number_of(is, "emissiveStrength", 1, 0, 1e12),
                    1e12);
            } else if (part.key() == "KHR_materials_ior") {
                material.index = std::max(number_of(is, "ior", 1.5, 0, 1e3), 1e-3);
            } else if (part.key() == "KHR_materials_transmission") {
                material.dissolve = 1 - number_of(is, "transmissionFactor", 0, 0, 1);
                if (material.is_glass())
                    unused.push_back("colour and roughness of glass");
                else if (material.dissolve < 1)
                    unused.push_back("a transmissionFactor of at most 0.5");
            } else if (part.key() == "KHR_materials_pbrSpecularGlossiness") {
                unused.push_back("specular colours and glossiness");
            } else if (part.key() == "KHR_materials_unlit") {
                unused.push_back("KHR_materials_unlit (matt: it needs light)");
            } else {
                unused.push_back(part.key());
            }
        }
    }

    void read_camera(const JsonField& field, const glm::dmat4& place) {
        const auto lens = find(field, "perspective");
        if (!lens) return note(field, "is no perspective camera; it is left out");
        const Vec3T<T> at(settings_.scale * glm::dvec3(place[3]));
        const double angle =
            number(member(*lens, "yfov"), 1e-5, 3.14, "within [1e-5, 3.14] radians");
        try {
            loaded_->cameras.push_back(
                {shown(name_of(field)),
                 look_at(ViewT<T>{
                     .position = at,
                     .target = at - Vec3T<T>(glm::normalize(glm::dvec3(place[2]))),
                     .up{glm::dvec3(place[1])},
                     .vfov_degrees = T(angle * 180 / std::numbers::pi)})});
        } catch (const std::invalid_argument& wrong) {
            note(field, join({"is left out: ", wrong.what()}));
        }
    }
    void read_light(const JsonField& number_field, const glm::dmat4& place) {
        const JsonField all =
            member(member(member(file_.root(), "extensions"), "KHR_lights_punctual"),
                   "lights");
        const JsonField field =
            entry(all, index_in(number_field, list_size(all), "lights"));
        const JsonField type = member(field, "type");
        static constexpr std::string_view known[]{"point", "spot", "directional"};
        require_one_of(type, known);
        if (find(field, "range")) note(field, "has a range, which is not used");
        const glm::dvec3 light =
            glm::clamp(vector_of(field, "color", glm::dvec3(1)), 0.0, 1e12) *
            number_of(field, "intensity", 1, 0, 1e12);
        const double scale = settings_.scale;
        const RgbT<T> intensity(scale * scale * light); // because distances scale too
        const Vec3T<T> at(scale * glm::dvec3(place[3]));
        const Vec3T<T> way(-glm::normalize(glm::dvec3(place[2])));
        const auto add = [&](auto made, auto& list) {
            try {
                check(made);
                list.push_back(made);
            } catch (const std::invalid_argument& wrong) {
                note(field, join({"is left out: ", wrong.what()}));
            }
        };
        if (text(type) == "point")
            return add(PointLightT<T>{at, intensity}, loaded_->points);
        if (text(type) == "directional")
            return add(SunLightT<T>{way, RgbT<T>(light)}, loaded_->suns);
        const auto cone = find(field, "spot");
        constexpr double degrees = 180 / std::numbers::pi;
        const double inner = cone ? number_of(*cone, "innerConeAngle", 0, 0, 1.571) : 0;
        const double outer =
            cone ? number_of(*cone, "outerConeAngle", 0.785398, 0, 1.571) : 0.785398;
        add(SpotLightT<T>{at, way, intensity, T(inner * degrees), T(outer * degrees)},
            loaded_->spots);
    }

    void note_unused() {
        const auto tell = [&](long long count, std::string_view what) {
            if (count > 0)
                mesh_.report.notes.push_back(join({to_text(count), " ", what, "."}));
        };
        tell(static_cast<long long>(entries(find(file_.root(), "animations")).size()),
             "animations are not used");
        tell(skins_, "nodes have skins, which are not used: their meshes stand as they "
                     "were modelled");
        tell(morphs_, "primitives have morph targets, which are not used");
        tell(tangents_, "primitives have TANGENT, which is not used: a normal map lies "
                        "along the texture coordinates of each triangle");
    }

    const GltfFile& file_;
    GltfData data_;
    const MeshFileSettings& settings_;
    MeshBuilder<T> mesh_;
    LoadedMeshT<T>* loaded_ = nullptr; // takes cameras and lights
    std::set<std::size_t> seen_{};     // nodes
    std::map<Key, Made> materials_{};
    std::set<const void*> noted_{};                     // materials
    std::map<std::string, std::size_t> pictures_{};     // numbers of images by name
    std::map<std::string, ImageT<T>> metal_pictures_{}; // by name
    long long metal_pixels_ = 0;
    long long triangles_ = 0, skins_ = 0, morphs_ = 0, tangents_ = 0;
    bool gloss_noted_ = false;
};

} // namespace ljus::detail
