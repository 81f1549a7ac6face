// SPDX-License-Identifier: BSD-3-Clause
#include "exported.hpp"

#include <map>

namespace reference {
namespace {

// The exported body DOFs count the body's nodes in ascending order; maps them back to the mesh.
Csr global_stiffness(const Scene& scene) {
    const auto d = static_cast<std::size_t>(scene.dimension());
    const std::size_t nodes = scene.node_count();
    std::vector<std::int32_t> label(nodes);
    REQUIRE(scene, delam_mesh_node_bodies, scene.mesh(), static_cast<std::int64_t>(nodes), label.data());
    std::map<std::int32_t, std::vector<std::int64_t>> members;
    for (std::size_t i = 0; i < nodes; ++i) {
        if (label[i] >= 0) members[label[i]].push_back(static_cast<std::int64_t>(i));
    }

    std::vector<std::vector<std::pair<std::int64_t, double>>> rows(nodes * d);
    for (const auto& [body, list] : members) {
        std::int64_t row_count = 0;
        std::int64_t entries = 0;
        REQUIRE(scene, delam_problem_body_matrix, scene.problem(), body, &row_count, &entries, nullptr, nullptr,
                nullptr);
        if (static_cast<std::size_t>(row_count) != list.size() * d)
            throw Failure(0, "body matrix: rows do not match the body");
        Csr local;
        local.start.resize(static_cast<std::size_t>(row_count) + 1);
        local.column.resize(static_cast<std::size_t>(entries));
        local.value.resize(static_cast<std::size_t>(entries));
        REQUIRE(scene, delam_problem_body_matrix, scene.problem(), body, &row_count, &entries, local.start.data(),
                local.column.data(), local.value.data());
        const auto global = [d, &nodes_of = list](std::size_t i) {
            return nodes_of[i / d] * static_cast<std::int64_t>(d) + static_cast<std::int64_t>(i % d);
        };
        for (std::size_t i = 0; i < local.rows(); ++i) {
            auto& row = rows[static_cast<std::size_t>(global(i))];
            for (auto e = local.start[i]; e < local.start[i + 1]; ++e) {
                const auto k = static_cast<std::size_t>(e);
                row.emplace_back(global(static_cast<std::size_t>(local.column[k])), local.value[k]);
            }
        }
    }
    Csr all;
    for (const auto& row : rows) {
        for (const auto& [column, value] : row) {
            all.column.push_back(column);
            all.value.push_back(value);
        }
        all.start.push_back(static_cast<std::int64_t>(all.column.size()));
    }
    return all;
}

}  // namespace

Exported::Exported(const Scene& scene) : dimension(scene.dimension()), dofs(scene.nodes().size()) {
    stiffness = global_stiffness(scene);
    alive.resize(dofs);
    for (std::size_t i = 0; i < dofs; ++i) alive[i] = stiffness.start[i + 1] > stiffness.start[i];

    for (std::size_t i = 0; i < scene.stiffness().size(); ++i)
        interfaces.push_back(scene.pairs(static_cast<std::int64_t>(i)));

    std::int64_t tied = 0;
    std::int64_t tie_entries = 0;
    REQUIRE(scene, delam_mesh_node_ties, scene.mesh(), &tied, &tie_entries, nullptr, nullptr, nullptr, nullptr);
    std::vector<std::int64_t> tie_nodes(static_cast<std::size_t>(tied)), starts(tie_nodes.size() + 1),
        of(static_cast<std::size_t>(tie_entries));
    std::vector<double> weights(of.size());
    REQUIRE(scene, delam_mesh_node_ties, scene.mesh(), &tied, &tie_entries, tie_nodes.data(), starts.data(), of.data(),
            weights.data());
    for (std::size_t i = 0; i < tie_nodes.size(); ++i) {
        ties.push_back({tie_nodes[i], {}});
        for (auto e = static_cast<std::size_t>(starts[i]); e < static_cast<std::size_t>(starts[i + 1]); ++e)
            ties.back().of.emplace_back(of[e], weights[e]);
    }

    std::int64_t rows = 0;
    std::int64_t entries = 0;
    std::int64_t pattern_count = 0;
    REQUIRE(scene, delam_problem_constraints, scene.problem(), &rows, &entries, &pattern_count, nullptr, nullptr,
            nullptr, nullptr);
    constraints.start.resize(static_cast<std::size_t>(rows) + 1);
    constraints.column.resize(static_cast<std::size_t>(entries));
    constraints.value.resize(static_cast<std::size_t>(entries));
    patterns = static_cast<std::size_t>(pattern_count);
    prescribed.resize(static_cast<std::size_t>(rows) * patterns);
    REQUIRE(scene, delam_problem_constraints, scene.problem(), &rows, &entries, &pattern_count,
            constraints.start.data(), constraints.column.data(), constraints.value.data(), prescribed.data());

    // A node without cells that something refers to is a control node: an unknown without stiffness.
    const auto refer = [&](std::int64_t node) {
        for (int k = 0; k < dimension; ++k) alive[static_cast<std::size_t>(node * dimension + k)] = true;
    };
    for (const std::int64_t dof : constraints.column) refer(dof / dimension);
    for (const Pairs& p : interfaces) {
        for (const std::int64_t node : p.node_a) refer(node);
        for (const std::int64_t node : p.node_b) refer(node);
    }
    for (std::size_t p = 0; p < patterns; ++p) {
        forces.emplace_back(dofs);
        REQUIRE(scene, delam_problem_forces, scene.problem(), static_cast<std::int64_t>(p),
                static_cast<std::int64_t>(dofs), forces.back().data());
    }
    strain_energy.resize(patterns * patterns);
    REQUIRE(scene, delam_problem_eigenstrain_energy, scene.problem(), static_cast<std::int64_t>(strain_energy.size()),
            strain_energy.data());
}

std::vector<double> Exported::factors(const Scene& scene, double time) const {
    std::vector<double> factor(patterns);
    REQUIRE(scene, delam_problem_factors, scene.problem(), time, static_cast<std::int64_t>(patterns), factor.data());
    return factor;
}

void Exported::load(const Scene& scene, double time, std::vector<double>& values, std::vector<double>& force) const {
    const std::vector<double> factor = factors(scene, time);
    values.assign(constraints.rows(), 0.0);
    force.assign(dofs, 0.0);
    for (std::size_t p = 0; p < patterns; ++p) {
        for (std::size_t c = 0; c < values.size(); ++c) values[c] += prescribed[c * patterns + p] * factor[p];
        for (std::size_t i = 0; i < dofs; ++i) force[i] += forces[p][i] * factor[p];
    }
}

}  // namespace reference
