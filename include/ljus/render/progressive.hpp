#pragma once

/// \file ljus/render/progressive.hpp
/// \brief Photon mapping that converges: many passes, each with a smaller radius.

#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"

namespace ljus {

/// \defgroup progressive Progressive photon mapping
/// \brief The mean of many passes with independent photons. Chapter:
/// \ref ch_progressive.
///
/// A *pass* is a function pass(i, scale) with i = 1, 2, ... It traces its own photons,
/// renders a picture with all radii multiplied by `scale`, and returns a RenderedT or
/// another type with members `image` and `complete`. An example is
/// photon_mapping_pass().
/// \{

/// The mean of many passes: the plain twin of run_progressive(). Pass i has the radius
/// \f$ r_i \f$, with \f$ r_{i+1}^2 = r_i^2\,(i + \alpha)/(i + 1) \f$. After n passes
/// the variance of the mean is proportional to \f$ n^{-\alpha} \f$, and the squared
/// bias of the mean to \f$ n^{-2(1-\alpha)} \f$.
/// \param passes  The number n of passes, at least 1.
/// \param pass    Called with i and \f$ r_i / r_1 \f$; see \ref progressive.
/// \param alpha   In (0, 1]; with 1 the radius is constant.
/// \return The mean of the passes, summed in double.
/// \cite knaus2011
// [plain]
template <typename RenderPass>
[[nodiscard]] ImageT<double> progressive_mean(long long passes, RenderPass&& pass,
                                              double alpha = 2.0 / 3) {
    ImageT<double> mean;
    double shrink = 1; // squared factor of the radius
    for (long long i = 1; i <= passes; ++i) {
        const auto image = pass(i, std::sqrt(shrink)).image;
        if (i == 1) mean = make_image<double>(image.width, image.height);
        for (std::size_t p = 0; p < image.pixels.size(); ++p)
            mean.pixels[p] += RgbT<double>(image.pixels[p]);
        shrink *= (double(i) + alpha) / (double(i) + 1);
    }
    for (RgbT<double>& color : mean.pixels) color /= double(passes);
    return mean;
}
// [plain]

namespace detail {

/// Adds a picture to the sums of squared deviations from the mean, by Welford's method.
/// \param sum      The sum of the n earlier pictures.
template <std::floating_point T>
void add_squares(ImageT<double>& squares, const ImageT<T>& x, const ImageT<double>& sum,
                 double n) {
    if (n == 0) return;
    for (std::size_t p = 0; p < x.pixels.size(); ++p) {
        const RgbT<double> away = RgbT<double>(x.pixels[p]) - sum.pixels[p] / n;
        squares.pixels[p] += away * away * (n / (n + 1));
    }
}

/// The standard error of a mean of n pictures, as a root mean square over all pixels.
[[nodiscard]] inline double standard_error(const ImageT<double>& squares, double n) {
    double sum = 0;
    for (const RgbT<double>& s : squares.pixels) sum += (s.x + s.y + s.z) / 3;
    return std::sqrt(sum / double(squares.pixels.size()) / (n * (n - 1)));
}

template <std::floating_point T>
[[nodiscard]] std::uint64_t hash_of(const ImageT<T>& image) noexcept {
    std::uint64_t hash = mix_bits(std::uint64_t(image.width));
    for (const RgbT<T>& color : image.pixels)
        for (const T channel : {color.x, color.y, color.z})
            hash = mix_bits(hash ^ std::bit_cast<std::uint64_t>(double(channel))) + 1;
    return hash;
}

} // namespace detail

/// The state of progressive rendering. Its size does not depend on the number of
/// passes. Alpha and the side of blocks may be set before the first pass.
struct ProgressiveState {
    /// Determines how fast the radius shrinks, in (0, 1]; see progressive_mean().
    double alpha = 2.0 / 3;
    /// Side of a block in pixels. The mean of a block gets an error of its own, because
    /// the errors of neighbouring pixels are correlated.
    int block_side = 8;
    double shrink = 1;              ///< \f$ r_i^2 / r_1^2 \f$ of the next pass.
    long long passes = 0;           ///< Number of passes in the sums.
    std::uint64_t first_pass = 0;   ///< Hash of the first pass's picture.
    ImageT<double> sum{};           ///< Sum of the passes, in W/(m^2 sr).
    ImageT<double> squares{};       ///< Sum of the squared deviations of the
                                    ///< passes from their mean.
    ImageT<double> block_squares{}; ///< The same as `squares`, for block means.
    /// The program's description of the picture, kept in a checkpoint. A program that
    /// resumes compares it with its own.
    std::string picture{};
};

/// The standard error of the mean of the passes.
///
/// The passes are independent: each has its own random streams, and the radii are fixed
/// in advance. The sum of the squared deviations of n independent values from their
/// mean, divided by n(n - 1), therefore estimates the variance of the mean. The
/// estimate is a little too large, because the expected values of the passes change
/// with the radius: for alpha = 2/3, the excess is the squared bias of the mean divided
/// by 3n. The estimate **does not contain the bias itself**: it measures only how much
/// the passes differ.
struct ProgressiveError {
    double pixels = 0; ///< Standard error of a pixel: root mean square over all pixels.
    double blocks = 0; ///< Standard error of a block's mean, which includes the
                       ///< correlation of its pixels.
};

/// Adds a pass to the sums, and shrinks the radius of the next.
/// \param state  The earlier passes.
/// \param image  The picture of the pass; every channel is finite.
/// \throws std::invalid_argument  if alpha is not in (0, 1], the side of blocks is
///         below 1, the picture differs in size from the first, or a channel is not
///         finite.
// [add_pass]
template <std::floating_point T>
void add_pass(ProgressiveState& state, const ImageT<T>& image) {
    require(state.alpha > 0 && state.alpha <= 1, "alpha", state.alpha, "in (0, 1]");
    require_at_least("the side of a block", state.block_side, 1);
    for (const RgbT<T>& color : image.pixels) require_finite("a pass's pixel", color);
    const auto blocks = block_means(image, state.block_side);
    if (state.passes == 0) {
        state.first_pass = detail::hash_of(image);
        state.sum = state.squares = make_image<double>(image.width, image.height);
        state.block_squares = make_image<double>(blocks.width, blocks.height);
    }
    detail::require_same_size(image, state.sum);
    const auto n = static_cast<double>(state.passes);
    detail::add_squares(state.squares, image, state.sum, n);
    detail::add_squares(state.block_squares, blocks,
                        block_means(state.sum, state.block_side), n);
    for (std::size_t p = 0; p < image.pixels.size(); ++p)
        state.sum.pixels[p] += RgbT<double>(image.pixels[p]);
    ++state.passes;
    state.shrink *= (n + 1 + state.alpha) / (n + 2);
}
// [add_pass]

/// The picture so far.
/// \param state  The sums of at least one pass.
/// \return The mean of the passes, in W/(m^2 sr).
/// \throws std::invalid_argument  if there is no pass.
template <std::floating_point T = float>
[[nodiscard]] ImageT<T> mean_image(const ProgressiveState& state) {
    require_at_least("the number of passes", state.passes, 1);
    auto mean = make_image<T>(state.sum.width, state.sum.height);
    for (std::size_t p = 0; p < mean.pixels.size(); ++p)
        mean.pixels[p] = RgbT<T>(state.sum.pixels[p] / double(state.passes));
    return mean;
}

/// The noise of the picture so far, in which bias is not counted; see ProgressiveError.
/// \return Standard errors, in W/(m^2 sr); infinity for fewer than two passes.
[[nodiscard]] inline ProgressiveError estimate_error(const ProgressiveState& state) {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    if (state.passes < 2) return {unknown, unknown};
    const auto n = static_cast<double>(state.passes);
    return {detail::standard_error(state.squares, n),
            detail::standard_error(state.block_squares, n)};
}

/// Adds passes up to a total number.
/// \param state   The earlier passes: none, or those of a checkpoint.
/// \param passes  The total number of passes.
/// \param pass    Called with i and \f$ r_i / r_1 \f$; see \ref progressive.
/// \param after   Called with the state after each pass, for a preview, a checkpoint or
///                a time limit. It returns whether to continue.
/// \return Whether the state contains all passes; a stopped pass is left out.
/// \throws std::invalid_argument  as add_pass().
// [run]
template <typename RenderPass, typename After>
bool run_progressive(ProgressiveState& state, long long passes, RenderPass&& pass,
                     After&& after) {
    while (state.passes < passes) {
        const auto rendered = pass(state.passes + 1, std::sqrt(state.shrink));
        if (!rendered.complete) return false;
        add_pass(state, rendered.image);
        if (!after(static_cast<const ProgressiveState&>(state))) break;
    }
    return state.passes >= passes;
}
// [run]

/// Checks that the passes so far belong to the picture that is to be continued: the
/// first pass is rendered again, and all bits are compared. The bits depend on the
/// world, camera, settings, seed, program and machine.
/// \param state  The state of a checkpoint.
/// \param pass   The function that will render further passes; see \ref progressive.
/// \throws std::invalid_argument  if the first pass differs.
/// \cost One pass.
template <typename RenderPass>
void require_first_pass(const ProgressiveState& state, RenderPass&& pass) {
    if (state.passes == 0) return;
    const auto again = pass(1LL, 1.0);
    if (!again.complete || detail::hash_of(again.image) == state.first_pass) return;
    throw std::invalid_argument(
        "The passes so far are of another picture: continue with the same scene, "
        "camera, settings, seed and program.");
}

/// The settings for further passes. They contain the radii that a mapper has chosen,
/// and the shares of photons that each lamp and each mirror or glass object gets.
/// \param first  The mapper of the first pass.
/// \return The settings, the same in every run of the program.
template <AnyWorld W, typename... X>
[[nodiscard]] PhotonMappingSettings
settings_for_passes(const PhotonMapper<W, X...>& first) {
    PhotonMappingSettings chosen = first.settings();
    if constexpr (W::lists_fog)
        if (chosen.fog_estimate.radius == 0 && first.passes().volume_map)
            chosen.fog_estimate.radius = float(
                typical_radius(first.maps().fog.empty() ? first.maps().fog_caustics
                                                        : first.maps().fog));
    return chosen;
}

/// One pass of the photon mapper, with its own photons and camera rays; the radii of
/// all maps are multiplied by `scale`.
///
/// With IndirectLight::rays there is no general map, and only the caustics are biased.
/// With k nearest photons the bias does not decrease until the shrinking radius is
/// smaller than the distance to the k-th photon. Automatic radii and shares are chosen
/// once, by settings_for_passes(). Each pass has its own irradiance cache, but
/// interpolation blurs the light by the same amount in every pass.
/// \param world     The closed scene.
/// \param camera    Any camera.
/// \param settings  Photons *of one pass*, and the radii of the first pass, above 0.
/// \param picture   Size; rays per pixel in one pass.
/// \param pass      The number of the pass, from 1.
/// \param scale     Factor of the radii, in (0, 1].
/// \param listed    As for a PhotonMapper; StratifiedStream for several rays per pixel.
/// \return The picture; not complete if a progress callback stopped it.
/// \throws std::invalid_argument  if a radius is 0: each pass would choose its own
///         radius, and none would shrink.
// [photon mapping pass]
template <AnyWorld W, CameraLike C, typename... X>
[[nodiscard]] RenderedT<typename C::Scalar>
photon_mapping_pass(const W& world, const C& camera, PhotonMappingSettings settings,
                    RenderSettings picture, long long pass, double scale,
                    Abilities<X...> listed = {}) {
    require_positive("caustics_estimate.radius", settings.caustics_estimate.radius);
    require_positive("general_estimate.radius", settings.general_estimate.radius);
    if (world.has_fog())
        require_positive("fog_estimate.radius", settings.fog_estimate.radius);
    const auto number = static_cast<std::uint64_t>(pass);
    settings.caustics.iteration = settings.general.iteration = number;
    picture.seed = mix_bits(mix_bits(picture.seed) + number);
    settings.caustics_estimate.radius *= static_cast<float>(scale);
    settings.general_estimate.radius *= static_cast<float>(scale);
    settings.fog_estimate.radius *= static_cast<float>(scale);
    PhotonMapper mapper(world, settings, listed);
    if (!mapper.maps().complete) return {.complete = false};
    mapper.fill_cache(camera, picture);
    return render(mapper, camera, picture);
}
// [photon mapping pass]

/// \}

} // namespace ljus
