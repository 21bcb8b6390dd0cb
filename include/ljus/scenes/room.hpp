#pragma once

/// \file ljus/scenes/room.hpp
/// \brief A scene with its camera.

#include "ljus/scene/camera.hpp"
#include "ljus/scene/query.hpp"

namespace ljus {

/// \defgroup room Ready-made scenes
/// \brief What the ready-made scenes return.
/// \{

/// A scene, and where it is seen from.
template <typename S>
struct Room {
    S scene{};                            ///< Shapes, materials and lights.
    CameraT<typename S::Scalar> camera{}; ///< Where it is seen from.
};

/// \}

} // namespace ljus
