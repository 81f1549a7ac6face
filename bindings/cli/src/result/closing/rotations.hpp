// SPDX-License-Identifier: BSD-3-Clause
// Tells what an analysis with small rotations leaves out.
#pragma once

#include <limits>
#include <string>

#include "model/library/model.hpp"
#include "result/fields/bulk_facts.hpp"

namespace cli {

struct SmallRotations {
    bool assumed = true;   // rotations are small at the end
    bool refused = false;  // kinematics = auto, and large rotations do not know the scene
    double rotation = 0;   // value rotation_max at the end, rad
    // These hold at the end. NaN: they are not known.
    double error = std::numeric_limits<double>::quiet_NaN();     // value rotation_error
    double buckling = std::numeric_limits<double>::quiet_NaN();  // value buckling_ratio
};

// of_end: asks for the values of the state that the solver shows, too. Scenes of a
// person who asks for kinematics = "linear" are not asked whether their bodies buckle.
SmallRotations small_rotations_of(const Model& model, delam_solver* solver, const Scene& scene, bool of_end);
// "" where rotations hardly matter.
std::string rotation_line(const SmallRotations& small, const BulkFacts& bulk);
// "" where no stresses come near to critical ones.
std::string critical_line(const SmallRotations& small);

}  // namespace cli
