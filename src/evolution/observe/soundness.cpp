// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/observe/soundness.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "evolution/increment/state_fields.hpp"
#include "evolution/observe/values.hpp"

namespace delam {

namespace {

std::string place_of(const State& state) { return text("step ", state.step, " at time ", state.time, ": "); }

class FiniteState {
public:
    explicit FiniteState(const State& state) : state_(state) {}
    template <class... Name>
    void number(double value, const Name&... name) const {
        if (!std::isfinite(value)) refuse(name..., " is ", value);
    }
    template <class... Words>
    [[noreturn]] void refuse(const Words&... words) const {
        fail(DELAM_ERROR_NUMERICAL, place_of(state_), words...,
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
    const FiniteState finite(state);
    const auto dim = index(problem.mesh->dimension());
    finite.array(state.response.jump, "jump", "pair", dim);
    finite.array(state.response.force, "force", "pair", dim);
    finite.array(state.adhesion, "adhesion", "pair");
    finite.array(state.mixity.shear, "mixity", "pair");
    for (std::size_t p = 0; p < problem.patterns.size(); ++p)
        finite.number(state.response.conjugate[p], "reaction of pattern '", problem.patterns[p].name, "'");
    finite.array(state.response.multipliers, "dual force", "multiplier");
    finite.array(state.response.rigid, "rigid motion", "coefficient");
    if (const std::optional<KeyedValue> energy = not_finite(state.ledger))
        finite.number(energy->value, "value '", energy->key, "'");
    Sound saved(unsaved - 1);  // in every version
    saved.compare(state, state);
    if (!saved.numbers) finite.refuse("a number that a saved state holds is not finite");
}

void require_supports(const Problem& problem, const State& state) {
    const SupportError& support = state.response.support;
    const double tolerance = problem.options.linear_tolerance;
    if (!support.violated(tolerance)) return;
    const std::int64_t dim = problem.mesh->dimension();
    const Constraint& constraint = problem.constraints[index(support.constraint)];
    const std::int64_t dof = constraint.dof.front();
    fail(DELAM_ERROR_NUMERICAL, place_of(state), "support ", problem.number_of(index(support.constraint)), " (of ",
         constraint.dof.size(), " displacements, first node ", dof / dim, ", component ", dof % dim,
         ") is violated by ", support.error, ", of displacements up to ", support.size,
         ", allowed: ", SupportError::allowed(tolerance),
         " of these; the iterative linear solve has lost its digits: try reduction = condensed");
}

}  // namespace

void require_sound(const Problem& problem, const State& state, bool converged) {
    require_finite(problem, state);
    if (converged) require_supports(problem, state);
}

}  // namespace delam
