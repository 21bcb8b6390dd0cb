#pragma once

/// \file ljus/render/detail/sample_sums.hpp
/// \brief The sums of the samples of pixels, with batched queries.

#include <array>
#include <span>

#include "ljus/math/vector.hpp"
#include "ljus/path/renderer.hpp"

namespace ljus::detail {

/// A renderer that delays some queries, to answer the queries of many samples together.
/// Its type `Batch` collects the queries as Context::batch, and has
///
///     std::uint32_t item;  // index of the sample that is being traced
///     void finish(const R& renderer, Counts& counts, const auto& give);
///
/// For each answer, finish() calls give(item, light), which adds the light to a sample.
/// Batching must not change any result. A renderer that reports light paths calls
/// log_delay() for each query that it delays.
template <typename R>
concept Batches = requires(typename R::Batch& batch) {
    batch.item;
};

/// The batch of a renderer that delays nothing.
template <typename R>
struct BatchOf {
    using Type = NoBatch;
    static constexpr int together = 1; ///< How many samples are finished at a time.
};
/// The batch of a renderer that delays queries.
template <Batches R>
struct BatchOf<R> {
    using Type = typename R::Batch;
    static constexpr int together = 64;
};

/// The sums over the samples of a pixel. They are in double, because a sum of 100 000
/// samples in float would keep only two digits of the next sample.
struct PixelSums {
    RgbT<double> sum{0};     ///< Sum of radiance.
    RgbT<double> squares{0}; ///< Sum of squared radiance.
};

/// Collects samples, and adds each sample to the sums of its pixel when its delayed
/// queries are answered.
template <typename R, std::floating_point T>
class SampleSums {
public:
    /// \param sums      The sums of all pixels that get samples.
    /// \param cost      Counts delayed queries, and samples that are not finite.
    SampleSums(const R& renderer, std::span<PixelSums> sums, Counts& cost)
        : renderer_(renderer), sums_(sums), cost_(cost) {}

    /// Adds a sample.
    /// \param pixel  The index of the sample's pixel in the sums.
    /// \param trace  Called with a batch; returns radiance and weight of the sample.
    template <typename Trace>
    void add(std::size_t pixel, const Trace& trace) {
        const auto item = static_cast<std::size_t>(count_);
        if constexpr (Batches<R>) batch_.item = static_cast<std::uint32_t>(count_);
        const auto found = trace(batch_);
        samples_[item] = found.radiance;
        weights_[item] = found.weight;
        pixels_[item] = pixel;
        if (++count_ == BatchOf<R>::together) finish();
    }
    void finish() {
        const auto count = static_cast<std::size_t>(count_);
        if constexpr (Batches<R>)
            batch_.finish(renderer_, cost_,
                          [&](std::uint32_t item, const RgbT<T>& light) {
                              samples_[item] += light;
                          });
        for (std::size_t i = 0; i < count; ++i) {
            if (!is_finite(samples_[i])) {
                ++cost_.rejected;
                continue;
            }
            const RgbT<double> sample(weights_[i] * samples_[i]);
            sums_[pixels_[i]].sum += sample;
            sums_[pixels_[i]].squares += sample * sample;
        }
        count_ = 0;
    }

private:
    const R& renderer_;
    std::span<PixelSums> sums_;
    Counts& cost_;
    typename BatchOf<R>::Type batch_{};
    int count_ = 0;
    std::array<RgbT<T>, BatchOf<R>::together> samples_;
    std::array<T, BatchOf<R>::together> weights_;
    std::array<std::size_t, BatchOf<R>::together> pixels_;
};

} // namespace ljus::detail
