#pragma once

/// \file chapters/experiments/show_table.hpp
/// \brief A table of the book, in its files and on the terminal.

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/plot.hpp"

namespace examples {

/// Saves a table, and prints it unless the program is to be quiet.
/// \param options  The folder, and whether to print.
/// \param table    The table; no row is longer than its headings.
inline void show_table(const Options& options, const Table& table) {
    save_table(options.out, table);
    if (options.quiet) return;
    // How many letters a text has: all bytes of UTF-8 that do not continue one.
    const auto letters = [](const std::string& text) {
        return std::size_t(std::count_if(text.begin(), text.end(), [](char c) {
            return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
        }));
    };
    std::vector<std::vector<std::string>> rows = table.rows;
    rows.insert(rows.begin(), table.columns);
    std::vector<std::size_t> width(table.columns.size());
    for (const auto& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i)
            width[i] = std::max(width[i], letters(row[i]));
    std::printf("%s\n", table.name.c_str());
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i)
            std::printf("%s%*s", row[i].c_str(), int(width[i] - letters(row[i])) + 2,
                        "");
        std::printf("\n");
    }
}

} // namespace examples
