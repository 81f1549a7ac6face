// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/analysis/rotation_watch.hpp"

#include <cmath>

#include "base/error.hpp"

namespace delam {

namespace {

// A run with small rotations warns of the same (bindings/cli/src/result/closing/rotations.cpp). Half and twice of the
// three (`delam run --set solver.kinematics=auto`) turn examples/enf in steps 6 and 36 instead of 18, dcb-elastica in 3
// and 8 instead of 6, blister in 1 and 3 instead of 2, and peel in 1: in the end energies that are dissipated differ by
// 7e-6 at most, and loads by 1e-6.
constexpr double turning_rotation = 0.1;  // rad
constexpr double turning_share = 0.005;   // of the energy of the bodies
constexpr double turning_ratio = 0.1;     // of the critical stresses: bending grows by 1 / (1 - ratio)
// Energies that rotations add at most, below which nothing is factorised: a part of the share that counts. (Half and
// twice only factorise more and less often.)
constexpr double negligible = 0.5 * turning_share;
// At fixed damage stresses are in proportion to the load, as long as contact does not change; damage makes free parts
// longer. The ratio is computed anew where the estimate comes this near, and where the debonded part has grown by this
// much of all. (Half and twice: as above.)
constexpr double safety = 0.5, grown = 0.02;

double debonded_share(const PairLaws& pairs, const State& state) {
    double sum = 0.0, all = 0.0;
    for (std::size_t p = 0; p < state.adhesion.size(); ++p) {
        if (pairs.law[p] == nullptr) continue;
        all += pairs.weight[p];
        sum += pairs.weight[p] * (1.0 - state.adhesion[p]);
    }
    return all > 0.0 ? sum / all : 0.0;
}

}  // namespace

double RotationWatch::buckling_ratio(Observer& observer, const State& state) {
    const double energy = state.ledger.stored_bulk, debonded = debonded_share(observer.pairs(), state);
    if (!(energy > 0.0)) return 0.0;
    if (known_ && std::abs(debonded - debonded_) <= grown) {
        const double estimate = ratio_ * std::sqrt(energy / energy_);
        if (estimate < safety * turning_ratio) return estimate;
    }
    ratio_ = observer.buckling_ratio(state);
    energy_ = energy;
    debonded_ = debonded;
    known_ = std::isfinite(ratio_);
    return ratio_;
}

std::string RotationWatch::judge(Observer& observer, const State& state) {
    const double rotation = observer.largest_rotation(state);
    if (rotation > turning_rotation) return text("cells rotate by up to ", rotation, " rad");
    const double error = observer.rotation_error(state, negligible);
    if (error > turning_share) return text("small rotations leave out about ", 100.0 * error, " % of the energy");
    const double ratio = buckling_ratio(observer, state);
    if (ratio > turning_ratio) return text("the stresses are ", ratio, " of those at which the bodies buckle");
    return {};
}

}  // namespace delam
