#pragma once

/// \file plot.hpp
/// \brief Writes plots and tables for the book, as data and as gnuplot files.
///
/// The data are written to NAME.csv. A plot also gets NAME.gp for gnuplot, and a table
/// NAME.html for a chapter. `scripts/plot FOLDER` draws each .gp as an .svg that is
/// readable in dark mode as well.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "ljus/io/file.hpp"

namespace examples {

/// A row of numbers, one per column. NaN leaves a cell empty. An empty row interrupts
/// the curves of a plot.
using Row = std::vector<double>;

/// A plot. The first column is x. Each other column is a curve, whose name is the
/// heading of the column and must not contain a comma. The first curve is thick, so
/// that it is visible beneath another curve.
struct Plot {
    std::string name;                 ///< Name of the files, e.g. "sphere-wrong".
    std::vector<std::string> columns; ///< Headings; the first labels the x axis.
    std::string y_label;              ///< The label of the y axis, with the unit.
    std::vector<Row> rows{};          ///< The data.
    bool log_x = false;               ///< Logarithmic x axis.
    bool log_y = false;               ///< Logarithmic y axis.
    std::string more = {}; ///< Further lines for gnuplot, e.g. "set key left".
    std::vector<std::string> notes{}; ///< Comments at the beginning of the data: how
                                      ///< they were measured.
};

/// A table of texts.
struct Table {
    std::string name;                             ///< Name of the files.
    std::vector<std::string> columns;             ///< Headings.
    std::vector<std::vector<std::string>> rows{}; ///< Cells.
    std::vector<std::string> notes{};             ///< Comments, as in a plot.
};

/// A number as text; empty for NaN.
/// \param value   The number.
/// \param format  A format for printf.
[[nodiscard]] inline std::string text(double value, const char* format = "%.4g") {
    if (std::isnan(value)) return {};
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, value);
    return buffer;
}

/// Prints a row of a table on the terminal.
/// \param row    The cells of the row.
/// \param width  Least width of a cell, in letters.
inline void print_row(const std::vector<std::string>& row, int width = 12) {
    for (const std::string& cell : row) std::printf("%-*s ", width, cell.c_str());
    std::printf("\n");
}

/// Prints the rows of a table, without its headings.
/// \param table  The table.
/// \param width  Least width of a cell, in letters.
inline void print_rows(const Table& table, int width = 12) {
    for (const auto& row : table.rows) print_row(row, width);
}

/// The number of characters of a UTF-8 text.
[[nodiscard]] inline std::size_t letters_of(const std::string& text) {
    return std::size_t(std::count_if(text.begin(), text.end(),
                                     [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Prints a table on the terminal. Each column is as wide as its cells, and longer
/// headings take several lines.
/// \param table  The table.
inline void print_table(const Table& table) {
    const std::size_t count = table.columns.size();
    std::vector<std::vector<std::string>> heading(count); // lines
    std::vector<std::size_t> width(count, 6);
    for (std::size_t c = 0; c < count; ++c) {
        for (const auto& row : table.rows)
            width[c] = std::max(width[c], letters_of(row[c]));
        std::string line;
        std::istringstream words(table.columns[c]);
        for (std::string word; words >> word;) {
            width[c] = std::max(width[c], letters_of(word));
            if (!line.empty() && letters_of(line + " " + word) > width[c])
                heading[c].push_back(std::exchange(line, ""));
            line += (line.empty() ? "" : " ") + word;
        }
        heading[c].push_back(line);
    }
    const auto print = [&](const auto& cell_of) {
        std::string line;
        for (std::size_t c = 0; c < count; ++c) {
            const std::string cell = cell_of(c);
            line += cell + std::string(width[c] + 2 - letters_of(cell), ' ');
        }
        std::printf("%s\n", line.substr(0, line.find_last_not_of(' ') + 1).c_str());
    };
    std::size_t lines = 0;
    for (const auto& each : heading) lines = std::max(lines, each.size());
    for (std::size_t i = 0; i < lines; ++i)
        print(
            [&](std::size_t c) { return i < heading[c].size() ? heading[c][i] : ""; });
    print([&](std::size_t c) { return std::string(width[c], '-'); });
    for (const auto& row : table.rows) print([&](std::size_t c) { return row[c]; });
}

/// Saves a text, as ljus::save_file() does.
/// \param path      The file.
/// \param contents  The text of the file.
inline void save_text(const std::string& path, const std::string& contents) {
    ljus::save_file(path, ljus::Bytes(contents.begin(), contents.end()));
}

/// One line of a CSV file.
/// \param cells  The cells. A cell with a comma or a quotation mark is quoted.
/// \return The line, with its line feed.
[[nodiscard]] inline std::string csv_line(const std::vector<std::string>& cells) {
    std::string line;
    for (const std::string& cell : cells) {
        if (!line.empty() || &cell != &cells.front()) line += ',';
        if (cell.find_first_of(",\"") == std::string::npos) {
            line += cell;
            continue;
        }
        line += '"';
        for (const char c : cell)
            line += c == '"' ? std::string("\"\"") : std::string(1, c);
        line += '"';
    }
    return line + '\n';
}

/// The first lines of a CSV file: the notes, each after a #, and the headings.
/// \param notes     How the numbers were measured.
/// \param headings  The headings of the columns.
[[nodiscard]] inline std::string csv_head(const std::vector<std::string>& notes,
                                          const std::vector<std::string>& headings) {
    std::string head;
    for (const std::string& note : notes) head += "# " + note + "\n";
    return head + csv_line(headings);
}

/// Saves the data of a plot as NAME.csv and its instructions as NAME.gp.
/// \param folder  The folder for the files, which exists.
/// \param plot    The plot.
inline void save_plot(const std::string& folder, const Plot& plot) {
    std::string csv = csv_head(plot.notes, plot.columns);
    for (const Row& row : plot.rows) {
        std::vector<std::string> cells;
        for (const double value : row) cells.push_back(text(value, "%.9g"));
        if (!row.empty())
            csv += csv_line(cells);
        else if (!csv.ends_with("\n\n")) // two would begin another set of data
            csv += "\n";
    }
    save_text(folder + "/" + plot.name + ".csv", csv);

    std::string gp =
        "# gnuplot " + plot.name + ".gp; scripts/plot does it for a folder.\n";
    gp += "set terminal svg size 720,400 dynamic font 'sans-serif,14' linewidth 1.6\n";
    gp += "set output '" + plot.name +
          ".svg'\n"
          "set datafile separator ','\nset datafile missing ''\n"
          "set border 3\nset tics nomirror out\nset grid lc rgb '#80808080' lw 0.4\n"
          "set key outside top horizontal center noenhanced\n"
          "set linetype 1 lc rgb '#3b8ed0'\nset linetype 2 lc rgb '#e0752d'\n"
          "set linetype 3 lc rgb '#2fa36b'\nset linetype 4 lc rgb '#a06cd5'\n"
          "set linetype 5 lc rgb '#d64550'\nset linetype 6 lc rgb '#8c8c3a'\n";
    const auto quoted = [](const std::string& label) {
        std::string result = "'";
        for (const char c : label)
            result += c == '\'' ? std::string("''") : std::string(1, c);
        return result + "'";
    };
    gp += "set xlabel " + quoted(plot.columns.front()) + " noenhanced\nset ylabel " +
          quoted(plot.y_label) + " noenhanced\n";
    if (plot.log_x) gp += "set logscale x\nset format x '10^{%L}'\n";
    if (plot.log_y) gp += "set logscale y\nset format y '10^{%L}'\n";
    gp += plot.more;
    std::string curves;
    for (std::size_t column = 1; column < plot.columns.size(); ++column) {
        const bool empty =
            std::all_of(plot.rows.begin(), plot.rows.end(), [column](const Row& row) {
                return row.empty() || std::isnan(row[column]);
            });
        if (empty) continue; // e.g. an error of 0 everywhere, on a logarithmic axis
        const std::string number = std::to_string(column + 1);
        curves += (curves.empty() ? "\nplot '" : ", '") + plot.name +
                  ".csv' using 1:" + number + " with linespoints lt " +
                  std::to_string(column) + (column == 1 ? " lw 2.5" : "") +
                  " pt 7 ps 0.35 title columnheader(" + number + ")";
    }
    gp += curves + "\n";
    save_text(folder + "/" + plot.name + ".gp", gp);
}

/// Text as a page or a drawing holds it.
inline std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        result += c == '&'   ? std::string("&amp;")
                  : c == '<' ? std::string("&lt;")
                             : std::string(1, c);
    return result;
}

/// Saves a table as NAME.csv and, for the chapter, as NAME.html.
/// \param folder  The folder for the files, which exists.
/// \param table   The table.
inline void save_table(const std::string& folder, const Table& table) {
    std::string csv = csv_head(table.notes, table.columns);
    std::string html =
        "<table class=\"markdownTable ljus-table\">\n<tr class=\"markdownTableHead\">";
    for (const std::string& heading : table.columns)
        html += "<th class=\"markdownTableHeadRight\">" + escaped(heading) + "</th>";
    html += "</tr>\n";
    for (const auto& row : table.rows) {
        csv += csv_line(row);
        html += "<tr>";
        for (const std::string& cell : row) html += "<td>" + escaped(cell) + "</td>";
        html += "</tr>\n";
    }
    save_text(folder + "/" + table.name + ".csv", csv);
    save_text(folder + "/" + table.name + ".html", html + "</table>\n");
}

} // namespace examples
