// SPDX-License-Identifier: BSD-3-Clause
// Change of the reactions with the load factors at a state, with its contact set held.
//
// With the adhesion fixed, everything is linear: conjugates of unit factors are the columns of d2E/dtheta2. In a step
// the adhesion follows. With J the jumps of unit factors at the state's springs s = w k zeta, each pair that damages
// adds a force v_a dzeta_a, v_a = w k j, to which the bodies respond by jumps -U_a, and
//
//   g''_a dzeta_a + (kappa A / w dzeta)_a = -(dY_a - D_B dB_a) =: -omega_a . dj,     dj = J dtheta - U dzeta
//
// (from Y = D(B, zeta) = -dg/dzeta where a pair damages; dB = 0 but with mixity_rule = converged). That is a small
// dense system. Under the variational rule the force of a pair is that of VariationalPair with the damage minimised
// out; what it differs from the springs takes the place of v omega^T.
#pragma once

#include <span>
#include <vector>

#include "evolution/contact/contact.hpp"
#include "evolution/increment/increment.hpp"
#include "linalg/dense/dense.hpp"
#include "reduction/operator/jump_operator.hpp"
#include "scene/problem.hpp"

namespace delam {

class Linearised {
public:
    Linearised(JumpOperator& op, const PairLaws& pairs, const ContactScene& contact, const State& state);
    // Solves with the state's own memory, so that the last digits depend on the state alone; every other call that
    // solves recalls the memory of its state too.

    // Returns the tangent at the adhesion of the state, under the rule of `increment`, [patterns][patterns].
    // Error(DELAM_ERROR_STATE): a pattern acts along a motion that nothing holds.
    std::vector<double> tangent(std::span<const Pattern> patterns, const Increment& increment);
    // Returns the tangent of the step of `increment`.
    std::vector<double> step_tangent(std::span<const Pattern> patterns, const Increment& increment);

    // The response of the pairs that damage in a step: own + omega U (coupled: - kappa A / w), and the answers U to v.
    struct Damaging {
        std::vector<PairDirection> directions;
        std::vector<Response> answers;
        DenseMatrix system;
    };
    Damaging damaging(std::size_t patterns, std::vector<PairDirection> directions, bool coupled);
    // Returns kappa A z / w of the gradient term at a pair, z [pairs].
    double coupling(std::size_t pair, std::span<const double> z) const;
    // Returns the response to these load factors. Error(DELAM_ERROR_STATE): they act along a motion that nothing holds.
    Response loaded(std::span<const double> theta);
    // Returns the response to forces on the rows, without loads.
    Response answer(std::size_t patterns, const std::vector<double>& force);
    double along(const PairDirection& direction, std::span<const double> jump) const;
    const State& state() const { return state_; }
    const PairLaws& pairs() const { return pairs_; }

private:
    Response unit(std::span<const double> theta, const std::vector<double>& force);
    // Returns the tangent of bodies and springs alone.
    std::vector<double> elastic(std::span<const Pattern> patterns);
    // Returns the elastic tangent less what the pairs along these directions give way. coupled: the gradient term
    // couples them.
    std::vector<double> yielding(std::span<const Pattern> patterns, std::vector<PairDirection> directions,
                                 bool coupled);

    JumpOperator& op_;
    const PairLaws& pairs_;
    const State& state_;
    std::size_t dim_;
    Springs springs_;
    std::vector<Response> columns_;  // of unit factors
};

}  // namespace delam
