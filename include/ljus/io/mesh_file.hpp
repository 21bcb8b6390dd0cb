#pragma once

/// \file ljus/io/mesh_file.hpp
/// \brief The content of a mesh file, in a form that is the same for all formats.

#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "ljus/accel/mesh.hpp"
#include "ljus/image/texture.hpp"
#include "ljus/io/file_beside.hpp"
#include "ljus/io/mesh_report.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/lights/spot_light.hpp"
#include "ljus/lights/sun_light.hpp"
#include "ljus/materials/cut_out.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/glossy.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/nested.hpp"
#include "ljus/materials/normal_map.hpp"
#include "ljus/materials/textured.hpp"
#include "ljus/scene/camera.hpp"
#include "ljus/scene/scene.hpp"

namespace ljus {

/// \defgroup mesh_file The content of mesh files
/// \brief The result of load_obj(), load_ply(), load_stl() and load_gltf().
/// \{

/// The normals that a mesh from a file gets.
enum class MeshNormals : std::uint8_t {
    file,   ///< The normals of the file, or of the triangles if the file has none.
    smooth, ///< The normals of smooth_normals(), even if the file has normals.
    flat    ///< The normals of the triangles.
};

/// The settings of a mesh file's reader.
struct MeshFileSettings {
    double scale = 1;                        ///< Factor of every coordinate.
    MeshNormals normals = MeshNormals::file; ///< The normals of the meshes.
    bool pictures = true; ///< Whether to load the pictures of materials, and to make a
                          ///< picture of vertex colours.
};

/// A picture of a material.
struct MeshImage {
    std::string name{}; ///< Key in LoadedMeshT::pictures; empty: no picture.
    /// Where the file names the picture, such as "room.mtl, line 12".
    std::string at{};
};

/// A material as a mesh file describes it.
struct MeshMaterial {
    std::string name{}; ///< Name in the file; empty for faces without a material.
    /// Diffuse colour Kd, in [0, 1]; in glTF the base colour. If the material has a
    /// picture and Kd is missing or 0, the colour is 1.
    glm::dvec3 diffuse{0.5};
    /// Specular colour Ks, in [0, 1]; in glTF the base colour of a metal.
    glm::dvec3 specular{0};
    glm::dvec3 emission{0}; ///< Emission Ke in W/(m^2 sr), at least 0; 0 if a picture
                            ///< says where the material glows.
    double roughness = 0;   ///< Roughness of a mirror, 0 or in [0.01, 1]; see GlossyT.
    double index = 1.5;     ///< Index of refraction Ni, within [0.001, 1000].
    /// Opacity d, or 1 - Tr; 0 is clear. If the material has a picture, a Tr of 1
    /// counts as opaque.
    double dissolve = 1;
    /// The number illum: 3, 5 and 8 are mirrors; 4, 6, 7 and 9 are glass. These four
    /// are not glass if Ni is 1, because some programs write them for every material.
    int illumination = 2;
    MeshImage picture{}; ///< A picture of colours, which are multiplied by `diffuse`.
    MeshImage mask{};    ///< A picture of alpha, which cuts holes; see Holes.
    MeshImage normals{}; ///< A picture of normals; see NormalMapT.
    /// Whether `mask` always uses the alpha channel of the picture. If false, the red
    /// channel is used for a picture without alpha.
    bool mask_is_alpha = true;
    double cutoff = 0.5;    ///< There is a hole where alpha is below this; at least 0.
    UvMapT<double> map{};   ///< How the pictures lie on the surface.
    PictureWrap wrap{};     ///< What the pictures show beyond their borders.
    PictureFilter filter{}; ///< How the pictures are filtered between pixels.

    /// Whether the material is glass: by its `illumination`, or because `dissolve` is
    /// below 0.5.
    [[nodiscard]] bool is_glass() const noexcept {
        const int i = illumination;
        const bool glass = i == 4 || i == 6 || i == 7 || i == 9;
        return (glass && index != 1) || dissolve < 0.5;
    }
    /// Whether the material is a mirror or a metal.
    [[nodiscard]] bool is_mirror() const noexcept {
        return illumination == 3 || illumination == 5 || illumination == 8;
    }
};

/// All faces of one material.
template <std::floating_point T>
struct MeshPartT {
    MeshT<T> mesh;         ///< The triangles of the part.
    MeshMaterial material; ///< The material of the part.
};

/// A camera of a mesh file.
template <std::floating_point T>
struct MeshCameraT {
    std::string name;  ///< Name in the file; may be empty.
    CameraT<T> camera; ///< The camera itself.
};

/// The content of a mesh file.
template <std::floating_point T>
struct LoadedMeshT {
    std::vector<MeshPartT<T>> parts{}; ///< The parts, one per material, in order of
                                       ///< first use.
    MeshReport report{};               ///< The problems of the file, and the numbers of
                                       ///< its elements.
    /// The pictures of the materials, by name: colours, alpha and normals. Pictures
    /// that cannot be read are missing.
    std::map<std::string, ImageT<T>> pictures{};
    std::vector<MeshCameraT<T>> cameras{}; ///< Cameras of a glTF file, in the order of
                                           ///< the nodes.
    std::vector<PointLightT<T>> points{};  ///< Point lights of a glTF file.
    std::vector<SpotLightT<T>> spots{};    ///< Spot lights of a glTF file.
    std::vector<SunLightT<T>> suns{};      ///< Directional lights of a glTF file.
};
using LoadedMesh = LoadedMeshT<float>; ///< LoadedMeshT in float.

/// A matt surface with a picture; see add_meshes().
template <std::floating_point T, typename Map = UvMapT<T>>
using MeshPictureT = Textured<LambertianT<T>, PictureTextureT<T, Map>>;
using MeshPicture = MeshPictureT<float>; ///< MeshPictureT in float.

/// A metal with a picture; see add_meshes().
template <std::floating_point T, typename Map = UvMapT<T>>
using MeshMetalPictureT = Textured<GlossyT<T>, PictureTextureT<T, Map>>;
using MeshMetalPicture = MeshMetalPictureT<float>; ///< MeshMetalPictureT in float.

/// A surface with a picture, holes and a normal map; see add_meshes().
template <Material Base, std::floating_point T = typename Base::Scalar>
using MeshDetailedT =
    CutOut<Textured<Textured<Base, PictureTextureT<T, UvMapT<T>>>, NormalMapT<T>>,
           PictureTextureT<T, UvMapT<T>>>;
/// MeshDetailedT of a matt surface, in float.
using MeshDetailed = MeshDetailedT<Lambertian>;
/// MeshDetailedT of a metal, in float.
using MeshMetalDetailed = MeshDetailedT<Glossy>;

namespace detail {

// The pixels of a picture; nullptr if there is none, or it could not be read.
template <std::floating_point T>
const ImageT<T>* find_picture(const LoadedMeshT<T>& loaded, const MeshImage& image) {
    const auto found = loaded.pictures.find(image.name);
    return found == loaded.pictures.end() ? nullptr : &found->second;
}

// The texture that a picture makes on a material.
template <typename Map, std::floating_point T>
PictureTextureT<T, Map> laid_picture(const MeshMaterial& is, const ImageT<T>& image) {
    return {.image = image,
            .map{UvMapT<T>{.scale = Vec2T<T>(is.map.scale),
                           .turn = Vec2T<T>(is.map.turn),
                           .offset = Vec2T<T>(is.map.offset)}},
            .wrap = is.wrap,
            .filter = is.filter};
}

// A surface with all pictures of a material. For a missing picture it gets one pixel
// that has no effect.
template <Material Base, std::floating_point T>
MeshDetailedT<Base> detailed(const Base& base, const MeshMaterial& is,
                             const LoadedMeshT<T>& loaded) {
    const auto picture = [&](const MeshImage& image, const RgbT<T>& otherwise) {
        const ImageT<T>* const found = find_picture(loaded, image);
        return laid_picture<UvMapT<T>>(is,
                                       found ? *found : make_image(1, 1, otherwise));
    };
    return {{{base, picture(is.picture, RgbT<T>{1})},
             {picture(is.normals, RgbT<T>{T(0.5), T(0.5), T(1)})}},
            {picture(is.mask, RgbT<T>{1}), is.cutoff}};
}

} // namespace detail

/// Adds a material of the file `loaded` to a scene that lists Lambertian; see
/// add_meshes().
/// \tparam Map  The map of the PictureTextureT that the scene lists; void means UvMapT.
/// \return The number of the material in the scene.
template <typename Map = void, typename Scene, std::floating_point T>
MaterialId add_material(Scene& scene, const MeshMaterial& is,
                        const LoadedMeshT<T>& loaded) {
    using At = std::conditional_t<std::is_void_v<Map>, UvMapT<T>, Map>;
    const ImageT<T>* const picture = detail::find_picture(loaded, is.picture);
    const bool rough = is.is_mirror() && is.roughness > 0;
    const auto painted = [&](const auto& base) {
        return Textured<std::decay_t<decltype(base)>, PictureTextureT<T, At>>{
            base, detail::laid_picture<At>(is, *picture)};
    };
    // A lamp has no holes.
    const bool details = is.emission == glm::dvec3(0) &&
                         (detail::find_picture(loaded, is.mask) != nullptr ||
                          detail::find_picture(loaded, is.normals) != nullptr);
    const GlassT<T> glass{.index = static_cast<T>(is.index)};
    const MirrorT<T> mirror{.reflectance = RgbT<T>(is.specular)};
    const GlossyT<T> metal{RgbT<T>(is.specular), static_cast<T>(is.roughness)};
    const LambertianT<T> matt{.albedo = RgbT<T>(is.diffuse)};
    if constexpr (Scene::template lists<GlassT<T>>)
        if (is.is_glass()) return scene.add(glass);
    if constexpr (Scene::template lists<Nested<GlassT<T>>>)
        if (is.is_glass()) return scene.add(Nested<GlassT<T>>{glass});
    if constexpr (Scene::template lists<MirrorT<T>>)
        if (is.is_mirror() && !rough) return scene.add(mirror);
    constexpr bool lists_painted = Scene::template lists<MeshMetalPictureT<T, At>>;
    if constexpr (Scene::template lists<MeshDetailedT<GlossyT<T>>>)
        if (rough && (details || (picture && !lists_painted)))
            return scene.add(detail::detailed(metal, is, loaded));
    if constexpr (lists_painted)
        if (rough && picture) return scene.add(painted(metal));
    if constexpr (Scene::template lists<GlossyT<T>>)
        if (rough && !picture) return scene.add(metal);
    if constexpr (Scene::template lists<MeshDetailedT<LambertianT<T>>>)
        if (details) return scene.add(detail::detailed(matt, is, loaded));
    if constexpr (Scene::template lists<MeshPictureT<T, At>>)
        if (picture) return scene.add(painted(matt));
    return scene.add(matt);
}

/// Adds all meshes of a file to a scene that lists Mesh and Lambertian, with the
/// materials of the file.
///
/// Glass, mirrors and rough metals need a scene that lists Glass, Mirror and Glossy;
/// otherwise they become Lambertian, in their own colour. Pictures need MeshPicture or,
/// for metals, MeshMetalPicture or MeshMetalDetailed. Holes and normal maps need
/// MeshDetailed or MeshMetalDetailed. A mesh with emission is a lamp, and has no holes
/// or normal map. Lights of the file are added if the scene lists their types.
/// \tparam Map  The map of the PictureTextureT that the scene lists; void means UvMapT.
template <typename Map = void, typename Scene, std::floating_point T>
void add_meshes(Scene& scene, const LoadedMeshT<T>& loaded) {
    for (const MeshPartT<T>& part : loaded.parts)
        scene.add(part.mesh, add_material<Map>(scene, part.material, loaded),
                  RgbT<T>(part.material.emission));
    const auto add_lights = [&](const auto& lights) {
        using Light = typename std::decay_t<decltype(lights)>::value_type;
        if constexpr (Scene::template lists<Light>)
            for (const Light& light : lights) scene.add(light);
    };
    add_lights(loaded.points);
    add_lights(loaded.spots);
    add_lights(loaded.suns);
}

/// Describes the material that add_meshes() makes of a file's material, such as
/// "matt (0.5, 0.5, 0.5), picture wood.png". A scene that does not list the type of
/// this material gets a simpler material.
[[nodiscard, gnu::cold]] inline std::string to_text(const MeshMaterial& is) {
    std::string text = is.is_glass()    ? "glass of index " + to_text(is.index)
                       : is.is_mirror() ? "mirror of " + to_text(Vec3(is.specular))
                                        : "matt " + to_text(Vec3(is.diffuse));
    if (is.is_mirror() && is.roughness > 0)
        text += ", roughness " + to_text(is.roughness);
    if (is.emission != glm::dvec3(0)) text += ", emits " + to_text(Vec3(is.emission));
    const auto add_image = [&](const char* what, const MeshImage& image) {
        if (!image.name.empty()) text += what + shown_path(image.name);
    };
    add_image(", picture ", is.picture);
    add_image(", holes by ", is.mask);
    add_image(", normals by ", is.normals);
    return text;
}

/// Describes the content of a mesh file: the numbers of its elements, the materials
/// that add_meshes() makes, and each problem with its position in the file.
template <std::floating_point T>
[[nodiscard, gnu::cold]] std::string to_text(const LoadedMeshT<T>& loaded) {
    const MeshContent& has = loaded.report.content;
    BoxT<T> box;
    double area = 0;
    long long triangles = 0;
    for (const MeshPartT<T>& part : loaded.parts) {
        box = box_union(box, part.mesh.tree().box());
        area += part.mesh.area_up_to().back();
        triangles += part.mesh.size();
    }
    const auto digits = [](double number) {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%.6g", number);
        return std::string(text.data());
    };
    using detail::join;
    std::string text =
        join({"  vertices   ", to_text(has.vertices), ", ", to_text(has.unused),
              " of them in no face; ", to_text(has.normals), " normals, ",
              to_text(has.uvs), " texture coordinates"});
    text += join({"\n  groups     ", to_text(has.groups), " in ", to_text(has.objects),
                  " objects"});
    text += join({"\n  faces      ", to_text(has.faces), ", ", to_text(has.polygons),
                  " of them with more than three corners, which are cut; ",
                  to_text(has.flat_faces), " without normals, ",
                  to_text(has.no_uv_faces), " without texture coordinates"});
    text += "\n  triangles  " + to_text(triangles);
    text += join({"\n  box        ", to_text(box.low), " to ", to_text(box.high)});
    text += "\n  area       " + digits(area);
    text += "\n  closed     " +
            (has.closed ? "yes; volume " + digits(has.volume) : std::string("no"));
    if (has.closed && has.volume < 0)
        text += ": the faces look inwards, it is inside out";
    text += "\n";
    for (const MeshPartT<T>& part : loaded.parts)
        text += "  material   " +
                (part.material.name.empty() ? "(none)" : shown(part.material.name)) +
                ": " + to_text(static_cast<long long>(part.mesh.size())) +
                " triangles, " + to_text(part.material) + "\n";
    for (const MeshCameraT<T>& one : loaded.cameras)
        text += "  camera     " + (one.name.empty() ? "(no name)" : shown(one.name)) +
                " at " + to_text(one.camera.position) + "\n";
    for (const auto& [lights, count] : {std::pair{"points", loaded.points.size()},
                                        {"spots", loaded.spots.size()},
                                        {"suns", loaded.suns.size()}})
        if (count > 0)
            text += join({"  lights     ", to_text(static_cast<long long>(count)), " ",
                          lights, "\n"});
    const std::string odd = to_text(loaded.report);
    return text + (odd.empty() ? "nothing is odd\n" : "odd:\n" + odd);
}

/// \}

} // namespace ljus
