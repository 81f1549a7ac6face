// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/bounds.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "evolution/minimise/proportional_loads.hpp"

namespace delam {

namespace {

// Energies agree to about as much, relative; jumps are not scaled by a smaller difference of two. (Half and twice
// change nothing in verify/bench/analyses.py: no scene is known that comes near it.)
constexpr double rounding_of_energies = 1e-11;

}  // namespace

std::optional<EnergyBounds> reduced_bounds(const PairLaws& pairs, const State& before, const State& next) {
    const double change = next.ledger.energy() - before.ledger.energy();
    if (next.adhesion == before.adhesion) return EnergyBounds{change, change};
    const std::optional<double> a = load_ratio(before.theta, next.theta);
    if (!a) return std::nullopt;
    return EnergyBounds{(1.0 - *a * *a) * (next.ledger.energy() - gradient_energy(pairs, next.adhesion)),
                        (1.0 / (*a * *a) - 1.0) * (before.ledger.energy() - gradient_energy(pairs, before.adhesion))};
}

Lift::Lift(JumpOperator& op, std::span<const std::uint8_t> bonded_rows, std::span<const BoundRow> bound,
           std::size_t patterns, const Take& take)
    : a_(static_cast<std::int64_t>(patterns), static_cast<std::int64_t>(patterns)) {
    const std::size_t rows = bonded_rows.size();
    std::vector<std::uint8_t> moving(op.prescribed_rows().begin(), op.prescribed_rows().end());
    // In each equation among jumps one row must give way: its own, or one that is not bonded.
    for (const BoundRow& equation : bound) {
        std::int64_t gives = bonded_rows[index(equation.row)] == 0 ? equation.row : -1;
        for (const std::int64_t other : equation.others)
            if (gives < 0 && bonded_rows[index(other)] == 0 && moving[index(other)] == 0) gives = other;
        if (gives >= 0) moving[index(gives)] = 1;
    }
    Springs bonded{std::vector<double>(rows, 0.0), std::vector<std::uint8_t>(rows, 1)};
    for (std::size_t i = 0; i < rows; ++i) {
        if (moving[i] == 0) continue;
        bonded.held[i] = 0;
        prescribed_.push_back(i);
    }
    jump_.assign(prescribed_.size(), std::vector<double>(patterns, 0.0));
    for (std::size_t p = 0; p < patterns; ++p) {
        std::vector<double> unit(patterns, 0.0);
        unit[p] = 1.0;
        Response response;
        op.solve(bonded, unit, response);
        if (!response.balanced)
            fail(DELAM_ERROR_PROBLEM,
                 "a dead force acts on a part that no support holds even when all interfaces are bonded");
        if (take) take(unit, response);
        for (std::size_t q = 0; q < patterns; ++q)
            a_(static_cast<std::int64_t>(q), static_cast<std::int64_t>(p)) = response.conjugate[q];
        for (std::size_t i = 0; i < prescribed_.size(); ++i) jump_[i][p] = response.jump[prescribed_[i]];
    }
}

double Lift::form(std::span<const double> a, std::span<const double> b, std::span<const double> stiffness) const {
    double sum = 0.0;
    for (std::size_t p = 0; p < a.size(); ++p)
        for (std::size_t q = 0; q < b.size(); ++q)
            sum += a[p] * a_(static_cast<std::int64_t>(p), static_cast<std::int64_t>(q)) * b[q];
    for (std::size_t i = 0; i < prescribed_.size(); ++i)
        sum += stiffness[prescribed_[i]] * dot(jump_[i], a) * dot(jump_[i], b);
    return sum;
}

double Lift::half_quadratic(std::span<const double> d, std::span<const double> stiffness) const {
    return 0.5 * form(d, d, stiffness);
}

double Lift::rise(std::span<const double> theta, const State& state, std::span<const double> stiffness,
                  bool scaled) const {
    const std::span<const double> reactions = state.response.conjugate, old = state.theta;
    std::vector<double> d(theta.size());
    for (std::size_t p = 0; p < d.size(); ++p) d[p] = theta[p] - old[p];
    const double held = dot(d, reactions) + half_quadratic(d, stiffness);
    if (!scaled) return held;
    // (s - 1) g + (s - 1)^2 c is what scaling adds.
    const double whole = 0.5 * form(old, old, stiffness), c = whole - 0.5 * dot(old, reactions);
    const double g = dot(d, reactions) - form(d, old, stiffness);
    if (!(c > rounding_of_energies * whole)) return held;
    const double t = std::max(-1.0, -0.5 * g / c);
    return held + t * g + t * t * c;
}

EnergyBounds step_bounds(const Lift& lift, const PairLaws& pairs, const State& before, const State& next,
                         bool quadratic) {
    if (const auto reduced = quadratic ? reduced_bounds(pairs, before, next) : std::nullopt) return *reduced;
    return {-lift.rise(before.theta, next, spring_stiffness(pairs, next.adhesion), quadratic),
            lift.rise(next.theta, before, spring_stiffness(pairs, before.adhesion), quadratic)};
}

}  // namespace delam
