// SPDX-License-Identifier: BSD-3-Clause
// The jump operator for large scenes: the bodies stay sparse, and each solve is an iteration that starts from the
// solution before (reanalysis.hpp). There is no dense matrix of the jumps, and the whole is factored only where it
// pays.
#pragma once

#include <memory>

#include "reduction/sparse/iterated/reanalysis.hpp"
#include "reduction/sparse/local_zone.hpp"
#include "reduction/sparse/sparse_operator.hpp"
#include "scene/problem.hpp"

namespace delam {

// Numbers from which its cost follows.
struct IteratedSize {
    double variables = 0.0;
    double stiffness = 0.0;    // entries of K
    double transformed = 0.0;  // of T^T K T
    FactorSize factor;         // of the whole
    double stored = 0.0;       // numbers that the factor stores
    double columns = 0.0;      // stored for constraints on many variables
    double factors = 1.0;      // kept at a time
    double softening = 1.0;    // interfaces that may be damaged
};

class Iterated final : public SparseOperator {
public:
    // `problem` must outlive the operator. Nothing is factored before the first solve.
    Iterated(const Problem& problem, Monitor& monitor);
    Iterated(const Problem& problem, AssembledBodies assembled, Monitor& monitor);
    std::string description() const override;
    Zone* part(std::span<const double> theta, const Response& response, std::span<const std::uint8_t> wanted) override;

    IteratedSize size() const;

private:
    const Reanalysis& reanalysis() const { return static_cast<const Reanalysis&>(solver()); }

    std::unique_ptr<LocalZone> part_;  // once they are asked for
};

}  // namespace delam
