#pragma once

/// \file ljus/render/detail/strip_sums.hpp
/// \brief The sums of a strip of pixels, of samples of which some light may come later.

#include <array>
#include <span>

#include "ljus/math/vector.hpp"
#include "ljus/path/counts.hpp"
#include "ljus/path/path_log.hpp"

namespace ljus::detail {

/// \addtogroup render
/// \{

/// So many pixels beside each other are rendered at a time.
inline constexpr int strip_width = 16;

/// A renderer that puts some map queries off, to answer those of many samples together.
/// Its type `Later` is the log of these samples, and has
///
///     std::uint32_t item;  // which of the samples is being traced
///     void finish(const R& renderer, Counts& counts, std::span<RgbT<T>> samples);
///
/// finish() adds the answers to the samples.
template <typename R>
concept AsksLater = requires {
    typename R::Later;
};

/// What a renderer that asks at once puts off: nothing.
template <typename R>
struct LaterOf {
    using Type = NoLog;                ///< The log of its samples.
    static constexpr int together = 1; ///< So many samples are finished at a time.
};
/// For one that puts questions off.
template <AsksLater R>
struct LaterOf<R> {
    using Type = typename R::Later;     ///< The log of its samples.
    static constexpr int together = 64; ///< So many samples are finished at a time.
};

/// The sums of the samples of each pixel of a strip. Which samples are finished
/// together depends on the strip alone, so that threads change nothing.
template <typename R, std::floating_point T>
class StripSums {
public:
    /// \param renderer  Whose samples.
    /// \param cost      Counts what is asked later, and samples that are not finite.
    StripSums(const R& renderer, Counts& cost) : renderer_(renderer), cost_(cost) {}

    /// Adds a sample.
    /// \param pixel  Of the strip, counted from its first.
    /// \param trace  Called with a log; returns radiance and weight of the sample.
    template <typename Trace>
    void add(int pixel, const Trace& trace) {
        const auto item = static_cast<std::size_t>(count_);
        if constexpr (AsksLater<R>) later_.item = static_cast<std::uint32_t>(count_);
        const auto found = trace(later_);
        samples_[item] = found.radiance;
        weights_[item] = found.weight;
        pixels_[item] = pixel;
        if (++count_ == LaterOf<R>::together) finish();
    }
    /// Adds what is left.
    void finish() {
        const auto count = static_cast<std::size_t>(count_);
        if constexpr (AsksLater<R>)
            later_.finish(renderer_, cost_, std::span(samples_.data(), count));
        for (std::size_t i = 0; i < count; ++i)
            if (is_finite(samples_[i]))
                sums_[static_cast<std::size_t>(pixels_[i])] +=
                    RgbT<double>(weights_[i] * samples_[i]);
            else
                ++cost_.rejected;
        count_ = 0;
    }
    /// The sum of a pixel's samples that were finite.
    [[nodiscard]] const RgbT<double>& of(int pixel) const noexcept {
        return sums_[static_cast<std::size_t>(pixel)];
    }

private:
    const R& renderer_;
    Counts& cost_;
    typename LaterOf<R>::Type later_{};
    int count_ = 0;
    std::array<RgbT<T>, LaterOf<R>::together> samples_;
    std::array<T, LaterOf<R>::together> weights_;
    std::array<int, LaterOf<R>::together> pixels_;
    // In double: a float would lose the last of 100 000 samples.
    std::array<RgbT<double>, strip_width> sums_{};
};

/// \}

} // namespace ljus::detail
