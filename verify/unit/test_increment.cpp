// SPDX-License-Identifier: BSD-3-Clause
// The increment of a load step, under each rule for the mixity: its energy, its damage step and the response of a pair
// belong together. The routes are independent: differences of energies, scans of the adhesion, sums over pairs.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <typeinfo>
#include <vector>

#include "base/error.hpp"
#include "check.hpp"
#include "delam/delam.h"
#include "evolution/increment/rule/converged_increment.hpp"
#include "evolution/increment/rule/frozen_increment.hpp"
#include "evolution/increment/rule/mixity_rule.hpp"
#include "evolution/increment/rule/variational_increment.hpp"
#include "refused.hpp"
#include "scene/options.hpp"

using namespace delam;

namespace {

constexpr std::size_t pair_count = 6;

struct Case {
    Law law;
    PairLaws pairs;
    State before;
    std::vector<double> jump;
    std::vector<std::unique_ptr<StepRule>> rules;
};

double real(std::mt19937& random, double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); }

// Pairs of one mixed-mode law, some damaged before, with jumps about their softening branches.
std::unique_ptr<Case> some_case(std::mt19937& random, int dimension) {
    auto c = std::make_unique<Case>();
    Law& law = c->law;
    law.normal_stiffness = real(random, 5e10, 2e11);
    law.tangential_stiffness = real(random, 5e10, 2e11);
    law.normal_onset = real(random, 50, 150);
    law.tangential_onset = real(random, 50, 150);
    law.normal_toughness = law.normal_onset * real(random, 2.0, 4.0);
    law.tangential_toughness = law.tangential_onset * real(random, 2.0, 4.0);
    c->pairs.dimension = dimension;
    for (std::size_t p = 0; p < pair_count; ++p) {
        c->pairs.law.push_back(&law);
        c->pairs.weight.push_back(real(random, 0.5, 2.0));
        c->before.adhesion.push_back(p % 3 == 0 ? 1.0 : real(random, 0.2, 1.0));
        c->before.mixity.shear.push_back(real(random, 0.1, 0.9));
        const double size = std::sqrt(2.0 * law.normal_onset / law.normal_stiffness) * real(random, 0.3, 2.0);
        const double angle = real(random, 0.1, 1.4), turn = dimension == 2 ? 0.0 : real(random, 0.0, 6.28);
        c->jump.push_back(size * std::cos(angle));
        c->jump.push_back(size * std::sin(angle) * std::cos(turn));
        if (dimension == 3) c->jump.push_back(size * std::sin(angle) * std::sin(turn));
    }
    c->before.mixity_before = c->before.mixity;
    c->before.loaded = 1;
    c->rules.push_back(std::make_unique<FrozenIncrement>(c->pairs, c->before, c->before.mixity, 1e-6));
    c->rules.push_back(std::make_unique<ConvergedIncrement>(c->pairs, c->before, c->before.mixity, 1e-6));
    c->rules.push_back(std::make_unique<VariationalIncrement>(c->pairs, c->before, c->before.mixity, 1e-6));
    // The variational rule reads from an iterate which jumps are rounding.
    for (const auto& rule : c->rules) rule->observe(c->before.adhesion, c->jump);
    return c;
}

std::span<const double> local(const Case& c, std::size_t pair, std::span<const double> jump) {
    const auto dim = static_cast<std::size_t>(c.pairs.dimension);
    return jump.subspan(pair * dim, dim);
}

}  // namespace

// No adhesion has less energy than that of the damage step, and the pair finds the same one by itself.
TEST(damage_step_minimises_the_energy) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 30; ++trial) {
        const auto c = some_case(random, 2 + trial % 2);
        for (const auto& rule : c->rules) {
            const std::vector<double> best = rule->damage_step(c->before.adhesion, c->jump);
            const double least = rule->energy(best, c->jump);
            for (std::size_t p = 0; p < pair_count; ++p) {
                ck_assert_double_eq_tol(rule->minimum(p, local(*c, p, c->jump)).adhesion, best[p], 1e-12);
                for (int n = 0; n <= 50; ++n) {
                    std::vector<double> other = best;
                    other[p] = c->before.adhesion[p] * n / 50.0;
                    ck_assert_double_ge(rule->energy(other, c->jump), least - 1e-10 * std::abs(least));
                }
            }
        }
    }
}

// A mixity that lags stays, does not count as held, and tells whether the last iterate shows another one.
TEST(mixities_lag) {
    std::mt19937 random(4);
    for (int trial = 0; trial < 10; ++trial) {
        const auto c = some_case(random, 2 + trial % 2);
        const auto other = some_case(random, c->pairs.dimension);
        ConvergedIncrement rule(c->pairs, c->before, c->before.mixity, 1e-6),
            loose(c->pairs, c->before, c->before.mixity, {1e-6, 1.0, 1e3});
        const PairMixities used = rule.memory().used;
        for (ConvergedIncrement* lagging : {&rule, &loose}) {
            lagging->lag();
            ck_assert(!lagging->observe(c->before.adhesion, other->jump));
            ck_assert(lagging->memory().used == used);
            ck_assert_int_eq(lagging->held(), 0);
        }
        ck_assert(rule.memory().own != used);
        ck_assert(!rule.follows());
        ck_assert(loose.follows());
    }
}

// The energy of the whole changes with the jumps as the minima of the pairs do.
TEST(pairs_add_up_to_the_energy) {
    std::mt19937 random(5);
    for (int trial = 0; trial < 30; ++trial) {
        const auto c = some_case(random, 2 + trial % 2);
        const auto other = some_case(random, c->pairs.dimension);
        for (const auto& rule : c->rules) {
            double sum = 0.0, size = 0.0;
            std::array<double, 2> whole{};
            for (int side = 0; side < 2; ++side) {
                const std::vector<double>& jump = side == 0 ? c->jump : other->jump;
                whole[static_cast<std::size_t>(side)] = rule->energy(rule->damage_step(c->before.adhesion, jump), jump);
                for (std::size_t p = 0; p < pair_count; ++p) {
                    const double e = c->pairs.weight[p] * rule->minimum(p, local(*c, p, jump)).energy;
                    sum += side == 0 ? -e : e;
                    size += std::abs(e);
                }
            }
            ck_assert_double_eq_tol(whole[1] - whole[0], sum, 1e-12 * size);
        }
    }
}

// The force of the model at its own jump is the slope of the least energy, its tangent that of the force.
TEST(model_is_the_derivative) {
    std::mt19937 random(7);
    for (int trial = 0; trial < 30; ++trial) {
        const auto c = some_case(random, 2 + trial % 2);
        const auto dim = static_cast<std::size_t>(c->pairs.dimension);
        const auto force = [&](const StepRule& rule, std::size_t p, std::span<const double> j, double fraction) {
            const PairModel m = rule.model(p, j, rule.minimum(p, j).adhesion, fraction);
            std::vector<double> f(dim);
            for (std::size_t r = 0; r < dim; ++r) {
                f[r] = -m.force[r];
                for (std::size_t q = 0; q < dim; ++q) f[r] += m.tangent[r * dim + q] * j[q];
            }
            return f;
        };
        for (const auto& rule : c->rules)
            for (std::size_t p = 0; p < pair_count; ++p) {
                const std::span<const double> at = local(*c, p, c->jump);
                const double zeta = rule->minimum(p, at).adhesion;
                // At a corner of the response there is no derivative.
                if (zeta < 1e-3 || zeta > 0.999 * c->before.adhesion[p]) continue;
                const std::vector<double> newton = force(*rule, p, at, 1.0), secant = force(*rule, p, at, 0.0);
                const PairModel model = rule->model(p, at, zeta, 1.0);
                const double stiffness =
                    c->pairs.weight[p] * std::max(c->law.normal_stiffness, c->law.tangential_stiffness);
                const double size = std::sqrt(2.0 * driving_energy(c->law, at).total() / c->law.normal_stiffness);
                for (std::size_t q = 0; q < dim; ++q) {
                    std::vector<double> low(at.begin(), at.end()), high = low;
                    const double h = 1e-5 * size;
                    low[q] -= h;
                    high[q] += h;
                    const double slope =
                        c->pairs.weight[p] * (rule->minimum(p, high).energy - rule->minimum(p, low).energy) / (2 * h);
                    ck_assert_double_eq_tol(newton[q], slope, 1e-6 * stiffness * size);
                    ck_assert_double_eq_tol(secant[q], newton[q], 1e-10 * stiffness * size);
                    const std::vector<double> a = force(*rule, p, low, 1.0), b = force(*rule, p, high, 1.0);
                    for (std::size_t r = 0; r < dim; ++r)
                        ck_assert_double_eq_tol(model.tangent[r * dim + q], (b[r] - a[r]) / (2 * h), 1e-4 * stiffness);
                }
            }
    }
}

// The error of a step in parts is that of its dissipated energy over this energy, however the step was divided. A part
// that dissipates nothing has no error.
TEST(parts_add_up_to_the_error_of_their_step) {
    const double dissipated[] = {0.0, 2.0, 3.0, 0.0, 7.0}, error[] = {0.5, 0.1, 0.4, 0.9, 0.05};
    Ledger before, sum, step;
    before.dissipated = 10.0;
    double all = 0.0, missed = 0.0;
    for (std::size_t k = 0; k < std::size(dissipated); ++k) {
        Ledger part = before;
        part.dissipated += dissipated[k];
        part.mixity_error = error[k];
        sum.add_part(part, before);
        all += dissipated[k];
        missed += dissipated[k] * error[k];
        before = part;
    }
    step.take_parts(sum);
    ck_assert_double_eq_tol(step.mixity_error, missed / all, 1e-15);
}

// Stored and dissipated energies of a step, summed pair by pair from the law, are what the ledger records.
TEST(the_ledger_is_the_sum_over_pairs) {
    std::mt19937 random(11);
    for (int trial = 0; trial < 30; ++trial) {
        const auto c = some_case(random, 2 + trial % 2);
        c->before.ledger.dissipated = 3.0;
        c->before.ledger.dissipated_linear = 5.0;
        for (std::size_t r = 0; r < c->rules.size(); ++r) {
            const StepRule& rule = *c->rules[r];
            State next = c->before;
            next.response.jump = c->jump;
            next.adhesion = rule.damage_step(c->before.adhesion, c->jump);
            rule.record(next);
            rule.record_ledger(next);
            double stored = 0.0, dissipated = 3.0, linear = 5.0;
            for (std::size_t p = 0; p < pair_count; ++p) {
                const Toughness t = c->law.toughness(next.mixity[p]);
                const double w = c->pairs.weight[p], zeta = next.adhesion[p], old = c->before.adhesion[p];
                stored += w * zeta * driving_energy(c->law, local(*c, p, c->jump)).total();
                dissipated += w * (c->law.dissipated(t, zeta) - c->law.dissipated(t, old));
                // The variational rule dissipates at the mixity before the step.
                linear += w * (old - zeta) * c->law.toughness(r == 2 ? next.mixity_before[p] : next.mixity[p]).total;
            }
            ck_assert_double_eq_tol(next.ledger.stored_interface, stored, 1e-12 * stored);
            ck_assert_double_eq_tol(next.ledger.dissipated, dissipated, 1e-12 * dissipated);
            ck_assert_double_eq_tol(next.ledger.dissipated_linear, linear, 1e-12 * linear);
            const double energies = r == 2 ? next.ledger.energy_linear() - c->before.ledger.energy_linear()
                                           : next.ledger.energy() - c->before.ledger.energy();
            ck_assert_double_eq_tol(next.ledger.increment, energies + (r == 2 ? linear - 5.0 : dissipated - 3.0),
                                    1e-12 * (std::abs(energies) + dissipated + linear));
        }
    }
}

// Each word of the option has its increment, where the law depends on the mixity; no other word has one.
TEST(words_of_the_option) {
    std::mt19937 random(7);
    const auto c = some_case(random, 2);
    const auto rows = option_table();
    const auto option =
        std::find_if(rows.begin(), rows.end(), [](const Option& row) { return row.key == std::string("mixity_rule"); });
    ck_assert_uint_eq(option->words.size(), c->rules.size());
    for (const auto& expected : c->rules) {
        const auto has_it = [&](const std::string& word) {
            const auto made = MixityRule(c->pairs, word).increment(c->pairs, c->before, c->before.mixity, 1e-6);
            const StepRule &one = *made, &other = *expected;
            return typeid(one) == typeid(other);
        };
        ck_assert_int_eq(std::count_if(option->words.begin(), option->words.end(), has_it), 1);
    }
    for (const bool mixed : {true, false}) {
        if (!mixed) c->pairs.law.assign(pair_count, nullptr);
        ck_assert_refused(DELAM_ERROR_INTERNAL, "", MixityRule(c->pairs, "Frozen"));
    }
}
