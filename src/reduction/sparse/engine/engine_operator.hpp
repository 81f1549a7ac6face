// SPDX-License-Identifier: BSD-3-Clause
// The jump operator of a scene whose bodies an engine of the host solves.
#pragma once

#include "reduction/sparse/sparse_operator.hpp"

namespace delam {

class EngineOperator final : public SparseOperator {
public:
    // The problem has an engine and must outlive the operator.
    EngineOperator(const Problem& problem, Monitor& monitor);
    // Has the engine recover the displacements of a response and keep them.
    void recover_in_engine(std::span<const double> theta, const Response& response) const;
    std::string description() const override;
};

}  // namespace delam
