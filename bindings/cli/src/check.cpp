// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "call.hpp"
#include "commands.hpp"
#include "history.hpp"
#include "interrupt.hpp"
#include "result.hpp"

namespace cli {

int check(const std::string& scene_file) {
    const Scene scene = read_scene(scene_file);
    Context context = new_context();
    const Interrupt interrupt(context.get());
    const Model model = build(std::move(context), scene);
    const Solver solver = new_solver(model, scene);
    const History history(model, solver.get(), scene);

    std::int64_t primal = 0;
    std::int64_t dual = 0;
    call(model.context.get(), delam_problem_dofs(model.problem.get(), &primal, &dual),
         std::string("numbers of unknowns"));
    fmt::print("{}: correct\n", scene_file);
    if (!scene.title.empty()) fmt::print("title       {}\n", scene.title);
    fmt::print("scene hash  {}\n", hash_of(model));
    fmt::print("unknowns    {} primal, {} dual\n", primal, dual);
    for (const Layer& layer : scene.layers)
        fmt::print("layer       \"{}\", thickness {}, material \"{}\"\n", layer.name, layer.thickness,
                   scene.materials[layer.material].name);
    for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
        const InterfaceData& data = scene.interfaces[i];
        std::int64_t pairs = 0;
        call(model.context.get(),
             delam_mesh_interface_size(model.mesh.get(), static_cast<std::int64_t>(i), nullptr, nullptr, &pairs,
                                       nullptr, nullptr),
             data.place);
        fmt::print("interface   \"{}\", {} pairs, {}, {} regions with adhesion of their own\n", data.name, pairs,
                   data.bonded ? "bonded for ever" : "law \"" + scene.laws[data.law].name + "\"", data.regions.size());
    }
    std::int64_t constraints = 0;
    std::int64_t entries = 0;
    std::int64_t patterns = 0;
    call(model.context.get(),
         delam_problem_constraints(model.problem.get(), &constraints, &entries, &patterns, nullptr, nullptr, nullptr,
                                   nullptr),
         std::string("constraints"));
    fmt::print("supports    {} prescribed displacements (supports and loads)\n", constraints);
    for (const PatternData& pattern : scene.patterns)
        fmt::print("pattern     \"{}\", {} instants from {} to {}\n", pattern.name, pattern.times.size(),
                   pattern.times.front(), pattern.times.back());
    fmt::print("time        {} to {} in {} steps\n", scene.times.front(), scene.times.back(), scene.step_count());
    fmt::print("\n{}", delam_solver_plan(solver.get()));
    return exit_done;
}

}  // namespace cli
