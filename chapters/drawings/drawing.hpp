#pragma once

/// \file chapters/drawings/drawing.hpp
/// \brief Diagrams of the book: an example draws with the same functions.

#include "common/drawing.hpp"
