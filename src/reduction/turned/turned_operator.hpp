// SPDX-License-Identifier: BSD-3-Clause
// Knows the mechanics of an analysis with small strains and large rotations: the true energy and forces of bodies and
// interfaces at displacements of the nodes, and the scene linearised about them.
//
// A response keeps the displacements of all nodes [mesh DOFs] as its own unknowns (Response::multipliers). It is not
// solved for here: evolution/step/turned/turned_steps.hpp minimises in linearised scenes.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "body/turned/turned_bodies.hpp"
#include "body/turned/turned_strains.hpp"
#include "reduction/operator/body_system.hpp"
#include "reduction/operator/jump_operator.hpp"
#include "reduction/turned/turned_jumps.hpp"
#include "scene/carriers.hpp"
#include "scene/problem.hpp"

namespace delam {

// Says where a scene is linearised: at which places of the nodes, under which stresses. These are those of
// displacements `from` with their change to first order, in the frames of displacements `along`: what a linear step
// about `along` has led to. The true ones of its result have the squares of the rotations besides, by which a stiffness
// of thin bodies leads far away (D. Magisano, L. Leonetti, G. Garcea, Comput. Methods Appl. Mech. Eng. 313 (2017)
// 986-1005). Without `from` the stresses are the true ones.
struct TurnedPoint {
    std::vector<double> displacement, from, along;  // [mesh DOFs]
    TurnedCell::Stresses stresses = TurnedCell::Stresses::count;
    std::vector<double> theta{};  // [patterns] the factors of the eigenstrains
    // [bodies] 1: nothing holds the body, so that stresses are left out of its stiffness and all rigid motions from its
    // place are free of energy. Empty: there are none. A state does not remember it, but tells it.
    std::vector<std::uint8_t> loose{};
    bool operator==(const TurnedPoint&) const = default;
    // Adds loose bodies, [bodies]. True if there are more then.
    bool loosen(const std::vector<std::uint8_t>& more);
};

// A state remembers this of its last linear scene.
struct TurnedMemory {
    TurnedPoint point;
    std::vector<double> of_operator;  // the memory that the operator of the scene has (JumpOperator::memory)
    // Returns it as the numbers of a state, and back. None say that it was linearised at its displacements.
    std::vector<double> numbers() const;
    static TurnedMemory of(std::span<const double> numbers, std::span<const double> displacement,
                           std::span<const double> theta);
};

struct LinearScene {
    Problem problem;
    std::shared_ptr<Mesh> mesh;
    std::vector<std::shared_ptr<HostStiffness>> stiffness;  // [bodies]
};

class TurnedOperator final : public JumpOperator {
public:
    // `problem` must outlive it.
    TurnedOperator(const Problem& problem, const Poll& poll);

    const Problem& problem() const { return problem_; }
    std::size_t dofs() const { return index(bodies_->dofs()); }
    // A scene that stays linear: frames of pairs turned, a stiffness given for each body, and a pattern more, whose
    // factor is always 1, with the forces and the parts of jumps that make up for it. Without numbers yet. With loose
    // bodies its nodes are where the point has them; it knows no other place then.
    LinearScene scene(const TurnedPoint& point) const;
    // Sets its stiffness and frames to those of a point. Where stresses are left out, it is semi-definite.
    void turn(LinearScene& scene, const TurnedPoint& point) const;
    // Sets its loads, so that at these displacements, which need not be those of turn(), and forces of the rows,
    // forces on nodes and jumps are the true ones, at any factors of the patterns. Couples are held as they are.
    void load(LinearScene& scene, std::span<const double> displacement, std::span<const double> row_force) const;
    // Returns the forces of its stiffness at displacements, [mesh DOFs].
    std::vector<double> forces(const LinearScene& scene, std::span<const double> displacement) const;
    // Sets its loads to these forces on the nodes alone, [mesh DOFs], in the additional pattern.
    void load_forces(LinearScene& scene, std::span<const double> force) const;
    // Returns by how much their stresses soften the bodies at displacements, each body over its nodes: the stiffness
    // without stresses less that with them. loose: as in a point.
    std::vector<SparseMatrix> softening(std::span<const double> theta, std::span<const double> displacement,
                                        std::span<const std::uint8_t> loose) const;
    // Returns the forces of such matrices at displacements, [mesh DOFs].
    std::vector<double> multiply_bodies(std::span<const SparseMatrix> of_bodies,
                                        std::span<const double> displacement) const;
    // Sets what belongs to the displacements: jumps, energies, unknowns, and the derivatives of the energy with respect
    // to factors of eigenstrains. The forces of rows, and the other derivatives, stay.
    void complete(std::span<const double> theta, std::vector<double> displacement, Response& response) const;
    // Adds to the derivatives of those, as the linear scene has them [patterns][patterns], the energy that eigenstrains
    // store without displacements.
    void add_strain_energy(std::span<double> tangent) const { strains_->add_energy(tangent); }
    // Returns the largest reaction, dead force or nodal force of eigenstrains, F.
    double load_size(std::span<const double> theta, const Response& response) const;
    // Returns the longest slide of pairs that pull, over the spacing of the pairs.
    double longest_slide(const Response& response) const;
    // Returns the force with which an interface pulls at its second side.
    Vector3 pull_of(std::size_t interface, const Response& response) const;
    // Returns the rounding of forces on the nodes at displacements, F.
    double rounding_of_forces(std::span<const double> displacement) const;
    // The largest unbalanced force, and the rounding of such forces, both over the load.
    struct Unbalanced {
        double off, rounding;
    };
    Unbalanced unbalanced(std::span<const double> theta, const Response& response) const;

    void solve(const Springs& springs, std::span<const double> theta, Response& response) override;
    std::vector<double> reaction(std::span<const double> theta, const Response& response) const override;
    std::vector<double> displacement(std::span<const double> theta, const Response& response) const override;
    // Returns the largest stiffness of a cell for every row.
    std::vector<double> row_stiffness() const override {
        return std::vector<double>(no_row_force_.size(), turned_->largest_stiffness());
    }
    double equilibrium_defect(std::span<const double> theta, const Response& response) const override;
    std::span<const std::uint8_t> prescribed_rows() const override { return prescribed_; }
    const TurnedBodies* turned(const Response& response) const override { return &at(response.multipliers); }
    void require_memory(std::span<const double> memory) const override;
    std::string description() const override;

private:
    TurnedBodies& at(std::span<const double> displacement) const;
    // Returns the forces of the cells in their frames, with those of eigenstrains.
    TurnedBodies::Pulls pulls(std::span<const double> theta, std::span<const double> displacement) const;
    // The same with the forces of cells and interfaces.
    double load_size(std::span<const double> theta, const Response& response, std::span<const double> force) const;
    // Returns the forces of cells and interfaces on the nodes.
    std::vector<double> internal_force(std::span<const double> theta, const Response& response) const;

    const Problem& problem_;
    std::unique_ptr<BodySystem> bodies_;
    Carriers carriers_;
    std::unique_ptr<TurnedJumps> jumps_;
    std::vector<std::uint8_t> prescribed_;
    std::vector<double> no_row_force_;
    std::unique_ptr<TurnedBodies> turned_;
    std::unique_ptr<const TurnedStrains> strains_;
    mutable std::vector<double> at_;  // the displacements of turned_
};

}  // namespace delam
