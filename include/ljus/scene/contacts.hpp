#pragma once

/// \file ljus/scene/contacts.hpp
/// \brief Finds objects whose surfaces are in the same place, and decides which surface
/// a path meets there.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "ljus/accel/detail/bvh_build.hpp"
#include "ljus/geometry/moving.hpp"
#include "ljus/geometry/touching.hpp"
#include "ljus/ref.hpp"
#include "ljus/scene/scene.hpp"

namespace ljus {

/// \defgroup contacts Contacts
/// \brief Surfaces of several objects in one place, as where a slab of glass rests on a
/// floor. Chapter: \ref ch_refraction.
///
/// A ray that leaves a surface starts beyond all surfaces in the same place. A path
/// therefore meets only one of them. Which one must not depend on the order in which
/// the objects were added:
///
/// | in one place                             | what a path meets                   |
/// |------------------------------------------|-------------------------------------|
/// | a lamp and any other surface             | the lamp; the brighter of two lamps |
/// | an opaque surface and a transparent body | the opaque surface, without air     |
/// |                                          | between them                        |
/// | two transparent bodies on opposite sides | a boundary with the relative index  |
/// | two transparent bodies on the same side  | the body of the higher index        |
/// | two opaque surfaces                      | the surface whose material covers   |
/// |                                          | less area                           |
/// | a thin surface and any other surface     | the other surface                   |
///
/// A World looks for contacts once, when it is made. It compares flat shapes, meshes,
/// spheres and cylinders, even if they move together or slide along each other. In all
/// other cases, as where two cylinders cross, a path meets the object that comes first
/// in the order of types and indices.
/// \{

template <std::floating_point T>
struct DiscT;
template <std::floating_point T>
struct CylinderT;

/// The kind of a surface in a contact. Of two kinds, a path meets the first in this
/// list.
enum class ContactKind : std::uint8_t {
    lamp,   ///< A surface that emits.
    opaque, ///< An opaque surface.
    body,   ///< The boundary of a transparent body.
    sheet   ///< A thin surface.
};

/// Stands for air, which has no material.
inline constexpr MaterialId no_body{0xffffffffu, 0};

/// The key of a surface. Of several surfaces in one place, a ray meets the surface
/// whose key comes first in lexicographical order. The numbers of a key describe, in
/// this order: the kind of the surface, its emission, index of refraction and
/// absorption, the area that its material covers, the light that it reflects, and the
/// number of the object.
using ContactKey = std::array<double, 16>;

/// Stands in place of an index for an object without contacts, and at the end of a list
/// of contacts.
inline constexpr std::uint32_t no_contact = 0xffffffffu;

/// Two objects that share an area or a point.
struct Contact {
    std::array<std::uint32_t, 2> pair{}; ///< Positions in Contacts::objects.
    /// The next contact of each object, in Contacts::pairs.
    std::array<std::uint32_t, 2> next{};
    BoxT<double> box{};     ///< A box around the shared place.
    bool over_area = false; ///< Whether the objects share an area, not only points.
    /// Whether the outsides of the two objects are on the same side of a shared area.
    bool alike = false;
    /// Whether the outsides of the two objects are on opposite sides of a shared area.
    bool opposed = false;
};

/// An object that has contacts.
struct TouchingObject {
    ObjectId object{};                      ///< The object.
    ContactKind kind = ContactKind::opaque; ///< The kind of the object's surface.
    ContactKey key{};                       ///< Decides which surface a path meets.
    std::uint32_t contact = no_contact;     ///< The object's first contact.
};

/// All contacts of a scene.
struct Contacts {
    detail::GrowingArray<Contact> pairs{};          ///< Each pair of objects once.
    detail::GrowingArray<TouchingObject> objects{}; ///< All objects with contacts.
    BoxT<double> box{};   ///< A box around all places that several objects share.
    bool complete = true; ///< False if more objects overlap than can be compared.
    /// For each type of shape, the number of objects of the types before it.
    detail::GrowingArray<std::uint32_t> first{};
    /// The position in `objects` of each object of the scene, or no_contact.
    std::vector<std::uint32_t> position{};

    /// The entry of an object; null if the object has no contacts.
    [[nodiscard]] const TouchingObject* find(ObjectId id) const noexcept {
        if (objects.empty()) return nullptr;
        const std::uint32_t at = position[first[id.type] + id.index];
        return at != no_contact ? &objects[at] : nullptr;
    }
};

namespace detail {

/// Whether the point of a ray at t may lie in a box, despite rounding.
template <std::floating_point T>
[[nodiscard]] bool may_be_in(const BoxT<T>& box, const RayT<T>& ray, T t) noexcept {
    const auto within = [&](glm::length_t axis) {
        const T way = t * ray.direction[axis], place = ray.origin[axis] + way;
        const T slack = T(8) * std::numeric_limits<T>::epsilon() * std::abs(way);
        return place + slack >= box.low[axis] && place - slack <= box.high[axis];
    };
    return within(0) && within(1) && within(2);
}

/// The bounding box of a shape or, if the shape has no bounds(), of its bounding
/// sphere.
template <Shape S>
[[nodiscard]] auto box_around(const S& shape) {
    if constexpr (requires { bounds(shape); })
        return bounds(shape);
    else
        return bounds(bounding_sphere(shape));
}

template <typename G>
inline constexpr bool has_triangles = requires(const G& mesh) {
    facet_of(mesh.triangle(mesh.size()));
};

template <typename G>
inline constexpr bool is_facet = requires(const G& shape) {
    facet_of(shape);
};

template <typename G>
inline constexpr bool is_ball = std::is_same_v<G, SphereT<ScalarOf<G>>>;

template <typename G>
inline constexpr bool is_disc = std::is_same_v<G, DiscT<ScalarOf<G>>>;

template <typename G>
inline constexpr bool is_tube = std::is_same_v<G, CylinderT<ScalarOf<G>>>;

/// A square around a disc.
template <typename G>
[[nodiscard, gnu::cold]] Facet around_disc(const G& disc) noexcept {
    const auto frame = frame_around(glm::normalize(glm::dvec3(disc.normal)));
    const glm::dvec3 u = double(disc.radius) * frame.tangent;
    const glm::dvec3 v = double(disc.radius) * frame.bitangent;
    const glm::dvec3 center(disc.center);
    return {.corners{center - u - v, center + u - v, center + u + v, center - u + v},
            .count = 4};
}

/// The number of pieces of a shape that are compared with other shapes: the number of
/// triangles of a mesh, 1 for a single surface, and 0 for a shape that is not compared.
template <Shape G>
[[nodiscard]] std::uint32_t piece_count([[maybe_unused]] const G& shape) noexcept {
    if constexpr (is_moving<G>)
        return piece_count(shape.shape);
    else if constexpr (has_triangles<G>)
        return static_cast<std::uint32_t>(shape.size());
    else
        return is_facet<G> || is_disc<G> || is_tube<G> || is_ball<G> ? 1 : 0;
}

template <Shape G>
[[nodiscard]] SurfacePiece piece_of([[maybe_unused]] const G& shape,
                                    [[maybe_unused]] std::uint32_t number) {
    if constexpr (is_moving<G>) {
        SurfacePiece piece = piece_of(shape.shape, number);
        piece.displacement = glm::dvec3(shape.displacement);
        return piece;
    } else if constexpr (has_triangles<G>)
        return {.facet = facet_of(shape.triangle(number))};
    else if constexpr (is_facet<G>)
        return {.facet = facet_of(shape)};
    else if constexpr (is_disc<G>)
        return {.facet = around_disc(shape)};
    else if constexpr (is_tube<G>)
        return {.facet{.corners{glm::dvec3(shape.base),
                                glm::dvec3(shape.base) + glm::dvec3(shape.axis)},
                       .count = 2},
                .radius = double(shape.radius)};
    else if constexpr (is_ball<G>)
        return {.facet{.corners{glm::dvec3(shape.center)}, .count = 1},
                .radius = double(shape.radius)};
    else
        return {};
}

/// The kind of a surface that does not emit.
template <Material M>
[[nodiscard]] ContactKind kind_of([[maybe_unused]] const M& m) {
    if constexpr (ThinSurface<M>)
        return ContactKind::sheet;
    else if constexpr (Refractive<M>)
        return refractive_index(m) > 0 ? ContactKind::body : ContactKind::opaque;
    else
        return MayAbsorb<M> ? ContactKind::body : ContactKind::opaque;
}

/// Writes a colour into a key. A brighter colour gives smaller numbers.
template <std::floating_point T>
void put_color(ContactKey& key, std::size_t at, const RgbT<T>& color) {
    key[at] = -double(color.x) - double(color.y) - double(color.z);
    key[at + 1] = -double(color.x);
    key[at + 2] = -double(color.y);
}

template <Material M>
[[gnu::cold]] void put_material(ContactKey& key, const M& m) {
    using T = typename M::Scalar;
    if constexpr (Refractive<M>) key[4] = -double(refractive_index(m));
    if constexpr (MayAbsorb<M>) put_color(key, 5, absorption(m));
    const Vec3T<T> wo{T(0.6), T(0), T(0.8)}, up{T(0), T(0), T(1)};
    const auto& here = material_at(m, Vec3T<T>{T(0)}, Vec2T<T>{T(0.5)});
    put_color(key, 9, evaluate(here, wo, up));
    if (const auto next =
            sample(here, wo, Vec3T<T>{T(0.5)}, Transport::flux, Lobes::all))
        put_color(key, 12, next->weight);
}

struct ContactObject {
    ObjectId id{};
    ContactKind kind = ContactKind::opaque;
    std::uint32_t material = 0; ///< The number of the object's material.
    std::uint32_t pieces = 0;   ///< The result of piece_count().
    double area = 0;            ///< The area of the object; 0 if unknown.
    BoxT<double> box{};
};

struct ContactSearch {
    /// The objects, in the order of types and indices.
    std::span<const ContactObject> objects;
    double epsilon; ///< Machine epsilon in the scene's precision.
    FunctionRef<SurfacePiece(ObjectId, std::uint32_t)> piece;
    /// Writes the emission and the material of an object into a key.
    FunctionRef<void(ContactKey&, ObjectId)> put;
};

/// Finds the contacts of a scene, without knowing the scene's types.
[[nodiscard, gnu::cold]] LJUS_CORE_INLINE Contacts
contacts_of(const ContactSearch& search);

template <std::floating_point T>
[[nodiscard, gnu::cold]] bool overlap(const BoxT<T>& a, const BoxT<T>& b) noexcept {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y &&
           b.low.y <= a.high.y && a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// A tree over boxes. Each box has a number, its *look*. Surfaces of the same look have
/// the same appearance, and their boxes are not compared with each other.
class LookTree {
public:
    /// Builds the tree. The boxes must have been enlarged by contact_distance(). They
    /// must be in units of the scene's largest coordinate, so that floats can represent
    /// them.
    LookTree(std::vector<Box> boxes, std::vector<std::uint32_t> looks)
        : boxes_(std::move(boxes)), looks_(std::move(looks)),
          tree_(build_bvh<float>(boxes_)), below_(tree_.nodes.size(), several) {
        for (std::size_t i = below_.size(); i-- > 0;) { // children after their parents
            const auto& [box, first, count] = tree_.nodes[i];
            for (std::uint32_t k = 0; k < (count == 0 ? 2 : count); ++k) {
                const std::uint32_t look = count == 0
                                               ? below_[first + k]
                                               : looks_[tree_.primitive_ids[first + k]];
                if (k == 0)
                    below_[i] = look;
                else if (below_[i] != look)
                    below_[i] = several;
            }
        }
    }

    [[nodiscard]] std::uint32_t size() const noexcept {
        return static_cast<std::uint32_t>(boxes_.size());
    }
    [[nodiscard]] const Box& box(std::uint32_t i) const noexcept { return boxes_[i]; }

    /// Calls f(k) for each box k that overlaps box i and has a different look. The
    /// budget is the number of nodes that may still be visited.
    /// \return False if the budget is spent.
    bool each_overlap(std::uint32_t i, long long& budget,
                      FunctionRef<void(std::uint32_t)> f) const {
        std::array<std::uint32_t, bvh_depth + 2> open{};
        for (std::size_t count_open = 1; count_open > 0;) { // open[0] is the root
            if (--budget < 0) return false;
            const std::uint32_t at = open[--count_open];
            const auto& [box, first, count] = tree_.nodes[at];
            if (below_[at] == looks_[i] || !overlap(box, boxes_[i])) continue;
            if (count == 0) {
                open[count_open++] = first;
                open[count_open++] = first + 1;
            }
            for (std::uint32_t slot = first; slot < first + count; ++slot) {
                const std::uint32_t k = tree_.primitive_ids[slot];
                if (looks_[k] != looks_[i] && overlap(boxes_[i], boxes_[k])) f(k);
            }
        }
        return true;
    }

private:
    static constexpr std::uint32_t several = 0xffffffffu;
    std::vector<Box> boxes_;
    std::vector<std::uint32_t> looks_;
    BvhNodesT<float> tree_;
    std::vector<std::uint32_t>
        below_; // per node, the look of all its boxes, or `several`
};

#ifndef LJUS_CORE // otherwise defined in ljus::core

/// The largest absolute coordinate of a box.
[[nodiscard, gnu::cold]] inline double reach_of(const BoxT<double>& box) noexcept {
    return max_component(glm::max(glm::abs(box.low), glm::abs(box.high)));
}

/// The distance within which two surfaces in a box count as coinciding.
[[nodiscard, gnu::cold]] inline double contact_distance(const BoxT<double>& box,
                                                        double epsilon) noexcept {
    return 8 * epsilon * reach_of(box);
}

/// The pieces of all objects that are compared; see piece_count().
struct ContactPieces {
    std::vector<Box> boxes{};
    std::vector<std::uint32_t> looks{};
    GrowingArray<std::uint32_t> object{}; ///< The object of each piece.
    GrowingArray<std::uint32_t> number{}; ///< The piece's number within the object.
};

/// Lists the pieces of all objects; of a mesh, only those close to other objects.
[[nodiscard, gnu::cold]] inline ContactPieces
list_pieces(const ContactSearch& search, const std::vector<std::uint32_t>& looks,
            long long& budget) {
    double unit = std::numeric_limits<double>::min(); // all may lie at 0
    for (const ContactObject& object : search.objects)
        unit = std::max(unit, reach_of(object.box));
    const auto in_units = [unit](const BoxT<double>& box) {
        const double by = contact_distance(box, std::numeric_limits<float>::epsilon());
        return Box{Vec3((box.low - by) / unit), Vec3((box.high + by) / unit)};
    };
    std::vector<Box> boxes(search.objects.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        boxes[i] = in_units(search.objects[i].box);
    const LookTree whole(std::move(boxes), looks);
    ContactPieces pieces;
    for (std::uint32_t i = 0; i < whole.size(); ++i) {
        const ContactObject& object = search.objects[i];
        const Box& mine = whole.box(i);
        Box near; // around the parts of `mine` in other boxes
        const auto unite = [&](std::uint32_t k) {
            near = box_union(near, {glm::max(whole.box(k).low, mine.low),
                                    glm::min(whole.box(k).high, mine.high)});
        };
        if (object.pieces == 1)
            near = mine;
        else if (object.pieces > 1)
            whole.each_overlap(i, budget, unite);
        for (std::uint32_t number = 0; number < object.pieces; ++number) {
            const Box box = object.pieces == 1
                                ? mine
                                : in_units(box_of(search.piece(object.id, number)));
            if (!overlap(box, near)) continue;
            pieces.boxes.push_back(box);
            pieces.looks.push_back(looks[i]);
            pieces.object.push_back(i);
            pieces.number.push_back(number);
        }
    }
    return pieces;
}

/// Finds the pairs of objects with pieces in one place, as indices of
/// ContactSearch::objects.
[[gnu::cold]] inline void find_pairs(Contacts& contacts, const ContactSearch& search,
                                     const std::vector<std::uint32_t>& looks) {
    long long budget = 1'000'000'000; // nodes
    ContactPieces pieces = list_pieces(search, looks, budget);
    const LookTree tree(std::move(pieces.boxes), std::move(pieces.looks));
    // For each object, the last pair in which it comes second. All pairs with the same
    // first object are found one after another.
    std::vector<std::uint32_t> last(looks.size(), no_contact);
    const auto compare = [&](std::uint32_t i, std::uint32_t k) {
        const std::uint32_t one = pieces.object[i], other = pieces.object[k];
        const auto a = search.piece(search.objects[one].id, pieces.number[i]);
        const auto b = search.piece(search.objects[other].id, pieces.number[k]);
        const double distance =
            contact_distance(box_union(box_of(a), box_of(b)), search.epsilon);
        const auto shared = shared_place(a, b, distance);
        if (!shared) return;
        auto& pairs = contacts.pairs;
        if (last[other] == no_contact || pairs[last[other]].pair[0] != one) {
            last[other] = static_cast<std::uint32_t>(pairs.size());
            pairs.push_back({.pair = {one, other}});
        }
        Contact& contact = pairs[last[other]];
        contact.box = box_union(
            contact.box, {shared->box.low - distance, shared->box.high + distance});
        contact.over_area |= shared->over_area;
        contact.alike |= shared->over_area && shared->alike;
        contact.opposed |= shared->over_area && !shared->alike;
    };
    for (std::uint32_t i = 0; i < tree.size() && contacts.complete; ++i) {
        const auto compare_once = [&](std::uint32_t k) {
            if (pieces.object[i] < pieces.object[k]) compare(i, k);
        };
        contacts.complete = tree.each_overlap(i, budget, compare_once);
    }
}

/// The area that each material covers, in units of 2^-30 of the largest area of an
/// object. Each area is rounded to a whole number of units, so that the order of the
/// sum does not matter.
[[nodiscard, gnu::cold]] inline std::vector<double>
covered_areas(std::span<const ContactObject> objects, std::size_t materials) {
    std::vector<double> covered(materials);
    double most = 0;
    for (const ContactObject& object : objects) most = std::max(most, object.area);
    for (const ContactObject& object : objects)
        if (const double part = object.area / most; part <= 1) // not if most is 0
            covered[object.material] += std::round(part * 0x1p30);
    return covered;
}

/// Lists the objects that have contacts, with their keys and their contacts.
[[gnu::cold]] inline void list_touching(Contacts& contacts, const ContactSearch& search,
                                        std::size_t materials) {
    const std::vector<double> covered = covered_areas(search.objects, materials);
    contacts.position = std::vector<std::uint32_t>(search.objects.size(), no_contact);
    for (std::uint32_t i = 0; i < search.objects.size(); ++i)
        while (contacts.first.size() <= search.objects[i].id.type)
            contacts.first.push_back(i);
    for (std::uint32_t i = 0; i < contacts.pairs.size(); ++i) {
        Contact& contact = contacts.pairs[i];
        contacts.box = box_union(contacts.box, contact.box);
        for (std::size_t k = 0; k < 2; ++k) {
            const std::uint32_t number = contact.pair[k];
            std::uint32_t& at = contacts.position[number];
            if (at == no_contact) {
                at = static_cast<std::uint32_t>(contacts.objects.size());
                const ContactObject& object = search.objects[number];
                TouchingObject touching{.object = object.id, .kind = object.kind};
                touching.key[0] = double(object.kind);
                touching.key[8] = covered[object.material];
                touching.key[15] = double(number);
                search.put(touching.key, object.id);
                contacts.objects.push_back(touching);
            }
            contact.pair[k] = at;
            contact.next[k] = contacts.objects[at].contact;
            contacts.objects[at].contact = i;
        }
    }
}

LJUS_CORE_INLINE Contacts contacts_of(const ContactSearch& search) {
    Contacts contacts;
    std::uint32_t materials = 0;
    for (const ContactObject& object : search.objects)
        materials = std::max(materials, object.material + 1);
    std::vector<std::uint32_t> looks(search.objects.size());
    bool one_look = true;
    for (std::uint32_t i = 0; i < looks.size(); ++i) {
        const ContactObject& object = search.objects[i]; // opaque: by material
        looks[i] = object.kind == ContactKind::opaque ? object.material : materials + i;
        one_look = one_look && looks[i] == looks[0];
    }
    if (one_look) return contacts;
    find_pairs(contacts, search, looks);
    if (!contacts.pairs.empty()) list_touching(contacts, search, materials);
    return contacts;
}

#endif

} // namespace detail

/// Finds the contacts of a World whose shapes, objects and materials are complete. The
/// boxes of the objects are given in the order of types and indices. The order in which
/// the objects were added affects only the order of the contacts.
/// \cost O(n log n) for n boxes; less if neighbouring objects are opaque and have the
///       same material.
template <typename W>
[[nodiscard, gnu::cold]] Contacts
find_contacts(const W& world, const std::vector<BoxT<typename W::Scalar>>& boxes) {
    constexpr auto types = static_cast<std::uint32_t>(
        std::tuple_size_v<std::remove_cvref_t<decltype(world.materials())>>);
    detail::GrowingArray<detail::ContactObject> objects(world.size());
    detail::ContactObject* next = objects.data();
    auto box = boxes.begin();
    world.each_object([&](ObjectId id, const auto& object) {
        detail::ContactObject& one = *next++ = {.id = id};
        one.material = object.material.index * types + object.material.type;
        one.kind = !is_black(object.emission)
                       ? ContactKind::lamp
                       : world.visit_material(object.material, [](const auto& m) {
                             return detail::kind_of(m);
                         });
        one.box = {glm::dvec3(box->low), glm::dvec3(box->high)};
        ++box;
        world.visit_shape(id, [&]<typename G>(const G& shape) {
            one.pieces = detail::piece_count(shape);
            if constexpr (HasArea<G>) one.area = double(area(shape));
        });
    });
    const auto piece = [&](ObjectId id, std::uint32_t number) {
        SurfacePiece found = world.visit_shape(id, [number](const auto& shape) {
            return detail::piece_of(shape, number);
        });
        found.inside_out = world.object(id).inside_out;
        return found;
    };
    const auto put = [&](ContactKey& key, ObjectId id) {
        const auto& object = world.object(id);
        detail::put_color(key, 1, object.emission);
        world.visit_material(object.material,
                             [&key](const auto& m) { detail::put_material(key, m); });
    };
    return detail::contacts_of(
        {objects, std::numeric_limits<typename W::Scalar>::epsilon(), piece, put});
}

/// \}

} // namespace ljus
