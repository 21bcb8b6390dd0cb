#pragma once

/// \file ljus/io/detail/json_objects.hpp
/// \brief The objects of scene files.

#include <algorithm>
#include <map>

#include <nlohmann/json.hpp>

#include "ljus/accel/instances.hpp"
#include "ljus/geometry/cylinder.hpp"
#include "ljus/geometry/detail/pair_triangles.hpp"
#include "ljus/geometry/disc.hpp"
#include "ljus/geometry/moving.hpp"
#include "ljus/geometry/placement.hpp"
#include "ljus/io/detail/json_lights.hpp"
#include "ljus/io/detail/json_materials.hpp"
#include "ljus/io/detail/json_members.hpp"
#include "ljus/lights/environment.hpp"
#include "ljus/lights/goniometric_light.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/lights/spot_light.hpp"
#include "ljus/lights/sun_light.hpp"
#include "ljus/scene/scene.hpp"

namespace ljus::detail {

template <std::floating_point T>
using FileSceneT = Scene<
    Shapes<QuadT<T>, SphereT<T>, TriangleT<T>, MeshT<T>, InstanceT<T>, DiscT<T>,
           CylinderT<T>, Moving<QuadT<T>>, Moving<SphereT<T>>, Moving<TriangleT<T>>>,
    FileMaterialsT<T>,
    Lights<PointLightT<T>, SpotLightT<T>, SunLightT<T>, EnvironmentLightT<T>,
           GoniometricLightT<T>>,
    Media<Fog<SphereT<T>>, Fog<BoxT<T>>>>;

/// The default reader of mesh files in load_json(). It reads nothing and throws an
/// exception that names MeshFiles.
template <std::floating_point T>
struct NoMeshesT {
    [[noreturn]] LoadedMeshT<T> operator()(const std::string& file,
                                           const MeshFileSettings&) const {
        refuse_file(file, "load_json() reads no meshes unless it is given MeshFiles, "
                          "from ljus/io/load_mesh.hpp");
    }
};

inline constexpr std::string_view normals_words[]{"file", "smooth", "flat"};
inline constexpr std::string_view ends_words[]{"open", "closed"};

inline constexpr JsonMember object_shared[]{
    type_row,
    optional("name", remark_value, "for people"),
    preset("emission", light_value, 0,
           "radiance on the side of the normal, W/(m^2 sr): it is a lamp"),
    lamp_group_row,
    optional("transform", {.kind = JsonKind::object, .of = "transform"},
             "ljus::Placement; a sphere, a disc or a cylinder has one scale; not of "
             "instances, which have places"),
    optional("displacement", point_value,
             "the way that it moves while the shutter is open: ljus::Moving; not of a "
             "mesh, a disc or a cylinder")};

inline constexpr JsonMember transform_members[]{
    preset("scale", {JsonKind::scale, 1e-9, 1e9, "within [1e-9, 1e9]"}, 1,
           "first: along x, y and z, or a number for all three", "[2, 1, 1]"),
    optional("rotate", {.kind = JsonKind::object, .of = "rotate"}, "then",
             R"({"axis": [0, 1, 0], "degrees": 30})"),
    preset("translate", point_value, 0, "last", "[0, 0, 1]")};
inline constexpr JsonMember rotate_members[]{
    needed("axis", direction_value, "through the origin", "[0, 1, 0]"),
    needed("degrees", {JsonKind::number, -1e6, 1e6, "within [-1e6, 1e6] degrees"},
           "counter-clockwise as seen against the axis", "30")};

inline constexpr JsonMember material_row =
    needed("material", text_value, "a name of materials", "\"grey\"");
inline constexpr JsonMember own_material_row = optional(
    "material", text_value,
    "a name of materials; without it, or with \"file\", those of the mesh file",
    "\"grey\"");
inline constexpr JsonMember sphere_members[]{material_row, center_row, radius_row};
inline constexpr JsonMember triangles_members[]{
    material_row,
    needed("vertices", {.kind = JsonKind::list, .of = "points"}, "a list of points",
           "[[0, 0, 0], [1, 0, 0], [0, 1, 0]]"),
    needed("indices", {.kind = JsonKind::list, .of = "triples"},
           "three numbers of vertices for each triangle, from 0 on; the normal is "
           "(V2 - V1) x (V3 - V1)",
           "[[0, 1, 2]]")};
inline constexpr JsonMember file_row = needed(
    "file", text_value, "OBJ, PLY, STL or glTF, beside the scene file", "\"mesh.obj\"");
inline constexpr JsonMember factor_row =
    preset("scale", factor_value, 1, "factor of all lengths");
inline constexpr JsonMember normals_row =
    preset("normals", {.kind = JsonKind::word, .words = normals_words}, 0,
           "those of the file, computed ones, or none");
inline constexpr JsonMember mesh_members[]{own_material_row, file_row, factor_row,
                                           normals_row};
inline constexpr JsonMember instances_members[]{
    own_material_row, file_row, factor_row, normals_row,
    needed("places", {.kind = JsonKind::list, .of = "places"},
           "a list of maps, each the twelve numbers of a 3 x 4 matrix, row by row",
           "[[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]]")};
inline constexpr JsonMember quad_members[]{
    material_row, needed("corner", point_value, "one of its corners", "[0, 0, 0]"),
    needed("edge_u", direction_value, "from there to the next corner", "[1, 0, 0]"),
    needed("edge_v", direction_value, "to the other one; the normal is edge_u x edge_v",
           "[0, 1, 0]")};
inline constexpr JsonMember box_members[]{material_row, low_row, high_row};
inline constexpr JsonMember disc_members[]{
    material_row, center_row,
    needed("normal", direction_value, "towards its front", "[0, -1, 0]"), radius_row};
inline constexpr JsonMember cylinder_members[]{
    material_row, needed("base", point_value, "where its axis begins", "[0, 0, 0]"),
    needed("axis", direction_value, "from there to its other end", "[0, 2, 0]"),
    radius_row,
    preset("ends", {.kind = JsonKind::word, .words = ends_words}, 0,
           "a tube, or closed by two discs")};

inline constexpr JsonTable object_tables[]{
    {"sphere", "a ball", sphere_members},
    {"triangles", "triangles; two that form a parallelogram become a quad",
     triangles_members},
    {"mesh", "the triangles of a file: ljus::MeshFiles", mesh_members},
    {"instances", "the meshes of a file, kept once, in many places: ljus::Instance",
     instances_members},
    {"quad", "a parallelogram", quad_members},
    {"box", "six quads that face outwards", box_members},
    {"disc", "a disc", disc_members},
    {"cylinder", "a tube", cylinder_members}};

inline std::array<std::uint32_t, 3>
read_triangle(const JsonField& field, const std::vector<glm::dvec3>& points) {
    if (list_size(field) != 3) refuse_value(field, "a list of three numbers");
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
        const JsonField index = entry(field, k);
        if (points.empty()) refuse(index, "names a vertex, but there are none");
        corners[k] = static_cast<std::uint32_t>(
            whole_number(index, 0, static_cast<long long>(points.size()) - 1));
    }
    const glm::dvec3& a = points[corners[0]];
    const glm::dvec3 normal =
        glm::cross(points[corners[1]] - a, points[corners[2]] - a);
    if (!(glm::dot(normal, normal) > 0)) refuse(field, "is a triangle without an area");
    return corners;
}

inline glm::dvec3 point_of(const JsonField& field) {
    check_value(field, point_value);
    return {field.value[0].get<double>(), field.value[1].get<double>(),
            field.value[2].get<double>()};
}

template <std::floating_point T>
FlatShapesT<T> read_triangles(const JsonField& field) {
    const JsonField vertices = member(field, "vertices");
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < list_size(vertices); ++i)
        points.push_back(point_of(entry(vertices, i)));

    const JsonField indices = member(field, "indices");
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i < list_size(indices); ++i)
        triangles.push_back(read_triangle(entry(indices, i), points));
    return pair_triangles<T>(points, triangles);
}

/// Limits for mesh files that a scene names several times. A file is read again only
/// for another scale, other normals or other materials: at most 16 times for meshes,
/// and 16 times for instances. Otherwise its meshes are copied; all copies in a scene
/// have at most 2^22 triangles together.
inline constexpr std::size_t max_mesh_readings = 16, max_copied_triangles = 1 << 22;

/// The largest number of triangles of all instances together. The area of a stretched
/// instance is computed as a sum over its triangles.
inline constexpr std::size_t max_placed_triangles = 1 << 30;

// How an object names a mesh file. The pictures are read if the object has the
// materials of the file.
struct MeshName {
    JsonField file;
    std::string path;
    MeshFileSettings settings;

    [[nodiscard]] bool same_reading(const MeshName& other) const {
        const MeshFileSettings &a = settings, &b = other.settings;
        return a.scale == b.scale && a.normals == b.normals && a.pictures == b.pictures;
    }
};

inline MeshName mesh_name(const JsonMembersOf& in, bool own_materials) {
    const JsonField file = in["file"];
    const std::string normals = in.word("normals");
    return {file,
            path_beside(file),
            {.scale = in.number("scale"),
             .normals = normals == "smooth" ? MeshNormals::smooth
                        : normals == "flat" ? MeshNormals::flat
                                            : MeshNormals::file,
             .pictures = own_materials}};
}

template <std::floating_point T>
struct FileSurfaceT {
    MaterialId material{};
    RgbT<T> emission{T(0)};
};

// The mesh files that a scene has read so far. Meshes are copied from the scene or, if
// a transform has changed those, from `unplaced`. Meshes of instances are kept once.
template <std::floating_point T>
struct FileMeshesT {
    struct Reading {
        MeshName named;
        std::vector<FileSurfaceT<T>> surfaces; // empty without materials of the file
        std::size_t first, last;               // of the meshes in the scene
        std::vector<MeshT<T>> unplaced{};
    };
    struct Kept {
        MeshName named;
        std::vector<FileSurfaceT<T>> surfaces;
        std::vector<Ref<MeshT<T>>> meshes{};
    };
    std::map<std::string, std::vector<Reading>> by_path{};
    std::map<std::string, std::vector<Kept>> kept{}; // for instances
    std::size_t copied = 0, placed = 0;              // triangles
    std::size_t pixels = 0;                          // of pictures that mesh files name
};

inline void require_readings(const JsonField& file, std::size_t readings) {
    if (readings == max_mesh_readings)
        refuse(file, "is named with more than 16 scales and normals");
}

template <std::floating_point T>
[[nodiscard]] MeshT<T> placed(const MeshT<T>& mesh, const PlacementT<T>& placement) {
    MeshDataT<T> data = mesh.data();
    for (Vec3T<T>& p : data.positions) p = placed_point(p, placement);
    for (Vec3T<T>& n : data.normals)
        if (glm::dot(n, n) > T(0)) n = placed_normal(n, placement);
    return MeshT<T>(std::move(data));
}

// The meshes of a file and, if the file's own materials are used, the surface of each.
template <std::floating_point T>
struct FilePartsT {
    std::vector<MeshT<T>> meshes{};
    std::vector<FileSurfaceT<T>> surfaces{};
};

template <std::floating_point T, typename LoadMeshes>
FilePartsT<T> load_parts(const MeshName& named, FileSceneT<T>& scene,
                         FileMeshesT<T>& known, LoadMeshes& load_meshes) {
    LoadedMeshT<T> loaded = load_meshes(named.path, named.settings);
    for (const auto& [name, image] : loaded.pictures)
        known.pixels += image.pixels.size();
    if (known.pixels > std::size_t(max_image_pixels))
        refuse(named.file,
               join({"has pictures which, with those of the mesh files before "
                     "it, have more than ",
                     std::to_string(max_image_pixels), " pixels"}));
    FilePartsT<T> parts;
    for (MeshPartT<T>& part : loaded.parts) {
        parts.meshes.push_back(std::move(part.mesh));
        if (!named.settings.pictures) continue;
        const MaterialId id = made_of(named.file, [&] {
            return add_material<FileMapT<T>>(scene, part.material, loaded);
        });
        parts.surfaces.push_back({id, RgbT<T>(part.material.emission)});
    }
    return parts;
}

// Adds the meshes of a file by calls of add(mesh, surface). The surface is null unless
// the file's own materials are used. If `is_placed`, add() applies a transform.
template <std::floating_point T, typename LoadMeshes, typename Add>
void read_meshes(const MeshName& named, FileSceneT<T>& scene, FileMeshesT<T>& known,
                 LoadMeshes& load_meshes, bool is_placed, Add add) {
    const auto& all = std::get<std::vector<MeshT<T>>>(scene.shapes);
    auto& readings = known.by_path[one_path(named.path)];
    const auto surface = [](const auto& surfaces, std::size_t i) {
        return surfaces.empty() ? nullptr : &surfaces[i];
    };
    for (const auto& reading : readings) {
        if (!reading.named.same_reading(named)) continue;
        std::size_t part = 0;
        const auto copy = [&](const MeshT<T>& mesh) {
            known.copied += mesh.size();
            if (known.copied > max_copied_triangles)
                refuse(named.file,
                       "is named once more; meshes that are named again have at "
                       "most 4194304 triangles together");
            add(MeshT<T>(mesh), surface(reading.surfaces, part++));
        };
        for (std::size_t i = reading.first; i < reading.last; ++i) copy(all[i]);
        for (const MeshT<T>& mesh : reading.unplaced) copy(mesh);
        return;
    }
    require_readings(named.file, readings.size());
    const std::size_t first = all.size();
    FilePartsT<T> parts = load_parts(named, scene, known, load_meshes);
    for (std::size_t i = 0; i < parts.meshes.size(); ++i)
        add(is_placed ? MeshT<T>(parts.meshes[i]) : std::move(parts.meshes[i]),
            surface(parts.surfaces, i));
    if (is_placed)
        readings.push_back(
            {named, std::move(parts.surfaces), first, first, std::move(parts.meshes)});
    else
        readings.push_back({named, std::move(parts.surfaces), first, all.size()});
}

// Reads the meshes of a file, which the scene keeps for instances.
template <std::floating_point T, typename LoadMeshes>
const typename FileMeshesT<T>::Kept&
read_kept_meshes(const MeshName& named, FileSceneT<T>& scene, FileMeshesT<T>& known,
                 LoadMeshes& load_meshes) {
    auto& readings = known.kept[one_path(named.path)];
    for (const auto& reading : readings)
        if (reading.named.same_reading(named)) return reading;
    require_readings(named.file, readings.size());
    FilePartsT<T> parts = load_parts(named, scene, known, load_meshes);
    readings.push_back({named, std::move(parts.surfaces)});
    for (MeshT<T>& mesh : parts.meshes)
        readings.back().meshes.push_back(scene.add(std::move(mesh)));
    return readings.back();
}

// Reads an affine map: the twelve numbers of a 3 x 4 matrix, row by row.
template <std::floating_point T>
AffineT<T> read_place(const JsonField& field) {
    if (list_size(field) != 12)
        refuse_value(field, "a list of twelve numbers, the rows of a 3 x 4 matrix");
    AffineT<T> map;
    for (int i = 0; i < 12; ++i)
        map[i % 4][i / 4] =
            static_cast<T>(number(entry(field, std::size_t(i)), -max_length, max_length,
                                  "within [-1e9, 1e9]"));
    return map;
}

// Places the meshes of a file once for each map, by calls of add(instance, surface) as
// in read_meshes().
template <std::floating_point T, typename LoadMeshes, typename Add>
void read_instances(const JsonMembersOf& in, const MeshName& named,
                    FileSceneT<T>& scene, FileMeshesT<T>& known,
                    LoadMeshes& load_meshes, Add add) {
    for (const char* name : {"transform", "displacement"})
        if (in.has(name))
            refuse(in[name], "belongs to other shapes; instances have places");
    const JsonField places = in["places"];
    const std::size_t count = list_size(places);
    const auto& kept = read_kept_meshes(named, scene, known, load_meshes);
    for (std::size_t part = 0; part < kept.meshes.size(); ++part) {
        const Ref<MeshT<T>>& mesh = kept.meshes[part];
        known.placed += std::min(count, max_placed_triangles) * mesh.get().size();
        if (known.placed > max_placed_triangles)
            refuse(places, "has too many entries; instances have at most 1073741824 "
                           "triangles together");
        for (std::size_t i = 0; i < count; ++i)
            made_of(entry(places, i), [&] {
                add(InstanceT<T>(mesh, read_place<T>(entry(places, i))),
                    kept.surfaces.empty() ? nullptr : &kept.surfaces[part]);
            });
    }
}

template <std::floating_point T>
PlacementT<T> read_transform(const JsonField& field) {
    const JsonMembersOf in(field, transform_members);
    PlacementT<T> placement{.scale{in.vector("scale")},
                            .translate{in.vector("translate")}};
    if (in.has("rotate")) {
        const JsonMembersOf rotate(in["rotate"], rotate_members);
        placement.rotate = {Vec3T<T>{rotate.vector("axis")},
                            static_cast<T>(rotate.number("degrees"))};
    }
    made_of(field, [&] { check(placement); });
    return placement;
}

// Calls add(shape) for each shape of an object, except meshes.
template <std::floating_point T, typename Add>
void read_shapes(const JsonMembersOf& in, std::string_view type, Add add) {
    const auto vector = [&](const char* name) { return Vec3T<T>{in.vector(name)}; };
    const auto radius = [&] {
        const T length = static_cast<T>(in.number("radius"));
        if (!(length > T(0))) refuse_value(in["radius"], "above 0");
        return length;
    };
    if (type == "sphere") {
        add(SphereT<T>{vector("center"), radius()});
    } else if (type == "quad") {
        const QuadT<T> quad{vector("corner"), vector("edge_u"), vector("edge_v")};
        if (!has_area(quad))
            refuse_value(in["edge_v"], "a vector that is not along edge_u");
        add(quad);
    } else if (type == "box") {
        const BoxT<T> box{vector("low"), vector("high")};
        if (!glm::all(glm::lessThan(box.low, box.high)))
            refuse_value(in["high"], "above low along x, y and z");
        for (const QuadT<T>& side : sides_of(box)) add(side);
    } else if (type == "disc") {
        add(DiscT<T>{vector("center"), vector("normal"), radius()});
    } else if (type == "cylinder") {
        const CylinderT<T> cylinder{vector("base"), vector("axis"), radius()};
        add(cylinder);
        if (in.word("ends") == "closed")
            for (const DiscT<T>& end : ends_of(cylinder)) add(end);
    } else {
        const FlatShapesT<T> shapes = read_triangles<T>(in.field());
        for (const QuadT<T>& quad : shapes.quads) add(quad);
        for (const TriangleT<T>& triangle : shapes.triangles) add(triangle);
    }
}

// Whether a shape may move in a scene file.
template <std::floating_point T, typename S>
inline constexpr bool may_move = false;
template <std::floating_point T, Movable S>
inline constexpr bool may_move<T, S> = FileSceneT<T>::template lists<Moving<S>>;

template <std::floating_point T, typename LoadMeshes>
void read_object(const JsonField& field,
                 const std::map<std::string, MaterialId>& materials,
                 const LampGroups& groups, FileSceneT<T>& scene, FileMeshesT<T>& meshes,
                 LoadMeshes& load_meshes) {
    const JsonTable& table = table_of(object_tables, field);
    const JsonMembersOf in(field, table.members, object_shared);
    const bool of_file = table.name == "mesh" || table.name == "instances";
    const bool own =
        of_file && (!in.has("material") ||
                    (text(in["material"]) == "file" && !materials.contains("file")));
    const MaterialId material =
        own ? MaterialId{} : entry_named(in["material"], materials, "materials");
    const double factor = groups.factor(in);
    const RgbT<T> radiance{factor * in.vector("emission")};
    std::optional<PlacementT<T>> placement;
    if (in.has("transform")) placement = read_transform<T>(in["transform"]);

    const auto add_to_scene = [&](auto shape, const FileSurfaceT<T>* surface) {
        if (surface == nullptr)
            scene.add(std::move(shape), material, radiance);
        else
            scene.add(std::move(shape), surface->material,
                      radiance + static_cast<T>(factor) * surface->emission);
    };
    const auto add = [&](auto shape, const FileSurfaceT<T>* surface = nullptr) {
        made_of(field, [&] {
            if (placement) shape = placed(shape, *placement);
            if (!in.has("displacement"))
                add_to_scene(std::move(shape), surface);
            else if constexpr (may_move<T, decltype(shape)>)
                add_to_scene(
                    Moving<decltype(shape)>{shape, Vec3T<T>{in.vector("displacement")}},
                    surface);
            else
                refuse(in["displacement"],
                       "belongs to spheres, quads, boxes and triangles; in a scene "
                       "file other shapes do not move");
        });
    };
    if (table.name == "mesh")
        read_meshes(mesh_name(in, own), scene, meshes, load_meshes,
                    placement.has_value(), add);
    else if (table.name == "instances")
        read_instances(in, mesh_name(in, own), scene, meshes, load_meshes,
                       add_to_scene);
    else
        read_shapes<T>(in, table.name, add);
}

} // namespace ljus::detail
