// SPDX-License-Identifier: BSD-3-Clause
// The rows of B: what the multipliers act on. Jumps of node pairs first, then the gluing of the copies of a node that
// several subdomains share, then the constraints (total FETI: supports are multipliers too).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reduction/feti/dual/subdomain.hpp"
#include "scene/problem.hpp"

namespace delam {

struct DualRows {
    std::int64_t jump_count = 0;
    std::int64_t glue_count = 0;
    std::int64_t constraint_count = 0;
    std::int64_t body_dofs = 0;  // boundary DOFs of bodies; those of the control nodes come after them
    std::vector<std::int64_t>
        offset;      // [subdomains+1] of each subdomain's boundary in the joint vector of boundary DOFs
    SparseMatrix b;  // [rows][boundary DOFs of all subdomains]

    std::int64_t count() const { return jump_count + glue_count + constraint_count; }
    std::int64_t boundary_count() const { return offset.back(); }
};

// A copy of a mesh node in a subdomain.
struct NodeCopy {
    std::int32_t subdomain;
    std::int64_t local;  // index within the subdomain's nodes
};

// Rows over local DOFs of subdomains, before the boundaries are numbered. One instance is built, then consumed.
class DualRowBuilder {
public:
    // gluing: "orthonormal" (m-1 rows for m copies of a DOF, a Helmert basis) or "redundant" (all m(m-1)/2
    // differences).
    DualRowBuilder(const Problem& problem, std::span<const Subdomain> subdomains, const std::string& gluing);
    // Local DOFs that rows touch, per subdomain, ascending.
    std::vector<std::vector<std::int64_t>> touched(std::size_t subdomains) const;
    // 1 / sqrt(rows that touch it) of each local DOF of a subdomain: what gives its motions the size of those of
    // bodies.
    std::vector<double> scale(std::int32_t subdomain, std::int64_t dofs) const;
    // Final rows, once every subdomain knows its boundary (a superset of what is touched).
    DualRows finish(std::span<const Subdomain> subdomains) const;
    // Copies of each mesh node.
    const std::vector<std::vector<NodeCopy>>& copies() const { return copies_; }

private:
    struct Entry {
        std::int32_t subdomain;
        std::int64_t dof;
        double coefficient;
    };
    std::vector<std::vector<NodeCopy>> copies_;
    std::vector<std::vector<Entry>> rows_;
    std::int64_t jump_count_ = 0, glue_count_ = 0, constraint_count_ = 0;
};

}  // namespace delam
