#pragma once

/// \file ljus/io/load_ies.hpp
/// \brief Reads the measured intensities of lamps from IES files.

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "ljus/io/detail/parse.hpp"
#include "ljus/lights/goniometric_light.hpp"

namespace ljus {

/// \defgroup load_ies IES files
/// \brief Files of the North American standard LM-63 \cite lm63, in which makers of
/// lamps publish measurements. Chapter: \ref ch_lamps.
///
/// This header reads the versions of 1986, 1991, 1995, 2002 and 2019, with all types of
/// photometry, all symmetries, `TILT=NONE` and `TILT=INCLUDE`. A tilt table says how a
/// lamp dims when its luminaire is tilted; it is read and not used.
/// \{

/// The content of an IES file.
struct IesLamp {
    /// Intensities in cd, in all directions. They include the multiplier and the
    /// ballast factors of the file.
    IntensityTable table{};
    /// Rated flux of all lamps in the luminaire, in lm; -1 if the file does not give
    /// the flux.
    double lumens = 0;
    double watts = 0; ///< Electric power of the luminaire, in W.
};

namespace detail {

/// The largest IES file that is read, in bytes.
inline constexpr std::size_t max_ies_file = std::size_t(1) << 22;

/// Reads the words and numbers of an IES file, and counts its lines.
struct IesReader {
    std::string_view rest;   ///< The text that is not read yet.
    const std::string& file; ///< The path of the file.
    long long line = 0;      ///< The number of the current line.
    Words words{};           ///< The unread words of the current line.

    /// Throws an exception that names the file and the current line.
    [[noreturn, gnu::cold]] void refuse_line(std::string_view why) const {
        refuse_file(file, join({"line ", to_text(line), ": ", why}));
    }
    std::string_view take() {
        ++line;
        return take_line(rest);
    }
    /// The next word of the line, up to a blank or a comma. The result is empty at the
    /// end of the line, and if a comma follows a blank.
    std::string_view word() {
        const std::string_view to_blank = words.next();
        const std::string_view text = to_blank.substr(0, to_blank.find(','));
        if (text.size() < to_blank.size()) {
            const char* const next = text.data() + text.size() + 1;
            const char* const end = words.rest.data() + words.rest.size();
            words.rest = {next, static_cast<std::size_t>(end - next)};
        }
        return text;
    }
    /// The next word of the file; empty at its end.
    std::string_view next_word() {
        std::string_view text = word();
        while (text.empty() && !(words.rest.empty() && rest.empty())) {
            if (words.rest.empty()) words.rest = take();
            text = word();
        }
        return text;
    }
    double number(const char* what) {
        const std::string_view text = next_word();
        if (text.empty()) refuse_line(join({"the file ends before ", what}));
        const double value = number_of(text);
        if (!std::isfinite(value))
            refuse_line(join(
                {what, " is '", shown(std::string(text)), "'; it must be a number"}));
        return value;
    }
    double number(const char* what, double low, double high) {
        const double value = number(what);
        if (!(value >= low && value <= high))
            refuse_line(join({what, " is ", to_text(value), "; it must be within [",
                              to_text(low), ", ", to_text(high), "]"}));
        return value;
    }
    std::size_t count(const char* what, double low, double high) {
        const double value = number(what, low, high);
        if (value != std::floor(value))
            refuse_line(
                join({what, " is ", to_text(value), "; it must be a whole number"}));
        return static_cast<std::size_t>(value);
    }
    /// Reads angles, each of which must be larger than the one before.
    std::vector<double> angles(const char* what, std::size_t count, double low,
                               double high) {
        std::vector<double> all;
        while (all.size() < count) {
            const double angle = number(what, low, high);
            if (!all.empty() && !(angle - all.back() >= 1e-3))
                refuse_line(
                    join({what, " is ", to_text(angle),
                          "; it must be above the one before, ", to_text(all.back())}));
            all.push_back(angle);
        }
        return all;
    }
};

/// The intensities of a file: for each horizontal angle, those of all vertical angles.
struct IesGrid {
    std::vector<double> horizontal{}; ///< Horizontal angles in degrees.
    std::vector<double> vertical{};   ///< Vertical angles in degrees.
    std::vector<double> candela{};    ///< Intensities in cd.

    /// Appends, at the horizontal angle `angle`, a column of the grid `from`, which has
    /// the same vertical angles.
    void append(double angle, const IesGrid& from, std::size_t column) {
        horizontal.push_back(angle);
        for (std::size_t i = 0; i < vertical.size(); ++i)
            candela.push_back(from.candela[column * vertical.size() + i]);
    }
    /// Appends the mirror images of all columns but the last. The mirror plane goes
    /// through the last column.
    void mirror() {
        const double plane = horizontal.back();
        for (std::size_t column = horizontal.size() - 1; column > 0; --column)
            append(2 * plane - horizontal[column - 1], *this, column - 1);
    }
};

/// Completes the intensities by the symmetry that the range of the horizontal angles
/// implies. `around` is true if these angles go around the axis, as in type C.
/// \return The range that the angles should have, in words; null if the range is valid.
[[nodiscard]] inline const char* complete(IesGrid& grid, bool around) {
    const double first = grid.horizontal.front(), last = grid.horizontal.back();
    if (!around) {
        if (first == 0 && last == 90) { // the left side mirrors the right one
            IesGrid left{.vertical = grid.vertical};
            for (std::size_t column = grid.horizontal.size() - 1; column > 0; --column)
                left.append(-grid.horizontal[column], grid, column);
            for (std::size_t column = 0; column < grid.horizontal.size(); ++column)
                left.append(grid.horizontal[column], grid, column);
            grid = std::move(left);
            return nullptr;
        }
        return first == -90 && last == 90 ? nullptr : "from 0 or -90 to 90";
    }
    // [complete]
    if (first == 0 && last == 0) { // rotationally symmetric
        grid.append(360, grid, 0);
    } else if (first == 0 && last == 90) { // four equal quarters
        grid.mirror();
        grid.mirror();
    } else if ((first == 0 && last == 180) || (first == 90 && last == 270)) {
        grid.mirror(); // two equal halves
    } else if (first == 0 && last > 180 && last < 360) {
        grid.append(360, grid, 0); // files leave out the last angle
    } else if (!(first == 0 && last == 360)) {
        return "from 0 to 0, 90, 180 or 360, or from 90 to 270";
    }
    // [complete]
    return nullptr;
}

/// The table of a complete grid. For photometers of the types B and A, a polar angle is
/// measured from the pole: it is 90 degrees minus an angle of the file.
[[nodiscard]] inline IntensityTable table_of(Photometry type, const IesGrid& grid) {
    const std::size_t rows = grid.vertical.size(), columns = grid.horizontal.size();
    IntensityTable table{.type = type};
    const auto from_pole = [](const std::vector<double>& angles) {
        std::vector<double> polar;
        for (std::size_t i = angles.size(); i > 0; --i)
            polar.push_back(90 - angles[i - 1]);
        return polar;
    };
    if (type == Photometry::c) {
        table.polar = grid.vertical;
        table.azimuth = grid.horizontal;
        table.candela = grid.candela;
    } else if (type == Photometry::a) {
        table.polar = from_pole(grid.vertical);
        table.azimuth = grid.horizontal;
        for (std::size_t j = 0; j < columns; ++j)
            for (std::size_t i = rows; i > 0; --i)
                table.candela.push_back(grid.candela[j * rows + i - 1]);
    } else {
        table.polar = from_pole(grid.horizontal);
        table.azimuth = grid.vertical;
        for (std::size_t i = 0; i < rows; ++i)
            for (std::size_t j = columns; j > 0; --j)
                table.candela.push_back(grid.candela[(j - 1) * rows + i]);
    }
    return table;
}

} // namespace detail

/// Reads a lamp from the text of an IES file.
/// \return The lamp with its complete table.
/// \throws std::runtime_error  with one sentence: "desk.ies: line 12: a vertical angle
///         is 20; it must be above the one before, 25."
/// \cost Time and memory linear in the size of the file.
[[nodiscard, gnu::cold]] inline IesLamp read_ies(std::string_view source,
                                                 const std::string& file) {
    detail::IesReader in{detail::plain_text(source, file), file};
    const bool since_2019 = in.rest.starts_with("IES:"); // before, "IESNA:" or others
    std::string_view tilt;
    while (!tilt.starts_with("TILT=")) {
        if (in.rest.empty())
            detail::fail_to_read(file,
                                 "no line begins with 'TILT=', which comes before "
                                 "the numbers of an IES file");
        tilt = in.take();
    }
    tilt = detail::Words{tilt.substr(5)}.next();
    if (detail::same_word(tilt, "INCLUDE")) {
        (void)in.number("the position of the lamp for the tilt", 1, 3);
        const std::size_t angles = in.count("the number of tilt angles", 1, 1000);
        for (std::size_t i = 0; i < 2 * angles; ++i) (void)in.number("a tilt");
    } else if (!detail::same_word(tilt, "NONE")) {
        in.refuse_line(detail::join({"the tilt is '", shown(std::string(tilt)),
                                     "'; it must be NONE or INCLUDE"}));
    }

    const auto lamps = static_cast<double>(in.count("the number of lamps", 1, 1e6));
    const double lumens = in.number("the flux of a lamp", -1, 1e12);
    double factor = in.number("the multiplier", 1e-9, 1e9);
    const std::size_t rows = in.count("the number of vertical angles", 2, 100000);
    const std::size_t columns = in.count("the number of horizontal angles", 1, 100000);
    const std::size_t type = in.count("the type of photometry", 1, 3);
    (void)in.count("the unit of length", 1, 2);
    for (int side = 0; side < 3; ++side) (void)in.number("a side of the luminaire");
    factor *= in.number("the ballast factor", 1e-9, 1e9);
    // Since 2019, a number in its place tells how the file was made, such as 1.1 for an
    // accredited laboratory.
    const double second = in.number("the ballast-lamp factor", 1e-9, 1e9);
    if (!since_2019) factor *= second;
    IesLamp lamp{.lumens = lumens < 0 ? -1 : lamps * lumens,
                 .watts = in.number("the power", 0, 1e12)};

    const bool around = type == 1; // type C
    detail::IesGrid grid;
    grid.vertical =
        in.angles("a vertical angle", rows, around ? 0 : -90, around ? 180 : 90);
    grid.horizontal =
        in.angles("a horizontal angle", columns, around ? 0 : -90, around ? 360 : 90);
    const double first = grid.horizontal.front(), last = grid.horizontal.back();
    for (std::size_t i = 0; i < rows * columns; ++i)
        grid.candela.push_back(factor * in.number("an intensity", 0, 1e9));
    if (std::isfinite(detail::number_of(in.next_word())))
        in.refuse_line(
            "a number follows the last intensity; there must be one for each "
            "pair of angles, and decimals must have a point");
    if (const char* const right = detail::complete(grid, around))
        detail::fail_to_read(
            file, detail::join({"its horizontal angles go from ", to_text(first),
                                " to ", to_text(last), "; they must go ", right}));
    lamp.table = detail::table_of(around      ? Photometry::c
                                  : type == 2 ? Photometry::b
                                              : Photometry::a,
                                  grid);
    return lamp;
}

/// Loads an IES file; see read_ies().
/// \throws std::runtime_error  as read_ies(), or if the file cannot be read.
[[nodiscard]] inline IesLamp load_ies(const std::string& path) {
    return read_ies(detail::load_text(path, detail::max_ies_file), path);
}

/// \}

} // namespace ljus
