// SPDX-License-Identifier: BSD-3-Clause
// The cards of constraints between displacements: *COUPLING with *KINEMATIC or *DISTRIBUTING, *RIGID BODY of nodes,
// *EQUATION, *MPC.
#pragma once

#include "deck/abaqus/inp_cards.hpp"
#include "deck/cards/deck.hpp"

namespace cli::abaqus {

class ConstraintReader {
public:
    // root: the scope of the sets and nodes that they name.
    ConstraintReader(Deck& deck, const Part& root) : deck_(deck), root_(root) {}

    // False: the card does not belong to a constraint.
    bool take(const InpCard& card);
    // Throws SceneFailure where a *COUPLING was not followed by its kind.
    void finish() const;

private:
    void take_coupling(const InpCard& card);
    void take_kinematic(const InpCard& card);
    void take_distributing(const InpCard& card);
    void take_rigid_body(const InpCard& card);
    void take_equation(const InpCard& card);
    void take_pins(const InpCard& card);
    void take_transform(const InpCard& card);

    Deck& deck_;
    const Part& root_;
    std::optional<Coupling> open_;  // a *COUPLING whose kind has not come yet
};

}  // namespace cli::abaqus
