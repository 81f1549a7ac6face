// SPDX-License-Identifier: BSD-3-Clause
// The text about a search belongs to a step: it is rolled back, replaced and kept with it, and a step in substeps has
// one text for each substep that was kept.
#include <sstream>
#include <string>
#include <vector>

#include "energetic_scenes.hpp"

namespace {

using reference::Scene;
using reference::Solver;

std::string searched(const Solver& solver) { return delam_solver_searched(solver.get()); }

// The times in the lines "step N at time T: ..."
std::vector<double> times(const std::string& text) {
    std::vector<double> found;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (const auto at = line.find(" at time "); line.starts_with("step ") && at != std::string::npos)
            found.push_back(std::stod(line.substr(at + 9)));
    return found;
}

// Lets go at time 0.5.
Scene block() {
    cases::Block b;
    b.end = 2.0 * cases::energetic_load(b);
    Scene scene = cases::make_block(b);
    cases::set_energetic(scene);
    return scene;
}

LOOP_TEST(of_the_step_that_is_kept, 0, 1) {
    const Scene scene = block();
    Solver solver(scene, 0.0);
    cases::expect(searched(solver).empty(), "no search in the initial state");
    solver.step(0.8);
    cases::expect(times(searched(solver)) == std::vector<double>{0.8}, "pending: " + searched(solver));
    solver.rollback();
    cases::expect(searched(solver).empty(), "rolled back to the initial state: " + searched(solver));
    solver.step(0.4);
    const std::string first = searched(solver);
    solver.commit();
    cases::expect(times(first) == std::vector<double>{0.4} && searched(solver) == first, "committed: " + first);
    const auto bytes = solver.save();
    solver.step(0.9);
    cases::expect(times(searched(solver)) == std::vector<double>{0.9}, "pending again: " + searched(solver));
    solver.rollback();
    cases::expect(searched(solver) == first, "rolled back to the first step: " + searched(solver));
    solver.equilibrate(0.5, {});
    cases::expect(searched(solver).empty(), "a state that was set: " + searched(solver));
    solver.rollback();
    cases::expect(searched(solver) == first, "back from a state that was set: " + searched(solver));
    scene.require(solver.load(bytes), "delam_solver_load");
    cases::expect(searched(solver).empty(), "a loaded state: " + searched(solver));
}

LOOP_TEST(of_every_substep, 0, 1) {
    Scene scene = block();
    scene.number("jump_tolerance", 0.05);
    Solver solver(scene, 0.0);
    solver.step(1.0);
    const std::vector<double> found = times(searched(solver));
    const std::string parts = std::to_string(solver.value("substeps"));
    cases::expect(solver.value("substeps") > 2.0 && solver.value("refused_steps") > 0.0, "substeps: " + parts);
    cases::expect(static_cast<double>(found.size()) == solver.value("substeps"), parts + ": " + searched(solver));
    for (std::size_t i = 0; i < found.size(); ++i)
        cases::expect(found[i] > (i == 0 ? 0.0 : found[i - 1]), "times: " + searched(solver));
    cases::expect(found.back() == 1.0, "the last text is that of the end: " + searched(solver));
}

}  // namespace
