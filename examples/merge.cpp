/// \file merge.cpp
/// \brief Merges the slices of a picture: ljus-merge.
///
///     render scene.json --slice 3/16 --out part        on one machine of sixteen
///     ljus-merge part/* --out picture.png              when all are there
///
/// The picture is byte for byte the one that a single process renders. If a slice is
/// missing, given twice, damaged, or of another picture, the program names it and
/// writes no picture.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/picture_slice.hpp"
#include "common/program_files.hpp"
#include "common/save_picture.hpp"

namespace {

/// The files that the user has named. A folder stands for all slices in it.
std::vector<std::string> files_of(const std::vector<std::string>& names) {
    std::vector<std::string> files;
    for (const std::string& name : names) {
        std::error_code error;
        if (!std::filesystem::is_directory(name, error)) {
            files.push_back(name);
            continue;
        }
        const std::size_t before = files.size();
        for (const auto& entry : std::filesystem::directory_iterator(name))
            if (entry.path().extension() == ".slice")
                files.push_back(entry.path().string());
        if (files.size() == before)
            throw std::runtime_error("the folder '" + name + "' has no slice");
        std::sort(files.begin() + std::ptrdiff_t(before), files.end());
    }
    return files;
}

void body(examples::CommandLine& line) {
    std::vector<std::string> names;
    line.about("Merges the slices of a picture, made by `render --slice K/N`.");
    line.without({"--quality", "--seed", "--threads", "--width", "--height", "--rays"});
    line.add("SLICE", names, "Files, or folders of files NAME.slice");
    line.file_types(examples::picture_types());
    const examples::Options options = line.parse();
    const std::string path =
        options.path(options.file.empty() ? "picture.png" : options.file);
    const std::vector<std::string> slices = files_of(names);
    examples::require_outputs(
        {{"--out", path}, {"the file of settings beside --out", path + ".json"}},
        slices);
    const examples::MergedPicture merged = examples::merge_slices(slices);
    if (merged.wide) {
        examples::save_picture(merged.image, path, merged.exposure);
    } else { // exact, because the numbers were float
        auto image = ljus::make_image(merged.image.width, merged.image.height);
        std::transform(merged.image.pixels.begin(), merged.image.pixels.end(),
                       image.pixels.begin(),
                       [](const auto& color) { return ljus::Rgb(color); });
        examples::save_picture(image, path, merged.exposure);
    }
    ljus::save_file(path + ".json",
                    ljus::Bytes(merged.settings.begin(), merged.settings.end()));
    if (!options.quiet)
        std::printf("%d x %d pixels\n  %s\n", merged.image.width, merged.image.height,
                    path.c_str());
}

} // namespace

/// Merges slices.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, body);
}
