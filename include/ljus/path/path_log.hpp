#pragma once

/// \file ljus/path/path_log.hpp
/// \brief A log of the vertices and terms of paths, in Heckbert's notation.

#include <string>
#include <string_view>
#include <vector>

#include "ljus/path/path_state.hpp"
#include "ljus/path/renderer.hpp"

namespace ljus {

/// \defgroup path_log Path logs
/// \brief Logs to which a renderer reports its paths. The default, NoLog, ignores them.
/// \{

/// A line of a PathLog.
struct PathLogLine {
    std::string path; ///< Letters of the path, beginning with E at the camera.
    std::string what; ///< "vertex", or the name of an estimator of light.
    /// For a vertex, the throughput after it. For an estimator, throughput times
    /// radiance, in W/(m^2 sr).
    glm::dvec3 value{0};
    glm::dvec3 position{0}; ///< Position of the last vertex so far.
    /// Density of the next direction, per steradian; 0 after a specular lobe.
    double pdf = 0;
};

/// A log that records every vertex and every term of a path.
struct PathLog {
    std::vector<PathLogLine> lines; ///< The lines, in the order of the path.
    std::string letters = "E";      ///< Letters of the path so far.
    glm::dvec3 here{0};             ///< Position at which the path has last arrived.

    /// Starts a path.
    void begin() { letters.assign(1, 'E'); } // = "E" warns in g++ 12, bug 105651

    /// Records the path's arrival at a surface, where it may end.
    template <std::floating_point T>
    void arrive(const Vec3T<T>& position) {
        here = glm::dvec3(position);
    }

    /// Records a scattering at a vertex: the letter, S for a specular lobe and D for
    /// any other; the throughput after the vertex; and the density of the new
    /// direction, per steradian, which is 0 for a specular lobe.
    template <std::floating_point T>
    void vertex(char letter, const Vec3T<T>& position, const RgbT<T>& throughput,
                T pdf) {
        letters += letter;
        lines.push_back({letters, "vertex", glm::dvec3(throughput),
                         glm::dvec3(position), double(pdf)});
    }

    /// Records radiance that the path finds, unless it is black.
    /// \param owner   The estimator: "emission", "shadow ray", "caustics map", ...
    /// \param suffix  The letters from the last vertex to the light.
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

/// If a log has delay(), reports a delayed term: one whose value is found later, see
/// LogLike.
/// \param suffix  The letters from the last vertex to the light.
template <typename Log>
void log_delay(Log& log, std::string_view suffix) {
    if constexpr (requires { log.delay(suffix); }) log.delay(suffix);
}

/// Reports the last scattering of a path, after continue_path().
template <typename Log, std::floating_point T>
void log_vertex(Log& log, const PathStateT<T>& path) {
    log.vertex(path.specular ? 'S' : 'D', path.previous, path.throughput, path.pdf);
}

/// Reports a path from split_path(), which has met only mirrors and glass, as a new
/// path with all its letters. Of its vertices, a PathLog records the last one: the path
/// no longer knows the others. Any other log receives the last one once per letter.
template <typename Log, std::floating_point T>
void log_specular_path(Log& log, const PathStateT<T>& path) {
    log.begin();
    for (int vertex = 1; vertex < path.depth; ++vertex)
        if constexpr (requires { log.letters; })
            log.letters += 'S';
        else
            log_vertex(log, path);
    log_vertex(log, path);
}

} // namespace detail

/// \}

} // namespace ljus
