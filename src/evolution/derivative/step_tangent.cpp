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

double Linearised::coupling(std::size_t pair, std::span<const double> z) const {
    double sum = 0.0;
    for (const auto& term : pairs_.gradient) {
        if (pair < term->first() || pair >= term->first() + term->pairs()) continue;
        const SparseMatrix& k = term->matrix();
        const std::size_t row = pair - term->first();
        for (std::int64_t e = k.start[row]; e < k.start[row + 1]; ++e)
            sum += k.value[index(e)] * z[term->first() + index(k.column[index(e)])];
    }
    return sum / pairs_.weight[pair];
}

Response Linearised::loaded(std::span<const double> theta) {
    Response response = unit(theta, {});
    if (!response.balanced)
        fail(DELAM_ERROR_STATE,
             "tangent: the loads act along a rigid motion that nothing holds at the present contact set");
    return response;
}

Response Linearised::answer(std::size_t patterns, const std::vector<double>& force) {
    const std::vector<double> still(patterns, 0.0);
    return unit(still, force);
}

Linearised::Damaging Linearised::damaging(std::size_t patterns, std::vector<PairDirection> found, bool coupled) {
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
    if (!coupled || pairs_.gradient.empty()) return of;
    std::vector<double> one(state_.adhesion.size(), 0.0);
    for (std::int64_t b = 0; b < n; ++b) {
        const std::size_t pair = of.directions[index(b)].pair;
        one[pair] = 1.0;
        for (std::int64_t a = 0; a < n; ++a) of.system(a, b) -= coupling(of.directions[index(a)].pair, one);
        one[pair] = 0.0;
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
    auto [directions, answers, system] = damaging(patterns.size(), std::move(found), coupled);
    const auto n = static_cast<std::int64_t>(directions.size());
    if (n == 0) return matrix;

    // (own + omega U - kappa A / w) x = omega J
    DenseMatrix right(n, count);
    for (std::int64_t a = 0; a < n; ++a)
        for (std::int64_t q = 0; q < count; ++q) right(a, q) = along(directions[index(a)], columns_[index(q)].jump);
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
