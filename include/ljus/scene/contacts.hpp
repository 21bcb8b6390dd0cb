#pragma once

/// \file ljus/scene/contacts.hpp
/// \brief Which objects of a scene have surfaces in one place, and which surface counts
/// there.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "ljus/accel/detail/bvh_build.hpp"
#include "ljus/function_ref.hpp"
#include "ljus/geometry/touching.hpp"
#include "ljus/scene/scene.hpp"

namespace ljus {

/// \defgroup contacts Contacts
/// \brief A slab of glass that rests on a floor. Chapter: \ref ch_refraction.
///
/// A ray that leaves a surface starts beyond all that lies in the same place. So of
/// several surfaces in one place a path meets one, and it must not depend on the order
/// in which they were added which one that is:
///
/// | in one place                             | what a path meets                   |
/// |------------------------------------------|-------------------------------------|
/// | a lamp and anything                      | the lamp; of two the brighter one   |
/// | something opaque and a body              | what is opaque, no air between      |
/// | two bodies, one on each side             | one boundary of the relative index  |
/// | two bodies, on the same side             | the one of the higher index         |
/// | two opaque surfaces                      | the one whose material covers less  |
/// | a thin surface and anything              | anything but the thin surface       |
///
/// A World looks for contacts once, when it is made. They are found between flat
/// shapes, meshes and spheres at rest; other shapes are met in the order of addition.
/// \{

/// What a surface is in a contact. The first in this list is met.
enum class ContactKind : std::uint8_t {
    lamp,   ///< It emits.
    opaque, ///< None of the others.
    body,   ///< The boundary of a transparent body: refractive_index(), or a medium.
    sheet   ///< A thin surface.
};

/// The material of air, which is none.
inline constexpr MaterialId no_body{0xffffffffu, 0};

/// Two objects that share an area or a point.
template <std::floating_point T>
struct ContactT {
    std::array<std::uint32_t, 2> pair{}; ///< Positions in ContactsT::objects.
    BoxT<T> box{};                       ///< A box around what they share.
    bool over_area = false;              ///< False if they touch in points.
    bool alike = false;   ///< Whether they share an area with outsides on one side.
    bool opposed = false; ///< Whether they share one with outsides on opposite sides.
};

/// An object that shares a place with others.
template <std::floating_point T>
struct TouchingObjectT {
    ObjectId object{};                                       ///< The object.
    ContactKind kind = ContactKind::opaque;                  ///< What it is.
    std::uint32_t rank = 0;                                  ///< The lowest one is met.
    std::vector<std::pair<std::uint32_t, BoxT<T>>> others{}; ///< Objects, and where.
};

/// All contacts of a scene.
template <std::floating_point T>
struct ContactsT {
    std::vector<ContactT<T>> pairs;          ///< By the objects' positions.
    std::vector<TouchingObjectT<T>> objects; ///< Those that take part.
    BoxT<T> box{};                           ///< A box around all that objects share.
    bool complete = true; ///< False if more objects overlap than can be compared.
    /// The position in `objects` of each object of a scene, or an absent one; empty
    /// without contacts.
    std::vector<std::vector<std::uint32_t>> position;

    /// The entry of an object; null if it touches none.
    [[nodiscard]] const TouchingObjectT<T>* find(ObjectId id) const noexcept {
        if (objects.empty()) return nullptr;
        const std::uint32_t at = position[id.type][id.index];
        return at < objects.size() ? &objects[at] : nullptr;
    }
};

namespace detail {

/// A part of an object in the search: its box, and its number within the object.
template <std::floating_point T>
struct ContactPartT {
    BoxT<T> box{};
    std::uint32_t object = 0; ///< In the order of the search.
    std::uint32_t part = 0;
    std::uint32_t look = 0; ///< Parts of one look need not be compared.
};

template <std::floating_point T>
[[nodiscard]] bool overlap(const BoxT<T>& a, const BoxT<T>& b) noexcept {
    return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y &&
           b.low.y <= a.high.y && a.low.z <= b.high.z && b.low.z <= a.high.z;
}

/// The largest coordinate of a box.
template <std::floating_point T>
[[nodiscard]] T reach_of(const BoxT<T>& box) noexcept {
    return max_component(glm::max(glm::abs(box.low), glm::abs(box.high)));
}

/// Surfaces with coordinates up to `reach` that are closer than this are in one place.
template <std::floating_point T>
[[nodiscard]] constexpr T contact_distance(T reach) noexcept {
    return T(8) * std::numeric_limits<T>::epsilon() * reach;
}

/// A box that is larger by the distance within which surfaces are in one place.
template <std::floating_point T>
[[nodiscard]] BoxT<T> widened(const BoxT<T>& box, T reach) noexcept {
    return {box.low - contact_distance(reach), box.high + contact_distance(reach)};
}

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

/// Visits the pairs of parts of different looks whose boxes overlap: each part asks a
/// tree over all of them.
/// \param budget  Decreases by the number of nodes visited; the search ends at 0.
template <std::floating_point T, typename Visit>
[[gnu::cold]] void overlapping_parts(const std::vector<ContactPartT<T>>& parts,
                                     long long& budget, const Visit& visit) {
    std::vector<BoxT<T>> boxes;
    for (const ContactPartT<T>& part : parts) boxes.push_back(part.box);
    const BvhNodesT<T> tree = build_bvh<T>(boxes);
    // The look that all parts below a node have; children come after their parents.
    constexpr std::uint32_t several = 0xffffffffu;
    std::vector<std::uint32_t> looks(tree.nodes.size(), several);
    const auto part_at = [&](std::uint32_t slot) -> const ContactPartT<T>& {
        return parts[tree.primitive_ids[slot]];
    };
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        const auto& [box, first, count] = tree.nodes[i];
        looks[i] = count == 0 ? looks[first] : part_at(first).look;
        const std::uint32_t more = count == 0 ? 2 : count;
        for (std::uint32_t k = 1; k < more; ++k)
            if ((count == 0 ? looks[first + k] : part_at(first + k).look) != looks[i])
                looks[i] = several;
    }
    std::vector<std::uint32_t> open;
    for (const ContactPartT<T>& part : parts) {
        open.assign(1, 0);
        while (!open.empty()) {
            if (--budget < 0) return;
            const std::uint32_t at = open.back();
            open.pop_back();
            const auto& [box, first, count] = tree.nodes[at];
            if (looks[at] == part.look || !overlap(box, part.box)) continue;
            if (count == 0) open.insert(open.end(), {first, first + 1});
            for (std::uint32_t slot = first; slot < first + count; ++slot)
                if (const ContactPartT<T>& other = part_at(slot);
                    part.look < other.look && overlap(part.box, other.box))
                    visit(part, other);
        }
    }
}

/// Finds the contacts between parts of objects.
/// \param parts   With boxes that contain them.
/// \param piece   The surface of a part.
/// \return Contacts by pairs of objects, each pair once, in the order of the search.
template <std::floating_point T>
[[nodiscard, gnu::cold]] ContactsT<T>
contacts_between(const std::vector<ContactPartT<T>>& parts,
                 FunctionRef<SurfacePiece(const ContactPartT<T>&)> piece) {
    ContactsT<T> found;
    const auto visit = [&](const ContactPartT<T>& a, const ContactPartT<T>& b) {
        const T reach = reach_of(box_union(a.box, b.box));
        const auto shared =
            shared_place(piece(a), piece(b), double(contact_distance(reach)));
        if (!shared) return;
        const bool area = shared->over_area;
        found.pairs.push_back(
            {.pair{std::min(a.object, b.object), std::max(a.object, b.object)},
             .box = widened(
                 BoxT<T>{Vec3T<T>(shared->box.low), Vec3T<T>(shared->box.high)}, reach),
             .over_area = area,
             .alike = area && shared->alike,
             .opposed = area && !shared->alike});
    };
    long long budget = 1'000'000'000;
    overlapping_parts(parts, budget, visit);
    found.complete = budget >= 0;
    auto& pairs = found.pairs;
    std::sort(pairs.begin(), pairs.end(),
              [](const auto& a, const auto& b) { return a.pair < b.pair; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (i == 0 || pairs[i].pair != pairs[kept - 1].pair) {
            pairs[kept++] = pairs[i];
            continue;
        }
        ContactT<T>& same = pairs[kept - 1];
        same.box = box_union(same.box, pairs[i].box);
        same.over_area |= pairs[i].over_area;
        same.alike |= pairs[i].alike;
        same.opposed |= pairs[i].opposed;
    }
    pairs.resize(kept);
    return found;
}

/// The bounding box of a shape: its own bounds(), or those of its bounding sphere.
template <Shape S>
[[nodiscard]] auto box_around(const S& shape) {
    if constexpr (requires { bounds(shape); })
        return bounds(shape);
    else
        return bounds(bounding_sphere(shape));
}

/// Whether a shape consists of triangles.
template <typename G>
inline constexpr bool has_triangles = requires(const G& mesh) {
    facet_of(mesh.triangle(mesh.size()));
};

/// The shapes of one type, behind functions that are compiled once per type, not once
/// per scene. Each takes the list and a position in it.
template <std::floating_point T>
struct ContactShapesT {
    const void* list; ///< A vector of shapes.
    BoxT<T> (*box)(const void*, std::uint32_t);
    double (*area)(const void*, std::uint32_t); ///< 0 if the shape does not know it.
    std::uint32_t (*parts)(const void*, std::uint32_t); ///< 0: it is not compared.
    SurfacePiece (*piece)(const void*, std::uint32_t, std::uint32_t part);
};

/// A list of shapes for a search.
template <Shape G>
[[nodiscard]] ContactShapesT<ScalarOf<G>> contact_shapes(const std::vector<G>& list) {
    using T = ScalarOf<G>;
    static constexpr auto at = [](const void* shapes, std::uint32_t i) -> const G& {
        return (*static_cast<const std::vector<G>*>(shapes))[i];
    };
    constexpr bool flat = requires(const G& shape) {
        facet_of(shape);
    };
    constexpr bool ball = std::is_same_v<G, SphereT<T>>;
    return {
        .list = &list,
        .box = [](const void* all, std::uint32_t i) { return box_around(at(all, i)); },
        .area =
            []([[maybe_unused]] const void* all, [[maybe_unused]] std::uint32_t i) {
                if constexpr (HasArea<G>)
                    return double(area(at(all, i)));
                else
                    return 0.0;
            },
        .parts =
            []([[maybe_unused]] const void* all, [[maybe_unused]] std::uint32_t i) {
                if constexpr (has_triangles<G>)
                    return static_cast<std::uint32_t>(at(all, i).size());
                else
                    return flat || ball ? 1u : 0u;
            },
        .piece =
            []([[maybe_unused]] const void* all, [[maybe_unused]] std::uint32_t i,
               [[maybe_unused]] std::uint32_t part) {
                SurfacePiece piece;
                if constexpr (flat)
                    piece.facet = facet_of(at(all, i));
                else if constexpr (has_triangles<G>)
                    piece.facet = facet_of(at(all, i).triangle(part));
                else if constexpr (ball)
                    piece.sphere = {glm::dvec3(at(all, i).center),
                                    double(at(all, i).radius)};
                return piece;
            }};
}

/// What decides between surfaces in one place, in this order: kind, emission, index of
/// refraction, absorption, area, what is reflected. The smaller list is met.
using ContactKey = std::array<double, 15>;

/// Writes a colour into a key: the brighter one is smaller.
template <std::floating_point T>
void put_color(ContactKey& key, std::size_t at, const RgbT<T>& color) {
    key[at] = -double(color.x) - double(color.y) - double(color.z);
    key[at + 1] = -double(color.x);
    key[at + 2] = -double(color.y);
}

/// The materials of one type, as ContactShapesT.
struct ContactMaterials {
    const void* list;                                ///< A vector of materials.
    std::uint32_t count;                             ///< Its size.
    ContactKind (*kind)(const void*, std::uint32_t); ///< Without emission.
    void (*put)(const void*, std::uint32_t, ContactKey&);
};

/// A list of materials for a search.
template <Material M>
[[nodiscard]] ContactMaterials contact_materials(const std::vector<M>& list) {
    using T = typename M::Scalar;
    static constexpr auto at = [](const void* all, std::uint32_t i) -> const M& {
        return (*static_cast<const std::vector<M>*>(all))[i];
    };
    return {.list = &list,
            .count = static_cast<std::uint32_t>(list.size()),
            .kind =
                []([[maybe_unused]] const void* all, [[maybe_unused]] std::uint32_t i) {
                    if constexpr (requires(const M& m) {
                                      pass_through(m, Vec3T<T>{}, Vec3T<T>{});
                                  })
                        return ContactKind::sheet;
                    else if constexpr (Refractive<M>)
                        return refractive_index(at(all, i)) > T(0)
                                   ? ContactKind::body
                                   : ContactKind::opaque;
                    else
                        return MayAbsorb<M> ? ContactKind::body : ContactKind::opaque;
                },
            .put =
                [](const void* all, std::uint32_t i, ContactKey& key) {
                    const M& m = at(all, i);
                    if constexpr (Refractive<M>) key[4] = -double(refractive_index(m));
                    if constexpr (MayAbsorb<M>) put_color(key, 5, absorption(m));
                    const Vec3T<T> wo{T(0.6), T(0), T(0.8)}, up{T(0), T(0), T(1)};
                    const auto& here = material_at(m, Vec3T<T>{T(0)}, Vec2T<T>{T(0.5)});
                    put_color(key, 9, evaluate(here, wo, up));
                    if (const auto next = sample(here, wo, Vec3T<T>{T(0.5)},
                                                 Transport::flux, Lobes::all))
                        put_color(key, 12, next->weight);
                }};
}

/// A search for contacts: what is known of a scene, and of each object.
template <std::floating_point T>
struct ContactSearchT {
    std::span<const ContactShapesT<T>> shapes;        ///< By type.
    std::span<const ContactMaterials> materials;      ///< By type.
    std::span<const std::vector<ObjectT<T>>> objects; ///< By type of shape.
    std::vector<ObjectId> ids{};                      ///< All objects.
    std::vector<ContactKind> kinds{};                 ///< What they are.
    std::vector<ContactPartT<T>> whole{};             ///< Their boxes and looks.
    std::vector<std::uint32_t> before{0}; ///< Number of materials of the types before.

    /// The number of a material.
    [[nodiscard]] std::uint32_t number(MaterialId material) const {
        return before[material.type] + material.index;
    }
    /// The properties of an object.
    [[nodiscard]] const ObjectT<T>& object(ObjectId id) const {
        return objects[id.type][id.index];
    }
};

/// Lists the objects of a search.
template <std::floating_point T>
void list_objects(ContactSearchT<T>& search) {
    for (const ContactMaterials& list : search.materials)
        search.before.push_back(search.before.back() + list.count);
    for (std::uint32_t type = 0; type < search.shapes.size(); ++type)
        for (std::uint32_t i = 0; i < search.objects[type].size(); ++i) {
            const ObjectT<T>& object = search.objects[type][i];
            const auto [of, which] = object.material;
            const auto number = static_cast<std::uint32_t>(search.ids.size());
            const ContactKind kind =
                is_black(object.emission)
                    ? search.materials[of].kind(search.materials[of].list, which)
                    : ContactKind::lamp;
            const BoxT<T> box = search.shapes[type].box(search.shapes[type].list, i);
            search.ids.push_back({type, i});
            search.kinds.push_back(kind);
            search.whole.push_back({.box = widened(box, reach_of(box)),
                                    .object = number,
                                    .look = kind == ContactKind::opaque
                                                ? search.number(object.material)
                                                : search.before.back() + number});
        }
}

/// The piece of a surface that is a part in a search.
template <std::floating_point T>
[[nodiscard]] SurfacePiece piece_of(const ContactSearchT<T>& search,
                                    const ContactPartT<T>& part) {
    const ObjectId id = search.ids[part.object];
    const ContactShapesT<T>& shapes = search.shapes[id.type];
    SurfacePiece piece = shapes.piece(shapes.list, id.index, part.part);
    piece.inside_out = search.object(id).inside_out;
    return piece;
}

/// The parts of objects that may touch another object.
template <std::floating_point T>
[[nodiscard]] std::vector<ContactPartT<T>> list_parts(const ContactSearchT<T>& search) {
    std::vector<ContactPartT<T>> parts;
    for (const ContactPartT<T>& object : search.whole) {
        const ObjectId id = search.ids[object.object];
        const ContactShapesT<T>& shapes = search.shapes[id.type];
        const std::uint32_t count = shapes.parts(shapes.list, id.index);
        if (count == 1) parts.push_back(object);
        if (count <= 1) continue;
        std::vector<BoxT<T>> others;
        for (const ContactPartT<T>& other : search.whole)
            if (other.look != object.look && overlap(other.box, object.box))
                others.push_back(other.box);
        const bool few = others.size() <= 64; // otherwise the search is faster
        ContactPartT<T> part = object;
        for (; part.part < count; ++part.part) {
            const BoxT<double> box = box_of(piece_of(search, part));
            part.box = {Vec3T<T>(box.low), Vec3T<T>(box.high)};
            part.box = widened(part.box, reach_of(part.box));
            const auto near = [&](const BoxT<T>& other) {
                return overlap(other, part.box);
            };
            if (!few || std::any_of(others.begin(), others.end(), near))
                parts.push_back(part);
        }
    }
    return parts;
}

/// The area of each material in a scene, by the material's number, in units of 2^-30 of
/// the largest area of an object: sums of whole numbers do not depend on an order.
template <std::floating_point T>
[[nodiscard, gnu::cold]] std::vector<long long>
covered_areas(const ContactSearchT<T>& search) {
    std::vector<long long> covered(search.before.back());
    double most = 0;
    const auto area = [&](ObjectId id) {
        const ContactShapesT<T>& shapes = search.shapes[id.type];
        return shapes.area(shapes.list, id.index);
    };
    for (const ObjectId id : search.ids) most = std::max(most, area(id));
    for (const ObjectId id : search.ids)
        if (const double part = area(id) / most; part <= 1) // not where most is 0
            covered[search.number(search.object(id).material)] +=
                std::llround(std::ldexp(part, 30));
    return covered;
}

/// Completes contacts: the objects that take part, and which of them is met.
/// \param contacts  Its pairs hold numbers of objects; they become positions.
template <std::floating_point T>
[[gnu::cold]] void rank_contacts(const ContactSearchT<T>& search,
                                 ContactsT<T>& contacts) {
    const std::vector<long long> covered = covered_areas(search);
    for (const auto& list : search.objects)
        contacts.position.emplace_back(list.size(), 0xffffffffu);
    std::vector<ContactKey> keys;
    for (ContactT<T>& contact : contacts.pairs) {
        contacts.box = box_union(contacts.box, contact.box);
        for (std::uint32_t& one : contact.pair) { // becomes a position
            const ObjectId id = search.ids[one];
            std::uint32_t& at = contacts.position[id.type][id.index];
            if (at == 0xffffffffu) {
                at = static_cast<std::uint32_t>(keys.size());
                const ContactKind kind = search.kinds[one];
                contacts.objects.push_back({.object = id, .kind = kind});
                const ObjectT<T>& object = search.object(id);
                ContactKey& key = keys.emplace_back();
                key[0] = double(kind);
                put_color(key, 1, object.emission);
                key[8] = double(covered[search.number(object.material)]);
                const ContactMaterials& list = search.materials[object.material.type];
                list.put(list.list, object.material.index, key);
            }
            one = at;
        }
        for (std::size_t k = 0; k < 2; ++k)
            contacts.objects[contact.pair[k]].others.emplace_back(contact.pair[1 - k],
                                                                  contact.box);
    }
    std::vector<std::uint32_t> order;
    for (std::uint32_t at = 0; at < keys.size(); ++at) order.push_back(at);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
    });
    for (std::uint32_t rank = 0; rank < order.size(); ++rank)
        contacts.objects[order[rank]].rank = rank;
}

/// The contacts of a search, which need not know the types of a scene.
template <std::floating_point T>
[[nodiscard, gnu::cold]] ContactsT<T> contacts_of(ContactSearchT<T> search) {
    list_objects(search);
    const auto one_look = [&](const auto& part) {
        return part.look == search.whole[0].look;
    };
    if (std::all_of(search.whole.begin(), search.whole.end(), one_look)) return {};
    const auto piece = [&](const ContactPartT<T>& part) {
        return piece_of(search, part);
    };
    auto contacts = contacts_between<T>(list_parts(search), piece);
    if (!contacts.pairs.empty()) rank_contacts(search, contacts);
    return contacts;
}

} // namespace detail

/// Finds the contacts of a scene.
/// \param world  A World; of its members, shapes, objects and materials are used.
/// \return The contacts; only their own order depends on the order of addition.
/// \cost O(n log n) boxes; less where neighbours are opaque and of one material.
// [find_contacts]
template <typename W>
[[nodiscard, gnu::cold]] ContactsT<typename W::Scalar> find_contacts(const W& world) {
    using T = typename W::Scalar;
    return std::apply(
        [&](const auto&... shapes) {
            return std::apply(
                [&](const auto&... materials) {
                    const std::array<detail::ContactShapesT<T>, sizeof...(shapes)> s{
                        detail::contact_shapes(shapes)...};
                    const std::array<detail::ContactMaterials, sizeof...(materials)> m{
                        detail::contact_materials(materials)...};
                    return detail::contacts_of<T>(
                        {.shapes = s, .materials = m, .objects = world.objects()});
                },
                world.materials());
        },
        world.shapes());
}
// [find_contacts]

/// \}

} // namespace ljus
