#pragma once

/// \file ljus/image/layer.hpp
/// \brief Layers: named images that belong to one picture.

#include <string>
#include <vector>

#include "ljus/image/image.hpp"

namespace ljus {

/// \defgroup layer Layers
/// \brief A layer holds other values for the pixels of a picture: normals, depths, or
/// the light of some paths. An EXR file can contain many layers; see \ref exr.
/// \{

/// One layer of a picture.
template <std::floating_point T>
struct LayerT {
    std::string name{}; ///< The name, e.g. "albedo"; empty for the picture itself.
    /// The names of three channels, or of one.
    std::vector<std::string> channels{"R", "G", "B"};
    ImageT<T> image{}; ///< The values. A single channel is repeated in all three.
};
using Layer = LayerT<float>; ///< LayerT in float.

/// The full name in OpenEXR of the channel with this index: "albedo.R", or "Z" in a
/// layer without a name.
template <std::floating_point T>
[[nodiscard]] std::string channel_name(const LayerT<T>& layer, std::size_t channel) {
    const std::string& own = layer.channels[channel];
    return layer.name.empty() ? own : layer.name + "." + own;
}

/// \}

} // namespace ljus
