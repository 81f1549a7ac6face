// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/derivative/step_tangent.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/numbers.hpp"

namespace delam {

namespace {

constexpr double singular = 1e-13;

}  // namespace

Linearised::Linearised(JumpOperator& op, const PairLaws& pairs, const ContactScene& contact, const State& state)
    : op_(op),
      pairs_(pairs),
      state_(state),
      dim_(index(contact.dimension)),
      springs_{spring_stiffness(pairs, state.adhesion), {}, {}} {
    op.recall(state.memory);
    springs_.held = held_rows(contact, state.closed);
}

Response Linearised::unit(std::span<const double> theta, const std::vector<double>& force) {
    Springs springs = springs_;
    springs.force = force;
    Response response;
    op_.solve(springs, theta, response);
    return response;
}

std::vector<double> Linearised::elastic(std::span<const Pattern> patterns) {
    std::vector<double> matrix(patterns.size() * patterns.size()), theta(patterns.size(), 0.0);
    for (std::size_t q = 0; q < patterns.size(); ++q) {
        theta[q] = 1.0;
        columns_.push_back(unit(theta, {}));
        theta[q] = 0.0;
        if (!columns_.back().balanced)
            fail(DELAM_ERROR_STATE, "tangent: pattern '", patterns[q].name,
                 "' acts along a rigid motion that nothing holds at the present contact set");
        for (std::size_t p = 0; p < patterns.size(); ++p)
            matrix[p * patterns.size() + q] = columns_.back().conjugate[p];
    }
    return matrix;
}

double Linearised::along(const PairDirection& direction, std::span<const double> jump) const {
    double sum = 0.0;
    for (std::size_t c = 0; c < dim_; ++c) sum += direction.form[c] * jump[direction.pair * dim_ + c];
    return sum;
}

void Linearised::add_gradient(std::span<const PairDirection> directions, DenseMatrix& system) const {
    const auto n = static_cast<std::int64_t>(directions.size());
    for (const auto& term : pairs_.gradient)
        for (std::int64_t a = 0; a < n; ++a) {
            const std::size_t pair = directions[index(a)].pair;
            if (pair < term->first() || pair >= term->first() + term->pairs()) continue;
            const SparseMatrix& k = term->matrix();
            const std::size_t row = pair - term->first();
            const auto begin = k.column.begin() + k.start[row], end = k.column.begin() + k.start[row + 1];
            for (std::int64_t b = 0; b < n; ++b) {
                const std::size_t other = directions[index(b)].pair;
                if (other < term->first() || other >= term->first() + term->pairs()) continue;
                const auto column = static_cast<std::int64_t>(other - term->first());
                if (const auto found = std::lower_bound(begin, end, column); found != end && *found == column)
                    system(a, b) -= k.value[index(found - k.column.begin())] / pairs_.weight[pair];
            }
        }
}

Response Linearised::answer(std::size_t patterns, const std::vector<double>& force) {
    const std::vector<double> still(patterns, 0.0);
    return unit(still, force);
}

Linearised::Damaging Linearised::damaging(std::size_t patterns, std::vector<PairDirection> found) {
    Damaging of{std::move(found), {}, {}};
    const auto n = static_cast<std::int64_t>(of.directions.size());
    of.system = DenseMatrix(n, n);
    std::vector<double> force(springs_.stiffness.size(), 0.0);
    for (std::int64_t b = 0; b < n; ++b) {
        const PairDirection& direction = of.directions[index(b)];
        const auto first = force.begin() + static_cast<std::ptrdiff_t>(direction.pair * dim_);
        std::copy(direction.force.begin(), direction.force.end(), first);
        of.answers.push_back(answer(patterns, force));
        std::fill_n(first, dim_, 0.0);
        for (std::int64_t a = 0; a < n; ++a) of.system(a, b) = along(of.directions[index(a)], of.answers.back().jump);
        of.system(b, b) += direction.own;
    }
    return of;
}

std::vector<double> Linearised::tangent(std::span<const Pattern> patterns, const Increment& increment) {
    return yielding(patterns, increment.held_directions(state_), false);
}

std::vector<double> Linearised::step_tangent(std::span<const Pattern> patterns, const Increment& increment) {
    return yielding(patterns, increment.directions(state_), true);
}

std::vector<double> Linearised::yielding(std::span<const Pattern> patterns, std::vector<PairDirection> found,
                                         bool coupled) {
    const auto count = static_cast<std::int64_t>(patterns.size());
    std::vector<double> matrix = elastic(patterns);
    auto [directions, answers, system] = damaging(patterns.size(), std::move(found));
    const auto n = static_cast<std::int64_t>(directions.size());
    if (n == 0) return matrix;

    // (own + omega U - kappa A / w) x = omega J
    DenseMatrix right(n, count);
    for (std::int64_t a = 0; a < n; ++a)
        for (std::int64_t q = 0; q < count; ++q) right(a, q) = along(directions[index(a)], columns_[index(q)].jump);
    if (coupled) add_gradient(directions, system);
    if (!solve_general(system, right, singular))
        fail(DELAM_ERROR_NUMERICAL, coupled ? "step tangent" : "tangent", ": singular with ", n,
             " partly damaged pairs; an instability (a jump of the state) is imminent");
    for (std::int64_t q = 0; q < count; ++q)
        for (std::int64_t p = 0; p < count; ++p)
            for (std::int64_t a = 0; a < n; ++a)
                matrix[index(p * count + q)] -= answers[index(a)].conjugate[index(p)] * right(a, q);
    return matrix;
}

}  // namespace delam
