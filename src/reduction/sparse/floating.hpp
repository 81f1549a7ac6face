// SPDX-License-Identifier: BSD-3-Clause
// Rigid motions of parts that only their interfaces hold. Nothing holds the free ones at the moment: they are null
// vectors of the system and must carry no load. Springs hold the weak ones so weakly that an iteration converges better
// if it knows them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reduction/dense/rigid_jumps.hpp"
#include "reduction/operator/body_system.hpp"
#include "reduction/sparse/jump_system.hpp"

namespace delam {

class Floating {
public:
    Floating(const BodySystem& bodies, const JumpSystem& system);

    // Finds both kinds at what acts on the system now.
    void update();
    // Number of updates that took more than a check of the springs that have become softer.
    std::int64_t examinations() const { return examinations_; }
    // Both kinds of motions in variables; they open no held row.
    const std::vector<std::vector<double>>& free() const { return free_; }
    const std::vector<std::vector<double>>& weak() const { return weak_; }
    // Springs that hold all these motions, for preconditioners.
    std::span<const Zone::Coupling> anchors() const { return anchors_; }
    // As many springs as there are free motions, which hold these: a load that balances leaves them without force.
    std::span<const Zone::Coupling> free_anchors() const { return free_anchors_; }
    // Rigid motions, of which all others are combinations, [motions] each; that of a free one; its u [mesh DOFs] and
    // variables.
    const DenseMatrix& jumps() const { return rigid_.jumps(); }
    std::int64_t motions() const { return rigid_.jumps().columns; }
    std::span<const double> free_combination(std::size_t i) const { return combination_[i]; }
    std::vector<double> rigid_displacement(std::span<const double> combination) const {
        return rigid_.displacement(combination);
    }
    std::vector<double> in_variables(std::span<const double> combination) const;
    // False: a free motion gets work of the dead forces, or of row_force: h, [rows] or empty.
    bool balances(std::span<const double> theta, std::span<const double> row_force) const;
    // Takes the free motions out of the jumps of x. How much of each it has added; empty: nothing.
    std::vector<double> settle(std::span<double> x) const;

private:
    std::vector<Zone::Coupling> anchors_of(const DenseMatrix& jumps) const;
    bool all_resisted();
    void examine();

    const BodySystem& bodies_;
    const JumpSystem& system_;
    RigidMotions rigid_;
    std::vector<std::int64_t> dof_of_;  // [variables that are displacements] one that is the variable itself
    bool known_ = false;                // the members below are set
    std::vector<std::uint8_t> held_, active_;
    std::vector<double> spring_;  // [rows] for which weak_ was found
    std::vector<std::vector<double>> free_, weak_;
    // The last state in which springs were found to resist all motions: its springs, and the least eigenvalue of
    // Z^T C Z there.
    std::vector<double> firm_;
    double resisted_ = 0.0;
    std::vector<double> reach_;  // [rows] squared length of the row of Z
    double enough_ = 0.0;        // such an eigenvalue, for which no motion is weakly held
    std::int64_t examinations_ = 0;
    std::vector<Zone::Coupling> anchors_, free_anchors_;
    std::vector<std::vector<double>> combination_;  // of the rigid motions, for each free one
};

}  // namespace delam
