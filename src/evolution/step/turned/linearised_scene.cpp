// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/turned/linearised_scene.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "delam/delam.h"

namespace delam {

State extended(const State& state, std::size_t patterns) {
    State own = state;
    own.theta.resize(patterns + 1, 0.0);
    own.response.conjugate.resize(patterns + 1, 0.0);
    own.response.multipliers.clear();
    own.memory.clear();
    own.search_memory.clear();
    own.search_energies.clear();
    return own;
}

// The first stiffness decides how the operator is cut into pieces, and with it the last digits. It is that of no
// displacements, whichever state an analysis that goes on begins with. Loose parts move about where they are: their
// scene is a new one with every stiffness.
void LinearisedScene::begin(const TurnedPoint& point, std::span<const double> at, std::size_t rows) {
    linear_.reset();
    linear_ = std::make_unique<Linear>(Linear{op_.scene(point), !point.loose.empty(), nullptr, {}, {}, {}});
    const std::vector<double> zero(op_.dofs(), 0.0);
    if (!point.loose.empty() || std::ranges::equal(at, zero)) return;
    const std::vector<double> unloaded(problem_.patterns.size(), 0.0), no_force(rows, 0.0);
    (void)about({zero, {}, {}, TurnedCell::Stresses::left_out, unloaded}, zero, no_force);
}

Stepper& LinearisedScene::about(const TurnedPoint& point, std::span<const double> at,
                                std::span<const double> row_force) {
    if (!linear_ || ((linear_->loose || !point.loose.empty()) && linear_->about != point))
        begin(point, at, row_force.size());
    Linear& linear = *linear_;
    take_histories();
    const bool turned = linear.about == point;
    if (turned && std::ranges::equal(linear.at, at) && std::ranges::equal(linear.row_force, row_force))
        return *linear.stepper;
    linear.about = {};
    if (!turned) op_.turn(linear.scene, point);
    op_.load(linear.scene, at, row_force);
    renewed(turned ? Renewed::loads : Renewed::all);
    if (linear.loose) linear.stepper->keep_places(places_);
    linear.about = point;
    linear.at.assign(at.begin(), at.end());
    linear.row_force.assign(row_force.begin(), row_force.end());
    return *linear.stepper;
}

// Frames that turn may let rows share unknowns that they had for themselves.
State LinearisedScene::resumed(State from) const {
    try {
        if (!from.memory.empty()) linear_->stepper->op().require_memory(from.memory);
    } catch (const Error& error) {
        if (error.status() != DELAM_ERROR_SNAPSHOT) throw;
        from.memory.clear();
    }
    return from;
}

void LinearisedScene::take_histories() {
    for (std::size_t p = 0; p < problem_.patterns.size(); ++p) {
        const Pattern& now = problem_.patterns[p];
        Pattern& own = linear_->scene.problem.patterns[p];
        if (own.times != now.times || own.values != now.values) own = now;
    }
}

Stepper& LinearisedScene::under(std::span<const double> force) {
    linear_->at.clear();
    op_.load_forces(linear_->scene, force);
    return renewed(Renewed::loads);
}

Stepper& LinearisedScene::renewed(Renewed what) {
    if (!linear_->stepper || !linear_->stepper->renew(what)) {
        linear_->stepper.reset();
        linear_->stepper = std::make_unique<Stepper>(linear_->scene.problem, monitor_, Stepper::Checks::made_before);
    }
    return *linear_->stepper;
}

}  // namespace delam
