// SPDX-License-Identifier: BSD-3-Clause
// Exhaustive scan of front positions: for each load step, the state of least stored + dissipated energy among all
// states with zeta = 0 from the notch to a front and unchanged beyond it, with the front not behind its previous
// position.
//
// Energies come from delam_solver_equilibrate; nothing of the library's search is used. Contact without friction is
// positively homogeneous, so under one proportional load the energy of an adhesion is quadratic in the load, and the
// mixities do not change:
//
//     E(w, a) = (w/w1)^2 E(w1, a),    B(w, a) = B(w1, a),
//
// and every front is solved only once, at the load w1 (cases/test_front_scan checks this against solutions at each
// load).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "flexure.hpp"

namespace reference {

// The energy that a broken pair dissipates. Equal pure-mode toughness does not make it constant: with exponents of 2
// the criterion gives Gc(B) = G / sqrt((1-B)^2 + B^2), up to 1.414 G at B = 1/2.
enum class MixityRule {
    pure,    // the tangential toughness, whatever the mixity
    frozen,  // a pair's mixity in the scan's own state at the end of the step before (first step: in the elastic state)
    converged  // a pair's mixity in the state in which it broke, with the front at this pair
};
const char* rule_name(MixityRule rule);
// Throws Failure for an unknown name.
MixityRule find_rule(const std::string& name);

// All pairs from the notch up to a front are broken.
struct Front {
    std::size_t first_intact = 0;  // the front is at this pair
    double advance = 0.0;          // m, sum of the weights of the pairs broken since the start
    double stored = 0.0;           // J/m at the unit load, bulk and interface
    std::vector<double> mixity;    // [pairs]
};

struct ScanStep {
    int step = 0;
    double load = 0.0;        // m
    std::size_t front = 0;    // index into fronts()
    double stored = 0.0;      // J/m
    double dissipated = 0.0;  // J/m, cumulative
    double total() const { return stored + dissipated; }
};

// The load at which the initial state stops being the one of least energy.
struct Crossing {
    double load = 0.0;        // m
    std::size_t front = 0;    // to which the front jumps
    double dissipated = 0.0;  // J/m, by this jump
};

class Fronts {
public:
    // Solves for all fronts at `load`; the last one leaves `kept` pairs intact at the right end. (With only one the
    // arms of the MMF at points are all but separate, and their contact set may not be found.)
    explicit Fronts(const Flexure& data, double load = 1e-3, std::size_t kept = 2);

    const std::vector<Front>& list() const { return fronts_; }
    const FlexureScene& flexure() const { return flexure_; }
    double stored(std::size_t front, double load) const;
    // Distance of a front from the left end, halfway between the shares of the last broken and the first intact pair:
    // notch + advance.
    double position(std::size_t front) const { return flexure_.data.notch + fronts_[front].advance; }
    // Energy dissipated by the move from one front position to another.
    double dissipated(std::size_t from, std::size_t to, MixityRule rule) const;
    // Energy of breaking a pair at its mixity in the state of a front.
    double cost(std::size_t front, std::size_t pair) const { return cost_[front][pair]; }
    // Runs the scan with its own history over the given loads.
    std::vector<ScanStep> scan(const std::vector<double>& loads, MixityRule rule) const;
    // First load at which another front has as little energy as the initial one. only_next: only the next pair may
    // break, which is Griffith's local criterion on this mesh.
    Crossing crossing(MixityRule rule, bool only_next = false) const;

private:
    double toughness(double mixity) const;

    FlexureScene flexure_;
    double unit_;
    std::vector<Front> fronts_;
    // Energy of breaking pair i at the mixity of front f: [front][pair]
    std::vector<std::vector<double>> cost_;
};

}  // namespace reference
