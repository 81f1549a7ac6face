// SPDX-License-Identifier: BSD-3-Clause
// Warns in the host's log about the steps of an analysis, once for each kind of warning.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "evolution/observe/observer.hpp"
#include "evolution/search/fronts.hpp"
#include "scene/advice/symmetry.hpp"
#include "scene/problem.hpp"

namespace delam {

class Warnings {
public:
    // Both must outlive them.
    Warnings(const Problem& problem, Monitor& monitor);
    // Warns of nothing again that the host was warned of before a stage of the analysis (scene/stage.hpp).
    void go_on_from(const Warnings& before);
    // Warns of a step whose energy lies outside its two-sided estimate, and of a ledger that does not close.
    void judge_ledger(const State& after, const Options& options);
    // Says when the adhesion loses a symmetry of the scene, once for each. Finds them at the first
    // damage.
    void judge_symmetry(const PairGraph& graph, const State& before, const State& after);
    // Warns of a front that advanced with too few pairs in its process zone.
    void judge_front(const Observer& observer, const State& before, const State& after);
    // Warns of cells whose rotation, in rad, is large for strains that are linear in the displacements.
    void judge_rotation(const State& state, double largest);
    // Says in which step the bodies buckle, and where.
    void tell_buckling(const State& state);
    // Warns of nodal forces that are poorly balanced.
    void report_balance(const std::string& what);

private:
    const Problem& problem_;
    Monitor& monitor_;
    std::optional<std::vector<Symmetry>> symmetries_;  // that have not been lost
    double least_ = 0.0, most_ = 0.0;                  // energies: of less damage than counts, and the largest so far
    bool told_of_estimate_ = false;
    bool told_of_ledger_ = false;
    bool told_of_front_ = false;
    bool told_of_rotation_ = false;
    bool told_of_balance_ = false;
};

}  // namespace delam
