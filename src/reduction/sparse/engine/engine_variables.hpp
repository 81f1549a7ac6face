// SPDX-License-Identifier: BSD-3-Clause
// The variables of jump_variables.hpp in the form that an engine of the host gets (delam_experimental_variables).
#pragma once

#include <cstdint>
#include <vector>

#include "delam/experimental.h"
#include "reduction/operator/body_system.hpp"

namespace delam {

class EngineVariables {
public:
    // Error(DELAM_ERROR_PROBLEM) if a jump has no home.
    explicit EngineVariables(const BodySystem& bodies);
    // Points into this object.
    delam_experimental_variables view() const;

private:
    // The variable of each DOF that is one; -1: none.
    void find_own(const JumpVariables& variables);
    void replace(const JumpVariables& variables);
    void find_homes(const JumpVariables& variables, std::int64_t dimension);
    void take_loads(const BodySystem& bodies);
    std::int64_t number_of(const JumpVariables& variables, std::int64_t variable) const;

    std::int64_t dimension_ = 0, dofs_ = 0, patterns_ = 0;
    std::vector<std::int64_t> dof_of_;  // [variables that are displacements]
    std::vector<std::int64_t> own_;     // [DOFs] variable that is this displacement, -1: replaced
    std::vector<std::int64_t> homes_, replaced_, row_starts_{0}, columns_;
    std::vector<double> coefficients_;
    std::vector<std::int64_t> lift_starts_{0}, lift_dofs_, force_starts_{0}, force_dofs_, visible_;
    std::vector<double> lift_values_, force_values_;
};

}  // namespace delam
