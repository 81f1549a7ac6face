// SPDX-License-Identifier: BSD-3-Clause
// Functions outside the promise (experimental.h).
#include "delam/experimental.h"
#include "base/numbers.hpp"

#include <algorithm>
#include <memory>
#include <unordered_set>
#include <utility>

#include "capi/handle/handles.hpp"
#include "evolution/analysis/plan.hpp"
#include "evolution/analysis/solver.hpp"
#include "mesh/cell_type.hpp"
#include "mesh/faces.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "scene/engine.hpp"
#include "scene/part.hpp"

using namespace delam;

namespace {

// Labels of bodies, each once.
void require_labels(const std::int32_t* bodies, std::int64_t count) {
    std::unordered_set<std::int32_t> seen;
    for (std::int64_t b = 0; b < count; ++b) {
        if (bodies[b] < 0) fail(DELAM_ERROR_ARGUMENT, "bodies[", b, "] = ", bodies[b], " must be >= 0");
        if (!seen.insert(bodies[b]).second)
            fail(DELAM_ERROR_ARGUMENT, "bodies[", b, "] = ", bodies[b], " occurs twice");
    }
}

// Indices of interfaces, at least one, each once.
std::vector<std::int64_t> require_interfaces(const Problem& problem, std::int64_t count,
                                             const std::int64_t* interfaces) {
    const auto there = static_cast<std::int64_t>(problem.interfaces.size());
    require_count_up_to(count, "interface_count", 1, there);
    std::vector<std::int64_t> list = require_indices(interfaces, count, there, 0, "interfaces");
    for (std::size_t i = 0; i < list.size(); ++i)
        if (std::find(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(i), list[i]) !=
            list.begin() + static_cast<std::ptrdiff_t>(i))
            fail(DELAM_ERROR_ARGUMENT, "interfaces[", i, "] = ", list[i], " occurs twice");
    return list;
}

}  // namespace

int32_t delam_experimental_problem_set_engine(delam_problem* problem, const delam_experimental_engine* engine) {
    return guard(problem, [&] {
        std::shared_ptr<Engine> own;
        if (engine != nullptr) own = std::make_shared<Engine>(*engine);
        problem->core->engine = std::move(own);
    });
}

int32_t delam_experimental_problem_part(const delam_problem* problem, int64_t count, const int64_t* cells,
                                        int64_t capacity, uint8_t* bytes, int64_t* size) {
    return guard_read(problem, [&] {
        const Problem& core = *problem->core;
        require_count_up_to(count, "count", 1, core.mesh->cell_count());
        const std::vector<std::int64_t> list = require_indices(cells, count, core.mesh->cell_count(), 0, "cells");
        for (std::size_t i = 1; i < list.size(); ++i)
            if (list[i] <= list[i - 1])
                fail(DELAM_ERROR_ARGUMENT, "cells[", i, "] = ", list[i], " must be > cells[", i - 1,
                     "] = ", list[i - 1]);
        const std::vector<std::uint8_t> part = save(part_of(core, list));
        const auto needed = static_cast<std::int64_t>(part.size());
        require_capacity_if(bytes != nullptr, capacity, needed, "bytes");
        if (bytes != nullptr) std::copy(part.begin(), part.end(), bytes);
        if (size != nullptr) *size = needed;
    });
}

int32_t delam_experimental_part_matrix(delam_context* context, int64_t size, const uint8_t* bytes, int64_t* dimension,
                                       int64_t* node_count, int64_t* entries, int64_t* nodes, double* coordinates,
                                       int64_t* row_starts, int64_t* columns, double* values) {
    return guard_read(context, [&] {
        require_count(size, "size");
        require_pointer(bytes, "bytes");
        const Part part = load_part({bytes, index(size)});
        const SoundPart sound(part);
        std::int64_t counted = 0;
        if (row_starts != nullptr || columns != nullptr || values != nullptr) {
            const SparseMatrix matrix = sound.stiffness([] { poll_cancel_now("assemble"); });
            counted = matrix.entries();
            if (row_starts != nullptr) std::copy(matrix.start.begin(), matrix.start.end(), row_starts);
            if (columns != nullptr) std::copy(matrix.column.begin(), matrix.column.end(), columns);
            if (values != nullptr) std::copy(matrix.value.begin(), matrix.value.end(), values);
        } else if (entries != nullptr) {
            counted = sound.entries();
        }
        if (nodes != nullptr) std::copy(part.nodes.begin(), part.nodes.end(), nodes);
        if (coordinates != nullptr) std::copy(part.coordinates.begin(), part.coordinates.end(), coordinates);
        if (dimension != nullptr) *dimension = part.dimension;
        if (node_count != nullptr) *node_count = static_cast<std::int64_t>(part.nodes.size());
        if (entries != nullptr) *entries = counted;
    });
}

int32_t delam_experimental_part_fields(delam_context* context, int64_t size, const uint8_t* bytes, int64_t node_count,
                                       const double* displacement, int64_t body_count, const int32_t* bodies,
                                       const double* eigenstrains, int64_t cell_count, double* stress,
                                       double* rotation) {
    return guard_read(context, [&] {
        require_count(size, "size");
        require_pointer(bytes, "bytes");
        require_count(node_count, "node_count");
        require_count(body_count, "body_count");
        require_count(cell_count, "cell_count");
        require_array(displacement, node_count, "displacement");
        require_array(bodies, body_count, "bodies");
        require_array(eigenstrains, body_count, "eigenstrains");
        require_finite(eigenstrains, 6 * body_count, "eigenstrains");
        const Part part = load_part({bytes, index(size)});
        const SoundPart sound(part);
        const Mesh& mesh = sound.mesh();
        if (node_count != mesh.node_count())
            fail(DELAM_ERROR_ARGUMENT, "node_count = ", node_count, ", but the part has ", mesh.node_count(), " nodes");
        if (cell_count != mesh.cell_count())
            fail(DELAM_ERROR_ARGUMENT, "cell_count = ", cell_count, ", but the part has ", mesh.cell_count(), " cells");
        require_finite(displacement, node_count * mesh.dimension(), "displacement");
        const std::span u(displacement, index(node_count * mesh.dimension()));
        require_labels(bodies, body_count);
        std::vector<Strain> strains(body_count > 0 ? part.labels.size() : 0);
        for (std::int64_t b = 0; b < body_count; ++b) {
            const auto at = std::lower_bound(part.labels.begin(), part.labels.end(), bodies[b]);
            if (at == part.labels.end() || *at != bodies[b]) continue;
            std::copy_n(eigenstrains + 6 * b, 6, strains[index(at - part.labels.begin())].begin());
        }
        const std::vector<double> stresses = stress == nullptr ? std::vector<double>() : sound.stress(u, strains);
        const std::vector<double> rotations = rotation == nullptr ? std::vector<double>() : sound.rotation(u);
        std::copy(stresses.begin(), stresses.end(), stress);
        std::copy(rotations.begin(), rotations.end(), rotation);
    });
}

int32_t delam_experimental_solver_recover(delam_solver* solver) {
    return guard_read(solver, listed::experimental_solver_recover, [&] {
        if (!solver->core->observer().recover_in_engine())
            fail(DELAM_ERROR_STATE, "solver: its problem has no engine (delam_experimental_problem_set_engine)");
    });
}

int32_t delam_experimental_solver_eigenstrains(delam_solver* solver, int64_t capacity, int32_t* bodies,
                                               double* eigenstrains, int64_t* count) {
    return guard_read(solver, listed::experimental_solver_eigenstrains, [&] {
        const std::vector<Strain> strains = solver->core->observer().eigenstrains();
        const auto needed = static_cast<std::int64_t>(strains.size());
        require_capacity_if(bodies != nullptr || eigenstrains != nullptr, capacity, needed, "bodies, eigenstrains");
        for (std::int64_t b = 0; b < needed; ++b) {
            if (bodies != nullptr) bodies[b] = solver->core->problem().mesh->body_label(static_cast<std::int32_t>(b));
            if (eigenstrains != nullptr) std::copy_n(strains[index(b)].begin(), 6, eigenstrains + 6 * b);
        }
        if (count != nullptr) *count = needed;
    });
}

int32_t delam_experimental_mesh_cut(delam_mesh* mesh, int64_t face_count, int32_t nodes_per_face, const int64_t* faces,
                                    int32_t index_base, int64_t* out_nodes) {
    return guard_build(mesh, [&] {
        Mesh& core = *mesh->core;
        require_pointer(out_nodes, "out_nodes");
        require_count(face_count, "face_count", 1);
        if (find_face_row(core.dimension(), nodes_per_face) == nullptr)
            fail(DELAM_ERROR_ARGUMENT, "nodes_per_face = ", nodes_per_face, ": must be ", face_sizes(core.dimension()));
        require_base(index_base);
        *out_nodes =
            cut(core, require_indices(faces, face_count * nodes_per_face, core.node_count(), index_base, "faces"),
                index(nodes_per_face));
    });
}

int32_t delam_experimental_mesh_set_tangents(delam_mesh* mesh, int64_t interface_index, int64_t count,
                                             const double* directions) {
    return guard_build(mesh, [&] {
        Mesh& core = *mesh->core;
        const auto interfaces = static_cast<std::int64_t>(core.interfaces().size());
        const std::int64_t own = require_index(interface_index, interfaces, 0, "interface_index");
        const std::int64_t pairs = core.interfaces()[index(own)].pair_count();
        if (core.dimension() != 3)
            fail(DELAM_ERROR_ARGUMENT, "directions: a pair in the plane has one tangent; this mesh has dimension ",
                 core.dimension());
        if (count != 1 && count != pairs)
            fail(DELAM_ERROR_ARGUMENT, "count = ", count, ", must be 1 or the number of pairs, ", pairs);
        require_array(directions, 3 * count, "directions");
        require_finite(directions, 3 * count, "directions");
        for (std::int64_t i = 0; i < count; ++i) {
            const double* given = directions + 3 * i;
            if (!(std::hypot(given[0], given[1], given[2]) > 0.0))
                fail(DELAM_ERROR_ARGUMENT, "directions[", i, "] has length 0");
        }
        set_tangents(core, own, {directions, index(3 * count)});
    });
}

int32_t delam_experimental_mesh_split_interface(delam_mesh* mesh, int64_t interface_index, int64_t count,
                                                const int64_t* pairs, int32_t index_base, int64_t* out_interface) {
    return guard_build(mesh, [&] {
        require_pointer(out_interface, "out_interface");
        require_base(index_base);
        const auto interfaces = static_cast<std::int64_t>(mesh->core->interfaces().size());
        const std::int64_t own = require_index(interface_index, interfaces, 0, "interface_index");
        const std::int64_t there = mesh->core->interfaces()[index(own)].pair_count();
        require_count_up_to(count, "count", 1, there);
        *out_interface = split_interface(*mesh->core, own, require_indices(pairs, count, there, index_base, "pairs"));
    });
}

int32_t delam_experimental_solver_follow(delam_solver* solver, int64_t interface_count, const int64_t* interfaces,
                                         const char* key, int64_t* parameter) {
    return guard_solve(solver, listed::experimental_solver_follow, [&] {
        const std::vector<std::int64_t> list = require_interfaces(solver->core->problem(), interface_count, interfaces);
        require_pointer(key, "key");
        const std::int64_t index = solver->core->follow(list, key);
        std::vector<PlanItem> plan = plan_of(*solver->core);
        solver->earlier_plans.push_back(std::exchange(solver->plan, std::move(plan)));
        if (parameter != nullptr) *parameter = index;
    });
}

int32_t delam_experimental_solver_sensitivity(const delam_solver* solver, int64_t capacity, double* matrix,
                                              int64_t* unknown) {
    return guard_read(solver, listed::experimental_solver_sensitivity, [&] {
        const std::vector<double> values = solver->core->sensitivities();
        require_array(matrix, static_cast<std::int64_t>(values.size()), "matrix");
        require_capacity(capacity, static_cast<std::int64_t>(values.size()), "matrix");
        std::copy(values.begin(), values.end(), matrix);
        if (unknown != nullptr) *unknown = solver->core->states().shown().sensitivity.unknown;
    });
}
