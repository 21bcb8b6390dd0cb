# From space: the light of a lamp falls off with the square of the distance.
ljus_break_it(NAME flatland-square HEADER examples/flatland/light.hpp TEST flatland
    FROM "return distance / (cosine * length);"
    TO   "return distance * distance / (cosine * length);"
    CASES "flatland: the light of*")

# A lamp seen from its edge is as bright as from the front.
ljus_break_it(NAME flatland-lamp-cosine HEADER examples/flatland/light.hpp TEST flatland
    FROM "return distance / (cosine * length);"
    TO   "return distance / (0 * cosine + length);"
    CASES "flatland: the light of*")

# A lamp that shines to both sides.
ljus_break_it(NAME flatland-one-sided HEADER examples/flatland/light.hpp TEST flatland
    FROM "if (!(glm::dot(way, chosen.point.normal) < 0)) return 0;"
    TO   ""
    CASES "flatland: the light of*")

# All light to the first lamp.
ljus_break_it(NAME flatland-lamp-choice HEADER examples/flatland/light.hpp TEST flatland
    FROM "chosen.probability = own / all;"
    TO   "chosen.probability = 1;"
    CASES "flatland: two lamps*")

# From space: pi times the radiance.
ljus_break_it(NAME flatland-flux HEADER examples/flatland/light.hpp TEST flatland
    FROM "return 2 * object.emission * length(object.shape);"
    TO   "return std::numbers::pi * object.emission * length(object.shape);"
    CASES "flatland: the light of a round*,flatland: in a furnace*")

# From space: Lambert's albedo over pi.
ljus_break_it(NAME flatland-lambert HEADER examples/flatland/material.hpp TEST flatland
    FROM "matt->albedo / 2"
    TO   "matt->albedo / 3.14159265358979"
    CASES "flatland: a Lambertian*")

# Directions even in the angle, with the density of the cosine.
ljus_break_it(NAME flatland-cosine HEADER examples/flatland/material.hpp TEST flatland
    FROM "return {2 * u - 1, 2 * std::sqrt(u * (1 - u))};"
    TO   "return {std::sin(3.14159 * (u - 0.5)), std::cos(3.14159 * (u - 0.5))};"
    CASES "flatland: directions*")

# From space: radiance in glass by the square of the index.
ljus_break_it(NAME flatland-radiance HEADER examples/flatland/material.hpp TEST flatland
    FROM "transport == Transport::radiance ? n_i / n_t : 1;"
    TO   "transport == Transport::radiance ? (n_i / n_t) * (n_i / n_t) : 1;"
    CASES "flatland: in a furnace*,flatland: radiance across*")

# Glass inside out.
ljus_break_it(NAME flatland-index HEADER examples/flatland/material.hpp TEST flatland
    FROM "const bool outside = wo.y > 0;"
    TO   "const bool outside = wo.y < 0;"
    CASES "flatland: a mirror*,flatland: the caustic*")

# A ray beside a segment meets its line.
ljus_break_it(NAME flatland-segment-end HEADER examples/flatland/scene.hpp TEST flatland
    FROM "if (!(0 <= s && s <= 1)) return std::nullopt;"
    TO   "if (!(0 <= s)) return std::nullopt;"
    CASES "flatland: rays meet*")

# Where a lamp is, its own surface lies in the way.
ljus_break_it(NAME flatland-occluded HEADER examples/flatland/scene.hpp TEST flatland
    FROM "ray.t_max = glm::distance(from, to) - ray.t_min;"
    TO   "ray.t_max = glm::distance(from, to) + ray.t_min;"
    CASES "flatland: rays meet*,flatland: the light of*")

# The report's roulette: survivors carry what was left of them.
ljus_break_it(NAME flatland-roulette HEADER examples/flatland/path.hpp TEST flatland
    FROM "path.throughput *= next->weight / probability;"
    TO   "path.throughput *= next->weight;"
    CASES "flatland: roulette*")

# Lamps count twice: met by the path, and by the shadow ray before.
ljus_break_it(NAME flatland-twice HEADER examples/flatland/path_tracing.hpp TEST flatland
    FROM "if (path.specular && vertex->emits())"
    TO   "if (vertex->emits())"
    CASES "flatland: in a furnace*,flatland: as many*")

# A depth too few.
ljus_break_it(NAME flatland-depth HEADER examples/flatland/path_tracing.hpp TEST flatland
    FROM "while (path.depth < max_depth)"
    TO   "while (path.depth + 1 < max_depth)"
    CASES "flatland: as many*")

# Photons that met glass are called direct.
ljus_break_it(NAME flatland-kind HEADER examples/flatland/photon_map.hpp TEST flatland
    FROM "return path.met_specular ? PhotonKind::caustic : PhotonKind::direct;"
    TO   "return PhotonKind::direct;"
    CASES "flatland: photons by*,flatland: the caustic*")

# Photons on glass and mirrors.
ljus_break_it(NAME flatland-stored HEADER examples/flatland/photon_map.hpp TEST flatland
    FROM "if (!std::holds_alternative<Lambertian>(vertex.object.material)) return;"
    TO   ""
    CASES "flatland: photons by*")

# From space: over the area of the disc.
ljus_break_it(NAME flatland-area HEADER examples/flatland/density_estimate.hpp TEST flatland
    FROM "photon.flux / (2 * radius);"
    TO   "photon.flux / (std::numbers::pi * radius * radius);"
    CASES "flatland: which*,flatland: in a furnace*")

# The photon that sets the radius is counted.
ljus_break_it(NAME flatland-kth HEADER examples/flatland/density_estimate.hpp TEST flatland
    FROM "found.erase(kth, found.end());"
    TO   "found.erase(kth + 1, found.end());"
    CASES "flatland: the k-th*")

# From space: the factor of Epanechnikov's kernel over a disc.
ljus_break_it(NAME flatland-kernel HEADER examples/flatland/density_estimate.hpp TEST flatland
    FROM "return 1.5 * (1 - x);"
    TO   "return 2 * (1 - x);"
    CASES "flatland: each kernel*")

# Photons of the next wall.
ljus_break_it(NAME flatland-corner HEADER examples/flatland/density_estimate.hpp TEST flatland
    FROM "glm::dot(photon.normal, point.normal) > 0.5 &&"
    TO   ""
    CASES "flatland: which*")

# The number on the border between two lamps is the first one's.
ljus_break_it(NAME flatland-lamp-border HEADER examples/flatland/light.hpp TEST flatland
    FROM "if (left < 0) break;"
    TO   "if (left <= 0) break;"
    CASES "flatland: of two lamps*")

# Flux that enters glass as if it were radiance.
ljus_break_it(NAME flatland-flux-in-glass HEADER examples/flatland/photon_map.hpp TEST flatland
    FROM "continue_path(path, *vertex, Transport::flux, stream)"
    TO   "continue_path(path, *vertex, Transport::radiance, stream)"
    CASES "flatland: a photon within*")

# A lamp of the plane shines on both of its sides.
ljus_break_it(NAME flatland-both-sides HEADER examples/flatland/path.hpp TEST flatland
    FROM "wo.y > 0 && object.emission > 0"
    TO   "object.emission > 0"
    CASES "flatland: a lamp shines*")

# What does not shine is a lamp, if it comes last.
ljus_break_it(NAME flatland-dark-lamp HEADER examples/flatland/light.hpp TEST flatland
    FROM "if (!(own > 0)) continue;"
    TO   ""
    CASES "flatland: of two lamps*")

# Only the last surface is remembered.
ljus_break_it(NAME flatland-forgets HEADER examples/flatland/path.hpp TEST flatland
    FROM "(next->specular ? path.met_specular : path.met_diffuse) = true;"
    TO   "path.met_diffuse = !(path.met_specular = next->specular);"
    CASES "flatland: a path does not forget*")
