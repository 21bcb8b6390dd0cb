#pragma once

/// \file ljus/io/progressive_file.hpp
/// \brief Checkpoints of progressive pictures in files.

#include "ljus/io/binary_file.hpp"
#include "ljus/render/progressive.hpp"

namespace ljus {

/// \defgroup progressive_file Checkpoints
/// \brief Saves the state of a progressive picture, so that a killed program can be
/// resumed.
///
/// A file has the header of \ref binary_file, with the block_side, width and height of
/// the picture. Then follow the other members of ProgressiveState. The last is the
/// description of the picture, preceded by its length.
/// \{

namespace detail {

inline constexpr FileFormat checkpoint_format{"ljus progressive", 2};

// Calls `each` with every number that follows the header, in the order of the file.
template <typename State, typename Each>
void each_checkpoint_number(State& state, Each each) {
    each(state.alpha);
    each(state.shrink);
    each(state.passes);
    each(state.first_pass);
    for (auto* image : {&state.sum, &state.squares, &state.block_squares})
        for (auto& color : image->pixels)
            for (int channel = 0; channel < 3; ++channel) each(color[channel]);
}

// A state with memory for the numbers of a file. The header gives the size of the
// picture.
[[nodiscard]] inline ProgressiveState empty_state_of(FileReader& file) {
    const auto side = file.take<std::uint32_t>();
    const auto width = file.take<std::uint32_t>();
    const auto height = file.take<std::uint32_t>();
    constexpr auto most = static_cast<std::uint32_t>(max_pixels);
    const bool sized = side >= 1 && side <= most && width >= 1 && height >= 1 &&
                       width <= most / height;
    if (!sized) file.refuse("its width, height or block side is out of range");
    const std::uint32_t columns = (width - 1) / side + 1;
    const std::uint32_t rows = (height - 1) / side + 1;
    const std::size_t numbers =
        4 + 6 * std::size_t(width) * height + 3 * std::size_t(columns) * rows;
    const std::size_t text = file_front_bytes + 8 * numbers;
    const std::size_t size = file.bytes.size();
    if (size < text + 8 ||
        size - text - 8 != number_at<std::uint64_t>(file.bytes, text))
        file.refuse("its " + std::to_string(size) +
                    " bytes do not match its picture's size");
    ProgressiveState state{.block_side = int(side)};
    state.picture.assign(file.bytes.begin() + std::ptrdiff_t(text) + 8,
                         file.bytes.end());
    state.sum = state.squares = make_image<double>(int(width), int(height));
    state.block_squares = make_image<double>(int(columns), int(rows));
    return state;
}

// Refuses numbers that no pass can have made.
inline void require_sense(const FileReader& file, const ProgressiveState& state) {
    if (state.passes < 1 || !(state.alpha > 0 && state.alpha <= 1) ||
        !(state.shrink > 0 && state.shrink <= 1))
        file.refuse("its number of passes, alpha or radius is out of range");
    // A sum beyond this range would have an infinite mean in float.
    const double largest = double(state.passes) * std::numeric_limits<float>::max();
    for (const auto& color : state.sum.pixels)
        if (max_component(glm::abs(color)) > largest)
            file.refuse("it has light beyond the range of a picture");
}

} // namespace detail

/// Saves a checkpoint.
/// \throws std::runtime_error  as save_file(); std::invalid_argument if the state has
///         no pass.
/// \cost 48 bytes per pixel.
inline void save_checkpoint(const std::string& path, const ProgressiveState& state) {
    require_at_least("the number of passes", state.passes, 1);
    Bytes bytes =
        file_front(detail::checkpoint_format, std::uint32_t(state.block_side),
                   std::uint32_t(state.sum.width), std::uint32_t(state.sum.height));
    detail::each_checkpoint_number(
        state, [&](const auto& number) { put_number(bytes, number); });
    put_number(bytes, std::uint64_t(state.picture.size()));
    bytes.insert(bytes.end(), state.picture.begin(), state.picture.end());
    put_checksum(bytes);
    save_file(path, bytes);
}

/// Loads a checkpoint. require_first_pass() tests whether it belongs to a picture.
/// \return The state, equal to the saved one in every bit.
/// \throws std::runtime_error  as open_file(), such as "cannot read 'a.check': its
///         checksum is wrong ...".
[[nodiscard]] inline ProgressiveState load_checkpoint(const std::string& path) {
    FileReader file = open_file(path, detail::file_limit(std::size_t(max_pixels), 96),
                                detail::checkpoint_format);
    ProgressiveState state = detail::empty_state_of(file);
    detail::each_checkpoint_number(state, [&]<typename Number>(Number& number) {
        number = file.take<Number>();
        if constexpr (std::is_floating_point_v<Number>)
            if (!std::isfinite(number))
                file.refuse("it has a number that is not finite");
    });
    detail::require_sense(file, state);
    return state;
}

/// \}

} // namespace ljus
