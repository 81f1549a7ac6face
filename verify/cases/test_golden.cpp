// SPDX-License-Identifier: BSD-3-Clause
// Saved states of every format version that the library reads exist and are read, whatever version wrote them:
// golden/vN-NAME.state, with the values in golden/vN-NAME.txt (key value). A scene is saved in the least version that
// holds its state. Given a folder as its argument, the program writes both for the present versions.
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "small_analysis.hpp"

#ifndef DELAM_GOLDEN
#error "DELAM_GOLDEN: folder of the saved states"
#endif

namespace {

using reference::Scene;
using reference::Solver;

// A bar of two cells, pulled and sheared until its interface softens. They are standard, as the first states have them.
Scene bar(const char* name) {
    Scene scene(2, {1.0}, {2}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 1e12, 0.25);
    REQUIRE(scene, delam_problem_set_formulation, scene.problem(), -1, "standard");
    scene.law(0, {125e9, 125e9, 100.0, 100.0, 250.0, 500.0});
    const auto bottom = scene.find(0, {0.0, 0.0}, {1.0, 0.0});
    scene.hold(bottom, {1.0, 0.0});
    scene.hold(bottom, {0.0, 1.0});
    const auto top = scene.find(1, {0.0, 2.0}, {1.0, 2.0});
    scene.drive(top, {1.0, 0.0}, scene.pattern("shear", {0.0, 1.0}, {0.0, 4e-5}), std::vector<double>(3, 1.0));
    scene.drive(top, {0.0, 1.0}, scene.pattern("pull", {0.0, 1.0}, {0.0, 8e-5}), {1.0, 0.9, 0.8});
    const bool energetic = std::string(name) == "energetic";
    scene.text("reduction", std::string(name) == "feti" ? "feti" : "condensed");
    scene.text("solution", energetic ? "energetic" : "local");
    scene.text("mixity_rule", "frozen");  // the default of the versions that wrote the first states
    if (energetic) scene.text("backtracking", "on");
    return scene;
}

// The same in space, one cell across. The versions that wrote the first states took steps whole. sheared: it slides
// between two shears, which have numbers of their own.
Scene slab(const char* step_control, bool sheared = false) {
    Scene scene(3, {1.0, 0.5}, {2, 1}, {1.0, 1.0}, {1, 1}, DELAM_HEX8);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 1e12, 0.25);
    REQUIRE(scene, delam_problem_set_formulation, scene.problem(), -1, "standard");
    reference::LawData law{125e9, 125e9, 100.0, 100.0, 250.0, 500.0};
    if (sheared) law.second_tangential_onset = 60.0, law.second_tangential_toughness = 350.0;
    scene.law(0, law);
    const auto bottom = scene.find(0, {0.0, 0.0, 0.0}, {1.0, 0.5, 0.0});
    for (const std::vector<double>& axis : {std::vector<double>{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}})
        scene.hold(bottom, axis);
    const auto top = scene.find(1, {0.0, 0.0, 2.0}, {1.0, 0.5, 2.0});
    std::vector<double> slanted;
    for (const auto node : top) slanted.push_back(1.0 - 0.2 * scene.coordinate(node, 0));
    const auto shear = scene.pattern("shear", {0.0, 1.0}, {0.0, 4e-5});
    scene.drive(top, {1.0, 0.0, 0.0}, shear, std::vector<double>(top.size(), 1.0));
    if (sheared) scene.drive(top, {0.0, 1.0, 0.0}, shear, std::vector<double>(top.size(), 0.8));
    scene.drive(top, {0.0, 0.0, 1.0}, scene.pattern("pull", {0.0, 1.0}, {0.0, 8e-5}), slanted);
    scene.text("reduction", "condensed");
    scene.text("mixity_rule", "converged");
    scene.text("step_control", step_control);
    return scene;
}

Scene scene_of(const std::string& name) {
    if (name == "followed" || name == "sheared") return slab("load", name == "sheared");
    if (name == "watched") {
        Scene scene = slab("fixed");
        scene.text("kinematics", "auto");
        return scene;
    }
    return name == "space" ? slab("fixed") : bar(name.c_str());
}

// Scenes, and the first version for which one of their states is kept.
struct Golden {
    const char* name;
    std::uint32_t since;
};
constexpr Golden goldens[] = {{"feti", 5},     {"energetic", 5}, {"told", 6},     {"space", 6},
                              {"recorded", 7}, {"followed", 15}, {"sheared", 18}, {"watched", 19}};
constexpr int steps = 8, saved = 5;

// told: the host changes a history halfway; recorded: it records a value. Both are then part of the saved state.
void analyse(Solver& solver, int first, int last, const std::string& name) {
    for (int k = first; k <= last; ++k) {
        const double times[] = {0.6, 1.0}, values[] = {2e-5, 9e-5};
        if (name == "told" && k == 4)
            REQUIRE(solver.scene(), delam_solver_set_history, solver.get(), 1, 2, times, values);
        if (name == "recorded" && k == 3) REQUIRE(solver.scene(), delam_solver_record, solver.get(), "work");
        solver.step(static_cast<double>(k) / steps);
        solver.commit();
    }
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    cases::expect(file.good(), path.string() + " cannot be read");
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<double> recorded_work(const Solver& solver) {
    std::int64_t first = 0, count = 0;
    REQUIRE(solver.scene(), delam_solver_recorded_size, solver.get(), &first, &count);
    std::vector<double> work(static_cast<std::size_t>(count));
    REQUIRE(solver.scene(), delam_solver_recorded, solver.get(), "work", count, work.data());
    return work;
}

// Values on which machines agree except for rounding.
constexpr const char* keys[] = {"step",  "time",  "stored_bulk",     "stored_interface", "dissipated",    "work",
                                "lower", "upper", "debonded_length", "reaction:pull",    "reaction:shear"};

// The format version follows eight bytes of magic.
constexpr std::size_t version_at = 8;
std::uint32_t version_of(const std::vector<std::uint8_t>& bytes) {
    std::uint32_t version = 0;
    cases::expect(bytes.size() >= version_at + sizeof version,
                  "a saved state of " + std::to_string(bytes.size()) + " bytes");
    std::memcpy(&version, bytes.data() + version_at, sizeof version);
    return version;
}

std::string stem_of(std::uint32_t version, const std::string& name) {
    return std::string("v").append(std::to_string(version)).append("-").append(name);
}

void write(const std::filesystem::path& folder) {
    for (const auto& [name, since] : goldens) {
        const Scene scene = scene_of(name);
        Solver solver(scene, 0.0);
        analyse(solver, 1, saved, name);
        const auto bytes = solver.save();
        const std::string stem = stem_of(version_of(bytes), name);
        std::ofstream(folder / (stem + ".state"), std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        std::ofstream text(folder / (stem + ".txt"));
        text.precision(17);
        for (const char* key : keys) text << key << ' ' << solver.value(key) << '\n';
    }
}

// Versions that are read, among all up to the one after the present: any other is refused because of its version, these
// because of their checksum. The last scene needs the present one.
std::vector<std::uint32_t> versions_read() {
    const Scene scene = scene_of(std::rbegin(goldens)->name);
    Solver solver(scene, 0.0);
    const auto bytes = solver.save();
    const std::uint32_t present = version_of(bytes);
    std::vector<std::uint32_t> read;
    for (std::uint32_t version = 0; version <= present + 1; ++version) {
        if (version == present) {
            read.push_back(version);
            continue;
        }
        auto other = bytes;
        std::memcpy(other.data() + version_at, &version, sizeof version);
        cases::expect(solver.load(other) == DELAM_ERROR_SNAPSHOT,
                      "bytes that say version " + std::to_string(version) + " were not refused");
        const std::string message = delam_context_message(scene.context());
        if (message.find("snapshot version " + std::to_string(version) + ",") == std::string::npos)
            read.push_back(version);
    }
    cases::expect(read.back() == present, "a version beyond that of a new save is read");
    cases::expect(read.back() - read.front() + 1 == read.size(), "versions in between are not read");
    return read;
}

TEST(every_version_is_there) {
    std::string missing;
    std::map<std::string, std::uint32_t> last;  // version in which a scene is saved
    for (const auto& [name, since] : goldens) {
        const Scene scene = scene_of(name);
        last[name] = version_of(Solver(scene, 0.0).save());
    }
    for (const std::uint32_t version : versions_read()) {
        int wanted = 0;
        for (const auto& [name, since] : goldens) {
            if (version < since || version > last.at(name)) continue;
            ++wanted;
            for (const char* extension : {".state", ".txt"})
                if (const std::string file = stem_of(version, name) + extension;
                    !std::filesystem::exists(std::filesystem::path(DELAM_GOLDEN) / file))
                    missing += " " + file;
        }
        if (wanted == 0) missing += " " + stem_of(version, "*.state");
    }
    cases::expect(missing.empty(), "golden states are missing:" + missing);
}

TEST(every_version_is_read) {
    int read = 0;
    for (const auto& entry : std::filesystem::directory_iterator(DELAM_GOLDEN)) {
        const std::filesystem::path& path = entry.path();
        if (path.extension() != ".state") continue;
        const std::string stem = path.stem().string(), name = stem.substr(stem.find('-') + 1);
        const auto bytes = read_bytes(path);
        cases::expect(stem == stem_of(version_of(bytes), name),
                      stem + " is of version " + std::to_string(version_of(bytes)));
        const Scene scene = scene_of(name);
        Solver solver(scene, 0.0), whole(scene, 0.0);
        scene.require(solver.load(bytes), path.c_str());
        // Saved again, a state of the present version has the same bytes; one of an earlier version has the present
        // version.
        const auto again = solver.save();
        cases::expect(version_of(again) != version_of(bytes) || again == bytes, stem + ": saved again it differs");
        cases::expect(solver.load(again) == DELAM_OK && solver.save() == again, stem + ": the present version of it");
        std::ifstream text(std::filesystem::path(path).replace_extension(".txt"));
        std::string key;
        double value = 0.0;
        int compared = 0;
        for (; text >> key >> value; ++compared) cases::expect(solver.value(key) == value, stem + ": " + key);
        cases::expect(compared == static_cast<int>(std::size(keys)), stem + ": its values are not there");
        // Continuing from it equals never having stopped, except for the rounding of another machine.
        analyse(solver, saved + 1, steps, name);
        analyse(whole, 1, steps, name);
        cases::expect(whole.value("dissipated") > 0.0, "nothing was damaged");
        for (const char* k : keys)
            cases::expect_near(solver.value(k), whole.value(k), 1e-8,
                               std::abs(whole.value("work")) + std::abs(whole.value(k)), stem + ": " + k);
        if (name == "recorded") {
            const std::vector<double> resumed = recorded_work(solver), all = recorded_work(whole);
            cases::expect(resumed.size() == steps - 1 && all.size() == resumed.size(),
                          stem + ": a recorded value for each step");
            for (std::size_t k = 0; k < all.size(); ++k)
                cases::expect_near(resumed[k], all[k], 1e-8, all.back(), stem + ": recorded work");
        }
        ++read;
    }
    cases::expect(read > 0, "no saved state was read");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1) {
        write(argv[1]);
        return 0;
    }
    return tests::run();
}
