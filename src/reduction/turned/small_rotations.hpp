// SPDX-License-Identifier: BSD-3-Clause
// Tells what small rotations leave out of a state: strains that are linear in the displacements know neither the
// stretch by rotations nor the work of the stresses on it, by which bodies buckle.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "body/assembly.hpp"
#include "body/turned/initial_stress.hpp"
#include "reduction/turned/held_bodies.hpp"
#include "scene/problem.hpp"

namespace delam {

class SmallRotations {
public:
    // Says what holds the bodies together: springs at the present adhesion, with the pairs held that contact presses
    // together.
    struct Holding {
        Springs springs;
        std::vector<std::uint8_t> touching;  // [rows] 1: normal row of a pair that touches without a force
    };
    // Displacements, [mesh DOFs], and their gradients and stresses at the centres of the cells.
    struct Moved {
        std::vector<double> displacement, slopes, stress;
    };
    // The problem, its bodies and what `holding` refers to must outlive it. bodies: as for HeldBodies. stored: the
    // energy of the bodies, F L.
    SmallRotations(const Problem& problem, const BodySystem* bodies, const std::vector<BodyModel>& models, Moved moved,
                   double stored, std::function<Holding()> holding);

    // Returns the relative error of strains that are linear in the displacements, about: the larger of half the square
    // of the largest rotation, and the energy that rotations add over that of the bodies. NaN without cells.
    double error();
    // The energy that rotations add by their strains, over that of the bodies: the work of the stresses, and the energy
    // of these strains themselves, as far as further displacements do not relieve them.
    struct Energy {
        double work = 0.0;
        double unrelieved = 0.0;  // before any further displacements
    };
    const Energy& energy() const { return energy_; }
    // Returns the share of `unrelieved` that further displacements leave, at the present adhesion and contact; 0 where
    // a part is free to move, and where there are no rotations. One factorisation of the bodies.
    double unrelieved_share();
    // Returns the present stresses over those at which the bodies buckle (critical_ratio); NaN without cells and where
    // a part is free to move. One factorisation of the bodies, or two.
    double buckling_ratio();

private:
    // The bodies at the present adhesion and contact; null: they are not known, or free.
    const HeldBodies* held();

    const Problem& problem_;
    const BodySystem* bodies_;
    double largest_;  // rotation of a cell, rad; NaN without cells
    InitialStress stress_;
    InitialStress membrane_;  // the stresses of the strains that rotations add
    double membrane_work_;    // of these on the rotations, without relief, F L
    Energy energy_;
    std::function<Holding()> holding_;
    std::vector<std::uint8_t> touching_;      // [rows] as in Holding
    std::unique_ptr<const HeldBodies> held_;  // null: not factorised, or nothing that can be
    bool tried_ = false;                      // to factorise them
};

}  // namespace delam
