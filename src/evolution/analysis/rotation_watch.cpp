// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/analysis/rotation_watch.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"

namespace delam {

namespace {

// A measure of what small rotations leave out.
struct Measure {
    double counts;        // beyond this value rotations are large
    double load_power;    // it grows with this power of its loads ..
    double length_power;  // .. and with this of the length over which an interface has lost its adhesion
};
// A run with small rotations warns of the same (bindings/cli/src/result/closing/rotations.cpp). Half and twice of the
// three values (`delam run --set solver.kinematics=auto`) turn examples/enf in steps 6 and 36 instead of 18,
// dcb-elastica in 3 and 8 instead of 6, blister in 1 and 3 instead of 2, and peel in 1: in the end energies that are
// dissipated differ by 7e-6 at most, and loads by 1e-6.
constexpr Measure of_rotation{0.1, 1.0, 1.0};  // rad
constexpr Measure of_energy{0.005, 2.0, 0.0};  // of that of the bodies; its load is the rotation
constexpr Measure of_stresses{0.1, 1.0, 2.0};  // over the critical ones: bending grows by 1 / (1 - ratio)

// Says when a measure is computed. (`delam run --set solver.kinematics=auto`: with half and twice of each, of the
// powers and of that in doubt() too, examples/enf and blister turn in the same steps, and dcb-alfano, dcb-3d, mmb and
// the first 12 of 40 steps of enf-3d do not; the last four take 0.8 to 1.6 of the time, because they compute it more
// rarely or more often.)
struct Renewal {
    double way = 0.5;       // it may have come this part of the way from its last value to what counts,
    double longer = 2.0;    // an interface has lost its adhesion over a length that is greater by this factor ..
    double ignored = 0.05;  // .. beside this share of its area,
    double touching = 0.1;  // or so much more or less of its area touches
};
constexpr Renewal renewal;

// Returns what tells of a state whether a measure must be computed, without loads.
RotationCheck shares_of(const Mesh& mesh, const PairLaws& pairs, const State& state) {
    RotationCheck shares;
    std::size_t p = 0;
    for (const InterfaceGeometry& interface : mesh.interfaces()) {
        double damaged = 0.0, touching = 0.0, all = 0.0;
        for (std::int64_t i = 0; i < interface.pair_count(); ++i, ++p) {
            all += pairs.weight[p];
            damaged += pairs.law[p] != nullptr ? pairs.weight[p] * (1.0 - state.adhesion[p]) : 0.0;
            touching += state.closed[p] != 0 ? pairs.weight[p] : 0.0;
        }
        shares.damaged.push_back(all > 0.0 ? damaged / all : 0.0);
        shares.touching.push_back(all > 0.0 ? touching / all : 0.0);
    }
    return shares;
}

// The factors by which loads have grown; infinite where one begins or turns round.
struct LoadRatios {
    double least = infinite;
    double most = 0.0;

    LoadRatios(std::span<const double> before, std::span<const double> now) {
        for (std::size_t p = 0; p < now.size(); ++p) {
            if (before[p] == 0.0 && now[p] == 0.0) continue;
            const double ratio = now[p] / before[p];
            least = std::min(least, ratio >= 0.0 ? ratio : 0.0);
            most = std::max(most, ratio >= 0.0 ? ratio : infinite);
        }
    }
    // True if loads have grown in proportion.
    bool proportional() const {
        constexpr double digits = 1e-9;  // of factors of histories
        return std::isfinite(most) && most - least <= digits * most;
    }
    // The factor by which what loads do together may have grown: some may have made up for others.
    double together() const { return proportional() ? most : std::max(most, 1.0 / least); }
    // Says how far loads are from having grown in proportion; 1: they have.
    double spread() const { return proportional() ? 1.0 : most / least; }
};

// Returns the factor by which the length over which an interface has lost its adhesion has grown, at least 1.
double lengthening(const RotationCheck& before, const RotationCheck& now) {
    double most = 1.0;
    for (std::size_t i = 0; i < now.damaged.size(); ++i)
        most = std::max(most, (now.damaged[i] + renewal.ignored) / (before.damaged[i] + renewal.ignored));
    return most;
}

double expected(const RotationCheck& check, const RotationCheck& now, const Measure& measure) {
    return check.value * std::pow(LoadRatios(check.loads, now.loads).together(), measure.load_power) *
           std::pow(lengthening(check, now), measure.length_power);
}

// True if nothing is known from before, or only of faces that touch elsewhere.
bool unknown(const RotationCheck& check, const RotationCheck& now) {
    if (check.loads.empty() || check.loads.size() != now.loads.size() || check.damaged.size() != now.damaged.size() ||
        check.touching.size() != now.touching.size())
        return true;
    for (std::size_t i = 0; i < now.touching.size(); ++i)
        if (std::abs(now.touching[i] - check.touching[i]) > renewal.touching) return true;
    return false;
}

// True if the measure may have come so far from where it was known last that it must be computed.
bool may_count(const RotationCheck& check, const RotationCheck& now, const Measure& measure) {
    return unknown(check, now) || lengthening(check, now) > renewal.longer ||
           !(expected(check, now, measure) < check.value + renewal.way * (measure.counts - check.value));
}

// Returns by which factor the relief of rotations may differ from what is known of it: loads in proportion move the
// bodies in proportion, and further displacements relieve strains over the length that has come off.
double doubt(const RotationCheck& check, const RotationCheck& now) {
    if (unknown(check, now)) return infinite;
    const double factor = lengthening(check, now) * LoadRatios(check.loads, now.loads).spread();
    return factor * factor;
}

// Returns the share of the energy that small rotations leave out: what it is at most, where that does not count, or
// what it is with the relief that is known.
double energy_left_out(Observer& observer, RotationCheck& relief, const RotationCheck& under_loads, double rotation) {
    const std::shared_ptr<SmallRotations> small = observer.small_rotations(observer.state());
    auto [work, unrelieved] = small->energy();
    if (!std::isfinite(work + unrelieved)) work = unrelieved = 0.0;  // squares of tiny loads are 0
    const double of_strains = 0.5 * rotation * rotation;
    if (work + unrelieved <= of_energy.counts) return std::max(of_strains, work + unrelieved);
    if (const double factor = doubt(relief, under_loads);
        !(work + factor * relief.value * unrelieved <= of_energy.counts)) {
        relief = under_loads;
        relief.value = small->unrelieved_share();
    }
    return std::max(of_strains, work + relief.value * unrelieved);
}

// Computes a measure where it may count; returns its value, or what it is at most.
double renewed(RotationCheck& check, RotationCheck now, const Measure& measure, const std::function<double()>& value) {
    if (!may_count(check, now, measure)) return expected(check, now, measure);
    const double known = value();
    now.value = std::isfinite(known) ? std::max(known, 0.0) : 0.0;
    check = std::move(now);
    return check.value;
}

}  // namespace

std::string judge_rotations(Observer& observer, const State& before, State& next) {
    next.rotations = before.rotations;
    if (!(next.ledger.stored_bulk > 0.0)) return {};
    RotationChecks& checks = next.rotations;
    RotationCheck under_loads = shares_of(*observer.problem().mesh, observer.pairs(), next);
    RotationCheck turned = under_loads;
    under_loads.loads = next.theta;
    turned.loads = {
        renewed(checks.rotation, under_loads, of_rotation, [&] { return observer.largest_rotation(next); })};
    // The rotation costs no factorisation, and tells more of the energy than the loads do.
    if (may_count(checks.energy, turned, of_energy)) {
        checks.rotation = under_loads;
        turned.loads = {checks.rotation.value = observer.largest_rotation(next)};
    }
    if (turned.loads.front() > of_rotation.counts) return text("cells rotate by up to ", turned.loads.front(), " rad");
    const double energy = renewed(checks.energy, turned, of_energy, [&] {
        return energy_left_out(observer, checks.relief, under_loads, turned.loads.front());
    });
    if (energy > of_energy.counts) return text("small rotations leave out about ", 100.0 * energy, " % of the energy");
    const double stresses = renewed(checks.stresses, under_loads, of_stresses,
                                    [&] { return observer.small_rotations(next)->buckling_ratio(); });
    if (stresses > of_stresses.counts)
        return text("the stresses are ", stresses, " of those at which the bodies buckle");
    return {};
}

}  // namespace delam
