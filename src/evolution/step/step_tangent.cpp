// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/step_tangent.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "law/mixity.hpp"
#include "law/variational.hpp"
#include "linalg/dense.hpp"

namespace delam {

namespace {

constexpr double singular = 1e-13;
constexpr double mixity_difference = 1e-6;

}  // namespace

Linearised::Linearised(JumpOperator& op, const PairLaws& pairs, const ContactScene& contact, const State& state)
    : op_(op),
      pairs_(pairs),
      state_(state),
      dim_(static_cast<std::size_t>(contact.dimension)),
      springs_{spring_stiffness(pairs, state.adhesion), {}, {}} {
    op.recall(state.memory);
    springs_.held.assign(springs_.stiffness.size(), 0);
    for (std::size_t p = 0; p < state.closed.size(); ++p)
        for (std::size_t c = 0; c < dim_; ++c)
            springs_.held[p * dim_ + c] = contact.bonded[p] != 0 || (c == 0 && state.closed[p] != 0) ? 1 : 0;
}

Response Linearised::unit(std::span<const double> theta, const std::vector<double>& force) {
    Springs springs = springs_;
    springs.force = force;
    Response response;
    op_.solve(springs, theta, response);
    return response;
}

std::vector<double> Linearised::tangent(std::span<const Pattern> patterns) {
    std::vector<double> matrix(patterns.size() * patterns.size()), theta(patterns.size(), 0.0);
    for (std::size_t q = 0; q < patterns.size(); ++q) {
        theta[q] = 1.0;
        columns_.push_back(unit(theta, {}));
        theta[q] = 0.0;
        if (!columns_.back().balanced)
            fail(DELAM_ERROR_STATE, "tangent: pattern '", patterns[q].name,
                 "' acts along a motion that nothing holds at this contact set");
        for (std::size_t p = 0; p < patterns.size(); ++p)
            matrix[p * patterns.size() + q] = columns_.back().conjugate[p];
    }
    return matrix;
}

// B = Y_t/Y: dB/dj_n = -B k_n j_n / Y, dB/dj_t = (1 - B) k_t j_t / Y.
void Linearised::add_mixity(Direction& direction, double zeta) const {
    const std::size_t p = direction.pair;
    const Law& law = *pairs_.law[p];
    const auto jump = std::span(state_.response.jump).subspan(p * dim_, dim_);
    const Driving y = driving_energy(law, jump);
    if (!tells_mixity(law, y, largest_driving(pairs_, state_.response.jump))) return;
    const double b = mode_mixity(y.normal, y.tangential);
    const double below = std::max(0.0, b - mixity_difference), above = std::min(1.0, b + mixity_difference);
    const double slope =
        (law.driving(law.toughness(above), zeta) - law.driving(law.toughness(below), zeta)) / (above - below);
    for (std::size_t c = 0; c < dim_; ++c) {
        const double k = c == 0 ? law.normal_stiffness : law.tangential_stiffness;
        direction.form[c] -= slope * (c == 0 ? -b : 1.0 - b) * k * jump[c] / y.total();
    }
}

// A pair damages where its adhesion has fallen in the step and is the minimiser at its load, strictly inside.
std::vector<Linearised::Direction> Linearised::damaging(MixityRule rule, std::span<const double> adhesion_old,
                                                        double tolerance) const {
    std::vector<std::uint8_t> coupled(state_.adhesion.size(), 0);
    for (const auto& term : pairs_.gradient)
        for (std::size_t p = 0; p < term->pairs(); ++p) coupled[term->first() + p] = term->coupled(p) ? 1 : 0;
    std::vector<Direction> found;
    for (std::size_t p = 0; p < state_.adhesion.size(); ++p) {
        const Law* law = pairs_.law[p];
        const double zeta = state_.adhesion[p];
        if (law == nullptr || !(zeta > 0.0) || !(zeta < adhesion_old[p])) continue;
        const Toughness toughness = pairs_.toughness(p, state_.mixity[p]);
        const auto jump = std::span(state_.response.jump).subspan(p * dim_, dim_);
        const double y = driving_energy(*law, jump).total();
        const double slope = law->driving_slope(toughness, zeta);  // -g''
        if (!std::isfinite(slope)) continue;
        if (coupled[p] == 0) {
            if (!(law->slope(toughness, y, adhesion_old[p]) < 0.0)) continue;
            if (std::abs(law->minimiser(toughness, y, adhesion_old[p]) - zeta) > 10.0 * tolerance)
                continue;  // broken earlier in the step, at rest now
        }
        Direction direction{p, std::vector<double>(dim_, 0.0), std::vector<double>(dim_, 0.0), slope};
        for (std::size_t c = 0; c < dim_; ++c) {
            if (c == 0 && state_.closed[p] != 0) continue;
            const double pull = (c == 0 ? law->normal_stiffness : law->tangential_stiffness) * jump[c];
            direction.force[c] = pairs_.weight[p] * pull;
            direction.form[c] = pull;
        }
        if (rule == MixityRule::converged && pairs_.mixed(p)) add_mixity(direction, zeta);
        found.push_back(std::move(direction));
    }
    return found;
}

// The force of each pair that is neither whole nor broken, less that of its springs, component by component.
std::vector<Linearised::Direction> Linearised::variational(std::span<const double> adhesion_old) const {
    std::vector<Direction> found;
    const double largest = largest_driving(pairs_, state_.response.jump);
    for (std::size_t p = 0; p < state_.adhesion.size(); ++p) {
        if (!pairs_.mixed(p) || !(state_.adhesion[p] > 0.0)) continue;
        const Law& law = *pairs_.law[p];
        const double before = state_.mixity_before[p];
        const VariationalPair pair{law, before, law.toughness(before).total, largest};
        const std::array<double, 9> tangent =
            pair.tangent(std::span(state_.response.jump).subspan(p * dim_, dim_), adhesion_old[p]);
        for (std::size_t r = 0; r < dim_; ++r) {
            if (r == 0 && state_.closed[p] != 0) continue;
            Direction direction{p, std::vector<double>(dim_, 0.0), std::vector<double>(dim_, 0.0), 1.0};
            direction.force[r] = 1.0;
            double size = 0.0;
            for (std::size_t c = 0; c < dim_; ++c) {
                if (c == 0 && state_.closed[p] != 0) continue;
                direction.form[c] =
                    pairs_.weight[p] * tangent[r * dim_ + c] - (c == r ? springs_.stiffness[p * dim_ + r] : 0.0);
                size = std::max(size, std::abs(direction.form[c]));
            }
            if (size > 1e-12 * springs_.stiffness[p * dim_ + r]) found.push_back(std::move(direction));
        }
    }
    return found;
}

double Linearised::along(const Direction& direction, std::span<const double> jump) const {
    double sum = 0.0;
    for (std::size_t c = 0; c < dim_; ++c) sum += direction.form[c] * jump[direction.pair * dim_ + c];
    return sum;
}

std::vector<double> Linearised::step_tangent(std::span<const Pattern> patterns, MixityRule rule,
                                             std::span<const double> adhesion_old, double tolerance) {
    const auto count = static_cast<std::int64_t>(patterns.size());
    std::vector<double> matrix = tangent(patterns);
    if (rule == MixityRule::variational && !pairs_.gradient.empty())
        fail(DELAM_ERROR_STATE, "step tangent: mixity_rule = variational together with a gradient term has none");
    const std::vector<Direction> directions =
        rule == MixityRule::variational ? variational(adhesion_old) : damaging(rule, adhesion_old, tolerance);
    const auto n = static_cast<std::int64_t>(directions.size());
    if (n == 0) return matrix;

    // (own + omega U - kappa A / w) x = omega J
    DenseMatrix system(n, n), right(n, count);
    std::vector<Response> answers;
    const std::vector<double> still(patterns.size(), 0.0);
    std::vector<double> force(springs_.stiffness.size(), 0.0);
    for (std::int64_t b = 0; b < n; ++b) {
        const Direction& direction = directions[static_cast<std::size_t>(b)];
        const auto first = force.begin() + static_cast<std::ptrdiff_t>(direction.pair * dim_);
        std::copy(direction.force.begin(), direction.force.end(), first);
        answers.push_back(unit(still, force));
        std::fill_n(first, dim_, 0.0);
        for (std::int64_t a = 0; a < n; ++a)
            system(a, b) = along(directions[static_cast<std::size_t>(a)], answers.back().jump);
        system(b, b) += direction.own;
    }
    for (std::int64_t a = 0; a < n; ++a)
        for (std::int64_t q = 0; q < count; ++q)
            right(a, q) = along(directions[static_cast<std::size_t>(a)], columns_[static_cast<std::size_t>(q)].jump);
    for (const auto& term : pairs_.gradient) {
        for (std::int64_t a = 0; a < n; ++a) {
            const std::size_t pair = directions[static_cast<std::size_t>(a)].pair;
            if (pair < term->first() || pair >= term->first() + term->pairs()) continue;
            const SparseMatrix& k = term->matrix();
            const std::size_t row = pair - term->first();
            for (std::int64_t b = 0; b < n; ++b) {
                const std::size_t other = directions[static_cast<std::size_t>(b)].pair;
                if (other < term->first() || other >= term->first() + term->pairs()) continue;
                const auto begin = k.column.begin() + k.start[row], end = k.column.begin() + k.start[row + 1];
                const auto found = std::lower_bound(begin, end, static_cast<std::int64_t>(other - term->first()));
                if (found != end && *found == static_cast<std::int64_t>(other - term->first()))
                    system(a, b) -= k.value[static_cast<std::size_t>(found - k.column.begin())] / pairs_.weight[pair];
            }
        }
    }
    if (!solve_general(system, right, singular))
        fail(DELAM_ERROR_NUMERICAL, "step tangent: singular with ", n, " damaging pairs; a jump is about to happen");
    for (std::int64_t q = 0; q < count; ++q)
        for (std::int64_t p = 0; p < count; ++p)
            for (std::int64_t a = 0; a < n; ++a)
                matrix[static_cast<std::size_t>(p * count + q)] -=
                    answers[static_cast<std::size_t>(a)].conjugate[static_cast<std::size_t>(p)] * right(a, q);
    return matrix;
}

}  // namespace delam
