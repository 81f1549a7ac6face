// SPDX-License-Identifier: BSD-3-Clause
// Damage over all pairs: driving energies, mixities, the damage step (pointwise, or coupled on interfaces with a
// gradient term), and interface energies.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "evolution/increment/gradient.hpp"
#include "evolution/increment/pair_mixities.hpp"
#include "law/driving.hpp"
#include "law/law.hpp"

namespace delam {

// One entry a pair; law null where the pair is bonded permanently or only touches.
struct PairLaws {
    int dimension = 2;
    std::vector<const Law*> law;
    std::vector<double> weight;  // L (2D) or L2 (3D)
    // Toughness of pairs whose mixity is not computed because their law does not depend on it; empty: all are computed.
    std::vector<std::optional<Toughness>> fixed;
    // Gradient terms of interfaces whose law has kappa > 0; empty: the damage step is pointwise everywhere.
    std::vector<std::shared_ptr<const GradientTerm>> gradient;

    // True if a pair has two toughnesses in shear.
    bool two_shears() const;
    bool mixed(std::size_t pair) const { return law[pair] != nullptr && (fixed.empty() || !fixed[pair]); }
    Toughness toughness(std::size_t pair, const Mixity& mixity) const {
        return mixed(pair) ? law[pair]->toughness(mixity) : *fixed[pair];
    }
};

Driving driving_energy(const PairLaws& pairs, std::size_t pair, std::span<const double> jump);

// Largest Y of all pairs.
double largest_driving(const PairLaws& pairs, std::span<const double> jump);
// The mixities of pure opening, with shares of the second shear where a law tells the shears apart.
PairMixities opening(const PairLaws& pairs);
// Mixities of every pair, [pairs]. A pair whose jump is rounding (below 1e-10 of the onset's or of the largest one)
// keeps its `known` one, and so does one whose mixity is not computed.
PairMixities mixities(const PairLaws& pairs, std::span<const double> jump, const PairMixities& known);
// True if any pair has a jump larger than the rounding of its onset.
bool any_jump(const PairLaws& pairs, std::span<const double> jump);
// s = weight k zeta of every row, [rows].
std::vector<double> spring_stiffness(const PairLaws& pairs, std::span<const double> adhesion);
// Go and Gc at the mixities, [pairs]; zero where there is no law.
std::vector<Toughness> toughnesses(const PairLaws& pairs, const PairMixities& mixity);
// A lower bound of the adhesion of a pair.
using LeastAdhesion = std::function<double(std::size_t pair)>;
// zeta = argmin over least <= zeta <= adhesion_old at the frozen mixity of `toughness`; returns [pairs]. adhesion:
// [pairs] where coupled interfaces start their iteration (coupled_damage.hpp); the problem is convex, so it only
// affects the last digits. least: asked of pairs that damage, and of coupled ones; none: 0.
std::vector<double> damage_step(const PairLaws& pairs, std::span<const Toughness> toughness,
                                std::span<const double> adhesion_old, std::span<const double> adhesion,
                                std::span<const double> jump, const LeastAdhesion& least = {});
// The same at given driving energies, [pairs].
std::vector<double> damage_at(const PairLaws& pairs, std::span<const Toughness> toughness,
                              std::span<const double> driving, std::span<const double> adhesion_old,
                              std::span<const double> adhesion, const LeastAdhesion& least = {});

double stored_energy(const PairLaws& pairs, std::span<const double> adhesion,
                     std::span<const double> jump);                               // sum w zeta Y + gradient
double gradient_energy(const PairLaws& pairs, std::span<const double> adhesion);  // its second part alone
double stored_linear(const PairLaws& pairs, const PairMixities& mixity,
                     std::span<const double> adhesion);  // sum w f
// sum w (g(B, zeta) - g(B, zeta_old)), the ledger whose stored part does not depend on the mixity
double dissipation(const PairLaws& pairs, const PairMixities& mixity, std::span<const double> adhesion_old,
                   std::span<const double> adhesion);
// The same with Go and Gc given, [pairs].
double dissipation(const PairLaws& pairs, std::span<const Toughness> toughness, std::span<const double> adhesion_old,
                   std::span<const double> adhesion);
// sum w Gc(B) (zeta_old - zeta)
double dissipation_linear(const PairLaws& pairs, const PairMixities& mixity, std::span<const double> adhesion_old,
                          std::span<const double> adhesion);

}  // namespace delam
