// SPDX-License-Identifier: BSD-3-Clause
// Combines linear steps whose results alternate. A linear step holds the couples of tractions as they are about where
// it begins: where faces have slid by more than a cell, one that begins too far on one side ends too far on the other.
// Anderson's method goes on from the combination of the last results whose beginnings, combined alike, are nearest to
// it (H. Walker, P. Ni, SIAM J. Numer. Anal. 49 (2011) 1715-1735), nearest in the energy of the bodies: what is left of
// cells next to each other is as stiff as it is small. It needs steps of one kind: at the same damage.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <span>
#include <vector>

namespace delam {

// Returns a - b.
std::vector<double> difference(std::span<const double> a, std::span<const double> b);

// Places of all nodes [mesh DOFs] and forces of all rows, about which a step is linear.
struct Iterate {
    std::vector<double> displacement, row_force;
};

class Mixing {
public:
    // Tells of a result its unbalanced force over the load, and its energy with what is dissipated, F L.
    struct Balance {
        double off, energy;
    };
    // Takes the begin of a linear step with its result, at this adhesion.
    void add(Iterate from, Iterate result, std::span<const double> adhesion, Balance balance);
    // True if the last steps have neither come nearer to a balance nor lowered the energy.
    bool needed() const { return needed_; }
    // Returns with what to go on then. forces: of a stiffness of the bodies, at displacements.
    using Forces = std::function<std::vector<double>(std::span<const double> displacement)>;
    Iterate mixed(const Forces& forces) const;

private:
    struct Step {
        std::vector<double> move;  // of the displacements, from the begin to the result
        Iterate result;
        Balance balance;
    };
    std::deque<Step> steps_;
    std::vector<double> adhesion_;
    bool needed_ = false;
};

}  // namespace delam
