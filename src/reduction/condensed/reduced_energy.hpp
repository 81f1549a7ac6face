// SPDX-License-Identifier: BSD-3-Clause
// The energy of an elimination in the variables that no equation determines. The equations t_pivot = M r + d theta
// reduce the energy in all trailing variables to
//
//     S_rr + S_rp M + M^T S_pr + M^T S_pp M   and   L_r + M^T L_p - (S_rp + M^T S_pp) d.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reduction/condensed/elimination.hpp"
#include "reduction/condensed/superelements.hpp"
#include "reduction/condensed/trailing_equations.hpp"
#include "reduction/dense/dense_energy.hpp"

namespace delam {

class ReducedEnergy {
public:
    // `equations` and `elimination` must outlive it, and the elimination must not be updated as long as it is used.
    ReducedEnergy(const TrailingEquations& equations, const Superelements& skeleton, const Elimination& elimination);

    // Has the rows [kept displacements | unknown jumps]. Without pivots it is that of the elimination itself.
    const DenseEnergy& energy() const { return pivot_.empty() ? elimination_->energy() : energy_; }
    // Returns the position of each row among the variables that no equation determines.
    const std::vector<std::int64_t>& rest_number() const { return rest_number_; }
    // Gives back the memory of energy(), which is then of no use.
    void forget() { energy_ = DenseEnergy(); }
    // Returns the unknowns of the elimination's energy() from those of this one.
    std::vector<double> recover(std::span<const double> theta, std::span<const double> rest) const;

private:
    void reduce();

    const TrailingEquations* equations_;
    const Elimination* elimination_;
    DenseEnergy energy_;                      // empty without pivots
    std::vector<std::int64_t> rest_, pivot_;  // rows of the elimination's energy: those of this one, and the others
    std::vector<std::int64_t> rest_number_;
    std::vector<std::int64_t> pivot_number_;  // of each pivot among the equations
    DenseMatrix binding_;                     // [pivots][rest]
};

}  // namespace delam
