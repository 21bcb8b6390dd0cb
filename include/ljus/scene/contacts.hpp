#pragma once

/// \file ljus/scene/contacts.hpp
/// \brief Which objects of a scene have surfaces in one place, and which surface counts
/// there.

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

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

/// Visits the pairs of parts of different looks whose boxes overlap, some more than
/// once. The list is halved across the axis that separates it best, until that helps no
/// more.
/// \param budget  Decreases by the number of comparisons; the search ends at 0.
template <std::floating_point T, typename Visit>
void overlapping_parts(std::vector<ContactPartT<T>> list, long long& budget,
                       const Visit& visit) {
    const auto alike = [&](const ContactPartT<T>& part) {
        return part.look == list[0].look;
    };
    if (std::all_of(list.begin(), list.end(), alike)) return;
    const auto size = list.size();
    if (size > 16) {
        Vec3T<T> twice{0};
        for (const auto& part : list) twice += part.box.low + part.box.high;
        const Vec3T<T> middle = twice / (T(2) * T(size));
        std::array<std::size_t, 3> below{}, above{}; // how many reach to each side
        for (const auto& part : list)
            for (glm::length_t axis = 0; axis < 3; ++axis) {
                const auto k = static_cast<std::size_t>(axis);
                below[k] += part.box.low[axis] <= middle[axis] ? 1 : 0;
                above[k] += part.box.high[axis] >= middle[axis] ? 1 : 0;
            }
        std::size_t k = 0, least = 3 * size;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t both = below[axis] + above[axis];
            if (5 * std::max(below[axis], above[axis]) > 4 * size || both >= least)
                continue;
            k = axis;
            least = both;
        }
        if (4 * least <= 5 * size) {
            const auto axis = static_cast<glm::length_t>(k);
            std::vector<ContactPartT<T>> half;
            half.reserve(below[k]);
            for (const auto& part : list)
                if (part.box.low[axis] <= middle[axis]) half.push_back(part);
            overlapping_parts(std::move(half), budget, visit);
            std::erase_if(list, [&](const ContactPartT<T>& part) {
                return !(part.box.high[axis] >= middle[axis]);
            });
            return overlapping_parts(std::move(list), budget, visit);
        }
    }
    std::sort(list.begin(), list.end(),
              [](const auto& a, const auto& b) { return a.look < b.look; });
    for (auto group = list.begin(); group != list.end();) {
        const auto next = std::find_if(group, list.end(), [&](const auto& part) {
            return part.look != group->look;
        });
        for (; group != next; ++group)
            for (auto other = next; other != list.end(); ++other) {
                if (--budget < 0) return;
                if (overlap(group->box, other->box)) visit(*group, *other);
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
    long long budget = 100'000'000;
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

/// The materials of one type, as ContactShapesT.
struct ContactMaterials {
    const void* list;                                ///< A vector of materials.
    std::uint32_t count;                             ///< Its size.
    ContactKind (*kind)(const void*, std::uint32_t); ///< Without emission.
    /// Numbers that tell materials apart: of a body, and of what it reflects.
    std::array<std::vector<double>, 2> (*key)(const void*, std::uint32_t);
};

/// A list of materials for a search.
template <Material M>
[[nodiscard]] ContactMaterials contact_materials(const std::vector<M>& list) {
    using T = typename M::Scalar;
    static constexpr auto at = [](const void* all, std::uint32_t i) -> const M& {
        return (*static_cast<const std::vector<M>*>(all))[i];
    };
    static constexpr auto add = [](std::vector<double>& key, const RgbT<T>& color) {
        key.push_back(-double(color.x) - double(color.y) - double(color.z));
        for (int c = 0; c < 3; ++c) key.push_back(-double(color[c]));
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
            .key =
                [](const void* all, std::uint32_t i) {
                    const M& m = at(all, i);
                    std::array<std::vector<double>, 2> key;
                    if constexpr (Refractive<M>)
                        key[0].push_back(-double(refractive_index(m)));
                    if constexpr (MayAbsorb<M>) add(key[0], absorption(m));
                    const Vec3T<T> wo{T(0.6), T(0), T(0.8)}, up{T(0), T(0), T(1)};
                    const auto& here = material_at(m, Vec3T<T>{T(0)}, Vec2T<T>{T(0.5)});
                    add(key[1], evaluate(here, wo, up));
                    const auto next =
                        sample(here, wo, Vec3T<T>{T(0.5)}, Transport::flux, Lobes::all);
                    add(key[1], next ? next->weight : RgbT<T>{T(0)});
                    return key;
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

    /// The properties of an object.
    [[nodiscard]] const ObjectT<T>& object(ObjectId id) const {
        return objects[id.type][id.index];
    }
};

/// Lists the objects of a search.
template <std::floating_point T>
void list_objects(ContactSearchT<T>& search) {
    std::vector<std::uint32_t> before{0}; // materials of the types before
    for (const ContactMaterials& list : search.materials)
        before.push_back(before.back() + list.count);
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
                                                ? before[of] + which
                                                : before.back() + number});
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

/// Completes contacts: the objects that take part, and which of them is met.
/// \param contacts  Its pairs hold numbers of objects; they become positions.
template <std::floating_point T>
void rank_contacts(const ContactSearchT<T>& search, ContactsT<T>& contacts) {
    using Id = std::pair<std::uint32_t, std::uint32_t>;
    std::map<Id, std::vector<double>> areas; // by material
    for (const ObjectId id : search.ids) {
        const MaterialId material = search.object(id).material;
        const ContactShapesT<T>& shapes = search.shapes[id.type];
        areas[{material.type, material.index}].push_back(
            shapes.area(shapes.list, id.index));
    }
    for (auto& [material, list] : areas) { // sorted, so that the order has no effect
        std::sort(list.begin(), list.end());
        list = {std::accumulate(list.begin(), list.end(), 0.0)};
    }
    for (const ContactT<T>& contact : contacts.pairs)
        contacts.box = box_union(contacts.box, contact.box);
    for (const auto& list : search.objects)
        contacts.position.emplace_back(list.size(), 0xffffffffu);
    std::vector<std::vector<double>> keys; // the smallest is met
    const auto position = [&](std::uint32_t number) {
        const ObjectId id = search.ids[number];
        std::uint32_t& at = contacts.position[id.type][id.index];
        if (at < contacts.objects.size()) return at;
        at = static_cast<std::uint32_t>(contacts.objects.size());
        const ContactKind kind = search.kinds[number];
        contacts.objects.push_back({.object = id, .kind = kind});
        const ObjectT<T>& object = search.object(id);
        const auto [of, which] = object.material;
        const double area = areas[{of, which}][0];
        const auto [body, reflected] =
            search.materials[of].key(search.materials[of].list, which);
        std::vector<double> key{double(kind)};
        if (kind == ContactKind::lamp)
            for (const double less :
                 {-double(object.emission.x) - double(object.emission.y) -
                      double(object.emission.z),
                  -double(object.emission.x), -double(object.emission.y)})
                key.push_back(less);
        key.insert(key.end(), body.begin(), body.end());
        key.push_back(area);
        key.insert(key.end(), reflected.begin(), reflected.end());
        keys.push_back(std::move(key));
        return at;
    };
    for (ContactT<T>& contact : contacts.pairs) {
        for (std::uint32_t& one : contact.pair) one = position(one);
        for (std::size_t k = 0; k < 2; ++k)
            contacts.objects[contact.pair[k]].others.emplace_back(contact.pair[1 - k],
                                                                  contact.box);
    }
    std::vector<std::uint32_t> order(keys.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return keys[a] < keys[b];
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
