#pragma once

/// \file chapters/experiments/oracle.hpp
/// \brief The reference that errors are measured against; examples share it.

#include "common/oracle.hpp" // IWYU pragma: export
