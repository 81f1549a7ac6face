// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/soundness.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"

namespace delam {

namespace {

std::string place_of(const State& state) { return text("step ", state.step, " at time ", state.time, ": "); }

class Finite {
public:
    explicit Finite(const State& state) : state_(state) {}
    template <class... Name>
    void number(double value, const Name&... name) const {
        if (std::isfinite(value)) return;
        fail(DELAM_ERROR_NUMERICAL, place_of(state_), name..., " is ", value,
             ": energies, which are quadratic in the loads, are beyond the largest number (",
             std::numeric_limits<double>::max(), "); choose other units or smaller loads");
    }
    // entries: of the array that belong to one item.
    void array(std::span<const double> values, const char* name, const char* item, std::size_t entries = 1) const {
        for (std::size_t i = 0; i < values.size(); ++i) number(values[i], name, " of ", item, " ", i / entries);
    }

private:
    const State& state_;
};

void require_finite(const Problem& problem, const State& state) {
    const Finite finite(state);
    const auto dim = index(problem.mesh->dimension());
    finite.array(state.response.jump, "jump", "pair", dim);
    finite.array(state.response.force, "force", "pair", dim);
    finite.array(state.adhesion, "adhesion", "pair");
    finite.array(state.mixity, "mixity", "pair");
    for (std::size_t p = 0; p < problem.patterns.size(); ++p)
        finite.number(state.response.conjugate[p], "reaction of pattern '", problem.patterns[p].name, "'");
    finite.array(state.response.multipliers, "dual force", "multiplier");
    finite.array(state.response.rigid, "rigid motion", "coefficient");
    const Ledger& ledger = state.ledger;
    finite.number(ledger.stored_bulk, "value 'stored_bulk'");
    finite.number(ledger.stored_interface, "value 'stored_interface'");
    finite.number(ledger.stored_interface_linear, "value 'stored_interface_slides'");
    finite.number(ledger.load_potential, "value 'load_potential'");
    finite.number(ledger.dissipated, "value 'dissipated'");
    finite.number(ledger.dissipated_linear, "value 'dissipated_slides'");
    finite.number(ledger.lower, "value 'lower'");
    finite.number(ledger.increment, "value 'increment'");
    finite.number(ledger.increment_lower, "value 'increment_lower'");
    finite.number(ledger.upper, "value 'upper'");
    finite.number(ledger.work, "value 'work'");
    finite.number(ledger.defect(), "value 'defect'");
    finite.number(ledger.defect_linear(), "value 'defect_slides'");
    finite.number(ledger.mixity_error, "value 'mixity_error'");
}

void require_supports(const Problem& problem, const State& state) {
    const SupportError& support = state.response.support;
    if (!support.violated()) return;
    const std::int64_t dim = problem.mesh->dimension();
    const Constraint& constraint = problem.constraints[index(support.constraint)];
    const std::int64_t dof = constraint.dof.front();
    fail(DELAM_ERROR_NUMERICAL, place_of(state), "support ", support.constraint, " (of ", constraint.dof.size(),
         " displacements, first node ", dof / dim, ", component ", dof % dim, ") is violated by ", support.error,
         ", of displacements up to ", support.size, ", allowed: ", SupportError::allowed,
         " of these; the iterative linear solve has lost its digits: try reduction = condensed");
}

}  // namespace

void require_sound(const Problem& problem, const State& state, bool converged) {
    require_finite(problem, state);
    if (converged) require_supports(problem, state);
}

}  // namespace delam
