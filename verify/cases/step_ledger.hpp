// SPDX-License-Identifier: BSD-3-Clause
// The energies that a step records, by their definitions: the work of the reactions by the trapezoidal rule, and the
// part of it that is neither stored nor dissipated where a pair is damaged abruptly. The functions are for one load
// pattern and a law of which Go/Gc is the same in all modes.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "api.hpp"
#include "support.hpp"

namespace cases {

struct StepLedger {
    double factor = 0.0, reaction = 0.0;  // of the load
    double energy = 0.0, dissipated = 0.0, work = 0.0, lower = 0.0, increment = 0.0, upper = 0.0, released = 0.0,
           defect = 0.0, substeps = 1.0;
    std::vector<double> adhesion;

    double size() const { return std::max(std::abs(energy), std::abs(work)); }
};

// factor: of the pattern `load` at the time of the state.
inline StepLedger read_ledger(const reference::Solver& s, const std::string& load, double factor) {
    return {factor,
            s.value("reaction:" + load),
            s.value("stored_bulk") + s.value("stored_interface") + s.value("load_potential"),
            s.value("dissipated"),
            s.value("work"),
            s.value("lower"),
            s.value("increment"),
            s.value("upper"),
            s.value("released"),
            s.value("defect"),
            s.value("substeps"),
            s.field("adhesion")};
}

// The largest part of its toughness that a pair loses: g(zeta)/Gc = (1 - zeta) / (1 + (Gc/Go - 1) zeta).
inline double largest_loss(const reference::LawData& law, const std::vector<double>& from,
                           const std::vector<double>& to) {
    const double ratio = law.normal_toughness / law.normal_onset;
    const auto spent = [&](double zeta) { return (1.0 - zeta) / (1.0 + (ratio - 1.0) * zeta); };
    double loss = 0.0;
    for (std::size_t p = 0; p < from.size(); ++p) loss = std::max(loss, spent(to[p]) - spent(from[p]));
    return loss;
}

// Work and released energy of a step that jumps at once to another state. Stored energies go with the square of the
// load, so that the energies before and after the jump are equal, with what it dissipates, at the load a with
// a^2 (e_before - e_after) = dissipated; if the step begins beyond this load, the difference is released.
struct Leap {
    double work = 0.0, released = 0.0;
};
inline Leap leap(const StepLedger& a, const StepLedger& b) {
    const double begin = a.factor / b.factor, before = a.energy / (begin * begin), after = b.energy;
    const double spent = b.dissipated - a.dissipated;
    const double square = before > after ? std::clamp(spent / (before - after), begin * begin, 1.0) : 1.0;
    return {before * (square - begin * begin) + after * (1.0 - square),
            std::max(0.0, square * (before - after) - spent)};
}

// Compares two states with one step between them. The energy of a pair that loses more than a tenth of its toughness is
// released; where one loses more than half, the reactions change at an instant that is not known, and the work is
// raised to what was stored and dissipated, up to the upper bound. A step that was minimised from another state (a
// return, a search) is a leap. in_parts: a step that takes more than a part of its toughness from a pair (path_step)
// knows its work from the states on its way, between the bounds, and so does one of several substeps.
inline void expect_work(const reference::LawData& law, const StepLedger& a, const StepLedger& b, double tolerance,
                        double size, const std::string& where, bool in_parts = false) {
    const double trapezoid = 0.5 * (b.factor - a.factor) * (a.reaction + b.reaction);
    const double loss = largest_loss(law, a.adhesion, b.adhesion);
    double work = trapezoid;
    if (b.substeps > 1.0 || (in_parts && loss > 0.09)) {
        expect_below(b.lower - (b.work - a.work), tolerance * size, where + "work below its bound");
        expect_below(b.work - a.work - b.upper, tolerance * size, where + "work above its bound");
        expect_below(-b.released, 0.0, where + "released");
        expect_below(b.released - std::max(0.0, b.upper - b.increment), tolerance * size, where + "released, at most");
    } else {
        double released = loss > 0.1 ? std::max(0.0, trapezoid - b.increment) : 0.0;
        if (loss > 0.1 && a.factor > 0.0 && std::abs(b.work - a.work - work) > tolerance * size) {
            const Leap known = leap(a, b);
            work = known.work;
            released = known.released;
        }
        expect_near(b.work - a.work, work, tolerance, size, where + "work");
        expect_near(b.released, released, tolerance, size, where + "released");
    }
    expect_near(b.defect - a.defect, b.energy - a.energy + b.dissipated - a.dissipated + b.released - (b.work - a.work),
                tolerance, size, where + "defect");
}

}  // namespace cases
