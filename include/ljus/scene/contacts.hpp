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

/// The kind of an object.
template <Material M, std::floating_point T>
[[nodiscard]] ContactKind contact_kind(const M& m, const RgbT<T>& emitted) {
    if (!is_black(emitted)) return ContactKind::lamp;
    if constexpr (requires { pass_through(m, Vec3T<T>{}, Vec3T<T>{}); })
        return ContactKind::sheet;
    else if constexpr (Refractive<M>)
        return refractive_index(m) > T(0) ? ContactKind::body : ContactKind::opaque;
    else
        return MayAbsorb<M> ? ContactKind::body : ContactKind::opaque;
}

/// What is compared between objects of one kind; the smaller list is met. It depends on
/// nothing but the materials, the emission and the areas.
/// \param area  Of the material in the whole scene.
template <Material M, std::floating_point T>
[[nodiscard, gnu::cold]] std::vector<double>
contact_key(const M& m, ContactKind kind, const RgbT<T>& emitted, double area) {
    std::vector<double> key{double(kind)};
    const auto add = [&](const RgbT<T>& color) {
        key.push_back(-double(color.x) - double(color.y) - double(color.z));
        for (int c = 0; c < 3; ++c) key.push_back(-double(color[c]));
    };
    if (kind == ContactKind::lamp) add(emitted);
    if constexpr (Refractive<M>) key.push_back(-double(refractive_index(m)));
    if constexpr (MayAbsorb<M>) add(absorption(m));
    key.push_back(area);
    const Vec3T<T> wo{T(0.6), T(0), T(0.8)}, up{T(0), T(0), T(1)};
    const auto& here = material_at(m, Vec3T<T>{T(0)}, Vec2T<T>{T(0.5)});
    add(evaluate(here, wo, up));
    const auto next = sample(here, wo, Vec3T<T>{T(0.5)}, Transport::flux, Lobes::all);
    add(next ? next->weight : RgbT<T>{T(0)});
    return key;
}

/// Whether a shape consists of triangles.
template <typename G>
inline constexpr bool has_triangles = requires(const G& mesh) {
    facet_of(mesh.triangle(mesh.size()));
};

/// A part of a shape at rest; an empty sphere for shapes of which no part is compared.
template <Shape G>
[[nodiscard]] SurfacePiece piece_of(const G& shape, std::uint32_t part,
                                    bool inside_out) {
    SurfacePiece piece{.inside_out = inside_out};
    if constexpr (requires { facet_of(shape); })
        piece.facet = facet_of(shape);
    else if constexpr (has_triangles<G>)
        piece.facet = facet_of(shape.triangle(part));
    else if constexpr (std::is_same_v<G, SphereT<ScalarOf<G>>>)
        piece.sphere = {glm::dvec3(shape.center), double(shape.radius)};
    return piece;
}

/// Adds the parts of an object that may touch another one to the list of a search.
/// \param whole  All objects.
template <Shape G>
void add_parts(const G& shape, const ContactPartT<ScalarOf<G>>& object,
               const std::vector<ContactPartT<ScalarOf<G>>>& whole,
               std::vector<ContactPartT<ScalarOf<G>>>& parts) {
    using T = ScalarOf<G>;
    if constexpr (has_triangles<G>) {
        std::vector<BoxT<T>> others;
        for (const auto& other : whole)
            if (other.look != object.look && overlap(other.box, object.box))
                others.push_back(other.box);
        const bool few = others.size() <= 64; // otherwise the search is faster
        ContactPartT<T> part = object;
        for (; part.part < shape.size(); ++part.part) {
            part.box = bounds(shape.triangle(part.part));
            part.box = widened(part.box, reach_of(part.box));
            const auto near = [&](const BoxT<T>& box) {
                return overlap(box, part.box);
            };
            if (!few || std::any_of(others.begin(), others.end(), near))
                parts.push_back(part);
        }
    } else if constexpr (requires { facet_of(shape); } ||
                         std::is_same_v<G, SphereT<T>>) {
        parts.push_back(object);
    }
}

/// Completes contacts: the objects that take part, and which of them is met.
/// \param ids    The objects, in the order of the search.
/// \param kinds  What they are.
/// \param contacts  Its pairs hold numbers of `ids`; they become positions.
template <typename W, std::floating_point T>
[[gnu::cold]] void rank_contacts(const W& world, const std::vector<ObjectId>& ids,
                                 const std::vector<ContactKind>& kinds,
                                 ContactsT<T>& contacts) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<double>> areas;
    for (const ObjectId id : ids)
        world.visit_shape(id, [&]<typename G>(const G& shape) {
            const MaterialId material = world.object(id).material;
            if constexpr (HasArea<G>)
                areas[{material.type, material.index}].push_back(double(area(shape)));
        });
    for (auto& [material, list] : areas) { // sorted, so that the order is no matter
        std::sort(list.begin(), list.end());
        list = {std::accumulate(list.begin(), list.end(), 0.0)};
    }
    for (const ContactT<T>& contact : contacts.pairs)
        contacts.box = box_union(contacts.box, contact.box);
    contacts.position.resize(world.objects().size());
    for (std::size_t type = 0; type < world.objects().size(); ++type)
        contacts.position[type].assign(world.objects()[type].size(), 0xffffffffu);
    std::vector<std::vector<double>> keys;
    const auto position = [&](std::uint32_t number) {
        const ObjectId id = ids[number];
        std::uint32_t& at = contacts.position[id.type][id.index];
        if (at < contacts.objects.size()) return at;
        at = static_cast<std::uint32_t>(contacts.objects.size());
        contacts.objects.push_back({.object = id, .kind = kinds[number]});
        const ObjectT<T>& object = world.object(id);
        const auto& area = areas[{object.material.type, object.material.index}];
        keys.push_back(world.visit_material(object.material, [&](const auto& m) {
            return contact_key(m, kinds[number], object.emission,
                               area.empty() ? 0.0 : area[0]);
        }));
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

} // namespace detail

/// Finds the contacts of a scene.
/// \param world  A World; of its members, shapes, objects and materials are used.
/// \return The contacts; nothing that depends on the order of addition but their order.
/// \cost O(n log n) boxes; less where neighbours are opaque and of one material.
// [find_contacts]
template <typename W>
[[nodiscard, gnu::cold]] ContactsT<typename W::Scalar> find_contacts(const W& world) {
    using T = typename W::Scalar;
    std::vector<ObjectId> ids;
    std::vector<ContactKind> kinds;
    std::vector<detail::ContactPartT<T>> whole, parts;
    std::vector<std::uint32_t> materials_before{0};
    const auto count = [&](const auto& list) {
        materials_before.push_back(materials_before.back() +
                                   static_cast<std::uint32_t>(list.size()));
    };
    std::apply([&](const auto&... lists) { (count(lists), ...); }, world.materials());
    std::uint32_t type = 0;
    const auto add_objects = [&](const auto& list) {
        for (std::uint32_t i = 0; i < list.size(); ++i) {
            const ObjectT<T>& object = world.object({type, i});
            const auto number = static_cast<std::uint32_t>(ids.size());
            ids.push_back({type, i});
            kinds.push_back(world.visit_material(object.material, [&](const auto& m) {
                return detail::contact_kind(m, object.emission);
            }));
            const bool plain = kinds.back() == ContactKind::opaque;
            const BoxT<T> box = detail::box_around(list[i]);
            whole.push_back({.box = detail::widened(box, detail::reach_of(box)),
                             .object = number,
                             .look = plain ? materials_before[object.material.type] +
                                                 object.material.index
                                           : materials_before.back() + number});
        }
        ++type;
    };
    std::apply([&](const auto&... lists) { (add_objects(lists), ...); },
               world.shapes());
    const auto one_look = [&](const auto& part) { return part.look == whole[0].look; };
    if (std::all_of(whole.begin(), whole.end(), one_look)) return {};

    for (const auto& object : whole)
        world.visit_shape(ids[object.object], [&](const auto& shape) {
            detail::add_parts(shape, object, whole, parts);
        });
    const auto piece = [&](const detail::ContactPartT<T>& part) {
        return world.visit_shape(ids[part.object], [&](const auto& shape) {
            return detail::piece_of(shape, part.part,
                                    world.object(ids[part.object]).inside_out);
        });
    };
    auto contacts = detail::contacts_between<T>(parts, piece);
    if (!contacts.pairs.empty()) detail::rank_contacts(world, ids, kinds, contacts);
    return contacts;
}
// [find_contacts]

/// \}

} // namespace ljus
