// SPDX-License-Identifier: BSD-3-Clause
// All bodies with springs on their interfaces, factorised: what small loads beside the present ones would do at the
// present adhesion and contact.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "linalg/sparse/cholesky.hpp"
#include "reduction/operator/body_system.hpp"
#include "reduction/operator/response.hpp"
#include "scene/problem.hpp"

namespace delam {

class HeldBodies {
public:
    // Returns null where nobody here knows all bodies, or something is free to move, or the factor takes more memory
    // than allowed. One factorisation of all bodies. system: they; null: they are assembled here. Both must outlive it.
    static std::unique_ptr<HeldBodies> of(const Problem& problem, const BodySystem* system, Springs springs,
                                          const Poll& poll);
    // Returns the same bodies with other springs; null as above.
    std::unique_ptr<HeldBodies> with(Springs springs, const Poll& poll) const;

    const Springs& springs() const { return springs_; }
    std::int64_t dofs() const { return bodies_->system.dofs(); }
    // Returns the displacements under forces, both [mesh DOFs]; what supports prescribe is zero.
    std::vector<double> solve(std::span<const double> force) const;
    // Returns the jumps of displacements, [rows].
    std::vector<double> jump(std::span<const double> displacement) const { return bodies_->system.jump(displacement); }

private:
    struct Bodies {
        std::unique_ptr<const BodySystem> own;  // null: others have them
        const BodySystem& system;
        SparseMatrix transformed;
        double most_bytes;  // of a factor
    };
    HeldBodies(std::shared_ptr<const Bodies> bodies, Springs springs, const Poll& poll);
    static std::unique_ptr<HeldBodies> factorised(std::shared_ptr<const Bodies> bodies, Springs springs,
                                                  const Poll& poll);
    SparseMatrix with_springs() const;

    std::shared_ptr<const Bodies> bodies_;
    Springs springs_;
    SparseMatrix matrix_;
    SparseCholesky factor_;
};

}  // namespace delam
