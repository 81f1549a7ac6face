// SPDX-License-Identifier: BSD-3-Clause
// One load step, followed in parts at the fixed load of its end. If the toughness depends on the mode, the energy that
// a pair dissipates depends on its path. The iterates of a minimisation are no such path in a jump of the state, or in
// a step that moves a front by more than its process zone. Each part is an incremental minimisation from the state that
// the part before has reached. It bounds the share of its toughness that a pair may dissipate (option path_step; more
// where few pairs soften at once). The path ends where no pair reaches this bound (M. Efendiev, A. Mielke, J. Convex
// Anal. 13, 2006; D. Knees, M. Negri, M3AS 27, 2017). The dissipated energy is that of every pair along the jumps that
// it meets (increment/path_dissipation.hpp).
//
// If no pair reaches the bound, the path has one part. If all loaded pairs have the same toughness (one mode), the path
// does not matter, and the step is not bounded. If they differ at the end of the step, the step is followed in parts
// after all. A law that debonds at once (Griffith's) is not bounded either.
//
// Where a minimisation that follows the mixities would find no rest (it is stable at none of the mixities that its own
// states show), the parts from there on keep the mixities with which they begin, until a part ends with those that it
// began with, or nearly. Such a state lies on or below the threshold of each pair.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "evolution/increment/rule/step_rule.hpp"
#include "evolution/path/within_step.hpp"
#include "evolution/search/fronts.hpp"

namespace delam {

PathPoint path_point(const PairLaws& pairs, const PairGraph& graph, const State& state, double dissipated);

class InnerPath {
public:
    // A minimisation of an increment from a state whose displacements may be known (`displaced`); whether it converged.
    using Minimise = std::function<bool(State& state, StepRule& increment, bool displaced)>;
    // An increment from a state, with these mixities and largest share.
    using Make = std::function<std::unique_ptr<StepRule>(const State& before, const PairMixities& mixity, double)>;

    // Sees the state after each part, and what has been dissipated until then. False: far enough.
    using Watch = std::function<bool(const State& state, const Dissipation& dissipated)>;

    InnerPath(const PairLaws& pairs, const PairGraph& graph, double stride, Make make, Minimise minimise)
        : pairs_(pairs), graph_(graph), stride_(stride), make_(std::move(make)), minimise_(std::move(minimise)) {}

    // Follows the step in parts, from the adhesion and mixity of `next`, which has the load of the end of the step;
    // `step` begins at the state before. begun: what the step has dissipated down to this adhesion; none: at these
    // mixities. displaced: the displacements of `next` are those of its adhesion. last: jumps
    // at the state from which a part has led to the one before the step; empty: not known. False: a part did not
    // converge.
    bool follow(State& next, const StepRule& step, const Dissipation* begun = nullptr, const Watch& watch = {},
                bool displaced = false, std::span<const double> last = {});
    // True if all pairs that are damaged in part, or nearly loaded to their onset, have the same toughness at these
    // mixities, or if there are no such pairs. before: pairs that were damaged since then count, too, at the mixities
    // that they show now.
    bool one_mode(const State& at, const PairMixities& mixity, const State* before) const;
    // Minimises in one part, without the bound of a part.
    bool minimise(State& next, StepRule& increment, bool displaced) const {
        return minimise_(next, increment, displaced);
    }
    // The energy that the step has dissipated in all parts, including that of its start, F L.
    const Dissipation& dissipated() const { return dissipated_; }
    // True if the path began at a state that is not the one before the step.
    bool started_elsewhere() const { return started_elsewhere_; }
    // The states reached by the parts, without the state before the step.
    const std::vector<PathPoint>& points() const { return points_; }

private:
    double bound(const State& at, const PairMixities& mixity) const;
    bool part(const State& at, State& next, bool displaced);
    void record(const State& at, const State& next);

    const PairLaws& pairs_;
    const PairGraph& graph_;
    double stride_;
    Make make_;
    Minimise minimise_;
    bool started_elsewhere_ = false;
    bool bounded_ = false;      // a part of this path has needed its bound: so do those that follow
    bool lags_ = false;         // mixities do not settle in a part of this path: they lag behind by one
    bool stopped_ = false;      // the last part, by its bound
    std::vector<double> last_;  // jumps at the state before the last part
    Dissipation dissipated_;
    std::vector<PathPoint> points_;
};

}  // namespace delam
