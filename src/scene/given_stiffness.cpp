// SPDX-License-Identifier: BSD-3-Clause
#include "scene/given_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

// Relative to the geometric mean of the two diagonal entries; a larger asymmetry is an error of the host, a smaller one
// is averaged out.
constexpr double asymmetry = 1e-9;

// Energies of motions, and their squares, must stay finite.
constexpr double largest_stiffness = 1e150;

struct Place {
    std::int32_t body = -1;
    std::int64_t dof = -1;  // of the body
};

// Both triangles, duplicates summed, symmetric to the last bit.
SparseMatrix symmetric(const Mesh& mesh, std::int32_t body, std::int64_t rows, std::vector<Triplet> entries) {
    SparseMatrix k = from_triplets(rows, rows, std::move(entries));
    const SparseMatrix turned = transpose(k);
    const std::vector<std::int64_t> nodes = mesh.body_nodes(body);
    const std::int64_t dim = mesh.dimension();
    const auto name = [&](std::int64_t dof) {
        return text("component ", dof % dim, " of node ", nodes[index(dof / dim)]);
    };
    std::vector<double> diagonal(index(rows), 0.0);
    for (std::int64_t r = 0; r < rows; ++r)
        for (std::int64_t e = k.start[index(r)]; e < k.start[index(r) + 1]; ++e)
            if (k.column[index(e)] == r) diagonal[index(r)] = k.value[index(e)];
    for (std::int64_t r = 0; r < rows; ++r)
        if (!(diagonal[index(r)] > 0.0 && diagonal[index(r)] <= largest_stiffness))
            fail(DELAM_ERROR_ARGUMENT, "the stiffness of body ", mesh.body_label(body), " has ", diagonal[index(r)],
                 " on the diagonal at ", name(r), ": must be > 0 and <= ", largest_stiffness);
    std::vector<Triplet> mean;
    mean.reserve(k.value.size());
    for (std::int64_t r = 0; r < rows; ++r) {
        std::int64_t e = k.start[index(r)], f = turned.start[index(r)];
        while (e < k.start[index(r) + 1] || f < turned.start[index(r) + 1]) {
            constexpr std::int64_t none = INT64_MAX;
            const std::int64_t c = e < k.start[index(r) + 1] ? k.column[index(e)] : none,
                               d = f < turned.start[index(r) + 1] ? turned.column[index(f)] : none;
            const double a = c <= d ? k.value[index(e++)] : 0.0, b = d <= c ? turned.value[index(f++)] : 0.0;
            const std::int64_t column = std::min(c, d);
            const double scale = std::sqrt(diagonal[index(r)]) * std::sqrt(diagonal[index(column)]);
            if (!(std::abs(a - b) <= asymmetry * scale))
                fail(DELAM_ERROR_ARGUMENT, "the stiffness of body ", mesh.body_label(body), " is not symmetric: ", a,
                     " and ", b, " between ", name(r), " and ", name(column), ", allowed difference ",
                     asymmetry * scale);
            // No entry of a matrix without negative energies exceeds the mean of its diagonal entries; twice that is no
            // rounding.
            if (!(std::abs(a) <= 2.0 * scale))
                fail(DELAM_ERROR_ARGUMENT, "the stiffness of body ", mesh.body_label(body), " has ", a, " between ",
                     name(r), " and ", name(column), ", beyond ", scale,
                     ", the geometric mean of their diagonal entries: the matrix is indefinite");
            mean.push_back({r, column, 0.5 * a + 0.5 * b});
        }
    }
    return from_triplets(rows, rows, std::move(mean));
}

}  // namespace

void take_stiffness(Problem& problem, const GivenMatrix& given, Monitor& monitor) {
    const Mesh& mesh = *problem.mesh;
    const std::int64_t dim = mesh.dimension(), rows = static_cast<std::int64_t>(given.nodes.size()) * dim;
    std::map<std::int32_t, std::vector<std::int64_t>> nodes_of;  // bodies
    std::vector<std::int64_t> listed(index(mesh.node_count()), -1);
    for (std::size_t i = 0; i < given.nodes.size(); ++i) {
        const std::int64_t node = given.nodes[i];
        if (listed[index(node)] >= 0) fail(DELAM_ERROR_ARGUMENT, "nodes[", i, "] = ", node, " occurs twice");
        listed[index(node)] = static_cast<std::int64_t>(i);
        const std::int32_t body = mesh.node_body(node);
        if (body < 0)
            fail(DELAM_ERROR_ARGUMENT, "nodes[", i, "] = ", node, " belongs to no body (delam_mesh_add_host_body)");
        nodes_of.try_emplace(body);
    }
    std::vector<Place> place(index(rows));  // of each row of the host's matrix
    for (auto& [body, nodes] : nodes_of) {
        nodes = mesh.body_nodes(body);
        for (std::size_t local = 0; local < nodes.size(); ++local) {
            const std::int64_t i = listed[index(nodes[local])];
            if (i < 0)
                fail(DELAM_ERROR_ARGUMENT, "nodes: node ", nodes[local], " of body ", mesh.body_label(body),
                     " is missing; a stiffness must cover whole bodies");
            for (std::int64_t c = 0; c < dim; ++c) {
                const std::int64_t row = given.dofs.empty() ? i * dim + c : given.dofs[index(i * dim + c)];
                if (place[index(row)].body >= 0)
                    fail(DELAM_ERROR_ARGUMENT, "dofs[", i, "][", c, "] = ", row,
                         " is the row of another displacement already");
                place[index(row)] = {body, static_cast<std::int64_t>(local) * dim + c};
            }
        }
    }
    std::map<std::int32_t, std::vector<Triplet>> entries;
    for (std::int64_t r = 0; r < rows; ++r) {
        const Place& at = place[index(r)];
        for (std::int64_t e = given.row_starts[index(r)]; e < given.row_starts[index(r) + 1]; ++e) {
            const Place& other = place[index(given.columns[index(e)])];
            if (other.body == at.body) {
                entries[at.body].push_back({at.dof, other.dof, given.values[index(e)]});
            } else if (given.values[index(e)] != 0.0) {
                fail(DELAM_ERROR_ARGUMENT, "values[", e, "] = ", given.values[index(e)], " in row ", r,
                     " couples bodies ", mesh.body_label(at.body), " and ", mesh.body_label(other.body),
                     ": bodies interact only at interfaces");
            }
        }
    }
    std::vector<std::shared_ptr<const HostStiffness>> taken = problem.stiffness;
    std::int64_t done = 0;
    for (const auto& [body, nodes] : nodes_of) {
        monitor.progress("stiffness", done++, static_cast<std::int64_t>(nodes_of.size()));
        const std::int64_t own_rows = static_cast<std::int64_t>(nodes.size()) * dim;
        ToldKernel own{given.kernel.told, DenseMatrix(own_rows, given.kernel.motions.columns)};
        for (std::int64_t r = 0; r < rows; ++r)
            for (std::int64_t c = 0; c < own.motions.columns && place[index(r)].body == body; ++c)
                own.motions(place[index(r)].dof, c) = given.kernel.motions(r, c);
        taken[index(body)] = std::make_shared<const HostStiffness>(
            host_stiffness(mesh, body, symmetric(mesh, body, own_rows, std::move(entries[body])), own, monitor));
    }
    problem.stiffness = std::move(taken);
}

}  // namespace delam
