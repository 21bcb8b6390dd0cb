# k photons over the disc of the k-th: k/(k-1) too bright.
ljus_break_it(NAME photon-map-k HEADER photons/irradiance_estimate.hpp TEST photon_map
    FROM "skip = full ? 1 : 0"
    TO   "skip = 0"
    CASES "photon_map: every kernel finds*")

# (k-1)/k as well as the k-th photon left out: too dark by as much.
ljus_break_it(NAME photon-map-twice HEADER photons/irradiance_estimate.hpp TEST photon_map
    FROM "weight * factor(photon) * photon.flux"
    TO   "(1 - 1 / T(gather.nearest)) * weight * factor(photon) * photon.flux"
    CASES "photon_map: every kernel finds*")

# The area of the cube's side instead of the disc's.
ljus_break_it(NAME photon-map-area HEADER photons/irradiance_estimate.hpp TEST photon_map
    FROM "std::numbers::pi * radius2"
    TO   "4 * radius2"
    CASES "photon_map: every kernel finds*")

# "A missing dot product" the other way round: the flux holds the cosine already.
ljus_break_it(NAME photon-map-cosine HEADER photons/density_estimate.hpp TEST photon_map
    FROM "weight * evaluate(material, wo, wi)"
    TO   "weight * wi.z * evaluate(material, wo, wi)"
    CASES "photon_map: the irradiance of a side*,photon_map: eight*")

ljus_break_it(NAME photon-map-direction HEADER photons/density_estimate.hpp TEST photon_map
    FROM "wi = to_local(surface.frame, -photon.direction);"
    TO   "wi = to_local(surface.frame, photon.direction);"
    CASES "photon_map: the irradiance of a side*,photon_map: eight*")

# A ball without a disc: the light of another wall.
ljus_break_it(NAME photon-map-thickness HEADER photons/density_estimate.hpp TEST photon_map
    FROM "height * height > height2 ||"
    TO   ""
    CASES "photon_map: eight*")

# The next wall of a corner, and the other side of a thin wall.
ljus_break_it(NAME photon-map-turned HEADER photons/density_estimate.hpp TEST photon_map
    FROM "detail::turned_away(photon.normal, surface.point.normal))
            return;"
    TO   "false)
            return;"
    CASES "photon_map: eight*")

# A disc so flat that a ball of twice its radius loses the rim.
ljus_break_it(NAME photon-map-flat HEADER photons/irradiance_estimate.hpp TEST photon_map
    FROM "float thickness = 0.5f;"
    TO   "float thickness = 0.1f;"
    CASES "photon_map: on a ball as small*"
    COMPILED)

# The k nearest of all kinds, of which shadow photons are then left out.
ljus_break_it(NAME photon-map-kinds HEADER photons/irradiance_estimate.hpp TEST photon_map
    FROM "return kinds.has(photon.kind);"
    TO   "return true;"
    CASES "photon_map: photons of other kinds*")

# 0/0 where all photons lie in one point.
ljus_break_it(NAME photon-map-one-point HEADER photons/irradiance_estimate.hpp TEST photon_map
    FROM "if (!(radius2 > 1e-30 * std::min(widest2, 1.0))) return {};"
    TO   ""
    CASES "photon_map: photons that all*")

# Eight at a time, what decides on a photon must be as it is one by one.
ljus_break_it(NAME lane-estimate-side HEADER photons/detail/flux_in_disc.hpp TEST photon_map
    FROM "towards < T(0) ? T(1) : T(0)"
    TO   "towards < T(0) ? T(1) : T(1)"
    CASES "photon_map: eight*")
ljus_break_it(NAME lane-estimate-height HEADER photons/detail/flux_in_disc.hpp TEST photon_map
    FROM "(-h <= limit)"
    TO   "true"
    CASES "photon_map: eight*")
ljus_break_it(NAME lane-estimate-turned HEADER photons/detail/flux_in_disc.hpp TEST photon_map
    FROM "T(2) * T(127) * (x * nx"
    TO   "T(127) * (x * nx"
    CASES "photon_map: eight*")
ljus_break_it(NAME lane-estimate-kinds HEADER photons/detail/flux_in_disc.hpp TEST photon_map
    FROM "(record.code[i] & kinds) != 0"
    TO   "(record.code[i] | kinds) != 0"
    CASES "photon_map: eight*")

# A sum in float alone.
ljus_break_it(NAME lane-estimate-float HEADER photons/detail/flux_in_disc.hpp TEST photon_map
    FROM "if (++parts_ == 16) add_part();"
    TO   ""
    CASES "photon_map: two million*")

# A radius whose disc is so small that the radiance is infinite.
ljus_break_it(NAME photon-map-radius HEADER photons/irradiance_estimate.hpp TEST photon_map
    FROM "gather.radius >= 1e-15f"
    TO   "gather.radius > 0"
    CASES "photon_map: a way to gather*")

# Estimates that are answered together: all of them at the first place, photons of a
# leaf's first block only, and a ball that gets those of the one before.
ljus_break_it(NAME together-center HEADER photons/density_estimate.hpp
    TEST photon_map
    FROM "{ return places[i].center; }"
    TO   "{ return places[0 * i].center; }"
    CASES "photon_map: estimates that are*")
ljus_break_it(NAME together-block HEADER accel/detail/kd_tree8_walk.hpp TEST photon_map
    FROM "some != 0; ++block, some >>= 8)"
    TO   "some != 0; ++block, some = 0)"
    CASES "photon_map: estimates that are*")
ljus_break_it(NAME together-room HEADER accel/detail/kd_tree8_walk.hpp TEST photon_map
    FROM "found.blocks.clear();"
    TO   ""
    CASES "photon_map: estimates that are*")
ljus_break_it(NAME together-side HEADER photons/density_estimate.hpp
    TEST photon_map
    FROM "place.from = seen_normal(vertex)"
    TO   "place.from = vertex.frame.normal"
    CASES "photon_map: estimates that are*")

# The disc of the k nearest is as high as the widest one.
ljus_break_it(NAME photon-map-k-height HEADER photons/irradiance_estimate.hpp
    TEST photon_map
    FROM "height * height > limit * limit * radius2"
    TO   "height * height > limit * limit * widest2"
    CASES "photon_map: of the k nearest the disc*")

# Places that are asked together by the normal of the frame.
ljus_break_it(NAME photon-map-place HEADER photons/density_estimate.hpp
    TEST photon_map
    FROM "place.normal = vertex.point.normal;"
    TO   "place.normal = vertex.frame.normal;"
    CASES "photon_map: estimates that are answered together*")

# A disc without a radius is taken for one.
ljus_break_it(NAME photon-map-room HEADER photons/irradiance_estimate.hpp TEST photon_map
    FROM "detail::check_disc(gather);\n    if (map.empty())"
    TO   "if (map.empty())"
    CASES "photon_map: an estimate refuses*")

# A photon without direction arrives at no side: it must not be taken in silence.
ljus_break_it(NAME photon-map-no-direction HEADER photons/photon_map.hpp TEST photon_map
    FROM "- T(1)) <= T(0.01)"
    TO   "- T(1)) <= T(1)"
    CASES "photon_map: data that are not finite*")

# Records that are moved to their groups, and not to their places.
ljus_break_it(NAME photon-map-record-places HEADER photons/detail/photon_records.hpp
    TEST photon_map
    FROM "records[to[i] - first]"
    TO   "records[i - first]"
    CASES "photon_map: each photon's record*")

# A file whose numbers nobody has checked.
ljus_break_it(NAME photon-map-file-checksum HEADER io/photon_map_file.hpp
    TEST photon_map_file
    FROM "map_checksum(file.bytes, map, threads))"
    TO   "number_at<std::uint64_t>(file.bytes, checksum_place))"
    CASES "photon_map_file: a file cut short*")
ljus_break_it(NAME photon-map-file-valid HEADER io/photon_map_file.hpp
    TEST photon_map_file
    FROM "if (!is_whole_block(map, block))"
    TO   "if (false)"
    CASES "photon_map_file: photons that no map*")
ljus_break_it(NAME photon-map-file-beyond HEADER io/photon_map_file.hpp
    TEST photon_map_file
    FROM "if (!std::isnan(points.x[i])) return false;"
    TO   ""
    CASES "photon_map_file: photons that no map*")
ljus_break_it(NAME photon-map-file-key HEADER io/photon_map_file.hpp
    TEST photon_map_file
    FROM "file.take<std::uint64_t>() != settings.key"
    TO   "file.take<std::uint64_t>() == 99"
    CASES "photon_map_file: a file cut short*")

# Bytes between the numbers of a record are what the memory held before.
ljus_break_it(NAME photon-map-file-unused HEADER photons/detail/photon_records.hpp
    TEST photon_map_file
    FROM "blocks_[i / 8] = {};"
    TO   ""
    CASES "photon_map_file: no byte between*")

# A copy of a map in a file refers to the file.
ljus_break_it(NAME photon-map-file-copy HEADER accel/detail/stored_array.hpp
    TEST photon_map_file
    FROM "StoredArray(GrowingArray<Element>(other.elements_))"
    TO   "elements_(other.elements_)"
    CASES "photon_map_file: it comes back*" COMPILED)
