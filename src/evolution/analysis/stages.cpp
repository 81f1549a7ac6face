// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/analysis/stages.hpp"

#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "evolution/analysis/snapshot.hpp"

namespace delam {

namespace {

// True if supports begin or end at the committed time, which is the end of this stage.
bool over(const Solver& now) {
    const StageOf* stage = now.stage();
    return stage != nullptr && now.states().pending() == nullptr && now.states().committed().time == stage->until;
}

// Returns the coefficient of a pattern whose part of an equation is this at the present factor.
double coefficient(const Solver& now, std::int64_t pattern, double part) {
    const double factor = now.states().committed().theta[index(pattern)];
    if (part == 0.0) return 0.0;
    if (factor == 0.0)
        fail(DELAM_ERROR_PROBLEM, "pattern '", now.problem().patterns[index(pattern)].name,
             "' has the factor 0 at time ", now.states().committed().time,
             ", at which a support that it belongs to begins or ends, must not be 0");
    return part / factor;
}

std::shared_ptr<Solver> next_stage(Solver& now) {
    const StageOf& old = *now.stage();
    const std::vector<Constraint>& constraints = old.whole->constraints;
    const State& at = now.states().committed();
    const std::vector<double> displacement = now.observer().displacement(at);
    const std::vector<double> reaction = now.stepper().op().reaction(at.theta, at.response);
    StageOf next{old.whole, old.stage, next_change(*old.whole, at.time)};
    next.stage.from = at.time;
    for (std::size_t c = 0; c < constraints.size(); ++c) {
        const Constraint& own = constraints[c];
        if (!own.begin || own.begin->time != at.time) continue;
        double missing = 0.0;  // left-hand side less right-hand side
        for (std::size_t i = 0; i < own.dof.size(); ++i)
            missing += own.coefficient[i] * displacement[index(own.dof[i])];
        for (std::size_t p = 0; p < own.prescribed.size(); ++p) missing -= own.prescribed[p] * at.theta[p];
        next.stage.offset[c] = coefficient(now, own.begin->pattern, missing);
    }
    // Rounding leaves reactions that would push a part that nothing holds any more.
    const double rounding = now.stepper().contact().rounding_of_forces(at.theta, at.response.jump);
    for (std::size_t k = 0; k < reaction.size(); ++k) {
        if (std::abs(reaction[k]) <= rounding) continue;
        const std::size_t c = index(now.problem().number_of(k));
        const Constraint& own = constraints[c];
        if (own.end && own.end->time == at.time) next.stage.force[c] = coefficient(now, own.end->pattern, reaction[k]);
    }
    try {
        return std::make_shared<Solver>(std::move(next), now, displacement);
    } catch (const Error& error) {
        if (error.status() != DELAM_ERROR_PROBLEM) throw;
        fail(error.status(), "from time ", at.time, " on, where supports begin or end: ", error.what());
    }
}

// Returns the solver that goes on with large rotations from where this one has come to.
std::shared_ptr<Solver> turned_stage(Solver& now) {
    StageOf next = *now.stage();
    next.stage.rotates = true;
    return std::make_shared<Solver>(std::move(next), now, now.observer().displacement(now.states().committed()));
}

}  // namespace

// A step in which small rotations leave out too much is taken once more, with large ones.
Outcome Stages::advance(std::shared_ptr<Solver>& now, double time) {
    std::shared_ptr<Solver> next = over(*now) ? next_stage(*now) : now;
    Outcome outcome = next->advance(time);
    if (outcome.outgrown) {
        next->rollback();
        next = turned_stage(*next);
        outcome = next->advance(time);
    }
    if (next != now) before_ = std::exchange(now, next);
    return outcome;
}

void Stages::commit(std::shared_ptr<Solver>& now) {
    now->commit();
    before_.reset();
}

void Stages::rollback(std::shared_ptr<Solver>& now) {
    now->rollback();
    if (before_ != nullptr) now = std::exchange(before_, nullptr);
}

void Stages::load(std::shared_ptr<Solver>& now, std::span<const std::uint8_t> bytes) {
    std::shared_ptr<Solver> own = now;
    if (const std::optional<Stage> stage = stage_in(*now, bytes); stage && *stage != now->stage()->stage)
        own = std::make_shared<Solver>(
            StageOf{now->stage()->whole, *stage, next_change(*now->stage()->whole, stage->from)}, *now,
            std::span<const double>());
    delam::load(*own, bytes);
    now = std::move(own);
    before_.reset();
}

void Stages::load_file(std::shared_ptr<Solver>& now, const std::string& path) { load(now, read_snapshot(*now, path)); }

}  // namespace delam
