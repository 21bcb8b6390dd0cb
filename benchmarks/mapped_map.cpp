/// \file mapped_map.cpp
/// \brief A map of a hundred million photons in a file: made, saved, opened and searched,
/// beside the same map in memory.
///
/// It needs 6 GB of memory and 5 GB on the disk, and Linux. "Cold" means that the system
/// has forgotten the file. An estimate adds up the photons within the typical radius of
/// 50, in one thread; there are 20000.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <ljus/io/photon_map_file.hpp>
#include <ljus/render/photon_mapping.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/clock.hpp"
#include "csv.hpp"

namespace {

using namespace ljus;

/// The number after a word in a file of /proc.
double of_process(const char* file, const std::string& word) {
    std::ifstream in(file);
    std::string found;
    double number = 0;
    while (in >> found)
        if (found == word) in >> number;
    return number;
}

/// What a step has cost.
class Steps {
public:
    /// Runs a step, and adds a row.
    template <typename Work>
    void operator()(const std::string& name, const Work& work) {
        ::rusage before{}, after{};
        ::getrusage(RUSAGE_SELF, &before);
        const double read = of_process("/proc/self/io", "read_bytes:");
        const examples::Timing time = examples::timed(work);
        ::getrusage(RUSAGE_SELF, &after);
        const auto add = [&](double value, const char* format) {
            row.push_back(examples::text(value, format));
        };
        row = {name};
        add(time.wall, "%.3g");
        add(time.work, "%.3g");
        add(double(after.ru_majflt - before.ru_majflt), "%.0f");
        add((of_process("/proc/self/io", "read_bytes:") - read) / 1e6, "%.0f");
        add(of_process("/proc/self/status", "RssFile:") * 1024 / 1e6, "%.0f");
        for (const std::string& cell : row) std::printf("%-34s", cell.c_str());
        std::printf("\n");
        std::fflush(stdout);
        table.rows.push_back(row);
    }
    examples::Table table{.name = "kd_tree-mapped",
                          .columns = {"step", "seconds", "processor seconds",
                                      "page faults that read", "MB read",
                                      "MB of the file in memory"}};

private:
    std::vector<std::string> row;
};

/// Makes the system forget what it has read of a file.
void forget(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDONLY);
    if (file < 0 || ::posix_fadvise(file, 0, 0, POSIX_FADV_DONTNEED) != 0) std::abort();
    ::close(file);
}

} // namespace

/// Prints the table, and saves it with `--csv FOLDER`; `--paths N` traces fewer.
int main(int argc, char** argv) {
    const std::string folder = csv_folder(argc, argv);
    const std::string path = (folder.empty() ? "." : folder) + "/mapped_map.photons";
    long long paths = 53'200'000;
    for (int i = 1; i + 1 < argc; ++i)
        if (std::strcmp(argv[i], "--paths") == 0) paths = std::atoll(argv[i + 1]);
    Steps step;
    const auto room = cornell_box();
    PhotonMappingSettings settings{.indirect = IndirectLight::map};
    settings.caustics.photons = 0;
    settings.general.photons = paths;
    settings.general.max_memory = 1e11;
    std::optional<PhotonMapper<std::remove_cvref_t<decltype(room.world)>>> mapper;
    step("traced and put into a tree", [&] { mapper.emplace(room.world, settings); });
    const PhotonMap& memory = mapper->maps().general;
    const std::size_t photons = memory.records.size();
    std::printf("%zu photons, at most %.1f bytes each; %.1f in the map\n", photons,
                of_process("/proc/self/status", "VmHWM:") * 1024 / double(photons),
                double(memory.tree.bytes() + memory.records.bytes()) / double(photons));
    step("saved", [&] { save_photon_map(path, memory); });

    // Places on surfaces: anywhere, and beside each other.
    const DensityEstimateSettings disc{.radius = float(typical_radius(memory, 50))};
    constexpr std::size_t searches = 20000;
    std::vector<SurfacePoint> anywhere, near;
    for (std::size_t i = 0; i < searches; ++i)
        for (auto* const list : {&anywhere, &near}) {
            const std::size_t photon =
                list == &near ? photons / 2 + i : i * 1029470957 % photons;
            SurfacePoint& point = list->emplace_back();
            point.position = memory.tree.point(photon);
            point.normal = glm::normalize(Vec3(memory.records[photon].normal));
        }
    Rgb sum{0};
    const auto ask = [&](const PhotonMap& map,
                         const std::vector<SurfacePoint>& places) {
        return [&] {
            for (const SurfacePoint& place : places)
                sum += estimate_irradiance(map, place, place.normal, disc);
        };
    };
    step("estimates anywhere (in memory)", ask(memory, anywhere));
    step("estimates nearby (in memory)", ask(memory, near));
    const Rgb in_memory = sum;
    mapper.reset();

    forget(path);
    step("opened and checked (cold)", [&] { (void)open_photon_map(path); });
    for (const bool single : {false, true}) {
        forget(path);
        const std::string how = single ? " (single pages)" : " (cold)";
        PhotonMap map;
        step("opened" + how, [&] {
            map = open_photon_map(path, {.check = false, .single_pages = single});
        });
        sum = Rgb{0};
        step("estimates anywhere" + how, ask(map, anywhere));
        step("estimates nearby" + how, ask(map, near));
        if (sum != in_memory) {
            std::fprintf(stderr, "the map in the file gives other estimates\n");
            return 1;
        }
        if (single) break;
        step("estimates anywhere (warm)", ask(map, anywhere));
        step("estimates nearby (warm)", ask(map, near));
    }
    std::remove(path.c_str());
    save_csv(folder, step.table);
    return 0;
}
