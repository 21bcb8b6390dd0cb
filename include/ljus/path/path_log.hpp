#pragma once

/// \file ljus/path/path_log.hpp
/// \brief A record of what a renderer did for one path, in Heckbert's notation.

#include <string>
#include <string_view>
#include <vector>

#include "ljus/path/path_state.hpp"
#include "ljus/path/renderer.hpp"

namespace ljus {

/// \defgroup path_log Path logs
/// \brief Every renderer reports to a log; usually it is a NoLog, which costs nothing.
/// \{

/// A line of a PathLog.
struct PathLogLine {
    std::string path;       ///< Letters from the camera, E first.
    std::string what;       ///< "vertex", or the estimator of a term.
    glm::dvec3 value{0};    ///< Throughput at a vertex; radiance of a term.
    glm::dvec3 position{0}; ///< Position of the last vertex so far.
    double pdf = 0;         ///< Density of the next direction, per steradian; 0: delta.
};

/// Records every vertex and every term of the paths reported to it.
struct PathLog {
    std::vector<PathLogLine> lines; ///< In the order of the path.
    std::string letters = "E";      ///< Letters of the path so far.
    glm::dvec3 here{0};             ///< Position of the path.

    /// Starts a path.
    void begin() { letters.assign(1, 'E'); } // g++ 12 warns of = "E" (its bug 105651)

    /// Records the path's arrival at a surface, where it may end.
    template <std::floating_point T>
    void arrive(const Vec3T<T>& position) {
        here = glm::dvec3(position);
    }

    /// Records a scattering at a vertex.
    /// \param letter      D or S, by the sampled lobe.
    /// \param position    Position of the vertex.
    /// \param throughput  After the vertex.
    /// \param pdf         Density of the direction; 0: delta.
    template <std::floating_point T>
    void vertex(char letter, const Vec3T<T>& position, const RgbT<T>& throughput,
                T pdf) {
        letters += letter;
        lines.push_back({letters, "vertex", glm::dvec3(throughput),
                         glm::dvec3(position), double(pdf)});
    }

    /// Records added radiance.
    /// \param owner   Its estimator: "emission", "shadow ray", "caustics map", ...
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

/// Reports the position of a path to a log that has arrive().
template <typename Log, std::floating_point T>
void log_arrival(Log& log, const Vec3T<T>& position) {
    if constexpr (requires { log.arrive(position); }) log.arrive(position);
}

/// Reports a term whose value a batch finds later to a log that has delay().
/// \param suffix  The letters from here to the light.
template <typename Log>
void log_delay(Log& log, std::string_view suffix) {
    if constexpr (requires { log.delay(suffix); }) log.delay(suffix);
}

/// Reports the last scattering of a path to a log.
/// \param path  The path after continue_path().
template <typename Log, std::floating_point T>
void log_vertex(Log& log, const PathStateT<T>& path) {
    log.vertex(path.specular ? 'S' : 'D', path.previous, path.throughput, path.pdf);
}

/// Reports a path from split_path(): repeats all its letters so far.
/// \param path  The path; it has met only mirrors and glass.
template <typename Log, std::floating_point T>
void log_specular_path(Log& log, const PathStateT<T>& path) {
    log.begin();
    for (int vertex = 0; vertex < path.depth; ++vertex) log_vertex(log, path);
}

} // namespace detail

/// \}

} // namespace ljus
