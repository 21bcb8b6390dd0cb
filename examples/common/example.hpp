#pragma once

/// \file examples/common/example.hpp
/// \brief What the chapters' examples need beside the library: a command line, a progress
/// bar, a stop watch, and tables.

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "common/rendered.hpp"
