// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/bodies/scene_variables.hpp"
#include "base/numbers.hpp"

#include <algorithm>
#include <numeric>

namespace delam::petsc {

namespace {

std::int64_t home_of(const delam_experimental_variables& v, std::int64_t variable) {
    if (variable < 0 || variable >= v.dofs + v.jump_count)
        fail(DELAM_ERROR_ARGUMENT, "variable ", variable, " is not in [0, ", v.dofs + v.jump_count, ")");
    return variable < v.dofs ? variable : v.homes[variable - v.dofs];
}

// Copies the variables in the order of the DOFs, with homes in the place of variables.
void translate(const delam_experimental_variables& v, SceneVariables& scene) {
    scene.dimension = v.dimension;
    scene.dofs = v.dofs;
    std::vector<std::int64_t> order(index(v.replaced_count));
    std::iota(order.begin(), order.end(), std::int64_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::int64_t a, std::int64_t b) { return v.replaced[a] < v.replaced[b]; });
    std::vector<std::int64_t> homes(v.homes, v.homes + v.jump_count);
    std::sort(homes.begin(), homes.end());
    scene.start.push_back(0);
    for (const std::int64_t r : order) {
        const std::int64_t dof = v.replaced[r];
        scene.replaced.push_back(dof);
        scene.is_home.push_back(std::binary_search(homes.begin(), homes.end(), dof) ? 1 : 0);
        for (std::int64_t e = v.row_starts[r]; e < v.row_starts[r + 1]; ++e) {
            scene.home.push_back(home_of(v, v.columns[e]));
            scene.coefficient.push_back(v.coefficients[e]);
        }
        scene.start.push_back(static_cast<std::int64_t>(scene.home.size()));
    }
    for (std::int64_t i = 0; i < v.visible_count; ++i) scene.visible.push_back(home_of(v, v.visible[i]));
}

SceneVariables::Terms terms(std::int64_t pattern, const std::int64_t* starts, const std::int64_t* dofs,
                            const double* values) {
    SceneVariables::Terms copy;
    copy.dof.assign(dofs + starts[pattern], dofs + starts[pattern + 1]);
    copy.value.assign(values + starts[pattern], values + starts[pattern + 1]);
    return copy;
}

}  // namespace

std::int64_t SceneVariables::place(std::int64_t dof) const {
    const auto found = std::lower_bound(replaced.begin(), replaced.end(), dof);
    return found != replaced.end() && *found == dof ? found - replaced.begin() : -1;
}

SceneVariables share_variables(const Communicator& comm, const delam_experimental_variables* variables) {
    SceneVariables scene;
    std::int64_t patterns = 0;
    comm.together([&] {
        if (!comm.root()) return;
        translate(*variables, scene);
        patterns = variables->pattern_count;
    });
    comm.broadcast(scene.dimension);
    comm.broadcast(scene.dofs);
    comm.broadcast(scene.replaced);
    comm.broadcast(scene.is_home);
    comm.broadcast(scene.start);
    comm.broadcast(scene.home);
    comm.broadcast(scene.coefficient);
    comm.broadcast(patterns);
    comm.together([&] {
        scene.lift.resize(index(patterns));
        scene.force.resize(index(patterns));
        if (!comm.root()) return;
        const delam_experimental_variables& v = *variables;
        for (std::int64_t p = 0; p < patterns; ++p) {
            scene.lift[index(p)] = terms(p, v.lift_starts, v.lift_dofs, v.lift_values);
            scene.force[index(p)] = terms(p, v.force_starts, v.force_dofs, v.force_values);
        }
    });
    for (std::size_t p = 0; p < scene.patterns(); ++p)
        for (SceneVariables::Terms* list : {&scene.lift[p], &scene.force[p]}) {
            comm.broadcast(list->dof);
            comm.broadcast(list->value);
        }
    return scene;
}

}  // namespace delam::petsc
