// SPDX-License-Identifier: BSD-3-Clause
#include "scene_file.hpp"

#include <algorithm>

#include "model/build.hpp"
#include "scene/read_scene.hpp"
#include "text/error.hpp"

namespace reference {

namespace {

// Names in tables, and values of the option `reduction`.
constexpr std::pair<const char*, const char*> realisations[] = {
    {"condensed", "condensed"}, {"iterated", "iterated"}, {"FETI", "feti"}};

double parameter(const cli::LawData& law, const std::string& key) {
    for (const auto& [name, value] : law.parameters)
        if (name == key) return value;
    throw Failure(DELAM_ERROR_ARGUMENT, "law \"" + law.name + "\" has no " + key);
}

cli::Model build(const std::string& path, const std::vector<std::string>& settings, cli::Scene& scene) {
    try {
        scene = cli::read_scene(path, settings);
        return cli::build(cli::new_context(), scene);
    } catch (const std::exception& e) {
        throw Failure(DELAM_ERROR_ARGUMENT, path + ": " + e.what());
    }
}

}  // namespace

SceneFile read_scene_file(const std::string& path, const std::vector<std::string>& settings) {
    cli::Scene scene;
    cli::Model model = build(path, settings, scene);
    std::vector<InterfaceStiffness> stiffness;
    for (const cli::InterfaceData& data : model.interfaces) {
        InterfaceStiffness own;
        own.bonded = data.bonded;
        if (!data.bonded && !data.contact) {
            own.normal = parameter(scene.laws[data.law], "normal_stiffness");
            own.tangential = parameter(scene.laws[data.law], "tangential_stiffness");
            own.second = cli::law_number(scene.laws[data.law], "second_tangential_stiffness");
        }
        stiffness.push_back(own);
    }
    return {Scene::adopt(Context(model.context.release()), Mesh(model.mesh.release()), Problem(model.problem.release()),
                         std::move(stiffness)),
            scene.times};
}

std::vector<Judged> judge(SceneFile& file, const std::vector<std::size_t>& steps, std::int64_t subdomains) {
    if (steps.empty()) return {};
    Scene& scene = file.scene;
    scene.text("reduction", "condensed");
    Solver analysis(scene, file.times.front());
    std::vector<std::vector<double>> adhesion;
    for (std::size_t k = 0; k <= *std::max_element(steps.begin(), steps.end()); ++k) {
        if (k > 0) {
            analysis.step(file.times[k]);
            analysis.commit();
        }
        if (std::find(steps.begin(), steps.end(), k) != steps.end()) adhesion.push_back(analysis.field("adhesion"));
    }
    if (subdomains > 0) scene.number("subdomains", static_cast<double>(subdomains));
    std::vector<std::pair<std::string, Solver>> solvers;
    for (const auto& [realisation, option] : realisations) {
        scene.text("reduction", option);
        solvers.emplace_back(realisation, Solver(scene, file.times.front()));
    }
    DirectReference direct(scene);
    std::vector<Judged> out;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const double time = file.times[steps[i]];
        const State state = direct.solve(time, adhesion[i]);
        Judged row;
        row.time = time;
        row.debonded = static_cast<double>(
                           std::count_if(adhesion[i].begin(), adhesion[i].end(), [](double z) { return z <= 1e-3; })) /
                       static_cast<double>(adhesion[i].size());
        row.closed = static_cast<int>(std::count(state.contact.begin(), state.contact.end(), true));
        for (auto& [realisation, solver] : solvers) {
            const std::int32_t status = delam_solver_equilibrate(solver.get(), time, adhesion[i].data());
            const bool stalled = status == DELAM_NOT_CONVERGED;
            if (!stalled) scene.require(status, "delam_solver_equilibrate");
            // A contact whose gap or pressure is of the size of rounding may be open or closed.
            row.answers.push_back({realisation, compare(solver, state, direct.exported(), 1e-9),
                                   accept(solver, direct.exported()), stalled, solver.value("linear_iterations")});
            solver.commit();
        }
        out.push_back(row);
    }
    return out;
}

}  // namespace reference
