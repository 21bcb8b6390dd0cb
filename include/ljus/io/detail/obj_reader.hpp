#pragma once

/// \file ljus/io/detail/obj_reader.hpp
/// \brief How load_obj() reads: line by line, trusting no number.

#include <map>

#include "ljus/image/color.hpp"
#include "ljus/io/detail/mesh_builder.hpp"
#include "ljus/io/detail/obj_material.hpp"

namespace ljus {

/// \defgroup obj_reader Reading mesh files
/// \brief Lines, words and numbers of OBJ and MTL files. No number is trusted: what
/// cannot be used is counted in the report, with its line.
/// \{

namespace detail {

// The number, from 0, that a number of the file means in a list of `count`.
inline std::uint32_t place_of(long long number, std::size_t count) {
    const auto all = static_cast<long long>(count);
    if (number == 0 || number > all || number < -all) return no_number;
    return static_cast<std::uint32_t>(number > 0 ? number - 1 : number + all);
}

// Reads a file line by line. Which materials there are is known at its end.
template <std::floating_point T>
class ObjReader {
public:
    ObjReader(const std::string& file, const MeshFileSettings& settings)
        : file_(file), text_{file}, mesh_(settings) {}

    // Reads a piece of the file, as LineReader::read() does.
    std::size_t read(std::string_view piece, bool last) {
        return text_.read(piece, last, [&](std::string_view line, long long number) {
            mesh_.place = number;
            read_line({line});
        });
    }

    // The faces by material, in the order of its first use, and the whole report.
    std::vector<MeshFacesT<T>> take_faces(MeshReport& report) {
        std::vector<const MeshMaterial*> known(names_.size() + 1); // nullptr for none
        for (const auto& [name, use] : names_) {
            const auto found = libraries_.materials.find(name);
            if (found == libraries_.materials.end())
                mesh_.report.add(MeshTrouble::no_material, use.at.line, use.at.count);
            else if (!name.empty())
                known[use.number] = &found->second;
        }
        std::vector<MeshFacesT<T>> parts = mesh_.take_faces(known);
        for (MeshFacesT<T>& part : parts)
            if (!part.colors.empty()) part.material.diffuse = glm::dvec3(1);
        unused_.tell(file_, mesh_.report.notes);
        report = std::move(mesh_.report);
        return parts;
    }

private:
    // A name of a material.
    struct Name {
        std::uint32_t number;
        MeshCount at; // lines usemtl
    };

    void read_line(Words words) {
        const std::string_view keyword = words.next();
        if (keyword == "v")
            vertex(words);
        else if (keyword == "vn")
            mesh_.add_normal(three_numbers(words));
        else if (keyword == "vt")
            texture(words);
        else if (keyword == "f" || keyword == "fo") // as old files have it
            face(words);
        else if (keyword == "usemtl")
            use(words.name());
        else if (keyword == "mtllib")
            libraries_.add(words.name(), file_, mesh_.place, mesh_.report);
        else if (keyword == "s")
            smoothing(words.next());
        else if (keyword == "o")
            ++mesh_.report.content.objects;
        else if (keyword == "g")
            ++mesh_.report.content.groups;
        else if (is_one_of(keyword, {"l", "p", "curv", "curv2", "surf", "bsp", "bzp",
                                     "cdc", "cdp"}))
            mesh_.report.add(MeshTrouble::no_face, mesh_.place);
        else if (!is_one_of(keyword, without_effect))
            unused_.add(keyword, mesh_.place);
    }
    void vertex(Words words) {
        mesh_.add_position(three_numbers(words));
        Words color = words;
        (void)words.next(); // a weight, or red: a colour has three numbers
        if (words.next().empty()) return;
        glm::dvec3 light = three_numbers(color);
        for (int i = 0; i < 3; ++i)
            if (light[i] >= 0 && light[i] <= 1) light[i] = srgb_decode(light[i]);
        mesh_.add_color(light);
    }
    void texture(Words words) {
        const double u = number_of(words.next());
        const std::string_view second = words.next(); // of a picture of one row: none
        mesh_.add_uv(u, second.empty() ? 0 : number_of(second));
    }
    void use(const std::string& name) {
        const auto number = static_cast<std::uint32_t>(names_.size() + 1); // 0: none
        Name& known =
            names_.try_emplace(name, Name{number, {0, mesh_.place}}).first->second;
        ++known.at.count;
        mesh_.material = known.number;
    }
    void smoothing(std::string_view group) {
        mesh_.in_smooth_group = !group.empty() && group != "off" && group != "0";
    }
    // Adds a corner of a face, "1/2/3", "1//3" or "-1".
    void corner(std::string_view word) {
        const std::array<std::size_t, 3> counts = mesh_.counts();
        std::array<std::uint32_t, 3> at{no_number, no_number, no_number};
        for (std::size_t k = 0; k < 3 && !word.empty(); ++k) {
            const std::size_t end = std::min(word.find('/'), word.size());
            const char* const last = word.data() + end;
            long long number = 0;
            const auto [stop, error] = std::from_chars(word.data(), last, number);
            if (end > 0 && (stop != last || error != std::errc{})) break;
            at[k] = place_of(number, counts[k]);
            if (end > 0 && at[k] == no_number) mesh_.miss(k);
            word.remove_prefix(std::min(end + 1, word.size()));
        }
        // A word that is written otherwise means no position.
        if (!word.empty()) mesh_.miss(of_position);
        mesh_.add_corner(at[of_position], at[of_uv], at[of_normal]);
    }
    void face(Words words) {
        for (auto word = words.next(); !word.empty(); word = words.next()) corner(word);
        mesh_.end_face();
    }

    // What belongs to curves, or says how others draw faces.
    static constexpr std::string_view without_effect[]{
        "",       "vp",     "cstype",     "deg",      "bmat", "step",  "parm",
        "trim",   "hole",   "scrv",       "sp",       "end",  "con",   "res",
        "mg",     "bevel",  "c_interp",   "d_interp", "lod",  "ctech", "stech",
        "maplib", "usemap", "shadow_obj", "trace_obj"};

    const std::string& file_; // its name, beside which its material files are
    UnusedLines unused_{};
    LineReader text_;
    MeshBuilder<T> mesh_;
    MaterialLibraries libraries_{};
    std::map<std::string, Name> names_{};
};

} // namespace detail

/// \}

} // namespace ljus
