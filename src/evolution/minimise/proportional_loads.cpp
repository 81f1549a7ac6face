// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/minimise/proportional_loads.hpp"

#include <cmath>

#include "base/numbers.hpp"
#include "evolution/contact/free_parts.hpp"

namespace delam {

namespace {

constexpr double proportional = 1e-12;  // of the load factors
constexpr double least_ratio = 1e-100;  // of two loads; the square of a smaller one may underflow

}  // namespace

std::optional<double> load_ratio(std::span<const double> before, std::span<const double> next) {
    const double size = dot(next, next), a = size > 0.0 ? dot(before, next) / size : 0.0;
    if (!(a > least_ratio)) return std::nullopt;
    for (std::size_t p = 0; p < next.size(); ++p)
        if (std::abs(before[p] - a * next[p]) > proportional * std::abs(before[p])) return std::nullopt;
    return a;
}

// The state before answers loads in proportion with displacements in proportion, at its adhesion and with its contact
// set: the bodies, springs and frictionless contact have no other length. (Free parts keep their places. Gaps are
// loads, too.)
bool displaced_in_proportion(const JumpOperator& op, const PairLaws& pairs, const ContactScene& contact, State& next,
                             const State& before) {
    const std::optional<double> a = load_ratio(before.theta, next.theta);
    if (!a || !op.traits().proportional || before.response.jump.empty() ||
        !pairs_on_the_wrong_side(op, contact, before.theta, before.closed, before.response).empty() ||
        free_motions(op, contact, spring_stiffness(pairs, before.adhesion), before.theta, before.closed,
                     before.response)
                .columns > 0)
        return false;
    const double grown = 1.0 / *a;
    Response& response = next.response;
    for (auto* values : {&response.jump, &response.force, &response.conjugate})
        for (double& v : *values) v *= grown;
    for (double* energy : {&response.stored_bulk, &response.load_potential}) *energy *= grown * grown;
    return true;
}

}  // namespace delam
