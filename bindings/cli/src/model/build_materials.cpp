// SPDX-License-Identifier: BSD-3-Clause
#include "model/build_materials.hpp"

#include <array>
#include <numeric>
#include <vector>

#include "model/call.hpp"

namespace cli {

void set_material(const delam_context* owner, delam_problem* problem, std::int32_t body, const Material& material,
                  const Layer& made_of_it) {
    if (const auto* isotropic = std::get_if<Isotropic>(&material.elastic))
        call(owner, delam_problem_set_elastic(problem, body, isotropic->young, isotropic->poisson), material.place);
    else
        call(owner,
             delam_problem_set_orthotropic(problem, body, std::get<std::array<double, 9>>(material.elastic).data()),
             material.place);
    if (made_of_it.axes)
        call(owner, delam_problem_set_orientation(problem, body, 1, nullptr, made_of_it.axes->data(), 0),
             made_of_it.place);
    call(owner, delam_problem_set_formulation(problem, body, made_of_it.formulation.c_str()), material.place);
}

void set_plies(const Model& model, const Scene& scene, std::size_t body) {
    const Layer& layer = scene.layers[body];
    if (layer.plies.empty()) return;
    const delam_context* owner = model.context.get();
    std::int64_t all = 0;
    call(owner, delam_mesh_size(model.mesh.get(), nullptr, nullptr, &all, nullptr, nullptr), layer.place);
    std::int64_t levels = 0;
    std::int64_t below = 0;
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        levels += scene.layers[i].divisions;
        if (i < body) below += scene.layers[i].divisions;
    }
    const std::int64_t in_a_level = all / levels;
    const std::int64_t in_a_ply = in_a_level * layer.divisions / static_cast<std::int64_t>(layer.plies.size());
    std::vector<std::int64_t> cells(static_cast<std::size_t>(in_a_ply));
    std::iota(cells.begin(), cells.end(), below * in_a_level);
    std::vector<double> axes;
    for (const std::array<double, 6>& ply : layer.plies) {
        axes.clear();
        for (std::int64_t c = 0; c < in_a_ply; ++c) axes.insert(axes.end(), ply.begin(), ply.end());
        call(owner,
             delam_problem_set_orientation(model.problem.get(), static_cast<std::int32_t>(body), in_a_ply, cells.data(),
                                           axes.data(), 0),
             layer.place);
        for (std::int64_t& c : cells) c += in_a_ply;
    }
}

void set_cell_axes(const delam_context* owner, delam_problem* problem, std::int32_t body, const MeshData& mesh,
                   const Place& place) {
    std::vector<std::int64_t> cells;
    std::vector<double> axes;
    std::int64_t cell = 0;
    for (const CellBlock& block : mesh.blocks)
        for (const std::int32_t label : block.bodies) {
            if (label == body) {
                const auto& own = mesh.orientation[static_cast<std::size_t>(cell)];
                cells.push_back(cell);
                axes.insert(axes.end(), own.begin(), own.end());
            }
            ++cell;
        }
    call(owner,
         delam_problem_set_orientation(problem, body, static_cast<std::int64_t>(cells.size()), cells.data(),
                                       axes.data(), 0),
         place);
}

}  // namespace cli
