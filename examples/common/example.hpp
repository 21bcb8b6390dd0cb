#pragma once

/// \file examples/common/example.hpp
/// \brief The common header of the example programs of the chapters: a command line, a
/// progress bar, a stop watch, and tables.

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "common/rendered.hpp"
