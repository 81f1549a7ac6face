// SPDX-License-Identifier: BSD-3-Clause
// The bodies of a scene as one sparse system in the variables of jump_variables.hpp, u = T v + U theta, with the
// forces that follow from displacements.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "linalg/sparse/sparse.hpp"
#include "reduction/operator/jump_variables.hpp"
#include "reduction/operator/renewed.hpp"
#include "scene/problem.hpp"
#include "scene/strain_loads.hpp"

namespace delam {

class BodySystem {
public:
    // `problem` must outlive the system. elsewhere: K is not assembled here, and stiffness(), transformed() and
    // stressed() may not be called.
    enum class Stiffness { here, elsewhere };
    BodySystem(const Problem& problem, const Poll& poll, Stiffness stiffness = Stiffness::here);
    // Keeps the problem as long as the system lives.
    BodySystem(std::shared_ptr<const Problem> problem, const Poll& poll);

    const Problem& problem() const { return problem_; }
    const JumpVariables& variables() const { return variables_; }
    const SparseMatrix& stiffness() const { return stiffness_; }  // K, all mesh DOFs
    std::int64_t dofs() const { return variables_.transform.rows; }
    // Takes what has changed in the problem (Problem::renewed). loads: not the stiffness and the frames.
    void renew(Renewed what, const Poll& poll);
    // T^T K T; the diagonal entries of all trailing variables exist.
    SparseMatrix transformed(const Poll& poll) const;
    // Computes the forces of all patterns. The forces in the result have been taken out of it.
    StrainLoads find_loads();
    // Computes the dead forces alone.
    void find_dead_forces();
    // [patterns][mesh DOFs], empty: none; dead forces, and those of eigenstrains
    const std::vector<std::vector<double>>& force() const { return force_; }

    // U theta
    std::vector<double> lift(std::span<const double> theta) const;
    // displacement += T v
    void add_variables(std::span<const double> variables, std::span<double> displacement) const;
    // Returns the jumps of displacements, [rows].
    std::vector<double> jump(std::span<const double> displacement) const;
    // K u
    std::vector<double> stressed(std::span<const double> displacement) const;
    // The forces that no element balances: K u - f + B^T force. stressed: K u; force: of the jump rows.
    std::vector<double> residual(std::span<const double> theta, std::span<const double> stressed,
                                 std::span<const double> force) const;

private:
    std::shared_ptr<const Problem> kept_;  // null: the problem outlives the system
    const Problem& problem_;
    SparseMatrix stiffness_;
    SparseMatrix jump_rows_;  // B, [rows][mesh DOFs]
    JumpVariables variables_;
    std::vector<std::vector<double>> force_;
};

// The bodies and T^T K T, which the realisations that keep the bodies whole begin with.
struct AssembledBodies {
    std::unique_ptr<BodySystem> system;
    SparseMatrix transformed;
};
AssembledBodies assemble_bodies(const Problem& problem, Monitor& monitor);
AssembledBodies assemble_bodies(std::shared_ptr<const Problem> problem, Monitor& monitor);

}  // namespace delam
