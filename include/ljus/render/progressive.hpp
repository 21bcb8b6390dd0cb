#pragma once

/// \file ljus/render/progressive.hpp
/// \brief Photon mapping that converges: many passes, each with a smaller radius.

#include <cmath>
#include <limits>

#include "ljus/render/detail/pass_sums.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"

namespace ljus {

/// \defgroup progressive Progressive photon mapping
/// \brief The mean of passes that forget their photons. Chapter: \ref ch_progressive.
///
/// A *pass* is called as pass(i, scale) with i = 1, 2, ...; it traces photons of its
/// own, renders a picture with all radii times `scale`, and returns a RenderedT, or
/// anything that has its `image` and `complete`. photon_mapping_pass() is one.
/// \{

/// The mean of many passes: the plain twin of run_progressive(). Pass i has the radius
/// \f$ r_i \f$, with \f$ r_{i+1}^2 = r_i^2\,(i + \alpha)/(i + 1) \f$; variance then
/// falls with \f$ n^{-\alpha} \f$, and squared bias with \f$ n^{-2(1-\alpha)} \f$.
/// \param passes  n, at least 1.
/// \param pass    Called with i and \f$ r_i / r_1 \f$; see \ref progressive.
/// \param alpha   In (0, 1]; with 1 the radius stays as it is.
/// \return The mean, added in double.
/// \cite knaus2011
// [plain]
template <typename RenderPass>
[[nodiscard]] ImageT<double> progressive_mean(long long passes, RenderPass&& pass,
                                              double alpha = 2.0 / 3) {
    ImageT<double> mean;
    double shrink = 1; // of the radius, squared
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

/// All that is left of the passes so far: as large after a million as after one. Plain
/// data; alpha and the side of blocks may be set before the first pass.
struct ProgressiveState {
    double alpha = 2.0 / 3; ///< In (0, 1]; see progressive_mean().
    int block_side = 8;     ///< Pixels; neighbours share photons, and err together.
    double shrink = 1;      ///< \f$ r_i^2 / r_1^2 \f$ of the next pass.
    long long passes = 0;   ///< In the sums.
    std::uint64_t first_pass = 0;   ///< A hash of the first one's picture.
    ImageT<double> sum{};           ///< Of the passes, W/(m^2 sr).
    ImageT<double> squares{};       ///< Of their distances from the mean.
    ImageT<double> block_squares{}; ///< The same of the means of blocks of pixels.
};

/// How far the mean of the passes is from where it would be with other random numbers.
///
/// The passes draw from streams of their own and the radii are set beforehand, so that
/// no pass depends on another. The squared distances of n independent numbers from
/// their mean, over n(n - 1), are the variance of the mean also where a later one
/// scatters more than an earlier one, as they do here. What the shrinking radius adds
/// is that the passes' expectations move: this makes the estimate too large, by a share
/// of the squared bias that vanishes, 1/(3n) for alpha = 2/3. The **bias itself is not
/// in it**: a blur that all passes share does not show in how they differ.
struct ProgressiveError {
    double pixels = 0; ///< Standard error of a pixel: its root mean square over all.
    double blocks = 0; ///< The same of a block's mean, with what its pixels share.
};

/// Adds a pass to the sums, and shrinks the radius of the next.
/// \param state  Of the passes before.
/// \param image  The pass; every channel finite.
/// \throws std::invalid_argument  if alpha is not in (0, 1], the side of blocks is
///         below 1, or the picture has another size than the first, or a NaN.
// [add_pass]
template <std::floating_point T>
void add_pass(ProgressiveState& state, const ImageT<T>& image) {
    require(state.alpha > 0 && state.alpha <= 1, "alpha", state.alpha, "in (0, 1]");
    require_at_least("the side of a block", state.block_side, 1);
    for (const RgbT<T>& color : image.pixels) require_finite("a pass's pixel", color);
    const auto blocks = detail::means_of_blocks(image, state.block_side);
    if (state.passes == 0) {
        state.first_pass = detail::hash_of(image);
        state.sum = state.squares = make_image<double>(image.width, image.height);
        state.block_squares = make_image<double>(blocks.width, blocks.height);
    }
    detail::require_same_size(image, state.sum);
    const auto n = static_cast<double>(state.passes);
    detail::add_squares(state.squares, image, state.sum, n);
    detail::add_squares(state.block_squares, blocks,
                        detail::means_of_blocks(state.sum, state.block_side), n);
    for (std::size_t p = 0; p < image.pixels.size(); ++p)
        state.sum.pixels[p] += RgbT<double>(image.pixels[p]);
    ++state.passes;
    state.shrink *= (n + 1 + state.alpha) / (n + 2);
}
// [add_pass]

/// The picture so far.
/// \param state  Of at least one pass.
/// \return The mean of the passes, W/(m^2 sr).
/// \throws std::invalid_argument  if there is no pass.
template <std::floating_point T = float>
[[nodiscard]] ImageT<T> mean_image(const ProgressiveState& state) {
    require_at_least("the number of passes", state.passes, 1);
    auto mean = make_image<T>(state.sum.width, state.sum.height);
    for (std::size_t p = 0; p < mean.pixels.size(); ++p)
        mean.pixels[p] = RgbT<T>(state.sum.pixels[p] / double(state.passes));
    return mean;
}

/// How noisy the picture so far is. Its bias is not in it; see ProgressiveError.
/// \param state  Of some passes.
/// \return Standard errors in W/(m^2 sr); infinity for less than two passes.
[[nodiscard]] inline ProgressiveError estimate_error(const ProgressiveState& state) {
    constexpr double unknown = std::numeric_limits<double>::infinity();
    if (state.passes < 2) return {unknown, unknown};
    const auto n = static_cast<double>(state.passes);
    return {detail::standard_error(state.squares, n),
            detail::standard_error(state.block_squares, n)};
}

/// Adds passes until there are enough.
/// \param state   Of the passes before: none, or those of a checkpoint.
/// \param passes  How many there shall be in all.
/// \param pass    Called with i and \f$ r_i / r_1 \f$; see \ref progressive.
/// \param after   Called with the state after each pass: the place for a preview, a
///                checkpoint, a look at the clock. It returns whether to go on.
/// \return Whether all passes are in the state; one that was stopped is left out.
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

/// Refuses to go on with passes of another picture. Whatever makes a picture what it is
/// (scene, camera, settings, seed, program, machine), makes its first pass what it is:
/// so that is rendered again, and must come out bit by bit as it did.
/// \param state  Of a checkpoint.
/// \param pass   That will go on.
/// \throws std::invalid_argument  in a sentence, if its first pass is another.
/// \cost One pass.
template <typename RenderPass>
void require_first_pass(const ProgressiveState& state, RenderPass&& pass) {
    if (state.passes == 0) return;
    const auto again = pass(1LL, 1.0);
    if (!again.complete || detail::hash_of(again.image) == state.first_pass) return;
    throw std::invalid_argument(
        "The passes so far are of another picture: scene, camera, settings, seed and "
        "program must be as they were.");
}

/// Settings of which nothing is left to choose from a pass's photons: with the radii
/// that are 0 chosen, and the shares that a budget asks for found by one pilot.
/// \param scene     The scene.
/// \param settings  Photons of one pass.
/// \return The same settings for each pass, and each time the program runs.
/// \throws std::invalid_argument  if a setting is out of range.
/// \cost With a radius of 0, the photon maps of one pass; with a budget, its pilot.
template <SceneLike S>
[[nodiscard]] PhotonMappingSettings
settings_for_passes(const S& scene, PhotonMappingSettings settings) {
    check(settings);
    if (detail::choose_passes(needs(scene), settings).caustics_map)
        settings.caustics.shares = caustic_shares(scene, settings);
    if (settings.caustics_estimate.radius > 0 && settings.general_estimate.radius > 0)
        return settings;
    const auto maps = make_photon_maps(scene, settings);
    return make_photon_mapper(scene, maps, settings).settings;
}

/// One pass of the photon mapper: photons of its own, camera rays of its own, and all
/// radii, of the caustics map and of the general map, times `scale`.
///
/// With IndirectLight::rays there is no general map, and only the caustics are biased
/// and have to converge. With k nearest photons the k-th sets the radius until the
/// shrinking one is smaller, and until then no bias goes away. A radius that is chosen
/// from the photons, and shares that a pilot finds, are chosen once: see
/// settings_for_passes(). Points of an irradiance cache are the pass's own, but the
/// interpolation between them blurs as much in every pass.
/// \tparam Draws    RandomStream, or StratifiedStream for several rays per pixel.
/// \param scene     The scene, or an IndexedScene, which saves indexing it each time.
/// \param camera    A CameraT, or anything with a camera_ray().
/// \param settings  Photons *of one pass*; the radii of the first, above 0.
/// \param picture   Size; rays per pixel in one pass.
/// \param pass      Its number, from 1 on.
/// \param scale     Of the radii, in (0, 1].
/// \return The picture; not complete if a progress callback stopped it.
/// \throws std::invalid_argument  if a radius is 0: each pass would choose its own, and
///         none would shrink.
// [photon mapping pass]
template <typename Draws = RandomStream, SceneLike S,
          template <std::floating_point> typename AnyCamera, std::floating_point T>
[[nodiscard]] RenderedT<T>
photon_mapping_pass(const S& scene, const AnyCamera<T>& camera,
                    PhotonMappingSettings settings, RenderSettings picture,
                    long long pass, double scale) {
    require_positive("caustics_estimate.radius", settings.caustics_estimate.radius);
    require_positive("general_estimate.radius", settings.general_estimate.radius);
    const auto number = static_cast<std::uint64_t>(pass);
    settings.caustics.iteration = settings.general.iteration = number;
    picture.seed = mix_bits(mix_bits(picture.seed) + number);
    settings.caustics_estimate.radius *= static_cast<float>(scale);
    settings.general_estimate.radius *= static_cast<float>(scale);
    auto maps = make_photon_maps(scene, settings);
    if (!maps.complete) return {.complete = false};
    add_irradiance_cache(maps, scene, camera, picture, settings);
    return render(make_photon_mapper<Draws>(scene, maps, settings), camera, picture);
}
// [photon mapping pass]

/// \}

} // namespace ljus
