// SPDX-License-Identifier: BSD-3-Clause
#include "build_materials.hpp"

#include "call.hpp"

namespace cli {

void set_material(const delam_context* owner, delam_problem* problem, std::int32_t body, const Material& material,
                  const std::optional<std::array<double, 6>>& axes, const Place& place) {
    if (const auto* isotropic = std::get_if<Isotropic>(&material.elastic))
        call(owner, delam_problem_set_elastic(problem, body, isotropic->young, isotropic->poisson), material.place);
    else
        call(owner,
             delam_problem_set_orthotropic(problem, body, std::get<std::array<double, 9>>(material.elastic).data()),
             material.place);
    if (axes) call(owner, delam_problem_set_orientation(problem, body, 1, nullptr, axes->data(), 0), place);
    call(owner, delam_problem_set_formulation(problem, body, material.formulation.c_str()), material.place);
}

}  // namespace cli
