// SPDX-License-Identifier: BSD-3-Clause
// Solves bodies and interfaces by iteration for the sparse operator (sparse_operator.hpp). It is the library's own
// (reanalysis.hpp) or an engine of the host (engine/engine_solver.hpp).
//
// A solution is a *state*, numbers of which the first system().count() are the variables of system(). Combinations of
// states whose weights sum to 1 are states, too.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/restarts.hpp"
#include "reduction/operator/zone.hpp"
#include "reduction/sparse/floating.hpp"
#include "reduction/sparse/jump_system.hpp"

namespace delam {

class BodySolver {
public:
    // Residuals below this part of the state are not asked for: it is what a decision about contact can still use.
    static constexpr double finest = finest_tolerance;

    virtual ~BodySolver() = default;

    virtual const JumpSystem& system() const = 0;
    // Numbers of a state.
    virtual std::int64_t state_size() const = 0;

    // Tells whether the energies of the next states are to be compared: the error that a residual hides must then be
    // small, too.
    virtual void compare_energies(bool /*yes*/) {}
    // Sets the couplings and held rows from now on. False: the system is not positive definite, and nothing can be
    // solved.
    virtual bool set(std::vector<Zone::Coupling> couplings, std::span<const std::uint8_t> held) = 0;
    // Returns the norm of a residual that may remain, given the norm at the start: as much, or what the tolerance
    // allows.
    using Forcing = std::function<double(double first)>;
    struct Answer {
        std::int64_t iterations = 0;
        double residual = 0.0;           // relative, in the energy norm
        double first = 0.0, norm = 0.0;  // of the residual, at the start and at the end
        SolveError error;           // of jumps and forces: ten times what a further step of the iteration would change
        double energy_error = 0.0;  // 1/2 r^T A^-1 r, F L, as far as the iteration knows A
        bool converged = true;
        bool balanced = true;  // false: a free motion carries a load; x is then not set
        bool definite = true;  // false: negative curvature was met; x is then of no use
    };
    // x: in: the state from which to start, empty: none; out: the solution. row_force: h, [rows] or empty. tolerance:
    // of the residual, relative to the size of the state, at best `finest`.
    virtual Answer solve(std::span<const double> theta, std::span<const double> row_force, double tolerance,
                         std::vector<double>& x, const Forcing& forcing = {}) = 0;
    // Adds the forces of held rows to those of the others. Returns the multipliers of constraints on many variables.
    virtual std::vector<double> held_forces(std::span<const double> theta, std::span<const double> x,
                                            std::span<double> force) const = 0;

    // Returns about the largest force of the load T^T (f - K U theta); 0: no load.
    virtual double load_size(std::span<const double> theta) const = 0;
    // Work of a state. strain: 1/2 u^T K u; done: f_p^T u; lifted: U_p^T (K u - f), the forces at what pattern p moves.
    struct Work {
        double strain = 0.0;
        std::vector<double> done, lifted;  // [patterns]
    };
    virtual Work work(std::span<const double> theta, std::span<const double> x) = 0;
    // Relative rounding of 1/2 u^T K u - f^T u.
    virtual double energy_rounding(std::span<const double> theta, std::span<const double> x) = 0;
    // u and K u of a state, over all DOFs of the mesh.
    virtual void recover(std::span<const double> theta, std::span<const double> x, std::vector<double>& displacement,
                         std::vector<double>& stressed) = 0;

    // Adds rigid motions to a state. displacement: theirs [mesh DOFs]; combination: of RigidMotions::jumps().
    virtual void move(std::span<const double> displacement, std::span<const double> combination,
                      std::span<double> x) const = 0;
    virtual const Floating& floating() const = 0;

    virtual std::int64_t factorisations() const = 0;
    // Saved data on which the last digits of the next solution depend.
    virtual std::vector<double> memory() = 0;
    virtual void recall(std::span<const double> memory) = 0;
    // Throws Error(DELAM_ERROR_SNAPSHOT).
    virtual void require_memory(std::span<const double> memory) const = 0;
};

}  // namespace delam
