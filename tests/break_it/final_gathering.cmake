# Points in the order of the tree: more of them where there are too many photons by chance.
ljus_break_it(NAME final-gathering-order HEADER photons/irradiance_points.hpp
    TEST final_gathering
    FROM "map.tree.point_ids()[index] % static_cast<std::size_t>(every) == 0;"
    TO   "index % static_cast<std::size_t>(every) == 0;"
    CASES "final gathering: what is looked up*")

# The photons that became points count, too, and the sum is too large by their part.
ljus_break_it(NAME final-gathering-own-photon HEADER photons/irradiance_points.hpp
    TEST final_gathering
    FROM "!is_point(map, index, every)"
    TO   "true"
    CASES "final gathering: what is looked up*")

# Photons are looked for within the radius that the settings leave open.
ljus_break_it(NAME final-gathering-few HEADER photons/irradiance_points.hpp
    TEST final_gathering
    FROM "vertex.point, radius, std::span"
    TO   "vertex.point, T(settings.radius), std::span"
    CASES "final gathering: fewer photons*")

# Light from the other side of a wall shines through it.
ljus_break_it(NAME final-gathering-side HEADER photons/irradiance_points.hpp
    TEST final_gathering
    FROM "if (!(glm::dot(photon.direction, normal) < T(0)) || on_other_side > T(0))"
    TO   "if (false)"
    CASES "final gathering: an even light*")

# No correction at edges: half of the light is missing there.
ljus_break_it(NAME final-gathering-edge HEADER photons/kernel_border.hpp
    TEST final_gathering
    FROM "product *= kernel_part(distance / radius);"
    TO   "product *= T(1);"
    CASES "final gathering: an even light*")

# The diagonal of a wall of two triangles taken for an edge.
ljus_break_it(NAME final-gathering-diagonal HEADER photons/kernel_border.hpp
    TEST final_gathering
    FROM "std::abs(glm::dot(there->point.normal, normal)) > T(0.99);"
    TO   "std::abs(glm::dot(there->point.normal, normal)) > T(2);"
    CASES "final gathering: what lies on*")

# A gather ray takes the light of whatever surface is near.
ljus_break_it(NAME final-gathering-normal HEADER photons/irradiance_points.hpp
    TEST final_gathering
    FROM "return glm::dot(points.records[i].normal, normal) > T(0.9) &&"
    TO   "return glm::dot(points.records[i].normal, normal) > T(-2) &&"
    CASES "final gathering: points answer*")

# Irradiance taken for radiance: pi times too bright.
ljus_break_it(NAME final-gathering-pi HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "return weight * irradiance(wi) * std::numbers::inv_pi_v<T>;"
    TO   "return weight * irradiance(wi);"
    CASES "final gathering: in a furnace*")

# A matt surface reflects the light of its front, also when seen from behind.
ljus_break_it(NAME final-gathering-front HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "std::copysign(T(1), wo.z)"
    TO   "T(1)"
    CASES "final gathering: what a material*")

# The harmonic mean of the gather rays' lengths for their mean: points count too far.
ljus_break_it(NAME final-gathering-distance HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "inverse += T(1) / found.distance;"
    TO   "inverse += found.distance;"
    CASES "final gathering: the irradiance of a square*")

# A gather ray through a mirror is as long as its last part.
ljus_break_it(NAME final-gathering-first HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "if (first) found.distance = vertex->distance;"
    TO   "found.distance = vertex->distance;"
    CASES "final gathering: what a gather ray brings*")

# A point on the far side of a wall answers for the near side.
ljus_break_it(NAME final-gathering-far-side HEADER photons/irradiance_points.hpp
    TEST final_gathering
    FROM "if (photon_side(record.direction, normal) < 0) normal = -normal;"
    TO   ""
    CASES "final gathering: points at photons*")

# All points have one shadow ray's numbers: in a half-shadow all are lit, or none.
ljus_break_it(NAME final-gathering-numbers HEADER photons/irradiance_points.hpp
    TEST final_gathering
    FROM "random_stream(seed, Pass::irradiance, 0, i)"
    TO   "random_stream(seed, Pass::irradiance, 0, 0)"
    CASES "final gathering: a point is on*")

# What stands just above the photon is asked in its place.
ljus_break_it(NAME final-gathering-height HEADER photons/irradiance_points.hpp
    TEST final_gathering
    FROM "T(1e-3) * radius"
    TO   "T(1e-1) * radius"
    CASES "final gathering: a point is on*")

# Gather rays leave coloured glass as if it were air.
ljus_break_it(NAME final-gathering-medium HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM ".medium = vertex.medium,"
    TO   ""
    CASES "final gathering: rays are attenuated*")

# All gather rays of a place end together.
ljus_break_it(NAME final-gathering-branch HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "std::uint64_t(i + 1) << 20"
    TO   "std::uint64_t(1) << 20"
    CASES "final gathering: in a hall*")

# What is known of the side that the normal points to, whichever the ray meets.
ljus_break_it(NAME final-gathering-seen-side HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "const T side = std::copysign(T(1), wi.z);"
    TO   "const T side = T(1);"
    CASES "final gathering: a gather ray looks up*")

# Whatever is asked for, the radius is that of 32 photons.
ljus_break_it(NAME final-gathering-chosen HEADER photons/irradiance_points.hpp
    TEST final_gathering
    FROM "std::min<std::size_t>(settings.nearest, 511)"
    TO   "32"
    CASES "final gathering: points at photons*")

# A step lower than the disc is wide is a way on.
ljus_break_it(NAME final-gathering-step HEADER photons/kernel_border.hpp
    TEST final_gathering
    FROM "T(0.01) * radius"
    TO   "T(1) * radius"
    CASES "final gathering: what lies on the surface*")

# A gather ray sees nothing of what gloss reflects.
ljus_break_it(NAME final-gathering-gloss-black HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "if (has(parts, Lobes::glossy) ||"
    TO   "if (has(parts, Lobes::glossy)) return false; else if ("
    CASES "final gathering: a gather ray goes on*")

# What the caustics map has of a lamp's light by gloss, gather rays bring again.
ljus_break_it(NAME final-gathering-gloss-twice HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "bool mirrors = lookup.gloss_as_mirrors;"
    TO   "bool mirrors = false;"
    CASES "final gathering: a ceiling over*")

# The light of lamps is lost at gloss that is too broad for a mirror.
ljus_break_it(NAME final-gathering-gloss-broad HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "if (!mirrors || !nearly_specular_at(world, *vertex, material)) {"
    TO   "if (!mirrors) {"
    CASES "final gathering: a gather ray goes on*")

# Where the camera's path meets gloss behind a matt surface, irradiance answers for it.
ljus_break_it(NAME final-gathering-gloss-matt HEADER render/photon_mapping.hpp
    TEST final_gathering
    FROM "            plan.gather = false;
"
    TO   ""
    CASES "final gathering: a white room*")

# Where the map has too few photons, gather rays end and find nothing.
ljus_break_it(NAME final-gathering-starved HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "(lookup.paths && has(parts, Lobes::diffuse))"
    TO   "(false && has(parts, Lobes::diffuse))"
    CASES "final gathering: with too few photons*")

# Paths of the camera end where nothing is known.
ljus_break_it(NAME final-gathering-starved-camera HEADER render/photon_mapping.hpp
    TEST final_gathering
    FROM "(has(lobes(material), Lobes::glossy) || mapper.maps().starved)"
    TO   "has(lobes(material), Lobes::glossy)"
    CASES "final gathering: with too few photons*")

# All photons count, though only those that have landed before are looked up.
ljus_break_it(NAME final-gathering-starved-count HEADER render/photon_mapping.hpp
    TEST final_gathering
    FROM "count_of(photons, PhotonKind::indirect);
    maps.starved"
    TO   "static_cast<long long>(joined(photons).size());
    maps.starved"
    CASES "final gathering: with too few photons*")

# Its lamps are asked again, though the caustics map has told.
ljus_break_it(NAME final-gathering-gloss-again HEADER render/photon_mapping.hpp
    TEST final_gathering
    FROM "gloss_mirrors && nearly_specular_at("
    TO   "false && nearly_specular_at("
    CASES "final gathering: a ceiling over*")

# Photons do not go on by gloss: a sun's light by it is in no map.
ljus_break_it(NAME final-gathering-gloss-photons HEADER photons/photon_path.hpp
    TEST final_gathering
    FROM "gloss && !vertex.turned ? Lobes::specular | Lobes::glossy : Lobes::specular;"
    TO   "Lobes::specular;"
    CASES "final gathering: a wall that a sun*")

# What gloss throws onto a ceiling is dark along its edges.
ljus_break_it(NAME final-gathering-gloss-edge HEADER render/gathering.hpp
    TEST final_gathering
    FROM "    return part_on_surface(mapper.world(), vertex, detail::seen_normal(vertex),
                           T(how.radius));"
    TO   "    return T(1);"
    CASES "final gathering: a ceiling over*")

# A sheet that lets light through shows the light of its near side.
ljus_break_it(NAME final-gathering-sheet HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "path.medium = detail::medium_beyond(vertex.medium, material, vertex.wo,
                                                next->sample.wi);"
    TO   "path.ray = spawn_ray(vertex.point,
                                 to_world(vertex.frame, Vec3T<T>{next->sample.wi.x,
                                          next->sample.wi.y, -next->sample.wi.z}),
                                 vertex.time);"
    CASES "final gathering: a sheet*")

# A rough surface reflects the same of light from any side.
ljus_break_it(NAME final-gathering-rough HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "path.throughput = next->sample.weight;"
    TO   "path.throughput = RgbT<T>{T(1)};"
    CASES "final gathering: a rough floor*")

# The albedo counts once where it is gathered and once where that is asked for.
ljus_break_it(NAME final-gathering-weights HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "weights[c] > T(0) ? std::numbers::pi_v<T> / weights[c] : T(0);"
    TO   "std::numbers::pi_v<T> / T(settings.rays);"
    CASES "final gathering: a rough floor*")

# Where no point is near, a surface is black to gather rays.
ljus_break_it(NAME final-gathering-no-point HEADER render/final_gathering.hpp
    TEST final_gathering
    FROM "if (!lookup.general) return RgbT<T>{T(0)};"
    TO   "return RgbT<T>{T(0)};"
    CASES "final gathering: a strong lamp*")

# Points and photons of a parallel wall nearby count.
ljus_break_it(NAME final-gathering-wall HEADER photons/irradiance_points.hpp
    TEST final_gathering
    FROM "return T(4) * height * height > radius2;"
    TO   "return height * height > 4 * radius2;"
    CASES "final gathering: a strong lamp*")

# Points are made on gloss, too, where no ray looks them up.
ljus_break_it(NAME final-gathering-gloss HEADER photons/irradiance_points.hpp
    TEST final_gathering
    FROM "if (glossy[i]) continue;"
    TO   ""
    CASES "final gathering: direct photons are*")

# Where gather rays end, what moves stays where it was.
ljus_break_it(NAME final-gathering-moving HEADER photons/irradiance_points.hpp TEST moving
    FROM "if (has_moving(world))"
    TO   "if (false)"
    CASES "moving: a lamp that passes by*")
