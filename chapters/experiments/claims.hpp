#pragma once

/// \file chapters/experiments/claims.hpp
/// \brief What chapter 36 says of the trades, as numbers that a sweep is judged by.

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "common/convergence.hpp"
#include "experiments/sweep.hpp"

namespace examples {

/// A sentence of the book, and the number that it stands on.
struct Claim {
    std::string text{};  ///< What is said.
    std::string scene{}; ///< Of which room.
    double value = 0;    ///< What was measured.
    double low = 0;      ///< It must not be below.
    double high = 0;     ///< Nor above.
    double band = 0;     ///< Half width of a slope's 95 % band; 0: no slope.

    /// NaN does not.
    [[nodiscard]] bool holds() const { return value >= low && value <= high; }
    /// For the terminal.
    [[nodiscard]] std::string sentence() const {
        return text + " (" + scene + "): " + examples::text(value, "%.3g") +
               ", and should be within " + examples::text(low, "%.3g") + " to " +
               examples::text(high, "%.3g");
    }
};

/// The factor of a 95 % band for a slope through some points: Student's t.
[[nodiscard]] inline double student_95(std::size_t points) {
    constexpr std::array<double, 9> t{0,     0,     0,     12.71, 4.303,
                                      3.182, 2.776, 2.571, 2.447};
    return points < 3          ? std::numeric_limits<double>::quiet_NaN()
           : points < t.size() ? t[points]
                               : 2.2;
}

/// Collects the claims about one room.
struct Judge {
    const Notebook& notebook;   ///< The sweep.
    std::string scene;          ///< The room.
    std::vector<Claim>& claims; ///< Gets them.

    /// What was measured at a setting of a knob; NaN if it was not.
    [[nodiscard]] Measured at(const std::string& knob, const std::string& value) const {
        for (const Measured& line : notebook.of(scene, knob))
            if (line.value == value) return line;
        Measured none;
        none.noise = none.bias = none.rays = none.maps = std::nan("");
        return none;
    }

    /// Claims a slope of the fitted power law.
    /// \param text   What is said.
    /// \param knob   Along which knob.
    /// \param paths  Of the settings that trace paths, or of the others.
    /// \param part   Of which number.
    /// \param low    The least that is right.
    /// \param high   The most.
    void slope(const std::string& text, const std::string& knob, bool paths,
               double Measured::*part, double low, double high) const {
        std::vector<double> x, y;
        for (const Measured& line : notebook.of(scene, knob))
            if ((line.value.rfind("paths", 0) == 0) == paths) {
                x.push_back(line.x);
                y.push_back(line.*part);
            }
        const auto law = fit_power(x, y);
        claims.push_back(
            {text, scene, law.slope, low, high, law.error * student_95(x.size())});
    }

    /// Claims the quotient of a number at two settings of a knob.
    /// \param text   What is said.
    /// \param knob   Which knob.
    /// \param one    The setting above the line.
    /// \param other  The setting below it.
    /// \param part   Of which number.
    /// \param low    The least that is right.
    /// \param high   The most.
    void ratio(const std::string& text, const std::string& knob, const std::string& one,
               const std::string& other, double Measured::*part, double low,
               double high) const {
        claims.push_back(
            {text, scene, at(knob, one).*part / at(knob, other).*part, low, high});
    }
};

/// Judges a sweep of all knobs.
///
/// Bands of slopes are as wide as the law asks for and chance among four seeds allows;
/// ratios are those of two settings.
/// \param notebook  The sweep.
/// \return Each claim in each room.
[[nodiscard]] inline std::vector<Claim> judge(const Notebook& notebook) {
    constexpr double far = std::numeric_limits<double>::infinity();
    std::vector<Claim> claims;
    for (const std::string scene : {"cornell", "caustic", "report"}) {
        const Judge by{notebook, scene, claims};
        // Where a few paths carry most of the light, four pictures say little about the
        // noise of path tracing, and noise hides the blur of a caustic.
        if (scene == "cornell")
            by.slope("noise of path tracing ~ rays^-1", "rays", true, &Measured::noise,
                     -1.4, -0.6);
        if (scene != "report")
            by.ratio("a radius of 0.4 blurs more than one of 0.1", "radius", "0.4",
                     "0.1", &Measured::bias, 2, far);
        by.slope("noise of photons ~ photons^-1", "photons", false, &Measured::maps,
                 -1.15, -0.85);
        // -2 where the light is even; an edge or a focus within the radius has less.
        by.slope("noise of photons ~ radius^-2, or slower", "radius", false,
                 &Measured::maps, -2.2, -1.2);
        by.ratio("256 nearest photons have a sixteenth of the noise of 16", "nearest",
                 "256", "16", &Measured::maps, 0.02, 0.125);
        by.ratio("a depth of 1 loses more than one of 2", "depth", "1", "2",
                 &Measured::bias, 1.3, far);
        by.ratio("a depth of 2 loses more than one of 4", "depth", "2", "4",
                 &Measured::bias, 1.3, far);
        // At a point the variances are as 1 : 4/3 : 9/5, the mean square of each kernel
        // over its disc. A pixel here is about 1 to 1.75 radii wide, and averages:
        // with the kernels convolved by such a square, each step is 1.2 to 1.37 and 1.1
        // to 1.21.
        by.ratio("Epanechnikov's kernel has more noise than the box", "kernel",
                 "epanechnikov", "box", &Measured::maps, 1.15, 1.45);
        by.ratio("the biweight has more noise than Epanechnikov's", "kernel",
                 "biweight", "epanechnikov", &Measured::maps, 1.1, 1.35);
        by.ratio("no indirect light is a large error of blocks", "indirect", "none",
                 "rays", &Measured::block, 5, far);
        by.ratio("a finer net of points takes more rays", "gather-tile", "1", "8",
                 &Measured::rays, 1.1, far);
        by.ratio("fast has less noise than the draft", "preset", "fast", "draft",
                 &Measured::noise, 0, 0.8);
        by.ratio("double is as noisy as float", "precision", "double", "float",
                 &Measured::noise, 0.5, 2);
    }
    return claims;
}

/// Saves the claims as trades-claims.csv and .html.
/// \param folder      Where to.
/// \param claims      Of judge().
/// \param conditions  Of the sweep.
inline void save_claims(const std::string& folder, const std::vector<Claim>& claims,
                        const std::string& conditions) {
    Table table{.name = "trades-claims",
                .columns = {"claim", "room", "measured", "must lie within", "holds"},
                .notes = {conditions}};
    for (const Claim& claim : claims)
        table.rows.push_back(
            {claim.text, claim.scene,
             text(claim.value, "%.3g") +
                 (claim.band > 0 ? " ± " + text(claim.band, "%.2g") : ""),
             text(claim.low, "%.3g") + " to " + text(claim.high, "%.3g"),
             claim.holds() ? "yes" : "no"});
    save_table(folder, table);
}

} // namespace examples
