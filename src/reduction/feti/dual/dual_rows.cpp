// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/dual/dual_rows.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "scene/carriers.hpp"

namespace delam {

DualRowBuilder::DualRowBuilder(const Problem& problem, std::span<const Subdomain> subdomains,
                               const std::string& gluing) {
    const Mesh& mesh = *problem.mesh;
    const int dim = mesh.dimension();
    copies_.resize(index(mesh.node_count()));
    for (std::size_t s = 0; s < subdomains.size(); ++s)
        for (std::size_t i = 0; i < subdomains[s].nodes.size(); ++i)
            copies_[index(subdomains[s].nodes[i])].push_back(
                {static_cast<std::int32_t>(s), static_cast<std::int64_t>(i)});

    // Any copy may stand for its node in jumps and constraints, since the copies are glued: the first one does.
    // A tied node is what it is tied to.
    const Carriers carriers(problem);
    const auto append = [&](std::vector<Entry>& row, std::int64_t node, int component, double coefficient) {
        for (const auto& [carrier, weight] : carriers.of(node)) {
            const NodeCopy& copy = copies_[index(carrier)].front();
            row.push_back({copy.subdomain, copy.local * dim + component, coefficient * weight});
        }
    };

    for (const InterfaceGeometry& interface : mesh.interfaces()) {
        for (std::int64_t p = 0; p < interface.pair_count(); ++p) {
            for (int c = 0; c < dim; ++c) {
                std::vector<Entry> row;
                for (int k = 0; k < dim; ++k) {
                    const double direction = interface.frame[index((p * dim + c) * dim + k)];
                    if (direction == 0.0) continue;
                    append(row, interface.node_b[index(p)], k, direction);
                    append(row, interface.node_a[index(p)], k, -direction);
                }
                rows_.push_back(std::move(row));
            }
        }
    }
    jump_count_ = static_cast<std::int64_t>(rows_.size());

    for (const auto& copies : copies_) {
        for (int k = 0; k < dim && copies.size() > 1; ++k) {
            const auto at = [&](std::size_t i, double coefficient) {
                return Entry{copies[i].subdomain, copies[i].local * dim + k, coefficient};
            };
            if (gluing == "redundant") {
                for (std::size_t i = 0; i < copies.size(); ++i)
                    for (std::size_t j = i + 1; j < copies.size(); ++j) rows_.push_back({at(i, 1.0), at(j, -1.0)});
                continue;
            }
            // Helmert: row i compares copy i with the mean of the i copies before it, at unit length.
            for (std::size_t i = 1; i < copies.size(); ++i) {
                const double n = static_cast<double>(i), scale = 1.0 / std::sqrt(n * (n + 1.0));
                std::vector<Entry> row;
                for (std::size_t j = 0; j < i; ++j) row.push_back(at(j, scale));
                row.push_back(at(i, -n * scale));
                rows_.push_back(std::move(row));
            }
        }
    }
    glue_count_ = static_cast<std::int64_t>(rows_.size()) - jump_count_;

    for (const Constraint& constraint : problem.constraints) {
        std::vector<Entry> row;
        for (std::size_t i = 0; i < constraint.dof.size(); ++i)
            append(row, constraint.dof[i] / dim, static_cast<int>(constraint.dof[i] % dim), constraint.coefficient[i]);
        rows_.push_back(std::move(row));
    }
    constraint_count_ = static_cast<std::int64_t>(problem.constraints.size());
}

std::vector<std::vector<std::int64_t>> DualRowBuilder::touched(std::size_t subdomains) const {
    std::vector<std::vector<std::int64_t>> dofs(subdomains);
    for (const auto& row : rows_)
        for (const Entry& e : row) dofs[index(e.subdomain)].push_back(e.dof);
    for (auto& list : dofs) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return dofs;
}

std::vector<double> DualRowBuilder::scale(std::int32_t subdomain, std::int64_t dofs) const {
    std::vector<double> touching(index(dofs), 0.0);
    for (const auto& row : rows_)
        for (const Entry& e : row)
            if (e.subdomain == subdomain) touching[index(e.dof)] += e.coefficient * e.coefficient;
    for (double& t : touching) t = t > 0.0 ? 1.0 / std::sqrt(t) : 1.0;
    return touching;
}

DualRows DualRowBuilder::finish(std::span<const Subdomain> subdomains) const {
    DualRows result;
    result.jump_count = jump_count_;
    result.glue_count = glue_count_;
    result.constraint_count = constraint_count_;
    result.offset.assign(1, 0);
    for (const Subdomain& s : subdomains) {
        result.offset.push_back(result.offset.back() + static_cast<std::int64_t>(s.boundary.size()));
        if (s.body >= 0) result.body_dofs = result.offset.back();
    }
    std::vector<Triplet> triplets;
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        for (const Entry& e : rows_[r]) {
            const auto& boundary = subdomains[index(e.subdomain)].boundary;
            const auto at = std::lower_bound(boundary.begin(), boundary.end(), e.dof) - boundary.begin();
            triplets.push_back({static_cast<std::int64_t>(r), result.offset[index(e.subdomain)] + at, e.coefficient});
        }
    }
    result.b = from_triplets(result.count(), result.boundary_count(), std::move(triplets));
    return result;
}

}  // namespace delam
