// SPDX-License-Identifier: BSD-3-Clause
// The dissipated energy of a step or of a candidate of its search, and the entries of a step in the ledger.
#pragma once

#include <span>
#include <vector>

#include "evolution/increment/increment.hpp"
#include "evolution/increment/state.hpp"

namespace delam {

// Energy that a step dissipates, F L.
struct Dissipation {
    double recorded = 0.0;
    double linear = 0.0;            // in the split of PANM 15 (2010)
    double error = 0.0;             // estimate for `recorded`
    std::vector<double> of_pair{};  // [pairs] parts of `recorded`; empty: not known
};

class StepAccount {
public:
    virtual ~StepAccount() = default;

    // ---- candidates of a search (search.hpp) ---------------------------------------------------------------------
    // D, with what else the rule minimises besides bodies and springs, from the state before to this adhesion.
    virtual double cost(const PairMixities& mixity, std::span<const double> adhesion) const = 0;
    // E of the state before, of the split that cost() completes.
    virtual double energy_before() const = 0;
    // True if pairs that break next take the mixity that the candidate's displacements show.
    virtual bool follows_iterates() const = 0;
    // True if the energies of candidates are bounds for the states left out.
    virtual bool bounds_candidates() const = 0;
    // ---- the ledger ----------------------------------------------------------------------------------------------
    // Records energies, dissipated energies and increments of the step in next.ledger. along: the energy dissipated
    // along the path; none: at the mixities of the state.
    virtual void record_ledger(State& next, const Dissipation* along = nullptr) const = 0;
};

// Energies of a state at its own mixity; the columns that accumulate are not touched.
void record_energies(const PairLaws& pairs, State& state);
// True if a pair loses so much of its toughness in a step that the work which is neither stored nor dissipated counts
// as released.
bool damages_abruptly(const Increment& step, std::span<const double> adhesion);

}  // namespace delam
