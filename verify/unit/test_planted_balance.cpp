// SPDX-License-Identifier: BSD-3-Clause
// Errors planted between a step and the energy balance of a path along the load: what it leaves open shows each of
// them. A double stands around the stepper; the file that follows the load is compiled once more here, with the double
// in the stepper's place, so that the library has no hook for it.
#include <algorithm>
#include <cmath>

#include "base/monitor.hpp"
#include "check.hpp"
#include "evolution/minimise/proportional_loads.hpp"
#include "evolution/step/growth_events.hpp"
#include "evolution/step/load_path.hpp"
#include "evolution/step/step_control.hpp"
#include "evolution/step/stepper.hpp"
#include "flexure.hpp"
#include "scene/advice/process_zone.hpp"
#include "scene/check/step_control.hpp"

namespace delam {

namespace {

enum class Fault { none, sign_of_a_reaction, lost_part, held_mixity, cut_jump };

// Answers as the stepper does, but for the planted error.
class FaultyStepper {
public:
    using Result = Stepper::Result;

    FaultyStepper(Stepper& stepper, Fault fault) : stepper_(stepper), fault_(fault) {}

    Result step(const State& before, double time, std::span<const Stepper::Start> also, double stride) {
        Result result = stepper_.step(before, time, also, stride);
        State& next = result.state;
        if (first_mixity_.shear.empty()) first_mixity_ = next.mixity;
        // Errors of a tenth of the way.
        const bool now = time > 0.55 && time < 0.65;
        if (fault_ == Fault::sign_of_a_reaction && now) next.response.conjugate[0] *= -1.0;
        if (fault_ == Fault::lost_part && now) next.ledger.dissipated = before.ledger.dissipated;
        if (fault_ == Fault::held_mixity)
            next.ledger.dissipated =
                before.ledger.dissipated + dissipation(stepper_.pairs(), first_mixity_, before.adhesion, next.adhesion);
        if (fault_ == Fault::cut_jump) cut(before, next);
        return result;
    }
    double held_rise(const State& state, std::span<const double> theta) const {
        return stepper_.held_rise(state, theta);
    }
    std::vector<double> factors(double time) const { return stepper_.factors(time); }
    bool one_mode(const State& before, const State& after) { return stepper_.one_mode(before, after); }
    const PairLaws& pairs() const { return stepper_.pairs(); }
    const std::vector<double>& initial_adhesion() const { return stepper_.initial_adhesion(); }

private:
    // The state after half of a jump, with the dissipated energy of the whole.
    void cut(const State& before, State& next) {
        std::vector<std::size_t> debonded;
        for (std::size_t p = 0; p < next.adhesion.size(); ++p)
            if (before.adhesion[p] > 0.0 && !(next.adhesion[p] > 0.0)) debonded.push_back(p);
        if (debonded.size() < 4) return;
        std::vector<double> half = next.adhesion;
        for (std::size_t i = debonded.size() / 2; i < debonded.size(); ++i)
            half[debonded[i]] = before.adhesion[debonded[i]];
        const State there = stepper_.equilibrate(before, next.time, half).state;
        next.adhesion = there.adhesion;
        next.response = there.response;
        next.closed = there.closed;
        next.ledger.stored_bulk = there.ledger.stored_bulk;
        next.ledger.stored_interface = there.ledger.stored_interface;
    }

    Stepper& stepper_;
    Fault fault_;
    PairMixities first_mixity_;
};

}  // namespace

}  // namespace delam

#define Stepper FaultyStepper
#define followed_step faulty_step
#define follows_load faulty_control
#include "evolution/step/load_path.cpp"
#undef Stepper
#undef followed_step
#undef follows_load

using namespace delam;

namespace {

constexpr std::int64_t steps = 20;

// Three-point bending in which the crack jumps, in one mode.
Problem jumping() {
    unit::Flexure f;
    f.along = 120;
    f.through = 2;
    f.law.normal_stiffness = f.law.tangential_stiffness = 1e14;
    f.law.normal_onset = f.law.tangential_onset = 2.0;
    return unit::make_flexure(f);
}

// Single-leg bending: the upper arm alone is held at the notched end. The crack grows in mixed mode.
Problem mixed() {
    unit::Flexure f;
    f.along = 120;
    f.through = 2;
    f.notch = 0.045;
    f.law.normal_stiffness = f.law.tangential_stiffness = 1e13;
    f.law.normal_onset = 1.0;
    f.law.tangential_onset = 4.0;
    f.law.normal_toughness = 100.0;
    f.law.tangential_toughness = 400.0;
    f.law.set_criterion(Criterion::benzeggagh_kenane);
    Problem problem = unit::make_flexure(f);
    const Mesh& mesh = *problem.mesh;
    const InterfaceGeometry& face = mesh.interfaces()[0];
    for (Constraint& c : problem.constraints) {
        const auto at = mesh.node(c.dof[0] / 2);
        if (at[0] > 1e-9 || c.dof[0] % 2 == 0) continue;
        for (std::size_t p = 0; p < face.node_a.size(); ++p)
            if (mesh.node(face.node_a[p])[0] < 1e-9) c.dof[0] = 2 * std::max(face.node_a[p], face.node_b[p]) + 1;
    }
    return problem;
}

struct Balance {
    double dissipated = 0.0;
    double open = 0.0;  // after a step at most, over the dissipated energy
    std::size_t jumps = 0;
};

// Follows a scene and compares the path without an error with the library's own.
Balance follow(Problem problem, Fault fault) {
    problem.options.step_control = "load";
    problem.options.path_step = used_step_control(problem, problem.options).path_step;
    Monitor monitor;
    Stepper stepper(problem, monitor);
    const PairGraph graph(problem.mesh->interfaces());
    FaultyStepper faulty(stepper, fault);
    State at = stepper.initial(0.0).state;
    Balance balance;
    double open = 0.0;
    for (std::int64_t k = 1; k <= steps; ++k) {
        const double time = static_cast<double>(k) / steps;
        ControlledStep step = faulty_step(faulty, graph, at, time, problem.options, 0.0);
        balance.jumps += step.jumps.size();
        State next = std::move(step.result.state);
        if (fault == Fault::none) {
            const Ledger own = followed_step(stepper, graph, at, time, problem.options).result.state.ledger;
            ck_assert(own.work == next.ledger.work && own.dissipated == next.ledger.dissipated);
        }
        at = std::move(next);
        open = std::max(open, std::abs(at.ledger.defect()));
        balance.dissipated = std::max(balance.dissipated, at.ledger.dissipated);
    }
    balance.open = open / balance.dissipated;
    return balance;
}

struct Planted {
    Problem (*scene)();
    Fault fault;
};
constexpr Planted planted[] = {{mixed, Fault::sign_of_a_reaction},
                               {mixed, Fault::lost_part},
                               {mixed, Fault::held_mixity},
                               {jumping, Fault::sign_of_a_reaction},
                               {jumping, Fault::cut_jump}};

}  // namespace

TEST(without_an_error_the_balance_closes) {
    for (Problem (*scene)() : {mixed, jumping}) {
        const Balance balance = follow(scene(), Fault::none);
        ck_assert(balance.dissipated > 0.5);
        ck_assert_uint_eq(balance.jumps, scene == jumping ? 1 : 0);
        ck_assert_msg(balance.open < Options{}.accuracy, "open: %g of the dissipated energy", balance.open);
    }
}

LOOP_TEST(an_error_is_open, 0, std::size(planted)) {
    const Planted& error = planted[loop];
    const Balance balance = follow(error.scene(), error.fault);
    ck_assert_msg(balance.open > 3.0 * Options{}.accuracy, "open: %g of the dissipated energy", balance.open);
}
