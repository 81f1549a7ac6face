// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/dual/scaling.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/numbers.hpp"

namespace delam {

namespace {

// Relative size below which a row counts as a combination of others. (Measured by verify/bench/constants.py on 250
// random scenes: half and twice decide alike.)
constexpr double dependence = 1e-9;

// Columns are sorted, control nodes last.
bool of_bodies(const SparseMatrix& b, std::int64_t row, std::int64_t body_dofs) {
    const auto first = index(b.start[index(row)]);
    return b.start[index(row)] < b.start[index(row) + 1] && b.column[first] < body_dofs;
}

// Rows that hang together through shared boundary DOFs of bodies, by union-find over DOFs. Rows among control nodes
// alone are in none.
std::vector<std::vector<std::int64_t>> clusters(const SparseMatrix& b, std::int64_t body_dofs) {
    std::vector<std::int64_t> parent(index(b.columns));
    std::iota(parent.begin(), parent.end(), std::int64_t{0});
    const auto find = [&](std::int64_t i) {
        while (parent[index(i)] != i) {
            auto& up = parent[index(i)];
            up = parent[index(up)];
            i = up;
        }
        return i;
    };
    for (std::int64_t r = 0; r < b.rows; ++r)
        for (std::int64_t e = b.start[index(r)]; e < b.start[index(r) + 1]; ++e)
            if (b.column[index(e)] < body_dofs)
                parent[index(find(b.column[index(e)]))] = find(b.column[index(b.start[index(r)])]);
    std::vector<std::vector<std::int64_t>> groups;
    std::vector<std::int64_t> group_of(index(b.columns), -1);
    for (std::int64_t r = 0; r < b.rows; ++r) {
        if (!of_bodies(b, r, body_dofs)) continue;
        const auto root = static_cast<std::size_t>(find(b.column[index(b.start[index(r)])]));
        if (group_of[root] < 0) {
            group_of[root] = static_cast<std::int64_t>(groups.size());
            groups.emplace_back();
        }
        groups[index(group_of[root])].push_back(r);
    }
    return groups;
}

// Rows of B over the DOFs below `end` that they touch, densely.
struct ClusterBlock {
    std::vector<std::int64_t> dof;
    DenseMatrix b;

    ClusterBlock(const SparseMatrix& matrix, const std::vector<std::int64_t>& rows, std::int64_t end) {
        for (const std::int64_t r : rows)
            for (std::int64_t e = matrix.start[index(r)]; e < matrix.start[index(r) + 1]; ++e)
                if (matrix.column[index(e)] < end) dof.push_back(matrix.column[index(e)]);
        std::sort(dof.begin(), dof.end());
        dof.erase(std::unique(dof.begin(), dof.end()), dof.end());
        b = DenseMatrix(static_cast<std::int64_t>(rows.size()), static_cast<std::int64_t>(dof.size()));
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const auto r = index(rows[i]);
            for (std::int64_t e = matrix.start[r]; e < matrix.start[r + 1]; ++e) {
                if (matrix.column[index(e)] >= end) continue;
                const auto at = std::lower_bound(dof.begin(), dof.end(), matrix.column[index(e)]) - dof.begin();
                b(static_cast<std::int64_t>(i), at) = matrix.value[index(e)];
            }
        }
    }
};

DenseMatrix transposed(const DenseMatrix& a) {
    DenseMatrix out(a.columns, a.rows);
    for (std::int64_t j = 0; j < a.columns; ++j)
        for (std::int64_t i = 0; i < a.rows; ++i) out(j, i) = a(i, j);
    return out;
}

// A^+ from the eigenpairs of A >= 0.
DenseMatrix pseudo_inverse(const Eigen& eigen) {
    const std::int64_t n = eigen.vector.rows;
    DenseMatrix scaled = eigen.vector;
    const double largest = n > 0 ? eigen.value.back() : 0.0;
    for (std::int64_t j = 0; j < n; ++j) {
        const double value = eigen.value[index(j)];
        const double inverse = value > dependence * largest ? 1.0 / value : 0.0;
        for (std::int64_t i = 0; i < n; ++i) scaled(i, j) *= inverse;
    }
    return multiply(scaled, transposed(eigen.vector));
}

// Finds the jump rows (they come first in a cluster) that lie in the span of the other kinds of rows.
void find_prescribed(const std::vector<std::int64_t>& rows, std::int64_t jump_count, const ClusterBlock& block,
                     Scaling& scaling) {
    const auto jumps = std::count_if(rows.begin(), rows.end(), [&](std::int64_t r) { return r < jump_count; });
    const std::int64_t others = static_cast<std::int64_t>(rows.size()) - jumps;
    if (jumps == 0 || others == 0) return;
    DenseMatrix gram(others, others);
    for (std::int64_t i = 0; i < others; ++i)
        for (std::int64_t j = 0; j < others; ++j)
            for (std::int64_t d = 0; d < block.b.columns; ++d)
                gram(i, j) += block.b(jumps + i, d) * block.b(jumps + j, d);
    const DenseMatrix inverse = pseudo_inverse(eigen_symmetric(gram));
    for (std::int64_t r = 0; r < jumps; ++r) {
        std::vector<double> rest(index(block.b.columns)), along(index(others), 0.0);
        double size = 0.0, left = 0.0;
        for (std::int64_t d = 0; d < block.b.columns; ++d) rest[index(d)] = block.b(r, d);
        for (const double v : rest) size += v * v;
        for (std::int64_t i = 0; i < others; ++i)
            for (std::int64_t d = 0; d < block.b.columns; ++d) along[index(i)] += block.b(jumps + i, d) * block.b(r, d);
        Scaling::Prescribed found{rows[index(r)], {}, {}};
        for (std::int64_t i = 0; i < others; ++i) {
            double y = 0.0;
            for (std::int64_t j = 0; j < others; ++j) y += inverse(i, j) * along[index(j)];
            for (std::int64_t d = 0; d < block.b.columns; ++d) rest[index(d)] -= y * block.b(jumps + i, d);
            if (std::abs(y) <= dependence) continue;
            found.row.push_back(rows[index(jumps + i)]);
            found.y.push_back(y);
        }
        for (const double v : rest) left += v * v;
        if (left > dependence * dependence * size) continue;
        scaling.prescribed[index(found.jump_row)] = 1;
        scaling.prescribed_jumps.push_back(std::move(found));
    }
}

}  // namespace

Scaling make_scaling(const DualRows& rows, const std::vector<Subdomain>& subdomains, const std::string& kind) {
    std::vector<double> inverse_weight(index(rows.boundary_count()), 1.0);
    if (kind == "stiffness")
        for (std::size_t s = 0; s < subdomains.size(); ++s)
            for (std::size_t i = 0; i < subdomains[s].boundary.size(); ++i)
                inverse_weight[index(rows.offset[s]) + i] = 1.0 / subdomains[s].diagonal[i];

    Scaling scaling;
    scaling.prescribed.assign(index(rows.jump_count), 0);
    std::vector<Triplet> triplets;
    std::vector<std::int64_t> control_rows;  // among control nodes alone
    for (std::int64_t r = rows.jump_count; r < rows.count(); ++r)
        if (!of_bodies(rows.b, r, rows.body_dofs)) control_rows.push_back(r);
    for (const auto& cluster : clusters(rows.b, rows.body_dofs)) {
        const ClusterBlock block(rows.b, cluster, rows.body_dofs);
        const auto n = static_cast<std::int64_t>(cluster.size());
        DenseMatrix weighted = block.b;  // B W^-1
        for (std::int64_t d = 0; d < weighted.columns; ++d)
            for (std::int64_t i = 0; i < n; ++i) weighted(i, d) *= inverse_weight[index(block.dof[index(d)])];
        const Eigen eigen = eigen_symmetric(multiply(weighted, transposed(block.b)));
        const DenseMatrix b_d = multiply(pseudo_inverse(eigen), weighted);
        for (std::int64_t i = 0; i < n; ++i)
            for (std::int64_t d = 0; d < b_d.columns; ++d)
                if (b_d(i, d) != 0.0) triplets.push_back({cluster[index(i)], block.dof[index(d)], b_d(i, d)});
        if (n == 1 && control_rows.empty()) continue;
        const double largest = eigen.value.back();
        for (std::int64_t j = 0; j < n && eigen.value[index(j)] <= dependence * largest; ++j) {
            Scaling::Dependency dependency{{}, {}, 1.0 / largest};
            bool of_jumps = false;
            for (std::int64_t i = 0; i < n; ++i) {
                if (std::abs(eigen.vector(i, j)) <= dependence) continue;
                dependency.row.push_back(cluster[index(i)]);
                dependency.z.push_back(eigen.vector(i, j));
                of_jumps = of_jumps || cluster[index(i)] < rows.jump_count;
            }
            if (of_jumps) scaling.dependencies.push_back(std::move(dependency));
        }
        std::vector<std::int64_t> held = cluster;
        held.insert(held.end(), control_rows.begin(), control_rows.end());
        find_prescribed(held, rows.jump_count, ClusterBlock(rows.b, held, rows.boundary_count()), scaling);
    }
    scaling.b_d = from_triplets(rows.count(), rows.boundary_count(), std::move(triplets));
    return scaling;
}

}  // namespace delam
