// SPDX-License-Identifier: BSD-3-Clause
// The scaled operator B_D of the FETI preconditioners, S~ = B_D S B_D^T, with
//   B_D = (B W^-1 B^T)^+ B W^-1,   W diagonal: the stiffness's diagonal, or 1 (multiplicity scaling),
// so that B_D^T B is the W-orthogonal projector off the continuous fields, whatever basis the rows use (D. Rixen, C.
// Farhat, IJNME 44, 1999, for signed rows). B W^-1 B^T falls apart into small clusters of rows that share boundary
// DOFs. Control nodes have no stiffness and stay out of it: what they must do, the coarse problem states.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reduction/feti/dual/dual_rows.hpp"

namespace delam {

struct Scaling {
    SparseMatrix b_d;  // [rows][boundary DOFs], as B

    // Directions z with B^T z = 0 (rows that depend on each other: a triple junction, redundant gluing): the bodies
    // give them no flexibility, only springs do. Those with an entry in a jump row are kept.
    struct Dependency {
        std::vector<std::int64_t> row;
        std::vector<double> z;
        double stiffness;  // scale of the bodies' stiffness there
    };
    std::vector<Dependency> dependencies;
    // Jump rows that are combinations of gluing and constraint rows alone, B_i = sum_k y_k B_k: constraints prescribe
    // their jump.
    struct Prescribed {
        std::int64_t jump_row;
        std::vector<std::int64_t> row;
        std::vector<double> y;
    };
    std::vector<Prescribed> prescribed_jumps;
    std::vector<std::uint8_t> prescribed;  // [jump rows] 1 for those
};

Scaling make_scaling(const DualRows& rows, const std::vector<Subdomain>& subdomains, const std::string& kind);

}  // namespace delam
