// SPDX-License-Identifier: BSD-3-Clause
#include "scene/stage.hpp"

#include <algorithm>
#include <limits>

#include "base/numbers.hpp"

namespace delam {

namespace {

bool holds(const Constraint& constraint, double time) {
    return !(constraint.begin && constraint.begin->time > time) && !(constraint.end && constraint.end->time <= time);
}

}  // namespace

std::vector<double> changes_of(const Problem& problem) {
    std::vector<double> times;
    for (const Constraint& constraint : problem.constraints)
        for (const auto& change : {constraint.begin, constraint.end})
            if (change) times.push_back(change->time);
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

bool may_turn(const Problem& problem) { return problem.options.kinematics == "auto"; }

double next_change(const Problem& problem, double time) {
    const std::vector<double> times = changes_of(problem);
    const auto next = std::upper_bound(times.begin(), times.end(), time);
    return next == times.end() ? std::numeric_limits<double>::infinity() : *next;
}

bool has_stages(const Problem& problem, double after) { return next_change(problem, after) < infinite; }

std::vector<std::int64_t> constraints_from(const Problem& problem, double time) {
    std::vector<std::int64_t> held;
    for (std::size_t c = 0; c < problem.constraints.size(); ++c)
        if (holds(problem.constraints[c], time)) held.push_back(static_cast<std::int64_t>(c));
    return held;
}

Problem scene_from(const Problem& problem, double time) {
    const std::vector<double> none(problem.constraints.size(), 0.0);
    return scene_of(problem, {time, none, none});
}

Problem scene_of(const Problem& problem, const Stage& stage) {
    Problem scene = problem;
    if (may_turn(problem)) scene.options.kinematics = stage.rotates ? "corotational" : "linear";
    if (changes_of(problem).empty()) return scene;
    scene.constraints.clear();
    scene.constraint_number = constraints_from(problem, stage.from);
    scene.constraint_total = static_cast<std::int64_t>(problem.constraints.size());
    for (const std::int64_t c : scene.constraint_number) {
        Constraint own = problem.constraints[index(c)];
        if (own.begin && stage.offset[index(c)] != 0.0) {
            own.prescribed.resize(std::max(own.prescribed.size(), index(own.begin->pattern) + 1), 0.0);
            own.prescribed[index(own.begin->pattern)] += stage.offset[index(c)];
        }
        own.begin.reset();
        own.end.reset();
        scene.constraints.push_back(std::move(own));
    }
    for (std::size_t c = 0; c < problem.constraints.size(); ++c) {
        const Constraint& ended = problem.constraints[c];
        for (std::size_t i = 0; stage.force[c] != 0.0 && i < ended.dof.size(); ++i)
            scene.forces.push_back({ended.end->pattern, ended.dof[i], ended.coefficient[i] * stage.force[c]});
    }
    return scene;
}

}  // namespace delam
