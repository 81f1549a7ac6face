// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "petsc/base/failure.hpp"

namespace delam::petsc {

// Places of DOFs in this rank's vectors: dimension*i + component for the i-th of its nodes.
class Places {
public:
    Places(std::int64_t dimension, std::vector<std::int64_t>& nodes) : dimension_(dimension), nodes_(nodes) {
        for (const std::int64_t node : nodes) place_.emplace(node, static_cast<std::int64_t>(place_.size()));
    }
    bool has(std::int64_t dof) const { return place_.contains(dof / dimension_); }
    // The node of a DOF that is not here yet is added.
    PetscInt of(std::int64_t dof) {
        const auto [found, is_new] = place_.try_emplace(dof / dimension_, static_cast<std::int64_t>(place_.size()));
        if (is_new) nodes_.push_back(found->first);
        return petsc_int(found->second * dimension_ + dof % dimension_);
    }

private:
    std::int64_t dimension_;
    std::vector<std::int64_t>& nodes_;
    std::unordered_map<std::int64_t, std::int64_t> place_;
};

}  // namespace delam::petsc
