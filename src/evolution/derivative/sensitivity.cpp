// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/derivative/sensitivity.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "law/driving.hpp"
#include "law/law_parameters.hpp"

namespace delam {

namespace {

constexpr double relative_step = 1e-6;     // of a parameter: differences of the law alone, which is smooth there
constexpr double singular_damage = 1e-13;  // as of the step tangent

double value_of(const Law& law, const std::string& key) {
    const LawParameter* row = find_parameter(law, key);
    if (row == nullptr || std::string(row->type) != "real")
        fail(DELAM_ERROR_ARGUMENT, "key '", key, "' is no number of the law; known are ",
             known_parameters(law, "real"));
    const double value = row->value != nullptr ? law.*(row->value) : row->read(law.softening);
    if (!(value > 0.0))
        fail(DELAM_ERROR_ARGUMENT, "key '", key, "' is ", value,
             " in the law: a number that is given, and not 0, is expected");
    return value;
}

Law changed(const Law& law, const std::string& key, double value) {
    Law out = law;
    set_parameter(out, key, value);
    return out;
}

// Equal numbers of both shears are one number in all directions of sliding, and others belong to axes (criterion.hpp):
// between the two, there is no derivative.
void require_same_axes(const Law& law, const Law& more, const std::string& key) {
    if (more.onset_modes().two_shears() == law.onset_modes().two_shears() &&
        more.total_modes().two_shears() == law.total_modes().two_shears())
        return;
    fail(DELAM_ERROR_ARGUMENT, "key '", key,
         "': onset or toughness is given for both shears with equal numbers, which are one number and have no "
         "derivative one by one: leave second_tangential_onset, second_tangential_strength or "
         "second_tangential_toughness out, or give it another value");
}

// The law at one pair; its derivative by p is (of(more) - of(less)) / difference.
struct AtPair {
    std::span<const double> jump;
    double zeta;
    Mixity mixity;
    bool follows;  // the mixity is that of the jump
    double residual(const Law& law) const {
        const Driving y = driving_energy(law, jump);
        return y.total() - law.driving(law.toughness(follows ? y.mixity() : mixity), zeta);
    }
    Mixity shown(const Law& law) const { return driving_energy(law, jump).mixity(); }
};

// The derivative by one parameter.
class Derivative {
public:
    Derivative(Linearised& linearised, const FollowedParameter& parameter, const StepRule* step,
               const Linearised::Damaging& damaging, std::size_t patterns)
        : linearised_(linearised),
          state_(linearised.state()),
          pairs_(linearised.pairs()),
          parameter_(parameter),
          step_(step),
          damaging_(damaging),
          patterns_(patterns),
          dim_(index(pairs_.dimension)),
          largest_(largest_driving(pairs_, state_.response.jump)) {}

    // at_rest: dzeta of pairs that do not damage, mixity: dB and dS before the step, [pairs] both.
    void find(std::span<const double> at_rest, const PairMixities& mixity) {
        const Response moved = linearised_.answer(patterns_, forces(at_rest));
        jump_.assign(moved.jump.size(), 0.0);
        for (std::size_t r = 0; r < jump_.size(); ++r) jump_[r] = -moved.jump[r];
        conjugate_.assign(patterns_, 0.0);
        for (std::size_t p = 0; p < patterns_; ++p) conjugate_[p] = -moved.conjugate[p];
        if (!parameter_.load.empty()) {
            const Response loaded = linearised_.loaded(parameter_.load);
            for (std::size_t r = 0; r < jump_.size(); ++r) jump_[r] += loaded.jump[r];
            for (std::size_t p = 0; p < patterns_; ++p) conjugate_[p] += loaded.conjugate[p];
        }
        adhesion_.assign(at_rest.begin(), at_rest.end());
        const auto n = static_cast<std::int64_t>(damaging_.directions.size());
        if (n > 0) {
            DenseMatrix system = damaging_.system, right(n, 1);
            for (std::int64_t a = 0; a < n; ++a) {
                const PairDirection& direction = damaging_.directions[index(a)];
                right(a, 0) = linearised_.along(direction, jump_) + residual(direction.pair, mixity) +
                              linearised_.coupling(direction.pair, at_rest);
            }
            known_ = solve_general(system, right, singular_damage);
            for (std::int64_t a = 0; a < n && known_; ++a) add(index(a), right(a, 0));
        }
        find_mixity(mixity);
    }

    // False: the system is singular, a jump is about to happen; the adhesions of the pairs that damage are then taken
    // as constant.
    bool known() const { return known_; }
    const std::vector<double>& conjugate() const { return conjugate_; }
    const std::vector<double>& adhesion() const { return adhesion_; }
    const PairMixities& mixity() const { return mixity_; }

private:
    std::span<const double> local(std::size_t pair) const {
        return std::span(state_.response.jump).subspan(pair * dim_, dim_);
    }
    bool tells(std::size_t pair) const {
        const Law& law = *pairs_.law[pair];
        return pairs_.mixed(pair) && tells_mixity(law, driving_energy(law, local(pair)), largest_);
    }
    // Returns the derivative by the parameter of a quantity `of` of the law, at a pair.
    template <class Of>
    double by_parameter(std::size_t pair, Of&& of) const {
        const std::int64_t law = parameter_.law[pair];
        if (law < 0) return 0.0;
        return (of(parameter_.more[index(law)]) - of(parameter_.less[index(law)])) / parameter_.difference;
    }

    // F, taken as forces h on the rows: h = -F acts, so that the jumps change by minus the answer.
    std::vector<double> forces(std::span<const double> at_rest) const {
        std::vector<double> force(state_.response.jump.size(), 0.0);
        for (std::size_t p = 0; p < state_.adhesion.size(); ++p) {
            if (pairs_.law[p] == nullptr || !(state_.adhesion[p] > 0.0)) continue;
            const std::span<const double> jump = local(p);
            for (std::size_t c = state_.closed[p] != 0 ? 1 : 0; c < dim_; ++c) {
                const double stiffness = by_parameter(p, [c](const Law& law) { return law.stiffness(c); });
                force[p * dim_ + c] = pairs_.weight[p] * jump[c] *
                                      (state_.adhesion[p] * stiffness + pairs_.law[p]->stiffness(c) * at_rest[p]);
            }
        }
        return force;
    }

    // r: of Y - D by the parameter and, where the mixity is that of the step before, by that.
    double residual(std::size_t pair, const PairMixities& mixity) const {
        const Law& law = *pairs_.law[pair];
        const bool follows = step_->in_parts() && tells(pair);
        const AtPair at{local(pair), state_.adhesion[pair], state_.mixity[pair], follows};
        double r = by_parameter(pair, [&](const Law& of) { return at.residual(of); });
        if (follows || !pairs_.mixed(pair)) return r;
        const auto [by_shear, by_second] = mixity[pair];
        if (by_shear != 0.0) r -= driving_by_shear(law, at.mixity, at.zeta, by_shear);
        if (by_second != 0.0) r -= driving_by_second(law, at.mixity, at.zeta, by_second);
        return r;
    }

    void add(std::size_t direction, double dzeta) {
        const Response& answer = damaging_.answers[direction];
        adhesion_[damaging_.directions[direction].pair] = dzeta;
        for (std::size_t r = 0; r < jump_.size(); ++r) jump_[r] -= answer.jump[r] * dzeta;
        for (std::size_t p = 0; p < patterns_; ++p) conjugate_[p] -= answer.conjugate[p] * dzeta;
    }

    // dB and dS of the mode that the jumps show, with dB/dj and dS/dj as in the step tangent.
    void find_mixity(const PairMixities& before) {
        mixity_ = before;
        for (std::size_t p = 0; p < mixity_.size(); ++p) {
            if (pairs_.law[p] == nullptr || !tells(p)) continue;
            const Law& law = *pairs_.law[p];
            const std::span<const double> jump = local(p);
            const Driving y = driving_energy(law, jump);
            const auto [b, second] = y.mixity();
            const AtPair at{jump, state_.adhesion[p], {b, second}, true};
            double by_shear = by_parameter(p, [&](const Law& of) { return at.shown(of).shear; });
            for (std::size_t c = 0; c < dim_; ++c)
                by_shear += (c == 0 ? -b : 1.0 - b) * law.stiffness(c) * jump[c] / y.total() * jump_[p * dim_ + c];
            double by_second = 0.0;
            if (law.two_shear_toughnesses() && y.tangential > 0.0) {
                by_second = by_parameter(p, [&](const Law& of) { return at.shown(of).second; });
                for (std::size_t c = 1; c < dim_; ++c)
                    by_second += (c == 1 ? -second : 1.0 - second) * law.stiffness(c) * jump[c] / y.tangential *
                                 jump_[p * dim_ + c];
            }
            mixity_.set(p, {by_shear, by_second});
        }
    }

    Linearised& linearised_;
    const State& state_;
    const PairLaws& pairs_;
    const FollowedParameter& parameter_;
    const StepRule* step_;
    const Linearised::Damaging& damaging_;
    std::size_t patterns_, dim_;
    double largest_;
    bool known_ = true;
    std::vector<double> jump_, conjugate_, adhesion_;
    PairMixities mixity_;
};

}  // namespace

FollowedParameter followed_parameter(const Problem& problem, std::span<const std::int64_t> interfaces,
                                     const std::string& key) {
    if (key == "gradient") fail(DELAM_ERROR_ARGUMENT, "key 'gradient' is not followed: the gradient term is not");
    if (interfaces.empty()) fail(DELAM_ERROR_ARGUMENT, "interfaces: at least one is expected");
    FollowedParameter out;
    std::vector<std::int64_t> law_of(problem.interfaces.size(), -1);
    double value = 0.0;
    for (const std::int64_t i : interfaces) {
        if (i < 0 || index(i) >= problem.interfaces.size())
            fail(DELAM_ERROR_ARGUMENT, "interfaces: ", i, " is not allowed, 0 to ", problem.interfaces.size() - 1);
        const auto& law = problem.interfaces[index(i)].law;
        if (!law) fail(DELAM_ERROR_ARGUMENT, "interface ", i, " has no law");
        const double own = value_of(*law, key);
        if (out.more.empty()) value = own;
        if (own != value)
            fail(DELAM_ERROR_ARGUMENT, "interfaces: ", key, " is ", own, " on interface ", i, ", but ", value,
                 " on another: one value is expected");
        law_of[index(i)] = static_cast<std::int64_t>(out.more.size());
        out.more.push_back(changed(*law, key, value * (1.0 + relative_step)));
        out.less.push_back(changed(*law, key, value * (1.0 - relative_step)));
        require_same_axes(*law, out.more.back(), key);
    }
    out.difference = value * (1.0 + relative_step) - value * (1.0 - relative_step);
    for (std::size_t i = 0; i < problem.interfaces.size(); ++i) {
        const auto& law = problem.interfaces[i].law;
        if (law && law->gradient > 0.0)
            fail(DELAM_ERROR_STATE, "interface ", i, " has a gradient term: its sensitivities are not followed");
        out.law.insert(out.law.end(), problem.mesh->interfaces()[i].weight.size(), law_of[i]);
    }
    return out;
}

std::vector<FollowedParameter> followed_loads(std::size_t patterns, std::size_t pairs, double share) {
    std::vector<FollowedParameter> loads(patterns);
    for (std::size_t q = 0; q < patterns; ++q) {
        loads[q].law.assign(pairs, -1);
        loads[q].load.assign(patterns, 0.0);
        loads[q].load[q] = share;
    }
    return loads;
}

std::vector<double> by_loads(const Sensitivity& by, std::size_t patterns) {
    std::vector<double> matrix(patterns * patterns);
    for (std::size_t q = 0; q < patterns; ++q)
        for (std::size_t p = 0; p < patterns; ++p) matrix[p * patterns + q] = by.conjugate[q * patterns + p];
    return matrix;
}

Sensitivity sensitivity(Linearised linearised, std::span<const FollowedParameter> parameters,
                        std::span<const Pattern> patterns, const StepRule* step, const Sensitivity* begun_with) {
    const Sensitivity none, &before = step != nullptr ? step->before().sensitivity : none;
    const State& state = linearised.state();
    const std::size_t pairs = state.adhesion.size();
    const Linearised::Damaging damaging =
        step != nullptr ? linearised.damaging(patterns.size(), step->directions(state), true) : Linearised::Damaging{};
    std::vector<std::uint8_t> active(pairs, 0);
    for (const PairDirection& direction : damaging.directions) active[direction.pair] = 1;
    Sensitivity out;
    out.unknown = before.unknown;
    for (std::size_t p = 0; p < pairs && step != nullptr; ++p)
        if (active[p] == 0 && state.adhesion[p] > 0.0 && state.adhesion[p] < step->adhesion_before()[p]) ++out.unknown;
    // The derivatives of a state that is given are 0.
    const auto of = [&](const std::vector<double>& by, std::size_t k, std::size_t p) {
        return by.empty() ? 0.0 : by[k * pairs + p];
    };
    for (std::size_t k = 0; k < parameters.size(); ++k) {
        std::vector<double> at_rest(pairs, 0.0);
        PairMixities begun(std::vector<double>(pairs, 0.0), std::vector<double>(pairs, 0.0));
        const Sensitivity& first = begun_with != nullptr ? *begun_with : before;
        for (std::size_t p = 0; p < pairs && step != nullptr; ++p) {
            begun.set(p, {of(first.mixity, k, p), of(first.second, k, p)});
            if (active[p] == 0 && state.adhesion[p] > 0.0 && state.adhesion[p] == step->adhesion_before()[p])
                at_rest[p] = of(before.adhesion, k, p);
        }
        Derivative by(linearised, parameters[k], step, damaging, patterns.size());
        by.find(at_rest, begun);
        if (!by.known() && k == 0) out.unknown += static_cast<std::int64_t>(damaging.directions.size());
        out.conjugate.insert(out.conjugate.end(), by.conjugate().begin(), by.conjugate().end());
        out.adhesion.insert(out.adhesion.end(), by.adhesion().begin(), by.adhesion().end());
        out.mixity.insert(out.mixity.end(), by.mixity().shear.begin(), by.mixity().shear.end());
        out.second.insert(out.second.end(), by.mixity().second.begin(), by.mixity().second.end());
    }
    return out;
}

}  // namespace delam
