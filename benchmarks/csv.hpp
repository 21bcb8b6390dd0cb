#pragma once

/// \file csv.hpp
/// \brief Tables of benchmarks for the book: the option --csv writes them, and
/// scripts/measure keeps them in chapters/measured.

#include <cstring>
#include <string>

#include "common/plot.hpp"

/// The folder after `--csv` on a command line, or nothing.
inline std::string csv_folder(int argc, char** argv) {
    for (int i = 1; i + 1 < argc; ++i)
        if (std::strcmp(argv[i], "--csv") == 0) return argv[i + 1];
    return {};
}

/// Saves a table if --csv was given.
inline void save_csv(const std::string& folder, const examples::Table& table) {
    if (!folder.empty()) save_table(folder, table);
}
