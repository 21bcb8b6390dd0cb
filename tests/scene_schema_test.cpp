// concept: load_json
/// \file scene_schema_test.cpp
/// \brief The schema of scene files, its page and the reader say the same. An
/// independent checker, of the test's own, judges by the schema.

#include <doctest/doctest.h>

#if __has_include(<nlohmann/json.hpp>)

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ljus/io/scene_schema.hpp"
#include "scratch_folder.hpp"
#include "support/json_schema.hpp"
#include "support/refusal.hpp"
#include "support/scene_page.hpp"

using namespace ljus;
using nlohmann::json;

namespace {

const json schema = json::parse(scene_schema());

bool by_schema(const json& scene) {
    return ljus_test::valid(scene, schema, schema);
}

/// Reads no mesh.
struct NothingRead {
    LoadedMesh operator()(const std::string&, const MeshFileSettings&) const {
        return {};
    }
};

std::string refusal(const json& scene) {
    return ljus_test::refusal<std::runtime_error>([&] {
        (void)read_json_scene(scene.dump(), LJUS_TEST_INPUTS "/a.json", NothingRead{});
    });
}

/// Both judge alike.
void agree(const json& scene, bool good) {
    CAPTURE(scene.dump());
    CAPTURE(refusal(scene));
    CHECK(by_schema(scene) == good);
    CHECK(refusal(scene).empty() == good);
}

const json frame = json::parse(R"({
 "camera": {"position": [0, 1, 5], "look_at": [0, 1, 0], "up": [0, 1, 0],
            "vfov_deg": 40},
 "image": {"width": 30, "height": 20},
 "materials": {"grey": {"type": "lambertian", "albedo": [0.5, 0.5, 0.5]}},
 "objects": [{"type": "sphere", "material": "grey", "center": [0, 0, 0], "radius": 1,
              "emission": [1, 1, 1]}]
})");

/// An object of a group in a scene.
struct Example {
    json scene = frame;
    json::json_pointer at; // where it is
    json& object() { return scene[at]; }
};
Example in_scene(const detail::JsonGroup& group, const json& object) {
    Example all;
    json& scene = all.scene;
    if (group.name == "scene") {
        scene.update(object);
        return all;
    }
    const std::pair<const char*, const char*> places[]{
        {"image", "/image"},
        {"camera", "/camera"},
        {"lens", "/camera/lens"},
        {"material", "/materials/new"},
        {"object", "/objects/1"},
        {"transform", "/objects/1/transform"},
        {"rotate", "/objects/0/transform/rotate"},
        {"light", "/lights/0"},
        {"gradient", "/lights/0/gradient"},
        {"fog", "/fog/0"}};
    if (group.name == "transform")
        scene["objects"][1] = {{"type", "quad"},
                               {"material", "grey"},
                               {"corner", {0, 0, 0}},
                               {"edge_u", {1, 0, 0}},
                               {"edge_v", {0, 1, 0}}};
    if (group.name == "light" || group.name == "gradient")
        scene["lights"] = json::array({json::object()});
    if (group.name == "fog") scene["fog"] = json::array({json::object()});
    if (group.name == "gradient") scene["lights"][0]["type"] = "environment";
    if (group.name == "object") scene["objects"].push_back(nullptr);
    for (const auto& [name, place] : places)
        if (group.name == name) all.at = json::json_pointer(place);
    all.object() = object;
    return all;
}

json value_of(const detail::JsonValue& value, double x) {
    using Kind = detail::JsonKind;
    if (value.kind == Kind::pair) return {x, x};
    if (value.kind == Kind::vector || value.kind == Kind::direction) return {x, x, x};
    return x;
}

template <typename Use>
void for_each_member(Use use) {
    for (const detail::JsonGroup& group : detail::scene_groups())
        for (const detail::JsonTable& table : group.tables)
            for (const detail::JsonMembers members : {group.shared, table.members})
                for (const detail::JsonMember& row : members) {
                    const json example =
                        json::parse(ljus_test::example_of(table, group.shared));
                    CAPTURE(group.name);
                    CAPTURE(table.name);
                    CAPTURE(row.name);
                    use(in_scene(group, example), group, table, row);
                }
}

} // namespace

TEST_CASE("scene schema: the examples of all objects are read") {
    agree(frame, true);
    int examples = 0;
    for (const detail::JsonGroup& group : detail::scene_groups())
        for (const detail::JsonTable& table : group.tables) {
            agree(
                in_scene(group, json::parse(ljus_test::example_of(table, group.shared)))
                    .scene,
                true);
            ++examples;
        }
    CHECK(examples == 7 + 24 + 8 + 5 + 2);
}

TEST_CASE("scene schema: what is needed must be there, and nothing unknown may be") {
    for_each_member([](Example all, const auto&, const detail::JsonTable& table,
                       const detail::JsonMember& row) {
        const std::string name(row.name);
        if (all.object().contains(name) || row.optional) {
            all.object().erase(name);
            bool one_of = false;
            for (const auto& other : table.one_of) one_of = one_of || other == row.name;
            // The page says which members of a map or a film go together.
            if (!row.optional || one_of) {
                if (!row.optional || row.name == "radiance") agree(all.scene, false);
            } else if (table.name != "checker" && table.name != "picture") {
                agree(all.scene, true);
            }
        }
    });
    for (const detail::JsonGroup& group : detail::scene_groups())
        for (const detail::JsonTable& table : group.tables) {
            Example all = in_scene(
                group, json::parse(ljus_test::example_of(table, group.shared)));
            all.object()["zzz"] = 1;
            agree(all.scene, false);
        }
}

TEST_CASE("scene schema: each number has the limits of the reader") {
    int numbers = 0;
    for_each_member([&](Example all, const auto&, const auto& table, const auto& row) {
        using Kind = detail::JsonKind;
        const auto& value = row.value;
        if (value.low == 0 && value.high == 0) return;
        if (row.name == "up" || row.name == "level" || row.name == "scale" ||
            row.name == "origin" || row.name == "edge_u" || row.name == "edge_v" ||
            row.name == "center" || row.name == "displacement") {
            // What else must be there, or what it may not be, is not in the schema.
            if (table.name == "soap-film" || table.name == "checker" ||
                table.name == "picture" || row.name == "displacement" ||
                row.name == "up")
                return;
        }
        if (table.name == "environment" && row.name == "radiance") return;
        json& object = all.object();
        const std::string name(row.name);
        const auto with = [&](double number, bool good) {
            object[name] = value_of(value, number);
            agree(all.scene, good);
        };
        ++numbers;
        const double high = value.high, low = value.low;
        with(high + (value.kind == Kind::whole ? 1 : std::abs(high) * 1e-3 + 1e-6),
             false);
        if (value.kind == Kind::length || (value.kind == Kind::direction && low < 0))
            with(0, false);
        else
            with(value.or_zero ? -1e-3
                 : value.kind == Kind::whole
                     ? low - 1
                     : low - (low == 0 ? 1e-6 : std::abs(low) * 1e-3),
                 false);
        object[name] = "text";
        agree(all.scene, false);
        object[name] = {1, 2, 3, 4};
        agree(all.scene, false);
        // Within the limits both accept it, unless another member forbids it.
        object[name] = value_of(value, value.or_zero ? low : high);
        CHECK(by_schema(all.scene));
        if (value.or_zero) with(0, true);
    });
    CHECK(numbers > 60);
}

TEST_CASE("scene schema: words are those of the reader") {
    int words = 0;
    for_each_member([&](Example all, const auto&, const auto&, const auto& row) {
        if (row.value.words.empty() && row.name != "type") return;
        json& object = all.object();
        const std::string name(row.name);
        if (name != "type" && name != "map")
            for (const std::string_view word : row.value.words) {
                object[name] = word;
                agree(all.scene, true);
                ++words;
            }
        object[name] = "no such word";
        agree(all.scene, false);
    });
    CHECK(words >= 14);
}

TEST_CASE("scene schema: every scene file in the tree is valid by it") {
    namespace fs = std::filesystem;
    int files = 0;
    for (const char* const folder : {LJUS_TEST_INPUTS, LJUS_TEST_INPUTS "/../scenes",
                                     LJUS_TEST_INPUTS "/../fuzz/seeds/json"})
        for (const auto& entry : fs::directory_iterator(folder)) {
            if (entry.path().extension() != ".json") continue;
            CAPTURE(entry.path().string());
            const json scene =
                json::parse(detail::load_text(entry.path().string(), 1 << 24));
            CHECK(by_schema(scene));
            ++files;
        }
    CHECK(files >= 6);
}

TEST_CASE("scene schema: the page has its tables") {
    const std::string path = LJUS_TEST_INPUTS "/../../chapters/scene_files.md";
    const std::string page = detail::load_text(path, 1 << 20);
    const std::string tables = ljus_test::scene_tables();
    const bool there = page.find(tables) != page.npos;
    const ScratchFolder folder;
    if (!there) {
        const std::string file = folder.file("tables.md");
        save_file(file, Bytes(tables.begin(), tables.end()));
        MESSAGE("the right tables: " << tables);
    }
    CHECK(there);
}

#endif
