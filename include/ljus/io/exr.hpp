#pragma once

/// \file ljus/io/exr.hpp
/// \brief OpenEXR files: pictures and their layers, in float or half.

#if __has_include(<OpenEXR/openexr.h>)
#include <OpenEXR/openexr.h>
#else
#include <openexr.h>
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <utility>

#include <glm/packing.hpp>

#include "ljus/image/image.hpp"
#include "ljus/io/detail/picture_size.hpp"
#include "ljus/io/detail/srgb_primaries.hpp"
#include "ljus/io/file.hpp"

namespace ljus {

/// \defgroup exr EXR
/// \brief The file format of the film industry. One file can hold a picture and its
/// layers. This header needs OpenEXR 3.1 or later. A program must link OpenEXRCore,
/// with -lOpenEXRCore-3_1 or by its CMake target OpenEXR::OpenEXRCore.
/// \{

/// How numbers are stored in an EXR file.
enum class ExrNumbers {
    floats, ///< 32 bits: a float is stored exactly.
    halves  ///< 16 bits: 11 significant bits, up to 65504; larger numbers become
            ///< infinite.
};

namespace detail {

/// The largest EXR file that is read, in bytes.
inline constexpr std::size_t max_exr_file = std::size_t(1) << 30;

/// The largest number of pixels in all layers of a file together.
inline constexpr long long max_layer_pixels = 1LL << 27;

/// The largest chunk of a file, in bytes after decompression.
inline constexpr std::uint64_t max_exr_chunk = std::uint64_t(1) << 28;

// An EXR file that is open in memory, and is closed at the end of the scope.
struct ExrFile {
    exr_context_t context = nullptr;
    ExrFile() = default;
    ExrFile(const ExrFile&) = delete;
    ExrFile& operator=(const ExrFile&) = delete;
    ~ExrFile() {
        if (context != nullptr) exr_finish(&context);
    }
};

inline exr_context_initializer_t exr_settings(void* data) {
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.user_data = data;
    settings.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
    // A valid file needs no more than a chunk and its work space at a time.
    settings.alloc_fn = [](std::size_t bytes) {
        return bytes > 4 * max_exr_chunk ? nullptr : std::malloc(bytes);
    };
    settings.free_fn = [](void* memory) { std::free(memory); };
    return settings;
}

// Reads a number, whose lowest byte comes first.
inline float exr_number(const unsigned char* bytes, std::uint16_t type) {
    std::uint32_t bits = bytes[0] | std::uint32_t(bytes[1]) << 8;
    if (type == EXR_PIXEL_HALF) return glm::unpackHalf2x16(bits).x;
    bits |= std::uint32_t(bytes[2]) << 16 | std::uint32_t(bytes[3]) << 24;
    return type == EXR_PIXEL_UINT ? static_cast<float>(bits)
                                  : std::bit_cast<float>(bits);
}

// The channels of one layer in a file.
struct ExrLayer {
    int part = 0;
    std::string name{};
    std::vector<std::string> channels{};
    std::vector<int> places{}; // indices of the channels in their part
};

// Reads an EXR file. Each error message is a sentence that begins with the file's path.
class ExrReader {
public:
    ExrReader(const Bytes& bytes, const std::string& path)
        : bytes_(bytes), path_(path) {
        auto settings = exr_settings(const_cast<Bytes*>(&bytes)); // the bytes are only
                                                                  // read
        settings.size_fn = [](exr_const_context_t, void* data) {
            return static_cast<std::int64_t>(static_cast<const Bytes*>(data)->size());
        };
        settings.read_fn = [](exr_const_context_t, void* data, void* to,
                              std::uint64_t size, std::uint64_t at,
                              exr_stream_error_func_ptr_t) -> std::int64_t {
            const Bytes& all = *static_cast<const Bytes*>(data);
            const std::uint64_t left =
                all.size() - std::min<std::uint64_t>(at, all.size());
            const std::uint64_t count = std::min(size, left);
            if (count > 0) std::memcpy(to, all.data() + at, count);
            return static_cast<std::int64_t>(count);
        };
        settings.flags = EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE |
                         EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
        require(exr_start_read(&file_.context, "file", &settings), "in its header");
        find_layers();
    }

    // The layers of the file, in the order of its parts.
    [[nodiscard]] const std::vector<ExrLayer>& layers() const { return layers_; }

    [[noreturn, gnu::cold]] void refuse(std::string_view why) const {
        throw std::runtime_error(join({shown_path(path_), " ", why, "."}));
    }

    // Refuses a cube map, which would be taken for a sky by latitude and longitude.
    void require_no_cube(int part) const {
        exr_envmap_t kind{};
        if (exr_attr_get_envmap(file_.context, part, "envmap", &kind) ==
                EXR_ERR_SUCCESS &&
            kind == EXR_ENVMAP_CUBE)
            refuse("has the six faces of a cube, as its attribute envmap says; convert "
                   "it to latitude and longitude, for example by 'exrenvmap -l'");
    }

    // Refuses a luminance that has colours beside it, which would be lost.
    void require_no_chroma(int part) const {
        const exr_attr_chlist_t* list = nullptr;
        require(exr_get_channels(file_.context, part, &list), "in its header");
        for (int i = 0; i < list->num_channels; ++i)
            if (std::string_view(list->entries[i].name.str) == "RY")
                refuse("has a luminance Y with colours in RY and BY, which are not "
                       "read; save it with R, G and B, or load its layer 'Y' alone");
    }

    // Decodes layers; refuses them if they have more than `most` pixels together.
    [[nodiscard]] std::vector<LayerT<float>> decode(const std::vector<ExrLayer>& wanted,
                                                    long long most) const {
        std::vector<LayerT<float>> result;
        long long pixels = 0;
        for (const ExrLayer& layer : wanted) {
            const Window window = window_of(layer.part), shown = shown_of(layer.part);
            const Window& larger = window.size() > shown.size() ? window : shown;
            if (larger.size() > most - pixels)
                refuse(join({"has layers of ", to_text(larger.width), " x ",
                             to_text(larger.height), " pixels, ",
                             to_text(static_cast<long long>(wanted.size())),
                             " of them are read; there must be at most ", to_text(most),
                             " pixels in all of them"}));
            pixels += larger.size();
            // The divisor is the largest number of pixels per byte. ZIP packs up to
            // 1032 bytes into one. DWA stores one number for 64 equal ones.
            exr_compression_t method{};
            require(exr_get_compression(file_.context, layer.part, &method),
                    "in its header");
            const bool dwa =
                method == EXR_COMPRESSION_DWAA || method == EXR_COMPRESSION_DWAB;
            if (std::size_t(window.size()) / (dwa ? 65536 : 1024) > bytes_.size())
                refuse("is damaged: it ends in the middle of its pixels");
        }
        for (const ExrLayer& layer : wanted) {
            const Window window = window_of(layer.part);
            result.push_back({layer.name, layer.channels,
                              make_image(int(window.width), int(window.height))});
        }
        int parts = 0;
        require(exr_get_count(file_.context, &parts), "in its header");
        for (int part = 0; part < parts; ++part) decode_part(part, wanted, result);
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            Image& image = result[i].image;
            if (wanted[i].channels.size() == 1)
                for (Rgb& color : image.pixels) color = Rgb{color.x};
            else if (wanted[i].channels[0] == "R")
                convert(image.pixels, matrix_of(wanted[i].part),
                        std::numeric_limits<float>::max());
            const Window window = window_of(wanted[i].part);
            const Window shown = shown_of(wanted[i].part);
            if (window == shown) continue;
            Image whole = make_image(int(shown.width), int(shown.height));
            for (int y = 0; y < whole.height; ++y)
                for (int x = 0; x < whole.width; ++x) {
                    const long long column = x + shown.x - window.x;
                    const long long row = y + shown.y - window.y;
                    if (column >= 0 && column < window.width && row >= 0 &&
                        row < window.height)
                        pixel(whole, x, y) = pixel(image, int(column), int(row));
                }
            image = std::move(whole);
        }
        return result;
    }

private:
    // A rectangle of pixels: the data window of a part is stored, its display window is
    // the picture.
    struct Window {
        long long x = 0, y = 0, width = 0, height = 0;
        [[nodiscard]] long long size() const { return width * height; }
        bool operator==(const Window&) const = default;
    };

    struct Decoder {
        exr_const_context_t context;
        exr_decode_pipeline_t pipeline{};
        ~Decoder() { exr_decoding_destroy(context, &pipeline); }
    };

    void require(exr_result_t result, std::string_view where) const {
        if (result == EXR_ERR_SUCCESS) return;
        if (result == EXR_ERR_OUT_OF_MEMORY)
            refuse(join({"needs more memory than there is or is allowed, ", where}));
        if (result == EXR_ERR_FEATURE_NOT_IMPLEMENTED)
            refuse("is compressed by a method that OpenEXRCore does not read, such as "
                   "DWAA; save it with ZIP or PIZ");
        std::string why = exr_get_default_error_message(result);
        while (!why.empty() && why.back() == '.') why.pop_back();
        refuse(join(
            {"is damaged, or not an EXR file that can be read: ", why, ", ", where}));
    }

    // The matrix that converts the colours of a part into linear sRGB.
    [[nodiscard]] glm::dmat3 matrix_of(int part) const {
        exr_attr_chromaticities_t is{};
        if (exr_attr_get_chromaticities(file_.context, part, "chromaticities", &is) !=
            EXR_ERR_SUCCESS)
            return glm::dmat3{1};
        const auto matrix =
            to_srgb(Primaries{is.red_x, is.red_y, is.green_x, is.green_y, is.blue_x,
                              is.blue_y, is.white_x, is.white_y});
        if (!matrix)
            refuse("has chromaticities that are not three primaries and a white; save "
                   "it with those of sRGB");
        return *matrix;
    }

    [[nodiscard]] Window window_of(int part) const {
        exr_attr_box2i_t box{};
        require(exr_get_data_window(file_.context, part, &box), "in its header");
        return window_of(box);
    }
    [[nodiscard]] Window shown_of(int part) const {
        exr_attr_box2i_t box{};
        require(exr_get_display_window(file_.context, part, &box), "in its header");
        return window_of(box);
    }
    [[nodiscard]] Window window_of(const exr_attr_box2i_t& box) const {
        const Window window{box.min.x, box.min.y,
                            static_cast<long long>(box.max.x) - box.min.x + 1,
                            static_cast<long long>(box.max.y) - box.min.y + 1};
        constexpr long long most_side = 1 << 24;
        if (window.width < 1 || window.height < 1 || window.width > most_side ||
            window.height > most_side)
            refuse(
                join({"has ", to_text(window.width), " x ", to_text(window.height),
                      " pixels; width and height must be 1 to ", to_text(most_side)}));
        return window;
    }

    // Finds the layers as load_exr_layers() describes them.
    void find_layers() {
        int parts = 0;
        require(exr_get_count(file_.context, &parts), "in its header");
        for (int part = 0; part < parts; ++part) {
            exr_storage_t storage{};
            require(exr_get_storage(file_.context, part, &storage), "in its header");
            if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
                continue; // deep pixels
            const exr_attr_chlist_t* list = nullptr;
            require(exr_get_channels(file_.context, part, &list), "in its header");
            std::string part_name;
            if (const char* name = nullptr;
                parts > 1 &&
                exr_get_name(file_.context, part, &name) == EXR_ERR_SUCCESS)
                part_name = name;
            std::vector<std::pair<std::string, std::string>> names; // layer, channel
            for (int i = 0; i < list->num_channels; ++i) {
                const exr_attr_chlist_entry_t& entry = list->entries[i];
                const std::string full(entry.name.str, std::size_t(entry.name.length));
                const std::size_t dot = full.rfind('.');
                const bool whole = entry.x_sampling == 1 && entry.y_sampling == 1;
                names.emplace_back(dot == std::string::npos ? part_name
                                                            : full.substr(0, dot),
                                   whole ? full.substr(dot + 1) : ""); // npos + 1 = 0
            }
            add_layers(part, names);
        }
        if (layers_.empty())
            refuse("has only deep pixels, or channels with fewer values than pixels, "
                   "which are not read; save it with R, G and B for each pixel");
    }
    void add_layers(int part,
                    const std::vector<std::pair<std::string, std::string>>& names) {
        const auto place_of = [&](const std::string& layer, const char* channel) {
            const auto at = std::find(names.begin(), names.end(),
                                      std::pair{layer, std::string(channel)});
            return at == names.end() ? -1 : int(at - names.begin());
        };
        std::vector<bool> taken(names.size(), false);
        for (std::size_t i = 0; i < names.size(); ++i) {
            const auto& [layer, channel] = names[i];
            if (taken[i] || channel.empty()) continue;
            ExrLayer found{part, layer, {channel}, {int(i)}};
            for (const auto& three : {std::array{"R", "G", "B"}, {"X", "Y", "Z"}}) {
                const std::vector<int> places{place_of(layer, three[0]),
                                              place_of(layer, three[1]),
                                              place_of(layer, three[2])};
                if (std::count(places.begin(), places.end(), -1) == 0 &&
                    std::count(places.begin(), places.end(), int(i)) == 1)
                    found = {part, layer, {three.begin(), three.end()}, places};
            }
            for (const int place : found.places) taken[std::size_t(place)] = true;
            layers_.push_back(std::move(found));
        }
    }

    void decode_part(int part, const std::vector<ExrLayer>& wanted,
                     std::vector<LayerT<float>>& layers) const {
        if (std::none_of(wanted.begin(), wanted.end(),
                         [&](const ExrLayer& layer) { return layer.part == part; }))
            return;
        const Window window = window_of(part);
        exr_storage_t storage{};
        require(exr_get_storage(file_.context, part, &storage), "in its header");
        const auto decode_chunk = [&](const exr_chunk_info_t& chunk, long long x,
                                      long long y) {
            const std::string where = join(
                {"in the pixels from column ", to_text(x), " and row ", to_text(y)});
            if (chunk.unpacked_size > max_exr_chunk)
                refuse(join({"has more than ",
                             to_text(static_cast<long long>(max_exr_chunk)),
                             " bytes in one piece, ", where}));
            if (chunk.packed_size > bytes_.size())
                require(EXR_ERR_CORRUPT_CHUNK, where);
            Decoder decoder{file_.context};
            exr_decode_pipeline_t& pipeline = decoder.pipeline;
            require(exr_decoding_initialize(file_.context, part, &chunk, &pipeline),
                    where);
            require(
                exr_decoding_choose_default_routines(file_.context, part, &pipeline),
                where);
            pipeline.unpack_and_convert_fn = nullptr; // that of OpenEXR 3.1 is unsafe
            // A chunk that no method makes smaller is stored as it is. OpenEXR 3.1
            // would unpack it by B44.
            if (chunk.packed_size == chunk.unpacked_size)
                pipeline.decompress_fn = nullptr;
            require(exr_decoding_run(file_.context, part, &pipeline), where);
            if (!unpack(pipeline, wanted, layers, x, y))
                require(EXR_ERR_CORRUPT_CHUNK, where);
        };
        exr_chunk_info_t chunk{};
        if (storage == EXR_STORAGE_SCANLINE) {
            int lines = 0;
            require(exr_get_scanlines_per_chunk(file_.context, part, &lines),
                    "in its header");
            for (long long y = 0; y < window.height; y += std::max(lines, 1)) {
                require(exr_read_scanline_chunk_info(file_.context, part,
                                                     int(window.y + y), &chunk),
                        join({"in the pixels of row ", to_text(y)}));
                decode_chunk(chunk, 0, y);
            }
            return;
        }
        int wide = 0, high = 0; // the largest level only
        require(exr_get_tile_sizes(file_.context, part, 0, 0, &wide, &high),
                "in its header");
        if (wide < 1 || high < 1) require(EXR_ERR_INVALID_ATTR, "in its tiles");
        for (long long y = 0; y < window.height; y += high)
            for (long long x = 0; x < window.width; x += wide) {
                require(exr_read_tile_chunk_info(file_.context, part, int(x / wide),
                                                 int(y / high), 0, 0, &chunk),
                        join({"in the tile at column ", to_text(x), " and row ",
                              to_text(y)}));
                decode_chunk(chunk, x, y);
            }
    }

    // Copies a decompressed chunk into layers, from the pixel (x, y) on. The chunk is
    // stored row by row, and within a row channel by channel.
    // \return Whether the chunk has all its pixels.
    [[nodiscard]] static bool unpack(const exr_decode_pipeline_t& pipeline,
                                     const std::vector<ExrLayer>& wanted,
                                     std::vector<LayerT<float>>& layers, long long x,
                                     long long y) {
        const exr_chunk_info_t& chunk = pipeline.chunk;
        const auto* at = static_cast<const unsigned char*>(pipeline.unpacked_buffer);
        std::uint64_t left = pipeline.decompress_fn == nullptr
                                 ? std::min(chunk.packed_size, chunk.unpacked_size)
                                 : chunk.unpacked_size;
        for (int row = 0; row < chunk.height; ++row)
            for (int c = 0; c < pipeline.channel_count; ++c) {
                const exr_coding_channel_info_t& channel = pipeline.channels[c];
                // A channel may be stored in some of the rows only.
                if (channel.y_samples > 1 &&
                    (chunk.start_y + row) % channel.y_samples != 0)
                    continue;
                const auto size = std::uint64_t(channel.bytes_per_element);
                const std::uint64_t needed = size * std::uint64_t(channel.width);
                if (channel.width < 0 || left < needed) return false;
                left -= needed;
                for (std::size_t i = 0; i < wanted.size(); ++i) {
                    const std::vector<int>& places = wanted[i].places;
                    const auto place = std::find(places.begin(), places.end(), c);
                    if (wanted[i].part != pipeline.part_index || place == places.end())
                        continue;
                    Image& image = layers[i].image;
                    if (x + channel.width > image.width || y + row >= image.height)
                        return false;
                    for (int k = 0; k < channel.width; ++k)
                        pixel(image, int(x) + k,
                              int(y) + row)[int(place - places.begin())] =
                            exr_number(at + size * std::uint64_t(k), channel.data_type);
                }
                at += needed;
            }
        return true;
    }

    const Bytes& bytes_;
    const std::string& path_;
    ExrFile file_{};
    std::vector<ExrLayer> layers_{};
};

// One channel of a file that is written.
struct ExrChannel {
    std::string name{};
    std::size_t layer = 0;
    int place = 0; // 0 to 2, its number in the layer
};

// The channels of all layers, sorted by name as in a file.
template <std::floating_point T>
std::vector<ExrChannel> exr_channels(const std::vector<LayerT<T>>& layers) {
    require(!layers.empty(), "the number of layers", 0LL, "at least 1");
    std::vector<ExrChannel> channels;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const LayerT<T>& layer = layers[i];
        require_same_size(layer.image, layers.front().image);
        require(layer.channels.size() == 1 || layer.channels.size() == 3,
                "the number of channels of a layer",
                static_cast<long long>(layer.channels.size()), "1 or 3");
        for (std::size_t c = 0; c < layer.channels.size(); ++c)
            channels.push_back({channel_name(layer, c), i, int(c)});
    }
    const auto by_name = [](const ExrChannel& a, const ExrChannel& b) {
        return a.name < b.name;
    };
    std::sort(channels.begin(), channels.end(), by_name);
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const std::string& name = channels[i].name;
        if (name.empty() || name.size() > 255 || name.find('\0') != std::string::npos)
            throw std::invalid_argument(
                join({"A channel is called '", shown(name),
                      "'; a name of an EXR file has 1 to 255 bytes, none of them 0."}));
        if (i > 0 && name == channels[i - 1].name)
            throw std::invalid_argument(
                join({"Two channels are called '", shown(name),
                      "'; the layers of an EXR file must have names of their own."}));
    }
    return channels;
}

template <std::floating_point T>
Bytes exr_bytes(const std::vector<LayerT<T>>& layers,
                const std::vector<ExrChannel>& channels, ExrNumbers numbers) {
    Bytes bytes;
    auto settings = exr_settings(&bytes);
    settings.write_fn = [](exr_const_context_t, void* data, const void* from,
                           std::uint64_t size, std::uint64_t at,
                           exr_stream_error_func_ptr_t) -> std::int64_t {
        Bytes& all = *static_cast<Bytes*>(data);
        try {
            if (at + size > all.size()) all.resize(at + size);
        } catch (const std::bad_alloc&) {
            return -1; // no exception may cross C
        }
        std::memcpy(all.data() + at, from, size);
        return static_cast<std::int64_t>(size);
    };
    const auto require_done = [](exr_result_t result) {
        if (result == EXR_ERR_SUCCESS) return;
        if (result == EXR_ERR_OUT_OF_MEMORY || result == EXR_ERR_WRITE_IO)
            throw std::bad_alloc();
        throw std::runtime_error(join({"OpenEXR cannot make a file of these layers: ",
                                       exr_get_default_error_message(result), "."}));
    };
    const int width = layers.front().image.width, height = layers.front().image.height;
    ExrFile file;
    exr_context_t& context = file.context;
    int part = 0, lines = 0;
    require_done(exr_start_write(&context, "file", EXR_WRITE_FILE_DIRECTLY, &settings));
    require_done(exr_set_longname_support(context, 1));
    require_done(exr_add_part(context, nullptr, EXR_STORAGE_SCANLINE, &part));
    require_done(exr_initialize_required_attr_simple(context, part, width, height,
                                                     EXR_COMPRESSION_ZIP));
    const auto type = numbers == ExrNumbers::halves ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
    for (const ExrChannel& channel : channels)
        require_done(exr_add_channel(context, part, channel.name.c_str(), type,
                                     EXR_PERCEPTUALLY_LINEAR, 1, 1));
    require_done(exr_write_header(context));
    require_done(exr_get_scanlines_per_chunk(context, part, &lines));

    std::vector<float> values; // of some rows, channel by channel
    for (int y = 0; y < height; y += lines) {
        values.clear();
        const int end = std::min(y + lines, height);
        for (const ExrChannel& channel : channels)
            for (int row = y; row < end; ++row)
                for (int x = 0; x < width; ++x)
                    values.push_back(static_cast<float>(
                        pixel(layers[channel.layer].image, x, row)[channel.place]));
        struct Encoder {
            exr_const_context_t context;
            exr_encode_pipeline_t pipeline{};
            ~Encoder() { exr_encoding_destroy(context, &pipeline); }
        } encoder{context};
        exr_chunk_info_t chunk{};
        require_done(exr_write_scanline_chunk_info(context, part, y, &chunk));
        require_done(exr_encoding_initialize(context, part, &chunk, &encoder.pipeline));
        const std::size_t size = values.size() / channels.size();
        for (std::size_t i = 0; i < channels.size(); ++i) { // both lists are sorted
            auto& channel = encoder.pipeline.channels[i];
            channel.encode_from_ptr =
                reinterpret_cast<const std::uint8_t*>(values.data() + i * size);
            channel.user_bytes_per_element = sizeof(float);
            channel.user_data_type = EXR_PIXEL_FLOAT;
            channel.user_pixel_stride = sizeof(float);
            channel.user_line_stride = int(sizeof(float)) * width;
        }
        require_done(
            exr_encoding_choose_default_routines(context, part, &encoder.pipeline));
        require_done(exr_encoding_run(context, part, &encoder.pipeline));
    }
    const exr_result_t closed = exr_finish(&context);
    context = nullptr;
    require_done(closed);
    return bytes;
}

// Converts a layer to precision T.
template <std::floating_point T>
LayerT<T> layer_in(LayerT<float>&& layer) {
    if constexpr (std::same_as<T, float>) {
        return std::move(layer);
    } else {
        const auto& from = layer.image;
        return {layer.name,
                layer.channels,
                {from.width, from.height, {from.pixels.begin(), from.pixels.end()}}};
    }
}

} // namespace detail

/// Loads all layers of an EXR file. The file may have scanlines or tiles, one part or
/// several, numbers of any type, and every compression that OpenEXRCore reads. Deep
/// parts and subsampled channels are left out.
/// \return The layers in the order of the parts. Channels R, G, B or X, Y, Z with the
///         same layer name form a layer; every other channel is a layer of its own. If
///         the file has several parts, a channel without a layer name has the name of
///         its part. A layer has the pixels of its part's display window; those that
///         the file does not store are 0. If the file names other primaries than those
///         of sRGB, every layer of channels R, G and B is converted, and its channels
///         are then at least 0. Normals and positions must be stored as X, Y and Z.
/// \throws std::runtime_error  with path and reason, if the file cannot be read, is
///         damaged, has no layer, or has more than 2^27 pixels in all layers together.
/// \cost Memory: 12 bytes per pixel and layer in float, of the data window or the
///       display window, whichever is larger; the same again for one layer at a time if
///       the two differ; and at most 256 MB for a chunk.
template <std::floating_point T = float>
[[nodiscard]] std::vector<LayerT<T>> load_exr_layers(const std::string& path) {
    const Bytes bytes = load_file(path, detail::max_exr_file, "\x76\x2f\x31\x01");
    const detail::ExrReader reader(bytes, path);
    std::vector<LayerT<T>> layers;
    for (auto& layer : reader.decode(reader.layers(), detail::max_layer_pixels))
        layers.push_back(detail::layer_in<T>(std::move(layer)));
    return layers;
}

/// Loads one layer of an EXR file, such as "albedo". With an empty name, loads the
/// picture itself: in colour from channels R, G and B, or in grey from a channel Y.
/// \return As a layer of load_exr_layers(). Pixels may be infinite or NaN, and negative
///         unless they were converted.
/// \throws std::runtime_error  as load_exr_layers(); or if the file lacks the layer
///         (the message lists its layers), is a cube map, has more than 2^25 pixels,
///         or, for an empty name, has colours beside the luminance Y.
template <std::floating_point T = float>
[[nodiscard]] ImageT<T> load_exr(const std::string& path,
                                 const std::string& layer = "") {
    const Bytes bytes = load_file(path, detail::max_exr_file, "\x76\x2f\x31\x01");
    const detail::ExrReader reader(bytes, path);
    const detail::ExrLayer* found = nullptr;
    std::string names;
    for (const detail::ExrLayer& one : reader.layers()) {
        const bool three = one.channels.size() == 3;
        const std::string full =
            three ? one.name : channel_name(Layer{one.name, one.channels, {}}, 0);
        if (full == (three || !layer.empty() ? layer : "Y") &&
            (found == nullptr || three))
            found = &one;
        if (names.size() < 400) names += " '" + (full.empty() ? "RGB" : full) + "'";
    }
    if (found == nullptr)
        reader.refuse(detail::join(
            {"has no ",
             layer.empty() ? "picture of R, G and B" : "layer '" + shown(layer) + "'",
             "; it has", shown(names, 400),
             layer.empty() ? ": load one by its name, or save it as R, G and B" : ""}));
    if (layer.empty() && found->channels.size() == 1)
        reader.require_no_chroma(found->part);
    reader.require_no_cube(found->part);
    auto layers = reader.decode({*found}, detail::max_image_pixels);
    return detail::layer_in<T>(std::move(layers.front())).image;
}

/// Saves layers as one EXR file of one part, in scanlines compressed by ZIP. A double
/// is rounded to float first.
/// \throws std::invalid_argument  if there is no layer, if the layers differ in size,
///         if a name occurs twice or does not have 1 to 255 bytes, or as check();
///         std::runtime_error as save_file().
/// \cost Memory for the file, and for buffers of 16 rows.
template <std::floating_point T>
void save_exr_layers(const std::vector<LayerT<T>>& layers, const std::string& path,
                     ExrNumbers numbers = ExrNumbers::floats) {
    save_file(path, detail::exr_bytes(layers, detail::exr_channels(layers), numbers));
}

/// Saves an image as an EXR file with the channels R, G and B.
/// \throws std::invalid_argument  as check(); std::runtime_error as save_file().
template <std::floating_point T>
void save_exr(const ImageT<T>& image, const std::string& path,
              ExrNumbers numbers = ExrNumbers::floats) {
    save_exr_layers(std::vector<LayerT<T>>{{.image = image}}, path, numbers);
}

/// Reads the files that a scene file names, including EXR pictures of the sky:
/// load_json("scene.json", WithExr{MeshFiles{}}).
template <typename Files>
struct WithExr {
    Files files{}; ///< Reads mesh files, for example MeshFiles.

    /// Reads a mesh file.
    template <typename Settings>
    [[nodiscard]] auto operator()(const std::string& path,
                                  const Settings& settings) const {
        return files(path, settings);
    }
    /// Reads a picture; see load_exr().
    template <std::floating_point T>
    [[nodiscard]] ImageT<T> load_picture(const std::string& path) const {
        return load_exr<T>(path);
    }
};
/// Deduces the type of the reader of mesh files.
template <typename Files>
WithExr(Files) -> WithExr<Files>;

/// \}

} // namespace ljus
