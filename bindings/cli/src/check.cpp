// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "call.hpp"
#include "commands.hpp"
#include "concept.hpp"
#include "history.hpp"
#include "interrupt.hpp"
#include "notes.hpp"
#include "resolution.hpp"
#include "result.hpp"
#include "say.hpp"

namespace cli {

namespace {

void say_mesh(const MeshData& mesh, const Scene& scene) {
    std::vector<std::int64_t> cells(mesh.body_names.size());
    for (const CellBlock& block : mesh.blocks)
        for (const std::int32_t body : block.bodies) ++cells[static_cast<std::size_t>(body)];
    for (std::size_t i = 0; i < cells.size(); ++i)
        say("body        \"{}\", {}, material \"{}\", formulation {}\n", mesh.body_names[i], counted(cells[i], "cell"),
            scene.materials[scene.layers[i].material].name, scene.layers[i].formulation);
    for (const auto& [name, nodes] : mesh.node_sets) {
        const auto faces = mesh.face_sets.find(name);
        say("set         \"{}\", {}{}\n", name, counted(static_cast<std::int64_t>(nodes.size()), "node"),
            faces == mesh.face_sets.end() ? ""
                                          : ", " + counted(static_cast<std::int64_t>(faces->second.size()), "face"));
    }
}

// Solvers whose factorisations take longer than this, s at the nominal rate, are planned, not built.
constexpr double short_setup = 2.0;

struct Planned {
    std::string text;
    bool converged = true;
};

// A small scene is solved at its initial state, which finds what a plan cannot.
Planned plan(const Model& model, const Scene& scene) {
    const char* text = "";
    double setup = 0.0;
    call(model.context.get(), delam_problem_plan(model.problem.get(), &text, &setup, nullptr), {scene.file, "", 0});
    Planned planned{text, true};
    if (setup > short_setup) {
        planned.text += fmt::format(
            "initial state: left out, its factorisations are predicted to take {:.2g} s; delam run computes it\n",
            setup);
        return planned;
    }
    const Solver solver = new_solver(model, scene, planned.converged);
    planned.text = delam_solver_plan(solver.get());
    return planned;
}

// An error ends the call, whose caller says it.
extern "C" void on_check_log(std::int32_t level, const char* text, void*) {
    if (level == 1) complain("warning: {}\n", text);
}

}  // namespace

int check(const std::string& scene_file, const std::vector<std::string>& settings, const Caller& caller) {
    const Scene scene = read_scene(scene_file, settings);
    if (scene.imported) say_import(*scene.imported, [](const std::string& text) { say("{}\n", text); });
    Context context = new_context();
    const Interrupt interrupt(context.get());
    delam_context_set_log(context.get(), on_check_log, nullptr);
    const Model model = build(std::move(context), scene);
    const History history(model, scene);
    Planned planned;
    const auto make_plan = [&] {
        planned = plan(model, scene);
        return 0;
    };
    (void)(caller.around ? caller.around(model, make_plan) : make_plan());

    std::int64_t primal = 0;
    std::int64_t dual = 0;
    call(model.context.get(), delam_problem_dofs(model.problem.get(), &primal, &dual),
         std::string("numbers of unknowns"));
    say("{}: correct\n", scene_file);
    if (!scene.title.empty()) say("title       {}\n", scene.title);
    say("concept     {}\n", concept_text(concept_of(model.problem.get())));
    say("scene hash  {}\n", hash_of(model));
    say("unknowns    {} primal, {} dual\n", primal, dual);
    if (scene.mesh)
        say_mesh(*scene.mesh, scene);
    else
        for (const Layer& layer : scene.layers)
            say("layer       \"{}\", thickness {}, material \"{}\"\n", layer.name, layer.thickness,
                scene.materials[layer.material].name);
    for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
        const InterfaceData& data = model.interfaces[i];
        std::int64_t pairs = 0;
        call(model.context.get(),
             delam_mesh_interface_size(model.mesh.get(), static_cast<std::int64_t>(i), nullptr, nullptr, &pairs,
                                       nullptr, nullptr),
             data.place);
        say("interface   \"{}\", {}, {}, {} with adhesion of their own\n", data.name, counted(pairs, "pair"),
            data.bonded    ? "bonded permanently"
            : data.contact ? "contact without adhesion"
                           : "law \"" + scene.laws[data.law].name + "\"",
            counted(static_cast<std::int64_t>(data.regions.size()), "region"));
    }
    std::int64_t constraints = 0;
    std::int64_t entries = 0;
    std::int64_t patterns = 0;
    call(model.context.get(),
         delam_problem_constraints(model.problem.get(), &constraints, &entries, &patterns, nullptr, nullptr, nullptr,
                                   nullptr),
         std::string("constraints"));
    say("supports    {} (supports and loads)\n", counted(constraints, "prescribed displacement"));
    for (const PatternData& pattern : scene.patterns)
        say("pattern     \"{}\", {} from {} to {}\n", pattern.name,
            counted(static_cast<std::int64_t>(pattern.times.size()), "instant"), pattern.times.front(),
            pattern.times.back());
    say("time        {} to {} in {}\n", scene.times.front(), scene.times.back(),
        counted(static_cast<std::int64_t>(scene.step_count()), "step"));
    for (const std::string& text : process_zones(model)) say("zone        {}\n", text);
    say("\n{}", planned.text);
    for (const std::string& text : notes_of(scene)) say("note: {}\n", text);
    for (const std::string& text : resolution_warnings(model)) complain("warning: {}\n", text);
    // Not on standard output, where it is lost when that goes to a file.
    for (const std::string& text : warnings_of(model, scene)) complain("warning: {}\n", text);
    if (!planned.converged) complain("warning: the displacement of the initial state did not converge\n");
    return exit_done;
}

}  // namespace cli
