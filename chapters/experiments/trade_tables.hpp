#pragma once

/// \file chapters/experiments/trade_tables.hpp
/// \brief A sweep as plots and tables: each knob, half of the time, equal time, equal
/// error, and the settings that no other beats.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "experiments/sweep.hpp"

namespace examples {

inline constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A squared bias and its standard error.
inline std::string bias_text(const Measured& m) {
    return text(m.bias, "%.2g") + " ± " + text(m.bias_error, "%.1g");
}

/// A plot of error against time, a curve for each room, and a table of everything.
inline void save_knob(const std::string& folder, const Notebook& notebook,
                      const std::vector<std::string>& scenes, const std::string& knob) {
    Plot plot{.name = "trades-" + knob,
              .columns = {"processor seconds"},
              .y_label = "relMSE",
              .log_x = true,
              .log_y = true,
              .notes = {notebook.conditions}};
    Table table{.name = plot.name + "-table",
                .columns = {"room", "setting", "s", "of which photons", "MB",
                            "rays per pixel", "RMSE", "relMSE", "bias²", "noise",
                            "of which photons", "blocks", "trimmed", "FLIP"},
                .notes = plot.notes};
    for (const std::string& scene : scenes) plot.columns.push_back(scene);
    for (std::size_t s = 0; s < scenes.size(); ++s) {
        auto lines = notebook.of(scenes[s], knob);
        for (const Measured& m : lines)
            table.rows.push_back(
                {m.scene, m.value, text(m.seconds, "%.3g"), text(m.photons, "%.2g"),
                 text(m.megabytes, "%.3g"), text(m.rays, "%.3g"), text(m.rmse, "%.3g"),
                 text(m.error(), "%.2g"), bias_text(m), text(m.noise, "%.2g"),
                 m.maps > 0 ? text(m.maps, "%.2g") : "", text(m.block, "%.2g"),
                 text(m.trimmed, "%.2g"), text(m.flip, "%.3f")});
        for (const bool paths : {false, true}) {
            for (const Measured& m : lines) {
                if ((m.value.rfind("paths", 0) == 0) != paths) continue;
                Row row(scenes.size() + 1, nothing);
                row[0] = m.seconds;
                row[s + 1] = m.error();
                plot.rows.push_back(row);
                if (m.x == 0) plot.rows.push_back({});
            }
            plot.rows.push_back({}); // no line between words, rooms, algorithms
        }
    }
    if (table.rows.empty()) return;
    save_plot(folder, plot);
    save_table(folder, table);
}

/// What half of the time costs: from the setting with the least error to the best of
/// those that take at most half as long.
inline std::string half_text(const std::vector<Measured>& lines) {
    const auto less = [](const Measured& a, const Measured& b) {
        return a.error() < b.error();
    };
    const auto best = std::min_element(lines.begin(), lines.end(), less);
    if (best == lines.end()) return "";
    const Measured *half = nullptr, *fastest = &*best;
    for (const Measured& m : lines) {
        if (m.seconds < fastest->seconds) fastest = &m;
        if (m.seconds > best->seconds / 2) continue;
        if (half == nullptr || less(m, *half)) half = &m;
    }
    const auto words = [&](const Measured& m) {
        const double factor = m.error() / best->error();
        const std::string times = text(factor, factor < 10 ? "%.2g" : "%.0f");
        return "× " + times + " (" + best->value + " → " + m.value + ")";
    };
    if (half != nullptr) return words(*half);
    const double saved = 1 - fastest->seconds / best->seconds;
    if (saved < 0.05) return "saves no time (best: " + best->value + ")";
    return "saves " + text(100 * saved, "%.0f") + " %: " + words(*fastest);
}

/// The settings of one room that no other beats in time and error.
inline void save_front(const std::string& folder, const Notebook& notebook,
                       const std::string& scene,
                       const std::vector<std::string>& knobs) {
    std::vector<Measured> all;
    for (const std::string& knob : knobs)
        for (const Measured& m : notebook.of(scene, knob)) all.push_back(m);
    if (all.empty()) return;
    std::sort(all.begin(), all.end(), [](const Measured& a, const Measured& b) {
        return a.seconds < b.seconds;
    });
    Table table{.name = "trades-front-" + scene,
                .columns = {"s", "relMSE", "bias²", "blocks", "trimmed", "FLIP", "MB",
                            "knob", "setting"},
                .notes = {notebook.conditions}};
    Plot plot{.name = table.name,
              .columns = {"processor seconds", "all settings", "path tracing",
                          "no setting beats it"},
              .y_label = "relMSE",
              .log_x = true,
              .log_y = true,
              .notes = table.notes};
    std::vector<Row> front;
    double best = std::numeric_limits<double>::infinity();
    for (const Measured& m : all) {
        const bool paths = m.value.rfind("paths", 0) == 0;
        const bool better = m.error() < best;
        plot.rows.push_back({m.seconds, paths ? nothing : m.error(),
                             paths ? m.error() : nothing, nothing});
        plot.rows.push_back({}); // dots
        if (!better) continue;
        front.push_back({m.seconds, nothing, nothing, m.error()});
        best = m.error();
        table.rows.push_back({text(m.seconds, "%.3g"), text(m.error(), "%.2g"),
                              bias_text(m), text(m.block, "%.2g"),
                              text(m.trimmed, "%.2g"), text(m.flip, "%.3f"),
                              text(m.megabytes, "%.3g"), m.knob, m.value});
    }
    plot.rows.insert(plot.rows.end(), front.begin(), front.end());
    plot.name += "-plot"; // its data are not those of the table
    save_table(folder, table);
    save_plot(folder, plot);
}

/// Whole ways to make a picture, repeated and averaged: their errors after the same
/// seconds, and their seconds to the same error.
inline void save_equal(const std::string& folder, const Notebook& notebook,
                       const std::vector<std::string>& scenes) {
    Table time{.name = "trades-equal-time",
               .columns = {"room", "way", "one picture, s", "after 0.1 s", "1 s",
                           "10 s", "100 s", "never below"},
               .notes = {notebook.conditions}};
    Table error{
        .name = "trades-equal-error",
        .columns = {"room", "way", "relMSE 0.1", "0.03", "0.01", "0.003", "0.001"},
        .notes = time.notes};
    for (const std::string& scene : scenes)
        for (const Measured& m : notebook.of(scene, "preset")) {
            const double bias = m.value == "paths" ? 0 : std::max(m.bias, 0.0);
            time.rows.push_back({scene, m.value, text(m.seconds, "%.2g")});
            for (const double seconds : {0.1, 1.0, 10.0, 100.0}) {
                const double n = std::floor(seconds / m.seconds * 1.1); // about
                time.rows.back().push_back(n < 1 ? "no picture yet"
                                                 : text(bias + m.noise / n, "%.2g"));
            }
            // A bias that is not twice its standard error has not been found.
            const bool found = m.bias > 2 * m.bias_error;
            time.rows.back().push_back(
                m.value == "paths" ? "no limit"
                : found            ? text(bias, "%.1g")
                                   : "below " + text(bias + 2 * m.bias_error, "%.1g"));
            error.rows.push_back({scene, m.value});
            for (const double target : {0.1, 0.03, 0.01, 0.003, 0.001}) {
                const double n = std::ceil(m.noise / (target - bias));
                error.rows.back().push_back(
                    bias >= target ? "never"
                                   : text(std::max(n, 1.0) * m.seconds, "%.2g") + " s");
            }
        }
    if (time.rows.empty()) return;
    const auto ways = notebook.of(scenes[0], "preset");
    Plot plot{.name = "trades-crossing",
              .columns = {"seconds"},
              .y_label = "relMSE",
              .log_x = true,
              .log_y = true,
              .notes = time.notes};
    for (const Measured& m : ways) plot.columns.push_back(m.value);
    for (double seconds = 0.01; seconds < 2000; seconds *= 1.5) {
        plot.rows.push_back({seconds});
        for (const Measured& m : ways) {
            const double bias = m.value == "paths" ? 0 : std::max(m.bias, 0.0);
            plot.rows.back().push_back(
                seconds < m.seconds ? nothing : bias + m.noise * m.seconds / seconds);
        }
    }
    save_plot(folder, plot);
    save_table(folder, time);
    save_table(folder, error);
}

/// Saves all plots and tables of a sweep, and trades.csv with all of it.
/// \param folder    Where to.
/// \param notebook  The sweep.
/// \param scenes    The rooms.
/// \param knobs     What was turned.
inline void save_trades(const std::string& folder, const Notebook& notebook,
                        const std::vector<std::string>& scenes,
                        const std::vector<std::string>& knobs) {
    Table half{
        .name = "trades-half", .columns = {"knob"}, .notes = {notebook.conditions}};
    std::string csv = csv_head({notebook.conditions},
                               {"scene", "knob", "value", "x", "seconds", "photons_s",
                                "megabytes", "rays", "rmse", "bias2", "bias2_error",
                                "noise", "maps", "blocks", "trimmed", "flip", "stamp"});
    for (const std::string& scene : scenes) half.columns.push_back(scene);
    for (const std::string& knob : knobs) {
        save_knob(folder, notebook, scenes, knob);
        half.rows.push_back({knob});
        for (const std::string& scene : scenes) {
            const auto lines = notebook.of(scene, knob);
            half.rows.back().push_back(half_text(lines));
            for (const Measured& m : lines) {
                std::vector<std::string> cells{m.scene, m.knob, m.value};
                for (const double number :
                     {m.x, m.seconds, m.photons, m.megabytes, m.rays, m.rmse, m.bias,
                      m.bias_error, m.noise, m.maps, m.block, m.trimmed, m.flip})
                    cells.push_back(text(number, "%.6g"));
                cells.push_back(m.stamp);
                csv += csv_line(cells);
            }
        }
        if (notebook.of(scenes[0], knob).empty()) half.rows.pop_back();
    }
    save_text(folder + "/trades.csv", csv);
    save_table(folder, half);
    for (const std::string& scene : scenes) save_front(folder, notebook, scene, knobs);
    save_equal(folder, notebook, scenes);
}

} // namespace examples
