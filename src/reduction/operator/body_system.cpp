// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/operator/body_system.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/numbers.hpp"
#include "body/assembly.hpp"
#include "linalg/dense/dense.hpp"
#include "scene/carriers.hpp"

namespace delam {

namespace {

// Assembles the stiffness of the bodies with cells of their own, over all mesh DOFs.
SparseMatrix assemble_cells(const Problem& problem, const Poll& poll) {
    const Mesh& mesh = *problem.mesh;
    std::vector<BodyModel> models;
    for (std::int32_t body = 0; body < mesh.body_count(); ++body)
        models.push_back(problem.stiffness[index(body)] == nullptr
                             ? problem.model(body)
                             : BodyModel{Elastic{1.0, 0.0}, problem.plane, Formulation::standard, nullptr});
    std::vector<std::int64_t> cells, nodes(index(mesh.node_count()));
    cells.reserve(index(mesh.cell_count()));
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
        if (problem.stiffness[index(mesh.cell_body(c))] == nullptr) cells.push_back(c);
    std::iota(nodes.begin(), nodes.end(), std::int64_t{0});
    return assemble_stiffness(mesh, cells, nodes, models, problem.options.threads, poll);
}

// The stiffness of all bodies over all mesh DOFs; rows of nodes of no body are empty. No two bodies share a row.
SparseMatrix assemble(const Problem& problem, const Poll& poll) {
    const Mesh& mesh = *problem.mesh;
    const std::int64_t dim = mesh.dimension();
    SparseMatrix of_cells = assemble_cells(problem, poll);
    if (std::all_of(problem.stiffness.begin(), problem.stiffness.end(),
                    [](const auto& given) { return given == nullptr; }))
        return of_cells;
    struct Row {
        const SparseMatrix* from = nullptr;
        std::int64_t row = 0;
        const std::vector<std::int64_t>* nodes = nullptr;  // of the columns; null: as they are
    };
    std::vector<Row> source(index(of_cells.rows));
    for (std::int64_t r = 0; r < of_cells.rows; ++r) source[index(r)] = {&of_cells, r, nullptr};
    std::vector<std::vector<std::int64_t>> nodes(index(mesh.body_count()));
    std::int64_t entries = of_cells.entries();
    for (std::int32_t body = 0; body < mesh.body_count(); ++body) {
        const auto& given = problem.stiffness[index(body)];
        if (given == nullptr) continue;
        nodes[index(body)] = mesh.body_nodes(body);
        for (std::int64_t r = 0; r < given->matrix.rows; ++r)
            source[index(nodes[index(body)][index(r / dim)] * dim + r % dim)] = {&given->matrix, r,
                                                                                 &nodes[index(body)]};
        entries += given->matrix.entries();
    }
    SparseMatrix k;
    k.rows = k.columns = of_cells.rows;
    k.column.reserve(index(entries));
    k.value.reserve(index(entries));
    for (const Row& row : source) {
        const SparseMatrix& m = *row.from;
        for (std::int64_t e = m.start[index(row.row)]; e < m.start[index(row.row) + 1]; ++e) {
            const std::int64_t c = m.column[index(e)];
            k.column.push_back(row.nodes == nullptr ? c : (*row.nodes)[index(c / dim)] * dim + c % dim);
            k.value.push_back(m.value[index(e)]);
        }
        k.start.push_back(k.entries());
    }
    return k;
}

SparseMatrix jump_matrix(const Problem& problem) {
    const std::int64_t dim = problem.mesh->dimension();
    std::vector<Triplet> triplets;
    const Carriers carriers(problem);
    std::int64_t row = 0;
    for (const InterfaceGeometry& face : problem.mesh->interfaces())
        for (std::size_t p = 0; p < face.node_a.size(); ++p)
            for (std::int64_t r = 0; r < dim; ++r, ++row)
                for (std::int64_t k = 0; k < dim; ++k) {
                    const double q = face.frame[(p * index(dim) + index(r)) * index(dim) + index(k)];
                    if (q == 0.0) continue;
                    for (const auto& [node, weight] : carriers.of(face.node_b[p]))
                        triplets.push_back({row, node * dim + k, q * weight});
                    for (const auto& [node, weight] : carriers.of(face.node_a[p]))
                        triplets.push_back({row, node * dim + k, -q * weight});
                }
    return from_triplets(row, problem.mesh->node_count() * dim, std::move(triplets));
}

// A control node used only by long constraints has no stiffness at all; its diagonal entry must exist all the same.
SparseMatrix with_diagonal(SparseMatrix k, std::int64_t first) {
    std::vector<Triplet> missing;
    for (std::int64_t r = first; r < k.rows; ++r) {
        const auto begin = k.column.begin() + k.start[index(r)], end = k.column.begin() + k.start[index(r) + 1];
        if (!std::binary_search(begin, end, r)) missing.push_back({r, r, 0.0});
    }
    if (missing.empty()) return k;
    return sum(k, from_triplets(k.rows, k.columns, std::move(missing)));
}

}  // namespace

BodySystem::BodySystem(const Problem& problem, const Poll& poll, Stiffness stiffness) : problem_(problem) {
    if (stiffness == Stiffness::here) stiffness_ = assemble(problem_, poll);
    call_if_set(poll);
    jump_rows_ = jump_matrix(problem_);
    call_if_set(poll);
    variables_ = make_jump_variables(problem_, poll);
    if (problem_.renewed) offset_jumps(variables_, problem_.jump_offset);
    call_if_set(poll);
}

BodySystem::BodySystem(std::shared_ptr<const Problem> problem, const Poll& poll) : BodySystem(*problem, poll) {
    kept_ = std::move(problem);
}

void BodySystem::renew(Renewed what, const Poll& poll) {
    if (what == Renewed::all) {
        stiffness_ = assemble(problem_, poll);
        jump_rows_ = jump_matrix(problem_);
        variables_ = make_jump_variables(problem_, poll);
    }
    offset_jumps(variables_, problem_.jump_offset);
    call_if_set(poll);
}

SparseMatrix BodySystem::transformed(const Poll& poll) const {
    return with_diagonal(congruence(stiffness_, variables_.transform, poll), variables_.leading);
}

namespace {

template <class Held>
AssembledBodies assembled(Held&& problem, Monitor& monitor) {
    const Poll assembling = [&monitor] { monitor.progress("assemble", 0, 0); };
    call_if_set(assembling);
    AssembledBodies bodies{std::make_unique<BodySystem>(std::forward<Held>(problem), assembling), {}};
    bodies.transformed = bodies.system->transformed(assembling);
    return bodies;
}

}  // namespace

AssembledBodies assemble_bodies(const Problem& problem, Monitor& monitor) { return assembled(problem, monitor); }

AssembledBodies assemble_bodies(std::shared_ptr<const Problem> problem, Monitor& monitor) {
    return assembled(std::move(problem), monitor);
}

void BodySystem::find_dead_forces() {
    force_.assign(problem_.patterns.size(), {});
    for (const NodalForce& f : problem_.forces) {
        auto& force = force_[index(f.pattern)];
        if (force.empty()) force.assign(index(dofs()), 0.0);
        force[index(f.dof)] += f.value;
    }
}

StrainLoads BodySystem::find_loads() {
    StrainLoads strained = strain_loads(problem_);
    find_dead_forces();
    for (std::size_t p = 0; p < force_.size(); ++p)
        if (!strained.force[p].empty()) force_[p] = std::move(strained.force[p]);
    return strained;
}

std::vector<double> BodySystem::lift(std::span<const double> theta) const {
    std::vector<double> u(index(dofs()), 0.0);
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (theta[p] != 0.0) add_scaled(theta[p], variables_.lift[p], u);
    return u;
}

void BodySystem::add_variables(std::span<const double> variables, std::span<double> displacement) const {
    std::vector<double> moved(displacement.size());
    multiply(variables_.transform, variables, moved);
    for (std::size_t i = 0; i < moved.size(); ++i) displacement[i] += moved[i];
}

std::vector<double> BodySystem::jump(std::span<const double> displacement) const {
    std::vector<double> jump(index(jump_rows_.rows));
    multiply(jump_rows_, displacement, jump);
    return jump;
}

std::vector<double> BodySystem::stressed(std::span<const double> displacement) const {
    std::vector<double> force(displacement.size());
    multiply(stiffness_, displacement, force);
    return force;
}

std::vector<double> BodySystem::residual(std::span<const double> theta, std::span<const double> stressed,
                                         std::span<const double> force) const {
    std::vector<double> r(stressed.begin(), stressed.end()), pull(stressed.size());
    multiply_transposed(jump_rows_, force, pull);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] += pull[i];
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (!force_[p].empty()) add_scaled(-theta[p], force_[p], r);
    return r;
}

}  // namespace delam
