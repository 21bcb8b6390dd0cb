#pragma once

/// \file ljus/path/path_log.hpp
/// \brief What a renderer did for one path, in Heckbert's letters.

#include <string>
#include <string_view>
#include <vector>

#include "ljus/path/path_state.hpp"
#include "ljus/path/renderer.hpp"

namespace ljus {

/// \defgroup path_log Path logs
/// \brief Every renderer reports to a log; most often to a NoLog, which costs nothing.
/// \{

/// One line of a PathLog.
struct PathLogLine {
    std::string path;       ///< Heckbert's letters from the camera, E first.
    std::string what;       ///< "vertex", or who carried the light.
    glm::dvec3 value{0};    ///< Throughput at a vertex; radiance of a term.
    glm::dvec3 position{0}; ///< Of the vertex; of a term, where the path has come to.
    double pdf = 0;         ///< Per steradian, of the direction it went on; 0: delta.
};

/// Keeps every vertex and every term of the paths it is told of.
struct PathLog {
    std::vector<PathLogLine> lines; ///< In the order of the path.
    std::string letters = "E";      ///< Of the path so far.
    glm::dvec3 here{0};             ///< Where it has come to.

    /// A path begins.
    void begin() { letters.assign(1, 'E'); } // g++ 12 warns of = "E" (its bug 105651)

    /// The path has come to a surface, from which it may not go on.
    template <std::floating_point T>
    void arrive(const Vec3T<T>& position) {
        here = glm::dvec3(position);
    }

    /// The path was scattered at a vertex.
    /// \param letter      D or S, by the lobe that was chosen.
    /// \param position    Of the vertex.
    /// \param throughput  After the vertex.
    /// \param pdf         Of the direction; 0 for a delta.
    template <std::floating_point T>
    void vertex(char letter, const Vec3T<T>& position, const RgbT<T>& throughput,
                T pdf) {
        letters += letter;
        lines.push_back({letters, "vertex", glm::dvec3(throughput),
                         glm::dvec3(position), double(pdf)});
    }

    /// Radiance was added.
    /// \param owner   Who carried it: "emission", "shadow ray", "caustics map", ...
    /// \param suffix  The letters from here to the light.
    /// \param value   Throughput times radiance.
    template <std::floating_point T>
    void term(std::string_view owner, std::string_view suffix, const RgbT<T>& value) {
        if (is_black(value)) return;
        lines.push_back({letters + std::string(suffix), std::string(owner),
                         glm::dvec3(value), here, 0});
    }
};

namespace detail {

/// Tells a log where a path has come to, if it has a function for that.
/// \param log       The log; most add up radiance, and need no places.
/// \param position  Of the surface.
template <typename Log, std::floating_point T>
void log_arrival(Log& log, const Vec3T<T>& position) {
    if constexpr (requires { log.arrive(position); }) log.arrive(position);
}

/// Tells a log of the last scattering of a path.
/// \param log   The log.
/// \param path  As continue_path() has left it.
template <typename Log, std::floating_point T>
void log_vertex(Log& log, const PathStateT<T>& path) {
    log.vertex(path.specular ? 'S' : 'D', path.previous, path.throughput, path.pdf);
}

/// Tells a log of a path that split off from one it knows: all its letters once more,
/// as far as it has come.
/// \param log   The log.
/// \param path  Of split_path(); only mirrors and glass lie behind it.
template <typename Log, std::floating_point T>
void log_specular_path(Log& log, const PathStateT<T>& path) {
    log.begin();
    for (int vertex = 0; vertex < path.depth; ++vertex) log_vertex(log, path);
}

} // namespace detail

/// \}

} // namespace ljus
