// SPDX-License-Identifier: BSD-3-Clause
// Interfaces whose frames turn: jumps of pairs, and the forces on the nodes that belong to tractions.
//
// A pair turns by R of sum_c m_c R_c = R U (polar decomposition) over the frames R_c of the cells that touch its nodes,
// half of the weight on either side, so that a reflection or an exchange of the sides changes nothing. Its rows are q_r
// = R q_r0, its jump is j_r = q_r . (u_b - u_a) + gap. As j depends on the frames of the cells, tractions t pull at the
// nodes by t_r q_r and turn the cells by couples, without which the forces would have no energy (J. Mosler, I.
// Scheider, J. Mech. Phys. Solids 59 (2011) 1647-1668):
//
//     M_c = m_c R (tr S I - S)^T J^-1 R^T sum_r t_r q_r x (u_b - u_a),    S = R^T R_c, J = tr U I - U.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "body/turned/turned_bodies.hpp"
#include "scene/carriers.hpp"
#include "scene/problem.hpp"

namespace delam {

class TurnedJumps {
public:
    // The arguments must outlive it.
    TurnedJumps(const Problem& problem, const Carriers& carriers);

    // Returns the frames of an interface as InterfaceGeometry has them.
    std::vector<double> frames(const TurnedBodies& bodies, std::size_t interface) const;
    // Returns the jumps, [rows].
    std::vector<double> jumps(const TurnedBodies& bodies, std::span<const double> theta,
                              std::span<const double> displacement) const;
    // Adds to the forces on the nodes [mesh DOFs] what forces of the rows cause: pulls, or the couples alone.
    void add_pulls(const TurnedBodies& bodies, std::span<const double> row_force, std::span<double> force) const;
    void add_couples(const TurnedBodies& bodies, std::span<const double> displacement,
                     std::span<const double> row_force, std::span<double> force) const;

private:
    struct Turn {
        Matrix3 rotation{}, stretch{};
    };
    using Touching = std::vector<std::pair<std::int64_t, double>>;  // cell, m_c
    Turn turn(const TurnedBodies& bodies, const Touching& cells, std::int64_t node) const;
    // Returns the row r of the pair p of an interface, turned.
    static Vector3 row(const InterfaceGeometry& interface, std::size_t dimension, std::size_t p, std::size_t r,
                       const Matrix3& rotation);
    Vector3 apart(const InterfaceGeometry& interface, std::size_t p, std::span<const double> displacement) const;

    const Problem& problem_;
    const Carriers& carriers_;
    std::size_t dimension_;
    std::vector<std::vector<Touching>> touching_;  // [interfaces][pairs]
};

}  // namespace delam
