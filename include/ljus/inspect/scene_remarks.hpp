#pragma once

/// \file ljus/inspect/scene_remarks.hpp
/// \brief Warnings about a scene that a renderer shows badly, each with a remedy.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "ljus/hook.hpp"
#include "ljus/image/color.hpp"
#include "ljus/math/random.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/photons/irradiance_estimate.hpp"
#include "ljus/photons/kernel_border.hpp"
#include "ljus/render/passes.hpp"

namespace ljus {

/// \addtogroup survey
/// \{

namespace detail {

/// Follows a line parallel to a photon's normal, and adds up the kernel's weights where
/// the line meets surfaces at which an estimate would use the photon. Each weight is
/// divided by the cosine between the normals. On a flat surface the sum is the weight
/// at `offset`.
/// \param offset  The vector from the photon to the line, perpendicular to the normal,
///                in units of the radius.
template <AnyWorld W, std::floating_point T, typename K>
[[nodiscard]] double found_along(const W& world, const SurfacePointT<T>& photon,
                                 const Vec3T<T>& offset,
                                 const DensityEstimateOf<K>& gather) {
    const T radius = T(gather.radius), height = T(gather.thickness) * radius;
    RayT<T> line{.origin = photon.position + radius * offset - height * photon.normal,
                 .direction = photon.normal,
                 .t_max = T(2) * height};
    double found = 0;
    for (int surfaces = 0; surfaces < 8; ++surfaces) {
        const auto hit = closest_hit(world, line);
        if (!hit) break;
        const auto point = vertex_at(world, line, *hit).point;
        const Vec3T<T> way = point.position - photon.position;
        const T distance2 = glm::dot(way, way) / (radius * radius);
        const T cosine = glm::dot(point.normal, photon.normal); // as in turned_away()
        if (cosine > T(0.5) && distance2 < T(1) &&
            std::abs(glm::dot(way, point.normal)) < height)
            found += double(kernel_weight(gather.kernel, distance2) / cosine);
        line.t_min = hit->at.t + T(1e-4) * radius;
    }
    return found;
}

} // namespace detail

/// The fraction of light that estimates lose at the edges of the object that loses
/// most. An estimate spreads each photon over a disc, and flux beyond the edges of the
/// object is lost. Objects with few sampled photons count together, as one object.
/// Estimates are assumed to use all photons within the radius. The seed is for random
/// points in the discs.
/// \return In [0, 1]; 0 if fewer than 16 sampled photons landed in total.
/// \cost About nine rays for each of at most 4096 photons.
template <AnyWorld W, std::floating_point T, typename K>
[[nodiscard, gnu::cold]] double edge_loss(const W& world, const PhotonMapT<T>& map,
                                          const DensityEstimateOf<K>& gather,
                                          PhotonKinds kinds, std::uint64_t seed) {
    constexpr int places = 4, few = 16;
    struct Landed {
        ObjectId object{};
        double flux = 0, found = 0;
        int photons = 1;
    };
    std::vector<Landed> all;
    const std::size_t step = map.records.size() / 4096 + 1;
    for (std::size_t i = 0; i < map.records.size(); i += step) {
        const detail::PhotonRecordT<T> photon = map.records[i];
        if (!kinds.has(photon.kind)) continue;
        const Vec3T<T> place = map.tree.point(i);
        const Vec3T<T> normal = glm::normalize(Vec3T<T>(photon.normal));
        const T near = T(1e-3f * gather.radius);
        const auto vertex = detail::vertex_below(world, place, normal, near);
        if (!vertex || vertex->emits()) continue; // reflections of lamps hardly show
        const FrameT<T> frame = frame_around(vertex->point.normal);
        auto stream = random_stream(seed, Pass::irradiance, 0, i);
        Landed landed{.object = vertex->id};
        for (int k = 0; k < places; ++k) {
            const T distance2 = (T(k) + next_1d<T>(stream)) / T(places);
            const T azimuth = T(2) * std::numbers::pi_v<T> * next_1d<T>(stream);
            const Vec3T<T> offset =
                std::sqrt(distance2) * (std::cos(azimuth) * frame.tangent +
                                        std::sin(azimuth) * frame.bitangent);
            const double flux = luminance(RgbT<double>(photon.flux));
            landed.flux += flux * double(kernel_weight(gather.kernel, distance2));
            landed.found +=
                flux * detail::found_along(world, vertex->point, offset, gather);
        }
        all.push_back(landed);
    }
    const auto order = [](const Landed& a, const Landed& b) {
        return a.object.type != b.object.type ? a.object.type < b.object.type
                                              : a.object.index < b.object.index;
    };
    std::sort(all.begin(), all.end(), order);
    double most = 0;
    const auto judge = [&](const Landed& sum) {
        if (sum.photons >= few) most = std::max(most, 1 - sum.found / sum.flux);
    };
    Landed rest{.photons = 0};
    for (auto i = all.begin(); i != all.end();) {
        Landed sum{.photons = 0};
        const auto end = std::upper_bound(i, all.end(), *i, order);
        for (; i != end; ++i) {
            sum.flux += i->flux;
            sum.found += i->found;
            ++sum.photons;
        }
        judge(sum);
        if (sum.photons >= few) continue;
        rest.flux += sum.flux;
        rest.found += sum.found;
        rest.photons += sum.photons;
    }
    judge(rest);
    return most;
}

namespace detail {

/// Warns if coordinates leave fewer than three digits for a shape, or if lengths are
/// too large for the precision of the world.
///
/// A number x with a mantissa of p bits has an error of up to 2^-p x. The surface of a
/// ball of radius r with coordinates up to c then has an error of 2^-p c / r, relative
/// to r. This leaves log10(2^p r / c) decimal digits. The direction of a shadow ray is
/// as long as the ray, and chord() multiplies four lengths. A ball may therefore cast
/// no shadow if a length exceeds the fourth root of the largest number.
template <AnyWorld W>
[[nodiscard, gnu::cold]] std::string digits_remark(const W& world) {
    using T = typename W::Scalar;
    constexpr bool single = std::is_same_v<T, float>;
    constexpr double widest = single ? 1e9 : 1e75;
    const auto in_double = [](const auto& shape) {
        const SphereT<T> ball = bounding_sphere(shape);
        return SphereT<double>{Vec3T<double>(ball.center), double(ball.radius)};
    };
    double most = 1, radius = 0, reach = 0;
    world.each_object([&](ObjectId id, const auto&) {
        const SphereT<double> bound = world.visit_shape(id, in_double);
        // [digits]
        const Vec3T<double> far = glm::abs(bound.center) + bound.radius;
        reach = std::max(reach, max_component(far));
        const double ratio = max_component(far) / bound.radius;
        if (!(ratio > most)) return;
        most = ratio;
        radius = bound.radius;
    });
    constexpr double half = double(std::numeric_limits<T>::epsilon()) / 2;
    const int digits = int(std::max(0.0, std::floor(-std::log10(half * most))));
    // [digits]
    char times[40], size[40];
    if (digits >= 3) {
        if (!(reach > widest)) return {};
        std::snprintf(times, sizeof times, "%.0e", reach);
        return join({"coordinates reach ", times,
                     single ? ": above 1e9 the squares of areas leave the range of "
                              "float; use double, or a larger unit of length"
                            : ": above 1e75 the squares of areas leave the range of "
                              "double; use a larger unit of length"});
    }
    if (!std::isfinite(most)) // all corners are one point
        return join({"an object is so small or so far away that ",
                     single ? "float" : "double", " keeps nothing of its size; ",
                     single ? "use double, or move the scene towards the origin"
                            : "move the scene towards the origin"});
    std::snprintf(times, sizeof times, "%.0e", most);
    std::snprintf(size, sizeof size, "%.3g", radius);
    return join({"coordinates reach ", times, " times the smallest radius, ", size,
                 single ? ": float keeps " : ": double keeps ", to_text(digits),
                 digits == 1 ? " digit of it; " : " digits of it; ",
                 single ? "use double, or move the scene towards the origin"
                        : "move the scene towards the origin"});
}

/// The number of objects with a glossy lobe so narrow that a shadow ray hardly ever
/// lies in it: the density of the lobe is above 1000 per steradian.
template <AnyWorld W>
[[nodiscard, gnu::cold]] std::size_t narrow_lobes(const W& world) {
    using T = typename W::Scalar;
    // A direction that is reflected by a facet almost parallel to the surface.
    const Vec3T<T> wo{T(0.6), T(0), T(0.8)}, u{T(0.5), T(0), T(0.5)};
    const auto narrow = [&](const auto& material) {
        const auto& here = material_at(material, Vec3T<T>{T(0)}, Vec2T<T>{T(0)});
        if (!has(lobes(here), Lobes::glossy)) return false;
        const auto next = sample(here, wo, u, Transport::radiance, Lobes::glossy);
        return next && next->pdf > T(1000);
    };
    std::size_t count = 0;
    world.each_object([&](ObjectId, const auto& object) {
        count += world.visit_material(object.material, narrow) ? 1 : 0;
    });
    return count;
}

/// The number of objects with a normal map that turns a normal.
template <AnyWorld W>
[[nodiscard, gnu::cold]] long long mapped_normals(const W& world) {
    long long count = 0;
    world.each_object([&](ObjectId, const auto& object) {
        count += world.visit_material(object.material, []<typename M>(const M& m) {
            if constexpr (NormalMapped<M>)
                return turns_normals_of(m) ? 1 : 0;
            else
                return 0;
        });
    });
    return count;
}

/// Remarks about a scene in which something moves: one photon map holds the light of
/// all times.
/// \param caustics  Whether a caustics map is looked up.
/// \param gathered  Whether indirect rays end at a lookup of the general map.
template <AnyWorld W>
[[nodiscard, gnu::cold]] std::vector<std::string>
moving_remarks([[maybe_unused]] const W& world, [[maybe_unused]] bool caustics,
               [[maybe_unused]] bool gathered) {
    std::vector<std::string> remarks;
    if constexpr (lists_moving<W>) {
        bool specular = false;
        world.each_object([&](ObjectId id, const auto& object) {
            const bool moves = world.visit_shape(
                id, []<typename G>(const G&) { return is_moving<G>; });
            const auto is_specular = [](const auto& m) {
                return has(lobes(m), Lobes::specular);
            };
            specular |= moves && world.visit_material(object.material, is_specular);
        });
        if (caustics && specular)
            remarks.push_back("mirrors or glass move: caustics are the mean over all "
                              "times, too bright or too dark where something that "
                              "moves stands before them");
        if (gathered && has_moving(world))
            remarks.push_back("objects move: indirect rays find the mean light of all "
                              "times, and beside what moves the picture is some "
                              "percent too bright or too dark");
    }
    return remarks;
}

/// A line, with a line feed, about the result of edge_loss(); empty if little is lost.
/// \param setting  The name of the estimate's settings.
/// \param remedy   The light that is lost, and what to do.
[[nodiscard, gnu::cold]] inline std::string edge_remark(double lost,
                                                        std::string_view setting,
                                                        float radius,
                                                        std::string_view remedy) {
    if (!(lost > 0.2)) return {};
    return join({"some object is so small for ", setting, ".radius = ", to_text(radius),
                 " that its edges lose about ", to_text(std::llround(100 * lost)),
                 " % of ", remedy, "\n"});
}

/// The number of materials with a roughness `sigma` above 1.6 radians. Such an angle
/// was probably meant in degrees.
template <AnyWorld W>
[[nodiscard, gnu::cold]] long long steep_materials(const W& world) {
    long long steep = 0;
    each_array(world.materials(), [&](const auto& array) {
        for ([[maybe_unused]] const auto& material : array)
            if constexpr (requires { material.sigma > 0; })
                steep += material.sigma > decltype(material.sigma)(1.6);
    });
    return steep;
}

/// The number of objects whose material shows a picture as light, but which were added
/// without a radiance, so that they are no lamps.
template <AnyWorld W>
[[nodiscard, gnu::cold]] long long dark_pictures([[maybe_unused]] const W& world) {
    long long dark = 0;
    if constexpr (W::lists_pictures)
        world.each_object([&](ObjectId, const auto& object) {
            const bool shows = world.visit_material(
                object.material, []<typename M>(const M&) { return ShowsPicture<M>; });
            dark += shows && object.light == no_light ? 1 : 0;
        });
    return dark;
}

/// Adds remarks about surfaces of different objects that coincide. There is one remark
/// for each rule that decides which surface a ray meets.
/// \param type_of  The name of an object's shape, such as "QuadT<float>".
[[gnu::cold]] LJUS_CORE_INLINE void
add_contact_remarks(const Contacts& contacts,
                    FunctionRef<std::string(ObjectId)> type_of,
                    std::vector<std::string>& remarks);

#ifndef LJUS_CORE // otherwise defined in ljus::core

/// What happens where two surfaces coincide, as the end of a sentence.
/// \return Null if no remark is needed, as for surfaces that touch only in points and
///         for opaque surfaces back to back.
[[nodiscard, gnu::cold]] inline const char*
contact_rule(const Contact& contact, ContactKind met, ContactKind other) noexcept {
    if (!contact.over_area) return nullptr;
    if (other == ContactKind::sheet)
        return "the thin surface has no effect there; move it away from the other one";
    if (met == ContactKind::lamp)
        return other == ContactKind::lamp ? "paths meet only the brighter of two "
                                            "lamps, but shadow rays find both; "
                                            "move or remove one"
                                          : "rays meet the lamp there";
    if (met == ContactKind::body)
        return contact.opposed ? "light passes from one body into the other; for air "
                                 "between them, move "
                                 "them apart"
                               : "rays meet the body of the higher index there; let "
                                 "one end before the other";
    if (other == ContactKind::body)
        return "light passes from the body to the opaque surface; for air between "
               "them, move them apart";
    return contact.alike ? "rays meet the opaque surface whose material covers less "
                           "of the scene"
                         : nullptr;
}

LJUS_CORE_INLINE void add_contact_remarks(const Contacts& contacts,
                                          FunctionRef<std::string(ObjectId)> type_of,
                                          std::vector<std::string>& remarks) {
    struct Found {
        const char* rule;
        const Contact* first;
        long long pairs;
    };
    std::vector<Found> all;
    for (const Contact& contact : contacts.pairs) {
        const TouchingObject* met = &contacts.objects[contact.pair[0]];
        const TouchingObject* other = &contacts.objects[contact.pair[1]];
        if (other->key < met->key) std::swap(met, other);
        const char* const rule = contact_rule(contact, met->kind, other->kind);
        if (rule == nullptr) continue;
        std::size_t i = 0;
        while (i < all.size() && all[i].rule != rule) ++i;
        if (i == all.size()) all.push_back({rule, &contact, 0});
        ++all[i].pairs;
    }
    const auto name = [&](std::uint32_t position) { // such as "Quad 3", "moving Quad 0"
        const ObjectId id = contacts.objects[position].object;
        const std::string whole = type_of(id);
        constexpr std::string_view motion = "Moving<";
        const bool moves = whole.starts_with(motion);
        const std::string_view type =
            std::string_view(whole).substr(moves ? motion.size() : 0);
        return join({moves ? "moving " : "", type.substr(0, type.find("T<")), " ",
                     to_text(static_cast<long long>(id.index))});
    };
    for (const auto& [rule, first, pairs] : all)
        remarks.push_back(join(
            {to_text(pairs), " pair(s) of objects have surfaces in one place, such as ",
             name(first->pair[0]), " and ", name(first->pair[1]), " around ",
             to_text(Vec3((first->box.low + first->box.high) / 2.0)), ": ", rule}));
    if (!contacts.complete)
        remarks.push_back("too many objects overlap to compare all of them: where "
                          "surfaces lie in one place, their order may decide which one "
                          "rays meet");
}

#endif

/// Warns of transparent bodies that overlap with equal priority, and of thin surfaces
/// inside a body. For each pair of objects one point is tested: the middle of the part
/// of space that their boxes share. Some overlaps are therefore not found. Where that
/// point lies on surfaces that only touch, a body that ends there may be counted; an
/// overlap is therefore reported only if a point beside it lies in both bodies as well.
/// \cost A few rays for each pair of bodies whose boxes overlap, for at most 4096
///       pairs.
template <AnyWorld W>
[[gnu::cold]] void add_overlap_remarks(const W& world,
                                       std::vector<std::string>& remarks) {
    using T = typename W::Scalar;
    struct Body {
        BoxT<T> box;
        bool thin;
    };
    std::vector<Body> all;
    world.each_object([&](ObjectId id, const auto& object) {
        const MaterialId material = object.material;
        const bool thin = world.visit_material(
            material, []<typename M>(const M&) { return ThinSurface<M>; });
        if (thin || world.rank_of(material) != 0)
            all.push_back({world.visit_shape(
                               id, [](const auto& shape) { return box_around(shape); }),
                           thin});
    });
    const auto priority_of = [&](std::uint8_t rank) {
        return world.visit_material(world.material_of_rank(rank),
                                    [](const auto& m) { return priority(m); });
    };
    const auto bodies_at = [&](const Vec3T<T>& point) {
        return bodies_around(
            world,
            RayT<T>{.origin = point, .direction = glm::normalize(Vec3T<T>{1, 2, 3})});
    };
    const auto is_tied = [&](const BodyList& around) {
        for (std::size_t n = 1; n < around.ranks.size() && around.ranks[n] != 0; ++n)
            if (around.ranks[n] != around.ranks[n - 1] &&
                priority_of(around.ranks[n]) == priority_of(around.ranks[n - 1]))
                return true;
        return false;
    };
    const auto size = [](const BoxT<T>& box) {
        return glm::length(box.high - box.low);
    };
    bool tied = false, film = false;
    int probes = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t k = 0; k < i && probes < 4096; ++k) {
            const BoxT<T> shared{glm::max(all[i].box.low, all[k].box.low),
                                 glm::min(all[i].box.high, all[k].box.high)};
            if (!glm::all(glm::lessThanEqual(shared.low, shared.high))) continue;
            ++probes;
            const Vec3T<T> middle = shared.low + (shared.high - shared.low) / T(2);
            const auto say = [&](bool& said, std::string_view what) {
                if (!said) remarks.push_back(join({what, to_text(Vec3(middle))}));
                said = true;
            };
            if ((all[i].thin || all[k].thin) && bodies_at(middle).top() != 0)
                say(film, "a thin surface lies in a transparent body, where it "
                          "reflects as it does in air; around ");
            if (tied || !is_tied(bodies_at(middle))) continue;
            const T beside = T(1e-3) * glm::min(size(all[i].box), size(all[k].box));
            bool real = false;
            for (int corner = 0; corner < 8 && !real; ++corner) {
                const Vec3T<T> signs{corner & 1 ? 1 : -1, corner & 2 ? 1 : -1,
                                     corner & 4 ? 1 : -1};
                real = is_tied(bodies_at(middle + beside * signs));
            }
            if (real)
                say(tied, world.has_priorities()
                              ? "transparent bodies of equal priority overlap, "
                                "and that of the higher index holds: give them "
                                "different priorities; around "
                              : "transparent bodies overlap, and each surface "
                                "is taken for a boundary between its body and air: "
                                "give them priorities; around ");
        }
}

/// The fraction of all directions in which the sky is visible from the middle of a
/// scene: about half in the open, little in a room with a window, 0 without a sky.
/// \cost 256 rays if the scene has a light that fills the sky.
template <AnyWorld W>
[[nodiscard, gnu::cold]] double share_of_sky([[maybe_unused]] const W& world) {
    using T = typename W::Scalar;
    int seen = 0;
    if constexpr (has_sky<W>) {
        bool sky = false;
        for (std::uint32_t i = 0; i < world.light_count(); ++i)
            sky = sky || world.visit_light(
                             i, []<typename L>(const L&) { return FillsSky<L>; });
        const Vec3T<T> middle =
            world.box().low + (world.box().high - world.box().low) / T(2);
        for (int i = 0; i < 256 && sky; ++i) {
            const Vec2T<T> u{(T(i / 16) + T(0.5)) / T(16),
                             (T(i % 16) + T(0.5)) / T(16)};
            seen += occluded(world, RayT<T>{.origin = middle,
                                            .direction = sample_uniform_sphere(u)})
                        ? 0
                        : 1;
        }
    }
    return seen / 256.0;
}

} // namespace detail

/// The warnings of a survey about a scene, as sentences without a full stop.
template <AnyWorld W>
[[nodiscard, gnu::cold]] std::vector<std::string>
scene_remarks(const W& world, const PhotonMappingSettings& settings) {
    std::vector<std::string> remarks;
    if (world.light_count() == 0)
        remarks.push_back("the scene has no light, and the picture will be black: add "
                          "an object with a radiance, or a point light");
    if (std::string digits = detail::digits_remark(world); !digits.empty())
        remarks.push_back(std::move(digits));
    if (const long long steep = detail::steep_materials(world); steep > 0)
        remarks.push_back(detail::join(
            {to_text(steep), " material(s) have a sigma above 1.6 radians, where the "
                             "models of rough surfaces hardly change: divide degrees "
                             "by 57.3"}));
    if (const long long dark = detail::dark_pictures(world); dark > 0)
        remarks.push_back(
            detail::join({to_text(dark),
                          " object(s) have the picture of a lamp, but no radiance that "
                          "it multiplies, and are dark: give them an emission"}));
    const std::size_t narrow =
        settings.direct == DirectLight::sampled ? detail::narrow_lobes(world) : 0;
    if (narrow > 0)
        remarks.push_back(detail::join(
            {to_text(static_cast<long long>(narrow)),
             " object(s) are nearly mirrors, in whose lobe a shadow ray hardly ever "
             "lies: their light is missing or in a few bright pixels; ask for "
             "direct light by mis, or for a mirror, of roughness 0"}));
    const double sky =
        settings.direct == DirectLight::mis ? 0 : detail::share_of_sky(world);
    if (sky > 0 && sky < 0.25)
        remarks.push_back(
            "from the middle of the scene only a small part of the sky is seen, as "
            "through a window: most shadow rays to it miss, and the picture is noisy");
    const auto type_of = [&](ObjectId id) {
        return world.visit_shape(
            id, []<typename G>(const G&) { return detail::type_name<G>(); });
    };
    detail::add_contact_remarks(world.contacts(), type_of, remarks);
    if constexpr (W::lists_priorities) detail::add_overlap_remarks(world, remarks);
    return remarks;
}

/// The warnings about the position of a camera: that the scene has no objects, or that
/// the camera is so near to a surface that rounding decides on which side of the
/// surface it is.
/// \cost Six rays.
template <AnyWorld W, std::floating_point T>
[[nodiscard, gnu::cold]] std::vector<std::string>
camera_remarks(const W& world, const Vec3T<T>& position) {
    if (world.size() == 0)
        return {
            "the scene has no objects: nothing but its sky, if it has one, is seen"};
    for (int way = 0; way < 6; ++way) {
        RayT<T> ray{.origin = position, .direction = Vec3T<T>{T(0)}};
        ray.direction[way / 2] = way % 2 == 0 ? T(1) : T(-1);
        const auto hit = closest_hit(world, ray);
        if (!hit) continue;
        const SurfacePointT<T> point = detail::surface_at(world, ray, *hit);
        const T height = std::abs(glm::dot(point.normal, position - point.position));
        if (height <= detail::leaving_distance(point))
            return {"camera.position lies in a surface, which its rays may meet at "
                    "once or not at all: move it to one side"};
    }
    return {};
}

/// The warnings about a photon mapper, each with a line feed: those of scene_remarks(),
/// then those about its photon passes.
template <typename Mapper>
[[nodiscard, gnu::cold]] std::string mapper_remarks(const Mapper& mapper) {
    std::string lines;
    for (const std::string& remark : scene_remarks(mapper.world(), mapper.settings()))
        lines += remark + "\n";
    lines += mapper.maps().remarks;
    const PhotonMappingSettings& settings = mapper.settings();
    for (const std::string& remark : detail::moving_remarks(
             mapper.world(), mapper.passes().caustics_map,
             mapper.passes().general_map && detail::gathers(settings.indirect)))
        lines += remark + "\n";
    if (mapper.passes().general_map && settings.indirect == IndirectLight::photons &&
        settings.general_estimate.nearest == 0)
        lines += detail::edge_remark(
            edge_loss(mapper.world(), mapper.maps().general, settings.general_estimate,
                      one_kind(PhotonKind::indirect), settings.general.seed),
            "general_estimate", settings.general_estimate.radius,
            "the light between surfaces; trace more photons, or let rays carry it");
    if (const long long mapped = detail::mapped_normals(mapper.world());
        mapped > 0 && mapper.passes().general_map)
        lines += detail::join(
            {to_text(mapped),
             " object(s) have normal maps, between which photons lose light, the more "
             "the normals lean; let rays carry indirect light\n"});
    // With gloss_as_mirrors, estimates are divided by part_of_caustics().
    if (mapper.passes().caustics_map && settings.caustics_estimate.nearest == 0 &&
        !mapper.passes().gloss_as_mirrors)
        lines += detail::edge_remark(
            edge_loss(mapper.world(), mapper.maps().caustics,
                      settings.caustics_estimate, one_kind(PhotonKind::caustic),
                      settings.caustics.seed),
            "caustics_estimate", settings.caustics_estimate.radius,
            "its caustics; choose a smaller radius, or trace more photons");
    return lines;
}

/// The remarks for path tracing: those of scene_remarks(), and one about light that no
/// path carries. A path may meet a lamp or the sky, but never a light without a size.
template <AnyWorld W>
[[nodiscard, gnu::cold]] std::vector<std::string> path_remarks(const W& world) {
    // Paths sample narrow lobes themselves, as with DirectLight::mis.
    auto remarks = scene_remarks(world, {.direct = DirectLight::mis});
    long long never_met = 0;
    for (std::uint32_t i = 0; i < world.light_count(); ++i)
        never_met += world.can_be_met(i) ? 0 : 1;
    const SceneNeeds found = needs(world);
    if (never_met > 0 && found.specular > 0 && found.diffuse > 0)
        remarks.push_back(detail::join(
            {to_text(never_met),
             " light(s) have no size, so that no path meets them: what mirrors and "
             "glass make of their light is missing; photon mapping carries it"}));
    return remarks;
}

/// \}

} // namespace ljus
