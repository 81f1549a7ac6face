// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/increment/damage_step.hpp"

#include <algorithm>

#include "base/numbers.hpp"
#include "evolution/increment/coupled_damage.hpp"

namespace delam {

bool PairLaws::two_shears() const {
    return std::any_of(law.begin(), law.end(),
                       [](const Law* own) { return own != nullptr && own->two_shear_toughnesses(); });
}

Driving driving_energy(const PairLaws& pairs, std::size_t pair, std::span<const double> jump) {
    const auto dim = index(pairs.dimension);
    return driving_energy(*pairs.law[pair], jump.subspan(pair * dim, dim));
}

double largest_driving(const PairLaws& pairs, std::span<const double> jump) {
    double largest = 0.0;
    for (std::size_t p = 0; p < pairs.law.size(); ++p)
        if (pairs.law[p] != nullptr) largest = std::max(largest, driving_energy(pairs, p, jump).total());
    return largest;
}

PairMixities opening(const PairLaws& pairs) {
    const std::size_t count = pairs.law.size();
    return {std::vector<double>(count, 0.0), std::vector<double>(pairs.two_shears() ? count : 0, 0.0)};
}

PairMixities mixities(const PairLaws& pairs, std::span<const double> jump, const PairMixities& known) {
    PairMixities b = known;
    bool any = false;
    for (std::size_t p = 0; p < b.size() && !any; ++p) any = pairs.mixed(p);
    if (!any) return b;
    const double largest = largest_driving(pairs, jump);
    for (std::size_t p = 0; p < b.size(); ++p) {
        if (!pairs.mixed(p)) continue;
        const Driving y = driving_energy(pairs, p, jump);
        if (tells_mixity(*pairs.law[p], y, largest)) b.set(p, y.mixity());
    }
    return b;
}

bool any_jump(const PairLaws& pairs, std::span<const double> jump) {
    for (std::size_t p = 0; p < pairs.law.size(); ++p)
        if (pairs.law[p] != nullptr &&
            driving_energy(pairs, p, jump).total() > driving_rounding * pairs.law[p]->least_onset())
            return true;
    return false;
}

std::vector<double> spring_stiffness(const PairLaws& pairs, std::span<const double> adhesion) {
    const auto dim = index(pairs.dimension);
    std::vector<double> s(pairs.law.size() * dim, 0.0);
    for (std::size_t p = 0; p < pairs.law.size(); ++p) {
        if (pairs.law[p] == nullptr) continue;
        // Never -0: springs that are equal have the same bits.
        const double scale = pairs.weight[p] * adhesion[p] + 0.0;
        for (std::size_t c = 0; c < dim; ++c) s[p * dim + c] = scale * pairs.law[p]->stiffness(c);
    }
    return s;
}

std::vector<Toughness> toughnesses(const PairLaws& pairs, const PairMixities& mixity) {
    std::vector<Toughness> t(mixity.size(), Toughness{0.0, 0.0});
    for (std::size_t p = 0; p < t.size(); ++p) {
        if (pairs.law[p] == nullptr) continue;
        // Neighbours often have the same mode.
        const bool like_the_last = p > 0 && pairs.law[p] == pairs.law[p - 1] && pairs.mixed(p) && pairs.mixed(p - 1) &&
                                   mixity[p] == mixity[p - 1];
        t[p] = like_the_last ? t[p - 1] : pairs.toughness(p, mixity[p]);
    }
    return t;
}

std::vector<double> damage_step(const PairLaws& pairs, std::span<const Toughness> toughness,
                                std::span<const double> adhesion_old, std::span<const double> adhesion,
                                std::span<const double> jump, const LeastAdhesion& least) {
    std::vector<double> driving(adhesion.size(), 0.0);
    for (std::size_t p = 0; p < driving.size(); ++p)
        if (pairs.law[p] != nullptr) driving[p] = driving_energy(pairs, p, jump).total();
    return damage_at(pairs, toughness, driving, adhesion_old, adhesion, least);
}

std::vector<double> damage_at(const PairLaws& pairs, std::span<const Toughness> toughness,
                              std::span<const double> driving, std::span<const double> adhesion_old,
                              std::span<const double> adhesion, const LeastAdhesion& least) {
    std::vector<double> zeta(adhesion_old.begin(), adhesion_old.end());
    for (std::size_t p = 0; p < zeta.size(); ++p)
        if (pairs.law[p] != nullptr && zeta[p] > 0.0) {
            zeta[p] = pairs.law[p]->minimiser(toughness[p], std::max(0.0, driving[p]), zeta[p]);
            if (least && zeta[p] < adhesion_old[p]) zeta[p] = std::max(zeta[p], least(p));
        }
    for (const auto& term : pairs.gradient) {
        const std::size_t first = term->first(), count = term->pairs();
        const std::span<double> own = std::span(zeta).subspan(first, count);
        std::vector<double> lower(count, 0.0);
        for (std::size_t i = 0; least && i < count; ++i) lower[i] = least(first + i);
        const CoupledDamage coupled =
            coupled_damage(*term, *pairs.law[first], toughness.subspan(first, count), driving.subspan(first, count),
                           lower, adhesion_old.subspan(first, count), own, adhesion.subspan(first, count));
        std::copy(coupled.adhesion.begin(), coupled.adhesion.end(), own.begin());
    }
    return zeta;
}

double gradient_energy(const PairLaws& pairs, std::span<const double> adhesion) {
    double sum = 0.0;
    for (const auto& term : pairs.gradient) sum += term->energy(adhesion.subspan(term->first(), term->pairs()));
    return sum;
}

double stored_energy(const PairLaws& pairs, std::span<const double> adhesion, std::span<const double> jump) {
    double sum = 0.0;
    for (std::size_t p = 0; p < adhesion.size(); ++p)
        if (pairs.law[p] != nullptr && adhesion[p] > 0.0)
            sum += pairs.weight[p] * adhesion[p] * driving_energy(pairs, p, jump).total();
    return sum + gradient_energy(pairs, adhesion);
}

double stored_linear(const PairLaws& pairs, const PairMixities& mixity, std::span<const double> adhesion) {
    double sum = 0.0;
    for (std::size_t p = 0; p < adhesion.size(); ++p)
        if (pairs.law[p] != nullptr && adhesion[p] > 0.0 && adhesion[p] < 1.0)  // f(0) = f(1) = 0
            sum += pairs.weight[p] * pairs.law[p]->stored_linear(pairs.toughness(p, mixity[p]), adhesion[p]);
    return sum;
}

namespace {

double dissipation_with(const PairLaws& pairs, std::span<const double> adhesion_old, std::span<const double> adhesion,
                        auto&& toughness_of) {
    double sum = 0.0;
    for (std::size_t p = 0; p < adhesion.size(); ++p) {
        if (pairs.law[p] == nullptr || adhesion[p] == adhesion_old[p]) continue;
        const Toughness t = toughness_of(p);
        sum +=
            pairs.weight[p] * (pairs.law[p]->dissipated(t, adhesion[p]) - pairs.law[p]->dissipated(t, adhesion_old[p]));
    }
    return sum;
}

}  // namespace

double dissipation(const PairLaws& pairs, const PairMixities& mixity, std::span<const double> adhesion_old,
                   std::span<const double> adhesion) {
    return dissipation_with(pairs, adhesion_old, adhesion,
                            [&](std::size_t p) { return pairs.toughness(p, mixity[p]); });
}

double dissipation(const PairLaws& pairs, std::span<const Toughness> toughness, std::span<const double> adhesion_old,
                   std::span<const double> adhesion) {
    return dissipation_with(pairs, adhesion_old, adhesion, [&](std::size_t p) { return toughness[p]; });
}

double dissipation_linear(const PairLaws& pairs, const PairMixities& mixity, std::span<const double> adhesion_old,
                          std::span<const double> adhesion) {
    double sum = 0.0;
    for (std::size_t p = 0; p < adhesion.size(); ++p)
        if (pairs.law[p] != nullptr && adhesion[p] != adhesion_old[p])
            sum += pairs.weight[p] * pairs.toughness(p, mixity[p]).total * (adhesion_old[p] - adhesion[p]);
    return sum;
}

}  // namespace delam
