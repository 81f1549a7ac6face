// SPDX-License-Identifier: BSD-3-Clause
#include "build_materials.hpp"

#include "call.hpp"

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
