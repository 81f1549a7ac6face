// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/body_system.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/numbers.hpp"
#include "linalg/dense.hpp"
#include "scene/carriers.hpp"

namespace delam {

namespace {

// The stiffness of all bodies over all mesh DOFs; rows of nodes of no body are empty.
SparseMatrix assemble(const Problem& problem, const Poll& poll) {
    const Mesh& mesh = *problem.mesh;
    const std::int64_t dim = mesh.dimension();
    const std::int64_t dofs = mesh.node_count() * dim;
    std::vector<SparseMatrix> part;
    std::vector<std::vector<std::int64_t>> nodes;
    for (std::int32_t body = 0; body < mesh.body_count(); ++body) {
        nodes.push_back(mesh.body_nodes(body));
        part.push_back(problem.body_stiffness(body, poll));
        call_if_set(poll);
    }
    SparseMatrix k;
    k.rows = k.columns = dofs;
    k.start.assign(index(dofs) + 1, 0);
    for (std::size_t b = 0; b < part.size(); ++b)
        for (std::int64_t r = 0; r < part[b].rows; ++r)
            k.start[index(nodes[b][index(r / dim)] * dim + r % dim) + 1] =
                part[b].start[index(r) + 1] - part[b].start[index(r)];
    std::partial_sum(k.start.begin(), k.start.end(), k.start.begin());
    k.column.resize(index(k.start.back()));
    k.value.resize(index(k.start.back()));
    for (std::size_t b = 0; b < part.size(); ++b) {
        for (std::int64_t r = 0; r < part[b].rows; ++r) {
            std::size_t at = index(k.start[index(nodes[b][index(r / dim)] * dim + r % dim)]);
            for (std::int64_t e = part[b].start[index(r)]; e < part[b].start[index(r) + 1]; ++e, ++at) {
                const std::int64_t c = part[b].column[index(e)];
                k.column[at] = nodes[b][index(c / dim)] * dim + c % dim;
                k.value[at] = part[b].value[index(e)];
            }
        }
        part[b] = SparseMatrix();
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
    std::vector<Triplet> all;
    for (std::int64_t r = 0; r < k.rows; ++r)
        for (std::int64_t e = k.start[index(r)]; e < k.start[index(r) + 1]; ++e)
            all.push_back({r, k.column[index(e)], k.value[index(e)]});
    all.insert(all.end(), missing.begin(), missing.end());
    return from_triplets(k.rows, k.columns, std::move(all));
}

}  // namespace

BodySystem::BodySystem(const Problem& problem, const Poll& poll) : problem_(problem) {
    stiffness_ = assemble(problem_, poll);
    call_if_set(poll);
    jump_rows_ = jump_matrix(problem_);
    call_if_set(poll);
    variables_ = make_jump_variables(problem_, poll);
    call_if_set(poll);
}

SparseMatrix BodySystem::transformed(const Poll& poll) const {
    return with_diagonal(congruence(stiffness_, variables_.transform, poll), variables_.leading);
}

AssembledBodies assemble_bodies(const Problem& problem, Monitor& monitor) {
    const Poll assembling = [&monitor] { monitor.progress("assemble", 0, 0); };
    call_if_set(assembling);
    AssembledBodies bodies{std::make_unique<BodySystem>(problem, assembling), {}};
    bodies.transformed = bodies.system->transformed(assembling);
    return bodies;
}

StrainLoads BodySystem::find_loads() {
    StrainLoads strained = strain_loads(problem_);
    const std::size_t patterns = problem_.patterns.size();
    force_.assign(patterns, {});
    for (const NodalForce& f : problem_.forces) {
        auto& force = force_[index(f.pattern)];
        if (force.empty()) force.assign(index(dofs()), 0.0);
        force[index(f.dof)] += f.value;
    }
    for (std::size_t p = 0; p < patterns; ++p)
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

std::vector<double> BodySystem::residual(std::span<const double> theta, std::span<const double> displacement,
                                         std::span<const double> force) const {
    std::vector<double> r(displacement.size()), pull(displacement.size());
    multiply(stiffness_, displacement, r);
    multiply_transposed(jump_rows_, force, pull);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] += pull[i];
    for (std::size_t p = 0; p < theta.size(); ++p)
        if (!force_[p].empty()) add_scaled(-theta[p], force_[p], r);
    return r;
}

}  // namespace delam
