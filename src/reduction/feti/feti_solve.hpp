// SPDX-License-Identifier: BSD-3-Clause
// One solve of total FETI: springs -> the dual operator; loads -> right-hand side; projected CG -> forces; forces ->
// jumps, energies.
#pragma once

#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "base/team.hpp"
#include "reduction/feti/dual/dual_loads.hpp"
#include "reduction/feti/dual/dual_operator.hpp"
#include "reduction/operator/response.hpp"
#include "scene/problem.hpp"

namespace delam {

class FetiSolve {
public:
    // Sets the springs of the dual operator, which must keep them.
    FetiSolve(const Problem& problem, Monitor& monitor, DualOperator& dual, const DualLoads& loads,
              const Springs& springs, std::span<const double> theta);
    // Begins with the multipliers of the response, where it has any.
    void run(Response& response);

private:
    void solve_unit(Response& response);
    std::vector<double> right_side() const;
    std::vector<double> first_guess(std::span<const double> right, const Response& response) const;
    void find_forces(double resultant, std::span<const double> right, std::span<double> lambda, Response& response);
    void find_jumps(std::span<const double> right, std::span<const double> lambda, Response& response);
    SupportError find_support_error(std::span<const double> f_lambda, std::span<const double> rigid_jump) const;
    void share_prescribed(std::span<double> lambda, Response& response) const;
    void find_energies(std::span<const double> lambda, Response& response) const;

    const Problem& problem_;
    Monitor& monitor_;
    const DualOperator& dual_;
    const DualLoads& loads_;
    std::vector<double> theta_;
    Team team_;
    // In units in which the load has the size 1.
    Springs springs_;
    DualLoads::Sum load_;
};

}  // namespace delam
