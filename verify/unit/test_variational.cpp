// SPDX-License-Identifier: BSD-3-Clause
// One pair under the variational rule, and mixities that follow an iterate: slopes by differences, the spring that
// bounds the curvature, the damage against brute force, termination of oscillations.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "check.hpp"
#include "evolution/increment/gradient.hpp"
#include "evolution/increment/rule/converged_increment.hpp"
#include "evolution/increment/rule/frozen_increment.hpp"
#include "evolution/increment/rule/variational_increment.hpp"
#include "law/variational.hpp"

using namespace delam;

namespace {

Law some_law(std::mt19937& random) {
    const auto real = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    Law law;
    law.normal_stiffness = real(5e10, 2e11);
    law.tangential_stiffness = real(5e10, 2e11);
    law.normal_onset = real(50, 150);
    law.tangential_onset = real(50, 150);
    law.normal_toughness = law.normal_onset * real(2.0, 4.0);
    law.tangential_toughness = law.tangential_onset * real(2.0, 4.0);
    law.onset_exponent_1 = law.toughness_exponent_1 = real(1.0, 3.0);
    law.onset_exponent_2 = law.toughness_exponent_2 = real(1.0, 3.0);
    return law;
}

// An open jump whose Y is about that of the softening branch.
std::array<double, 3> some_jump(std::mt19937& random, const Law& law) {
    const auto real = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    const double size = std::sqrt(2.0 * law.normal_onset / law.normal_stiffness) * real(0.3, 2.5),
                 angle = real(0.05, 1.5), turn = real(0.0, 6.28);
    return {size * std::cos(angle), size * std::sin(angle) * std::cos(turn), size * std::sin(angle) * std::sin(turn)};
}

// A state in which nothing is damaged.
State whole(std::size_t pairs) {
    State state;
    state.adhesion.assign(pairs, 1.0);
    return state;
}

}  // namespace

TEST(toughness_slopes) {
    std::mt19937 random(1);
    for (int trial = 0; trial < 200; ++trial) {
        const Law law = some_law(random);
        const double b = std::uniform_real_distribution<double>(0.02, 0.98)(random), h = 1e-5;
        const ToughnessSlope slope = law.toughness_slope(b);
        const Toughness low = law.toughness(b - h), high = law.toughness(b + h);
        ck_assert_double_eq_tol(slope.onset, (high.onset - low.onset) / (2 * h), 1e-4 * law.normal_onset);
        ck_assert_double_eq_tol(slope.total, (high.total - low.total) / (2 * h), 1e-4 * law.normal_toughness);
        const double zeta = std::uniform_real_distribution<double>(0.02, 0.98)(random);
        ck_assert_double_eq_tol(stored_linear_slope(law, b, zeta),
                                (law.stored_linear(high, zeta) - law.stored_linear(low, zeta)) / (2 * h),
                                1e-4 * law.normal_toughness);
        ck_assert(stored_linear_slope(law, b, 0.0) == 0.0 && stored_linear_slope(law, b, 1.0) == 0.0);
    }
    Law constant;
    constant.normal_onset = constant.tangential_onset = 100.0;
    constant.normal_toughness = constant.tangential_toughness = 250.0;
    constant.onset_exponent_1 = constant.onset_exponent_2 = constant.toughness_exponent_1 =
        constant.toughness_exponent_2 = 1.0;
    ck_assert(constant.toughness_slope(0.3).onset == 0.0 && constant.toughness_slope(0.3).total == 0.0);
}

// Force = gradient of the energy at fixed damage; tangent = derivative of the force along the damage that minimises.
TEST(force_and_tangent) {
    std::mt19937 random(2);
    for (int trial = 0; trial < 300; ++trial) {
        const Law law = some_law(random);
        const std::array<double, 3> j = some_jump(random, law);
        const std::size_t dim = trial % 2 == 0 ? 2 : 3;
        const std::span<const double> local(j.data(), dim);
        const VariationalPair pair{law, 0.2, law.toughness(0.2).total, 0.0};
        const double zeta = std::uniform_real_distribution<double>(0.0, 1.0)(random);
        const auto force = pair.force(local, zeta);
        const double size = std::sqrt(j[0] * j[0] + j[1] * j[1] + j[2] * j[2]), h = 1e-5 * size;
        for (std::size_t c = 0; c < dim; ++c) {
            std::array<double, 3> low = j, high = j;
            low[c] -= h;
            high[c] += h;
            const double slope = (pair.energy(std::span<const double>(high.data(), dim), zeta) -
                                  pair.energy(std::span<const double>(low.data(), dim), zeta)) /
                                 (2 * h);
            ck_assert_double_eq_tol(force[c], slope, 1e-6 * law.normal_stiffness * size);
        }
        const auto h2 = pair.tangent(local, 0.9);
        const auto held = pair.tangent_held(local, zeta);
        for (std::size_t q = 0; q < dim; ++q) {
            const double step = 1e-5 * size;
            std::array<double, 3> low = j, high = j;
            low[q] -= step;
            high[q] += step;
            const std::span<const double> a(low.data(), dim), b(high.data(), dim);
            for (std::size_t r = 0; r < dim; ++r)
                ck_assert_double_eq_tol(held[r * dim + q],
                                        (pair.force(b, zeta)[r] - pair.force(a, zeta)[r]) / (2 * step),
                                        1e-3 * law.normal_stiffness * (1.0 + law.normal_toughness / law.normal_onset));
            const double za = pair.minimiser(a, 0.9), zb = pair.minimiser(b, 0.9);
            if ((za >= 0.9) != (zb >= 0.9) || (za <= 0.0) != (zb <= 0.0)) continue;  // a kink in between
            const auto fa = pair.force(a, za), fb = pair.force(b, zb);
            for (std::size_t r = 0; r < dim; ++r)
                ck_assert_double_eq_tol(h2[r * dim + q], (fb[r] - fa[r]) / (2 * step),
                                        2e-3 * law.normal_stiffness * (1.0 + law.normal_toughness / law.normal_onset));
        }
    }
}

TEST(damage_is_the_minimiser) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 200; ++trial) {
        const Law law = some_law(random);
        const std::array<double, 3> j = some_jump(random, law);
        const double before = std::uniform_real_distribution<double>(0.0, 1.0)(random),
                     old = std::uniform_real_distribution<double>(0.3, 1.0)(random);
        const VariationalPair pair{law, before, law.toughness(before).total, 0.0};
        const double zeta = pair.minimiser(j, old), reached = pair.energy(j, zeta);
        ck_assert(zeta >= 0.0 && zeta <= old);
        for (int i = 0; i <= 400; ++i)
            ck_assert(pair.energy(j, old * i / 400.0) >= reached - 1e-12 * law.normal_toughness);
    }
}

// Three pairs in a row, coupled by a gradient term: the middle one damages and draws its neighbours along, whose modes
// turn to where the toughness is less, by more than their Y.
TEST(coupled_damage_is_the_minimiser) {
    Law law;
    law.normal_stiffness = law.tangential_stiffness = 1e11;
    law.normal_onset = law.tangential_onset = 30.0;
    law.normal_toughness = 200.0;
    law.tangential_toughness = 250.0;
    law.gradient = 1.0;
    PairLaws pairs;
    pairs.law = {&law, &law, &law};
    pairs.weight = {1.0, 1.0, 1.0};
    std::vector<Triplet> chain{{0, 0, 1.0},  {0, 1, -1.0}, {1, 0, -1.0}, {1, 1, 2.0},
                               {1, 2, -1.0}, {2, 1, -1.0}, {2, 2, 1.0}};
    pairs.gradient = {std::make_shared<GradientTerm>(300.0, from_triplets(3, 3, std::move(chain)), pairs.weight, 0)};
    State before = whole(3);
    before.adhesion = {0.95, 0.9, 0.97};
    const std::vector<double> used{0.9, 0.5, 0.8}, jump{2e-6, 1e-6, 6e-5, 5e-5, 2e-6, 2e-6};
    const VariationalIncrement step(pairs, before, used, 1e-6);
    const std::vector<double> zeta = step.damage_step(before.adhesion, jump);
    ck_assert(zeta[0] < 0.95 && zeta[1] > 0.0 && zeta[1] < 0.9 && zeta[2] < 0.97);
    const double reached = step.energy(zeta, jump);
    for (std::size_t p = 0; p < 3; ++p)
        for (const double change : {-1e-2, -1e-3, 1e-3, 1e-2}) {
            std::vector<double> other = zeta;
            other[p] = std::clamp(other[p] + change, 0.0, before.adhesion[p]);
            ck_assert_double_ge(step.energy(other, jump), reached - 1e-10 * std::abs(reached));
        }
}

// Near j the energy stays below the model with the spring mu K, and therefore linearised steps descend.
TEST(proximal_spring_bounds_the_curvature) {
    std::mt19937 random(4);
    for (int trial = 0; trial < 300; ++trial) {
        const Law law = some_law(random);
        const std::array<double, 3> j = some_jump(random, law);
        const double zeta = std::uniform_real_distribution<double>(0.02, 0.98)(random);
        const VariationalPair pair{law, 0.5, law.toughness(0.5).total, 0.0};
        const std::span<const double> local(j.data(), 2);
        const double mu = pair.proximal(local, zeta);
        ck_assert(mu >= 0.0);
        const auto force = pair.force(local, zeta);
        const double start = pair.energy(local, zeta);
        for (int turn = 0; turn < 16; ++turn) {
            const double reach = 1e-2 * std::sqrt(j[0] * j[0] + j[1] * j[1]);
            const std::array<double, 2> d{reach * std::cos(turn * 0.3927), reach * std::sin(turn * 0.3927)};
            const std::array<double, 2> to{j[0] + d[0], j[1] + d[1]};
            if (to[0] <= 0.0) continue;
            const double curvature =
                0.5 * (zeta + mu) * (law.normal_stiffness * d[0] * d[0] + law.tangential_stiffness * d[1] * d[1]);
            const double model = start + force[0] * d[0] + force[1] * d[1] + curvature;
            ck_assert_double_le(pair.energy(to, zeta), model + 0.1 * curvature + 1e-9 * law.normal_toughness);
        }
    }
}

// No jump, and contact: the mixity gives no traction; as the jump tends to zero the energy stays bounded.
TEST(small_jumps_and_contact) {
    std::mt19937 random(5);
    const Law law = some_law(random);
    const VariationalPair pair{law, 0.3, law.toughness(0.3).total, law.normal_onset};
    for (const std::array<double, 2>& none : {std::array<double, 2>{0.0, 0.0}, {1e-18, 1e-18}}) {
        const auto force = pair.force(none, 0.5);
        ck_assert(force[0] == 0.5 * law.normal_stiffness * none[0] &&
                  force[1] == 0.5 * law.tangential_stiffness * none[1]);
        ck_assert(pair.proximal(none, 0.5) == 0.0);
    }
    const std::array<double, 2> closed{0.0, 1e-5};
    ck_assert(pair.force(closed, 0.5)[0] == 0.0);
    for (double size = 1e-4; size > 1e-16; size *= 0.1) {
        const std::array<double, 2> j{size, 0.7 * size};
        ck_assert(std::isfinite(pair.force(j, 0.5)[0]) &&
                  std::abs(pair.energy(j, 0.5)) < 10.0 * law.tangential_toughness + law.normal_stiffness * size * size);
    }
}

namespace {

Law alike_in_both_modes() {
    Law law;
    law.normal_stiffness = law.tangential_stiffness = 1e11;
    law.normal_onset = law.tangential_onset = 100.0;
    law.normal_toughness = law.tangential_toughness = 250.0;
    return law;
}

// Jumps at which the pair shows the mixity b, with the driving energy y.
std::vector<double> jump_of(double y, double b) {
    return {std::sqrt(2.0 * y * (1.0 - b) / 1e11), std::sqrt(2.0 * y * b / 1e11)};
}

}  // namespace

// A pair whose shown mixity overshoots that in use, however much: a finite number of updates.
TEST(swings_end) {
    const Law law = alike_in_both_modes();
    PairLaws pairs;
    pairs.law = {&law};
    pairs.weight = {1.0};
    for (const double gain : {-0.5, -1.0, -2.0, -50.0}) {
        const State before = whole(1);
        ConvergedIncrement mixity(pairs, before, std::vector<double>{0.1}, 1e-6);
        const std::vector<double> adhesion{0.8};
        int updates = 0;
        for (; updates < 5000; ++updates) {
            const double b = std::clamp(0.3 + gain * (mixity.memory().used.shear[0] - 0.3), 0.05, 0.45);
            if (!mixity.observe(adhesion, jump_of(150.0, b))) break;
        }
        ck_assert_msg(updates < 5000, "gain %g: the mixity swings for ever", gain);
        if (gain > -10.0) ck_assert_double_eq_tol(mixity.memory().used.shear[0], 0.3, 1e-4);
        ck_assert(mixity.held() == 0 || gain < -10.0);
    }
}

// Where other pairs made a mixity swing at first, it goes the whole way once they rest: with the fraction that the
// swings have left it would take 150 updates.
TEST(an_oscillating_mixity_settles) {
    const Law law = alike_in_both_modes();
    PairLaws pairs;
    pairs.law = {&law};
    pairs.weight = {1.0};
    const State before = whole(1);
    ConvergedIncrement mixity(pairs, before, std::vector<double>{0.1}, 1e-6);
    const auto observe = [&](double b) { return mixity.observe(std::vector<double>{0.8}, jump_of(150.0, b)); };
    for (int swing = 0; swing < 6; ++swing) ck_assert(observe(swing % 2 == 0 ? 0.45 : 0.05));
    const double left = std::abs(mixity.memory().used.shear[0] - 0.48);
    ck_assert_double_gt(left, 0.05);
    int updates = 0;
    while (std::abs(mixity.memory().used.shear[0] - 0.48) > 1e-8 * left && updates < 200) {
        observe(0.48);
        ++updates;
    }
    ck_assert_int_le(updates, 8);
}

TEST(broken_pairs_keep_theirs) {
    const Law law = alike_in_both_modes();
    PairLaws pairs;
    pairs.law = {&law, &law};
    pairs.weight = {1.0, 1.0};
    const State before = whole(2);
    ConvergedIncrement mixity(pairs, before, std::vector<double>{0.1, 0.2}, 1e-6);
    const std::vector<double> jump{1e-5, 1e-5, 1e-5, 1e-5};
    mixity.observe(std::vector<double>{0.0, 0.5}, jump);
    ck_assert(mixity.memory().used.shear[0] == 0.1);
    ck_assert_double_eq_tol(mixity.memory().used.shear[1], 0.5, 1e-12);
    // Frozen mixities stay, but are compared with those shown: Gc = 250 / sqrt((1-B)^2 + B^2).
    FrozenIncrement frozen(pairs, before, std::vector<double>{0.1, 0.0}, 1e-6);
    frozen.observe(std::vector<double>{0.0, 0.5}, jump);
    ck_assert(frozen.memory().used.shear[1] == 0.0);
    State state = before;
    state.adhesion = {1.0, 0.0};
    frozen.record(state);
    ck_assert_double_eq_tol(state.ledger.mixity_error, std::sqrt(2.0) - 1.0, 1e-12);
    state.adhesion = before.adhesion;
    frozen.record(state);
    ck_assert(state.ledger.mixity_error == 0.0);
}
