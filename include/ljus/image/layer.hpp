#pragma once

/// \file ljus/image/layer.hpp
/// \brief Images with names: a picture, and what belongs to each of its pixels.

#include <string>
#include <vector>

#include "ljus/image/image.hpp"

namespace ljus {

/// \defgroup layer Layers
/// \brief The pixels of a picture again, with other values: normals, depths, or the
/// light of some paths. An EXR file holds many; see \ref exr.
/// \{

/// One layer of a picture.
template <std::floating_point T>
struct LayerT {
    std::string name{};                               ///< As "albedo"; "": the picture.
    std::vector<std::string> channels{"R", "G", "B"}; ///< Three, or one.
    ImageT<T> image{}; ///< The values. One channel stands in all three.
};
using Layer = LayerT<float>; ///< LayerT in float.

/// The full name of a channel, as OpenEXR has it: "albedo.R", or "Z" in a layer without
/// a name.
/// \param layer    The layer.
/// \param channel  Its number, below channels.size().
template <std::floating_point T>
[[nodiscard]] std::string channel_name(const LayerT<T>& layer, std::size_t channel) {
    const std::string& own = layer.channels[channel];
    return layer.name.empty() ? own : layer.name + "." + own;
}

/// \}

} // namespace ljus
