// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/analysis/rotation_watch.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "evolution/minimise/proportional_loads.hpp"

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
// twice of this and of the next two turn enf, dcb-elastica and blister in the same steps.)
constexpr double negligible = 0.1 * turning_share;
// At fixed damage and contact stresses are in proportion to loads that are; damage makes free parts longer. The ratio
// is computed anew where the estimate comes this near, and where the debonded part of an interface has grown by this
// much of it.
constexpr double safety = 0.5, grown = 0.02;

// Returns the debonded share of each interface.
std::vector<double> debonded_shares(const Mesh& mesh, const PairLaws& pairs, const State& state) {
    std::vector<double> shares;
    std::size_t p = 0;
    for (const InterfaceGeometry& interface : mesh.interfaces()) {
        double sum = 0.0, all = 0.0;
        for (std::int64_t i = 0; i < interface.pair_count(); ++i, ++p) {
            if (pairs.law[p] == nullptr) continue;
            all += pairs.weight[p];
            sum += pairs.weight[p] * (1.0 - state.adhesion[p]);
        }
        shares.push_back(all > 0.0 ? sum / all : 0.0);
    }
    return shares;
}

}  // namespace

double RotationWatch::buckling_ratio(Observer& observer, const State& state) {
    if (!(state.ledger.stored_bulk > 0.0)) return 0.0;
    Known now{0.0, state.theta, state.closed, debonded_shares(*observer.problem().mesh, observer.pairs(), state)};
    if (known_ && known_->closed == now.closed) {
        double most = 0.0;
        for (std::size_t i = 0; i < now.debonded.size(); ++i)
            most = std::max(most, std::abs(now.debonded[i] - known_->debonded[i]));
        const std::optional<double> part = load_ratio(known_->theta, now.theta);
        if (most <= grown && part && known_->ratio < safety * turning_ratio * *part) return known_->ratio / *part;
    }
    known_.reset();
    now.ratio = observer.buckling_ratio(state);
    const double ratio = now.ratio;
    if (std::isfinite(ratio)) known_ = std::move(now);
    return ratio;
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
