// SPDX-License-Identifier: BSD-3-Clause
// The jump operator of a scene whose bodies an engine of the host solves.
#pragma once

#include "reduction/sparse/sparse_operator.hpp"

namespace delam {

class EngineOperator final : public SparseOperator {
public:
    // The problem has an engine and must outlive the operator.
    EngineOperator(const Problem& problem, Monitor& monitor);
    bool recover_in_engine(std::span<const double> theta, const Response& response) const override;
    std::string description() const override;
};

}  // namespace delam
