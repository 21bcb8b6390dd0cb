#pragma once

/// \file ljus/scenes/room.hpp
/// \brief A scene with its camera.

#include "ljus/scene/camera.hpp"
#include "ljus/scene/world.hpp"

namespace ljus {

/// \defgroup room Ready-made scenes
/// \brief The type that all ready-made scenes return.
/// \{

/// A closed scene with its camera.
template <typename S>
struct Room {
    World<S> world;                       ///< Shapes, materials and lights.
    CameraT<typename S::Scalar> camera{}; ///< The camera.
};
/// Deduces the scene type from the world.
template <typename S>
Room(World<S>, CameraT<typename S::Scalar>) -> Room<S>;

/// \}

} // namespace ljus
