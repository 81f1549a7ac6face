// SPDX-License-Identifier: BSD-3-Clause
// Checks whether a state is in equilibrium. Rounding can destroy all digits of a stiffness that is a small difference
// of large ones (plies thousands of times longer than thick). Minimisation and its tolerances would not notice.
#pragma once

#include "evolution/contact/contact.hpp"
#include "evolution/increment/damage_step.hpp"
#include "evolution/increment/state.hpp"
#include "reduction/operator/jump_operator.hpp"
#include "scene/problem.hpp"

namespace delam {

// Relative to the largest reaction, or to ContactScene::force_floor if that is larger:
inline constexpr double poor_balance = 1e-6;  // worth a warning
inline constexpr double no_balance = 1e-3;    // the state is useless

// Reads the balance of forces of a state.
class Balance {
public:
    // All must outlive this object.
    Balance(const Problem& problem, const JumpOperator& op, const ContactScene& contact, const PairLaws& pairs,
            const State& state)
        : problem_(problem), op_(op), contact_(contact), pairs_(pairs), state_(state) {}

    // Largest reaction, F, or the floor of forces where that is larger (stresses of eigenstrains may need no
    // reactions).
    double reaction() const;
    // Largest unbalanced force, F; 0 where the displacements [mesh DOFs] are rigid motions of all pieces or the
    // rounding of gaps, or where contact alone holds some parts and it is no more than the rounding of their motions.
    double left(std::span<const double> displacement) const;
    // Largest unbalanced force over the largest reaction; 0 if the operator's estimate gives no reason to compute it,
    // which takes no time.
    double off() const;

private:
    const Problem& problem_;
    const JumpOperator& op_;
    const ContactScene& contact_;
    const PairLaws& pairs_;
    const State& state_;
};

}  // namespace delam
