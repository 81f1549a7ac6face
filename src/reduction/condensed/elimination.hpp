// SPDX-License-Identifier: BSD-3-Clause
// What is left of the skeleton of superelements when the displacements on the cuts, and all jumps that do not change,
// have been minimised out: an energy of the jumps of the zone.
//
// A node adds the energies that its children have left and its own entries, and eliminates what it owns,
//     F = [F_ee F_er; F_re F_rr],   L L^T = F_ee + springs,   V = L^-1 F_er,   F_rr - V^T V   goes on to its parent
// (the multifrontal method: I. Duff, J. Reid, ACM TOMS 9, 1983), where r are the jumps of the zone below and the
// border. A change of springs or of the zone asks for the nodes from the changed leaf to the root alone. What a node
// leaves is a function of its springs and its zone, not of what was there before.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "reduction/condensed/superelements.hpp"
#include "reduction/zone/dense_energy.hpp"

namespace delam {

class Elimination {
public:
    // `bodies` must outlive it. load: of the skeleton, [places][patterns].
    Elimination(const Superelements& bodies, DenseMatrix load);

    // States of a jump: a spring s >= 0 with which it is minimised out, or one of these.
    static constexpr double held = -1.0;
    static constexpr double in_zone = -2.0;
    // state: [places]; 0 for displacements. Throws Error(DELAM_ERROR_NUMERICAL) if nothing holds what is eliminated;
    // then nothing is left that could be used.
    void update(std::span<const double> state, const Poll& poll);
    // Of the kept displacements, then the jumps of the zone, in ascending order.
    const DenseEnergy& energy() const { return front_.back().energy; }
    const std::vector<std::int64_t>& places() const { return front_.back().left; }
    // All of the skeleton from the unknowns of energy().
    void recover(std::span<const double> theta, std::span<const double> left, std::span<double> skeleton) const;
    // S x = b on the displacements of the cuts, with all jumps and kept displacements at rest; in place, b: [places].
    // All jumps must be held or in the zone.
    void solve_cuts(std::span<double> b) const;

private:
    struct Front {
        std::vector<std::int64_t> out, left;  // places
        DenseMatrix factor;                   // L
        DenseMatrix coupling;                 // V
        DenseMatrix load;                     // L^-1 f_e
        DenseEnergy energy;                   // lower triangle
    };
    void eliminate(std::size_t node, const Poll& poll);
    void divide(Front& front, const Superelements::Node& node);
    void add_leaf(Front& front, std::int64_t leaf);
    void add_entries(Front& front, std::span<const Triplet> entries);
    void add(Front& front, std::span<const std::int64_t> at, const DenseEnergy& energy);

    const Superelements& bodies_;
    DenseMatrix load_;
    std::vector<double> state_;
    std::vector<Front> front_;
    std::vector<std::int64_t> at_;  // scratch: place in a front
    bool valid_ = false;
};

}  // namespace delam
