// SPDX-License-Identifier: BSD-3-Clause
// Knows the mechanics of an analysis with small strains and large rotations: the true energy and forces of bodies and
// interfaces at displacements of the nodes, and the scene linearised about them.
//
// A response keeps the displacements of all nodes [mesh DOFs] as its own unknowns (Response::multipliers). It is not
// solved for here: evolution/step/turned_steps.hpp minimises in linearised scenes.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "body/turned/turned_bodies.hpp"
#include "reduction/operator/body_system.hpp"
#include "reduction/operator/jump_operator.hpp"
#include "reduction/turned/turned_jumps.hpp"
#include "scene/carriers.hpp"
#include "scene/problem.hpp"

namespace delam {

class TurnedOperator final : public JumpOperator {
public:
    // `problem` must outlive it.
    TurnedOperator(const Problem& problem, const Poll& poll);

    std::size_t dofs() const { return index(bodies_->dofs()); }
    // The scene about these displacements, which stays linear: frames of pairs turned, a stiffness given for each body,
    // and a pattern more, whose factor is always 1, with the forces K u - f(u) that make up for it. row_force: of the
    // pairs, whose couples are held as they are. Where stresses are left out of the stiffness, it is semi-definite.
    Problem linearised(std::span<const double> displacement, std::span<const double> row_force,
                       TurnedCell::Stresses stresses) const;
    // Sets what belongs to the displacements: jumps, energies, unknowns. The forces of rows stay.
    void complete(std::span<const double> theta, std::vector<double> displacement, Response& response) const;
    // The largest unbalanced force, and the rounding of such forces, both over the load: the largest reaction or dead
    // force.
    struct Unbalanced {
        double off, rounding;
    };
    Unbalanced unbalanced(std::span<const double> theta, const Response& response) const;

    void solve(const Springs& springs, std::span<const double> theta, Response& response) override;
    std::vector<double> reaction(std::span<const double> theta, const Response& response) const override;
    std::vector<double> displacement(std::span<const double> theta, const Response& response) const override;
    std::vector<double> row_stiffness() const override { return {}; }
    double equilibrium_defect(std::span<const double> theta, const Response& response) const override;
    std::span<const std::uint8_t> prescribed_rows() const override { return prescribed_; }
    const TurnedBodies* turned(const Response& response) const override { return &at(response.multipliers); }
    std::string description() const override;

private:
    TurnedBodies& at(std::span<const double> displacement) const;
    // Forces of cells and interfaces on the nodes.
    std::vector<double> internal_force(const Response& response) const;

    const Problem& problem_;
    std::unique_ptr<BodySystem> bodies_;
    Carriers carriers_;
    TurnedJumps jumps_;
    std::vector<std::uint8_t> prescribed_;
    std::vector<double> no_row_force_;
    std::unique_ptr<TurnedBodies> turned_;
    mutable std::vector<double> at_;  // the displacements of turned_
};

}  // namespace delam
