// SPDX-License-Identifier: BSD-3-Clause
// The matrices and vectors that the library assembled, for hosts that check or reuse them.
#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "capi/handle/handles.hpp"
#include "scene/advice/process_zone.hpp"
#include "scene/advice/proposal.hpp"
#include "scene/problem.hpp"
#include "scene/strain_loads.hpp"

namespace {

using namespace delam;

void give(const SparseMatrix& matrix, std::int64_t* row_starts, std::int64_t* columns, double* values) {
    if (row_starts != nullptr) std::copy(matrix.start.begin(), matrix.start.end(), row_starts);
    if (columns != nullptr) std::copy(matrix.column.begin(), matrix.column.end(), columns);
    if (values != nullptr) std::copy(matrix.value.begin(), matrix.value.end(), values);
}

// Forces of the bodies with eigenstrains.
void require_materials(const Problem& problem) {
    for (const Eigenstrain& eigenstrain : problem.eigenstrains) require_material(problem, eigenstrain.body);
}

// The mesh of a problem is fixed, but the materials of its bodies may change between two calls.
const SparseMatrix& body_matrix(const delam_problem& problem, std::int32_t body) {
    const Problem& core = *problem.core;
    if (const auto& own = core.stiffness[index(body)]) return own->matrix;
    require_material(core, body);
    const BodyModel model = core.model(body);
    delam_problem::BodyMatrix& last = problem.assembled;
    if (last.body != body || last.model != model) {
        last = {body, model, core.body_stiffness(body, [] { poll_cancel_now("assemble"); })};
    }
    return last.matrix;
}

}  // namespace

int32_t delam_problem_body_matrix(const delam_problem* problem, int32_t body, int64_t* rows, int64_t* entries,
                                  int64_t* row_starts, int64_t* columns, double* values) {
    return guard_read(problem, [&] {
        const std::int32_t index = body < 0 ? -1 : problem->core->mesh->body_of_label(body);
        if (index < 0) fail(DELAM_ERROR_ARGUMENT, "body = ", body, ": no body has this label");
        const SparseMatrix& matrix = body_matrix(*problem, index);
        if (rows != nullptr) *rows = matrix.rows;
        if (entries != nullptr) *entries = matrix.entries();
        give(matrix, row_starts, columns, values);
    });
}

int32_t delam_problem_constraints(const delam_problem* problem, int64_t* rows, int64_t* entries, int64_t* pattern_count,
                                  int64_t* row_starts, int64_t* columns, double* values, double* coefficients) {
    return guard_read(problem, [&] {
        const Problem& core = *problem->core;
        SparseMatrix matrix;
        matrix.rows = static_cast<std::int64_t>(core.constraints.size());
        matrix.columns = core.mesh->node_count() * core.mesh->dimension();
        for (const Constraint& constraint : core.constraints) {
            poll_cancel("loads", 1 + static_cast<std::int64_t>(constraint.dof.size()) / 16);
            matrix.column.insert(matrix.column.end(), constraint.dof.begin(), constraint.dof.end());
            matrix.value.insert(matrix.value.end(), constraint.coefficient.begin(), constraint.coefficient.end());
            matrix.start.push_back(matrix.entries());
        }
        if (rows != nullptr) *rows = matrix.rows;
        if (entries != nullptr) *entries = matrix.entries();
        if (pattern_count != nullptr) *pattern_count = static_cast<std::int64_t>(core.patterns.size());
        give(matrix, row_starts, columns, values);
        if (coefficients != nullptr) {
            const std::vector<double> prescribed = core.prescribed_matrix();
            std::copy(prescribed.begin(), prescribed.end(), coefficients);
        }
    });
}

int32_t delam_problem_forces(const delam_problem* problem, int64_t pattern, int64_t capacity, double* forces) {
    return guard_read(problem, [&] {
        const Problem& core = *problem->core;
        require_index(pattern, static_cast<std::int64_t>(core.patterns.size()), 0, "pattern");
        require_pointer(forces, "forces");
        const std::int64_t dofs = core.mesh->node_count() * core.mesh->dimension();
        require_capacity(capacity, dofs, "forces");
        std::fill_n(forces, dofs, 0.0);
        for (const NodalForce& force : core.forces) {
            if (force.pattern == pattern) forces[force.dof] += force.value;
        }
        if (core.patterns[index(pattern)].drives != Pattern::Drives::strain) return;
        require_materials(core);
        const std::vector<double> of_strains = strain_loads(core).force[index(pattern)];
        for (std::size_t i = 0; i < of_strains.size(); ++i) forces[i] += of_strains[i];
    });
}

int32_t delam_problem_eigenstrain_energy(const delam_problem* problem, int64_t capacity, double* matrix) {
    return guard_read(problem, [&] {
        const Problem& core = *problem->core;
        const auto patterns = static_cast<std::int64_t>(core.patterns.size());
        require_array(matrix, patterns * patterns, "matrix");
        require_capacity(capacity, patterns * patterns, "matrix");
        require_materials(core);
        const std::vector<double> energy = strain_loads(core).energy;
        std::copy(energy.begin(), energy.end(), matrix);
    });
}

int32_t delam_problem_factors(const delam_problem* problem, double time, int64_t capacity, double* factors) {
    return guard(problem, [&] {
        if (!std::isfinite(time)) fail(DELAM_ERROR_ARGUMENT, "time = ", time, " is not finite");
        const std::vector<double> list = problem->core->factors(time);
        require_array(factors, static_cast<std::int64_t>(list.size()), "factors");
        require_capacity(capacity, static_cast<std::int64_t>(list.size()), "factors");
        std::copy(list.begin(), list.end(), factors);
    });
}

int32_t delam_problem_pattern_count(const delam_problem* problem, int64_t* count) {
    return guard(problem, [&] {
        require_pointer(count, "count");
        *count = static_cast<std::int64_t>(problem->core->patterns.size());
    });
}

const char* delam_problem_pattern_name(const delam_problem* problem, int64_t pattern) {
    const char* name = nullptr;
    guard(problem, [&] {
        const auto count = static_cast<std::int64_t>(problem->names.size());
        name = problem->names[index(require_index(pattern, count, 0, "pattern"))].c_str();
    });
    return name;
}

int32_t delam_problem_process_zone(const delam_problem* problem, int64_t interface_index, double* length,
                                   double* spacing) {
    return guard_read(problem, [&] {
        const auto count = static_cast<std::int64_t>(problem->core->interfaces.size());
        const std::int64_t interface = require_index(interface_index, count, 0, "interface_index");
        if (length == nullptr) {  // the spacing alone does not depend on the bodies
            if (spacing != nullptr) *spacing = pair_spacing(*problem->core, interface);
            return;
        }
        const ProcessZone zone = predicted_process_zone(*problem->core, interface);
        *length = zone.length;
        if (spacing != nullptr) *spacing = zone.spacing;
    });
}

int32_t delam_problem_propose(const delam_problem* problem, int64_t interface_index, double pairs, double* stiffness,
                              double* share, double* normal_strength, double* tangential_strength) {
    return guard_read(problem, [&] {
        const auto count = static_cast<std::int64_t>(problem->core->interfaces.size());
        const std::int64_t interface = require_index(interface_index, count, 0, "interface_index");
        if (!(pairs > 0.0 && std::isfinite(pairs)))
            fail(DELAM_ERROR_ARGUMENT, "pairs = ", pairs, ": must be > 0 and finite");
        const Proposal found = proposal(*problem->core, interface, pairs);
        if (stiffness != nullptr) *stiffness = found.stiffness;
        if (share != nullptr) *share = found.share;
        if (normal_strength != nullptr) *normal_strength = found.strength[0];
        if (tangential_strength != nullptr) *tangential_strength = found.strength[1];
    });
}
