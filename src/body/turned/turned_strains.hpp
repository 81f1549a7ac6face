// SPDX-License-Identifier: BSD-3-Clause
// Eigenstrains of cells whose frames turn: each cell has its own in its frame, so that with the displacements d there
// and factors theta the energy of a cell (body/eigenstrain.hpp) is
//
//     1/2 d^T S d - sum theta_p g_p . d + 1/2 sum theta_p W_pq theta_q,
//
// the forces in its frame are S d - sum theta_p g_p, and a strained cell that nothing holds keeps its stresses at zero
// however it turns.
#pragma once

#include <span>
#include <vector>

#include "body/turned/turned_bodies.hpp"

namespace delam {

class TurnedStrains {
public:
    using Pulls = TurnedBodies::Pulls;
    // pulls: g [patterns]; empty: the pattern strains nothing. energy: W, [patterns][patterns].
    TurnedStrains(std::vector<Pulls> pulls, std::vector<double> energy)
        : pulls_(std::move(pulls)), energy_(std::move(energy)) {}

    // Subtracts their forces in the frames at factors [patterns].
    void subtract(std::span<const double> theta, Pulls& pulls) const;
    // Returns the forces on the nodes at factor 1 of each pattern, [patterns][mesh DOFs]; empty: none.
    std::vector<std::vector<double>> forces(const TurnedBodies& bodies) const;
    // Returns what the strains add to the energy of the bodies.
    double energy(std::span<const double> theta, const TurnedBodies& bodies) const;
    // Replaces the derivatives of the energy with respect to the factors of the patterns that strain.
    void set_conjugate(std::span<const double> theta, const TurnedBodies& bodies, std::span<double> conjugate) const;
    // Adds W to the derivatives of those, [patterns][patterns].
    void add_energy(std::span<double> tangent) const;

private:
    std::vector<Pulls> pulls_;
    std::vector<double> energy_;
};

}  // namespace delam
