// SPDX-License-Identifier: BSD-3-Clause
// Saved states of every format version that was ever in use are read, whatever wrote them: golden/vN-NAME.state, the values beside them in
// golden/vN-NAME.txt (key value). With a folder as its argument the program writes both for the present version.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "small_march.hpp"

#ifndef DELAM_GOLDEN
#error "DELAM_GOLDEN: folder of the saved states"
#endif

namespace {

using reference::Scene;
using reference::Solver;

// A bar of two cells that is pulled and sheared until its interface softens.
Scene bar(const char* name) {
    Scene scene(2, {1.0}, {2}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 1e12, 0.25);
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
    if (energetic) scene.text("backtracking", "on");
    return scene;
}

constexpr const char* names[] = {"feti", "energetic", "told"};
constexpr int steps = 8, saved = 5;

// told: the host changes a history half-way, which is then part of what is saved.
void march(Solver& solver, int first, int last, const std::string& name) {
    for (int k = first; k <= last; ++k) {
        const double times[] = {0.6, 1.0}, values[] = {2e-5, 9e-5};
        if (name == "told" && k == 4) solver.scene().require(delam_solver_set_history(solver.get(), 1, 2, times, values), "delam_solver_set_history");
        solver.step(static_cast<double>(k) / steps);
        solver.commit();
    }
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    cases::expect(file.good(), path.string() + " cannot be read");
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// Values that machines agree on but for rounding.
constexpr const char* keys[] = {"step", "time", "stored_bulk", "stored_interface", "dissipated", "work", "lower", "upper",
                                "debonded_length", "reaction:pull", "reaction:shear"};

void write(const std::filesystem::path& folder) {
    for (const char* name : names) {
        const Scene scene = bar(name);
        Solver solver(scene, 0.0);
        march(solver, 1, saved, name);
        const auto bytes = solver.save();
        std::uint32_t version = 0;
        std::memcpy(&version, bytes.data() + 8, sizeof version);
        const std::string stem = "v" + std::to_string(version) + "-" + name;
        std::ofstream(folder / (stem + ".state"), std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        std::ofstream text(folder / (stem + ".txt"));
        text.precision(17);
        for (const char* key : keys) text << key << ' ' << solver.value(key) << '\n';
    }
}

CASE_TEST(every_version_is_read) {
    std::map<std::string, int> read;
    for (const auto& entry : std::filesystem::directory_iterator(DELAM_GOLDEN)) {
        const std::filesystem::path& path = entry.path();
        if (path.extension() != ".state") continue;
        const std::string stem = path.stem().string(), name = stem.substr(stem.find('-') + 1);
        const Scene scene = bar(name.c_str());
        Solver solver(scene, 0.0), whole(scene, 0.0);
        scene.require(solver.load(read_bytes(path)), path.c_str());
        std::ifstream text(std::filesystem::path(path).replace_extension(".txt"));
        std::string key;
        double value = 0.0;
        int compared = 0;
        for (; text >> key >> value; ++compared)
            cases::expect(solver.value(key) == value, stem + ": " + key);
        cases::expect(compared == static_cast<int>(std::size(keys)), stem + ": its values are not there");
        // Going on from it equals never having stopped, but for the rounding of another machine.
        march(solver, saved + 1, steps, name);
        march(whole, 1, steps, name);
        cases::expect(whole.value("dissipated") > 0.0, "nothing was damaged");
        for (const char* k : keys)
            cases::expect_near(solver.value(k), whole.value(k), 1e-8, std::abs(whole.value("work")) + std::abs(whole.value(k)), stem + ": " + k);
        ++read[name];
    }
    for (const char* name : names) cases::expect(read[name] > 0, std::string("no saved state of ") + name);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1) {
        write(argv[1]);
        return 0;
    }
    Suite* suite = suite_create("golden");
    TCase* one = tcase_create("golden");
    tcase_add_test(one, every_version_is_read);
    suite_add_tcase(suite, one);
    return cases::run_suite(suite);
}
