// SPDX-License-Identifier: BSD-3-Clause
// The energy of the unknowns of a zone: of an elimination, equations resolved and kept displacements minimised out.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "reduction/condensed/reduced_energy.hpp"

namespace delam {

class ZoneEnergy {
public:
    // All three must outlive it, and the elimination must not be updated as long as it is used.
    ZoneEnergy(const TrailingEquations& equations, const Superelements& skeleton, const Elimination& elimination,
               const Poll& poll);
    const DenseEnergy& energy() const { return base_ ? base_->energy() : reduced_.energy(); }
    const std::vector<std::int64_t>& unknowns() const { return unknowns_; }  // of each row
    // Returns the unknowns of the elimination's energy().
    std::vector<double> recover(std::span<const double> theta, std::span<const double> zone) const;

private:
    ReducedEnergy reduced_;
    std::unique_ptr<Condensation> base_;  // null: there are no kept displacements
    std::vector<std::int64_t> unknowns_;
};

}  // namespace delam
