// SPDX-License-Identifier: BSD-3-Clause
// All bodies condensed onto the skeleton of a tree of superelements, once.
//
// In the variables of jump_variables.hpp the stiffness is T^T K T. Every zone is what is left when all else of the
// skeleton has been minimised out (elimination.hpp); constraints that bind several variables are resolved there. All
// jumps together have an energy
//
//     E(theta, x) = 1/2 x^T S x - theta^T L^T x + 1/2 theta^T A theta,      jump rows  j = N x + O theta
//
// (N: the identity except for rows that close a ring of bodies or that a constraint binds; O: jumps that constraints
// prescribe), whose S is made only if a host asks for it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "base/numbers.hpp"
#include "reduction/condensed/elimination.hpp"
#include "reduction/condensed/superelements.hpp"
#include "reduction/condensed/trailing_equations.hpp"
#include "reduction/condensed/zone_energy.hpp"
#include "reduction/dense/dense_energy.hpp"
#include "reduction/dense/rigid_jumps.hpp"
#include "reduction/operator/body_system.hpp"
#include "reduction/operator/jump_row.hpp"
#include "reduction/operator/linear_reading.hpp"
#include "scene/problem.hpp"

namespace delam {

class Bulk {
public:
    // Assembles and analyses; condense() computes the numbers. `problem` must outlive it.
    Bulk(const Problem& problem, Monitor& monitor);
    // Keeps the problem, so that operators of other problems with the same bodies may share it.
    Bulk(std::shared_ptr<const Problem> problem, Monitor& monitor);
    void condense(Monitor& monitor);
    // Condenses what has changed in the problem (Problem::renewed). False: the matrix has other entries than the one
    // that was analysed, and nothing is left that could be used.
    bool renew(Renewed what, Monitor& monitor);
    // Gives the assembled bodies to another realisation of the operator, before condense().
    AssembledBodies release() &&;

    const std::vector<JumpRow>& rows() const { return equations_.jump_rows(); }
    std::int64_t unknowns() const { return equations_.unknowns(); }
    // The first jump row that equals unknown i. Others may equal it too (on opposite faces of a periodic cell).
    const std::vector<std::int64_t>& row_of_unknown() const { return equations_.row_of_unknown(); }
    // Returns the constraints that bind several variables; before condense() there are none.
    const TrailingEquations& equations() const { return equations_; }
    const DenseMatrix& load() const { return load_; }  // L, [unknowns][patterns]
    // An upper bound of the diagonal of S, of its size: with everything else at rest.
    double diagonal(std::int64_t unknown) const { return superelements_->diagonal()[index(equations_.place(unknown))]; }
    // The same with every displacement at rest, within the bodies too.
    double assembled_diagonal(std::int64_t unknown) const {
        return superelements_->assembled_diagonal()[index(equations_.place(unknown))];
    }
    const DenseMatrix& pattern_stiffness() const { return pattern_stiffness_; }
    // Jumps of the rigid motions that the supports leave free, [unknowns][motions], orthonormal.
    const DenseMatrix& rigid() const { return rigid_; }
    // The work of dead forces along the same motions.
    const DeadWork& dead_work() const { return dead_work_; }

    // An elimination of this skeleton.
    Elimination elimination() const { return {*superelements_, trailing_load_}; }
    // Returns the energy of its zone, which must not be used after the next update of the elimination.
    ZoneEnergy zone_energy(const Elimination& elimination, const Poll& poll) const {
        return {equations_, *superelements_, elimination, poll};
    }

    // All unknowns at zero, kept displacements at their minimum.
    std::vector<double> skeleton_at_rest(std::span<const double> theta) const;
    // L theta - S x of the wanted unknowns at a point of the skeleton; 0 for the others.
    std::vector<double> residual(std::span<const double> theta, std::span<const double> skeleton,
                                 std::span<const std::uint8_t> wanted) const;
    // Returns the displacements from the unknowns alone.
    std::vector<double> displacement(std::span<const double> theta, std::span<const double> unknowns) const;
    // Returns how the sum of displacements with these weights, [mesh DOFs], follows from unknowns and loads: of_row has
    // the unknowns.
    LinearReading reading(std::span<const double> weights) const;
    // Returns the bodies as they are without condensation.
    const BodySystem& system() const { return *system_; }
    // S and L of all unknowns: m^2 numbers.
    DenseEnergy dense(const Poll& poll) const;

    // Energy error, F L, that the factor's rounding leaves in the displacements of the loads themselves, with the
    // unknowns at rest.
    double rounding_energy(std::span<const double> theta) const;

    const Superelements& superelements() const { return *superelements_; }
    // T^T K T, until it is condensed.
    const SparseMatrix& transformed() const { return transformed_; }
    std::int64_t factorisations() const { return factorisations_; }

private:
    Bulk(AssembledBodies bodies, Monitor& monitor);
    void factorise(const Poll& poll);
    void take_loads(std::size_t first, const Poll& poll);  // of the patterns from the first on
    void rest(const Poll& poll);
    std::vector<double> solve_bonded(std::span<const double> forces) const;
    // T S T^T of nodal forces, where S is what solve_bonded() does.
    std::vector<double> moved_bonded(std::span<const double> nodal) const;
    std::vector<double> displacement_from_lift(std::span<const double> theta, std::span<const double> unknowns) const;
    // Returns the variables that the unknowns determine, with all loads at zero.
    std::vector<double> moved_by_jumps(std::span<const double> unknowns) const;
    std::vector<double> carried(std::span<const double> theta, std::span<const double> displacement) const;
    void condense_loads(std::size_t first, const Poll& poll);
    void find_pattern_stiffness(std::size_t first, const StrainLoads& strained, const Poll& poll);
    void balance_strains();
    const JumpVariables& variables() const { return system_->variables(); }
    const SparseMatrix& stiffness() const { return system_->stiffness(); }

    std::unique_ptr<BodySystem> system_;
    const Problem& problem_;
    SparseMatrix transformed_;
    SparseMatrix analysed_;  // of a problem that is renewed: the pattern
    std::unique_ptr<Superelements> superelements_;
    TrailingEquations equations_;
    std::unique_ptr<Elimination> bonded_;  // all jumps at rest, those in equations left
    // The same with the loads, where equations leave more than jumps; null: they do not.
    std::unique_ptr<Elimination> resting_;
    std::unique_ptr<ZoneEnergy> resting_energy_;
    DenseMatrix kept_factor_;  // of the kept displacements that no equation determines, all jumps at rest
    std::int64_t factorisations_ = 0;
    DenseMatrix trailing_load_;  // [skeleton][patterns], with all trailing variables at rest
    DenseMatrix load_;
    // [patterns][mesh DOFs] displacements at factor 1 with all jumps at rest; and their forces, as long as needed.
    std::vector<std::vector<double>> closed_, stressed_;
    DenseMatrix pattern_stiffness_;
    std::vector<double> left_over_;  // [patterns] work of the forces that solve_bonded() left, with random signs
    DenseMatrix rigid_;
    DeadWork dead_work_;
};

}  // namespace delam
