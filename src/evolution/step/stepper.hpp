// SPDX-License-Identifier: BSD-3-Clause
// One load step: from the state before it to a state at a later time, under the requested solution concept.
//
// A step minimises  I(z, u) = E(t, u, z) + D(z_before, z)  over 0 <= z <= z_before from one or several starts and keeps
// the lowest; `local` starts from z_before, `energetic` also from the best states of a search (search.hpp).
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/monitor.hpp"
#include "evolution/derivative/sensitivity.hpp"
#include "evolution/increment/rule/mixity_rule.hpp"
#include "evolution/minimise/minimise.hpp"
#include "evolution/path/inner_path.hpp"
#include "evolution/search/search.hpp"
#include "evolution/step/bounds.hpp"
#include "reduction/choice/choose.hpp"
#include "scene/problem.hpp"

namespace delam {

class Stepper {
public:
    enum class Checks { made_here, made_before };
    // problem and monitor must outlive it. Checks the problem, and cuts and factors the bodies. other: shares the
    // bodies that this one has condensed, if they are the same (design_operator).
    Stepper(const Problem& problem, Monitor& monitor, Checks checks = Checks::made_here,
            const Stepper* other = nullptr);
    Stepper(const Stepper&) = delete;
    Stepper& operator=(const Stepper&) = delete;

    struct Result {
        State state;
        bool converged = true;
        std::string searched{};       // the candidates that the search compared; empty: there was none
        std::vector<double> along{};  // [pairs] dissipated along the path of the step, F L; empty: not known
    };
    // The initial state: displacements at the initial adhesion.
    Result initial(double time);
    // A start from another state of the same scene: its adhesion, clipped to `before`, for broken pairs the mixity with
    // which they broke, and the energy dissipated since the beginning of the analysis, F L. descends: true if the state
    // was reached from `before`, so that the difference was dissipated in between.
    struct Start {
        Start(const State& state, bool descends_)
            : descends(descends_),
              adhesion(state.adhesion),
              mixity(state.mixity),
              dissipated(state.ledger.dissipated),
              dissipated_linear(state.ledger.dissipated_linear) {}
        bool descends;
        std::vector<double> adhesion;  // [pairs]
        PairMixities mixity;
        double dissipated, dissipated_linear;
    };
    // stride: the largest share of its toughness that a pair may dissipate in a part; 0: the option path_step.
    Result step(const State& before, double time, std::span<const Start> also = {}, double stride = 0.0);
    // Displacements alone, at the state's adhesion and a time. displacement: of `before`, [mesh DOFs]; empty: that of
    // its response.
    Result equilibrate(const State& before, double time, std::span<const double> adhesion,
                       std::vector<double> displacement = {});
    // Steps that are made of those of other scenes, answering as those here do.
    struct OtherSteps {
        virtual ~OtherSteps() = default;
        virtual Result initial(double time) const = 0;
        virtual Result step(const State& before, double time, double stride) const = 0;
        virtual Result equilibrate(const State& before, double time, std::span<const double> adhesion) const = 0;
        virtual std::vector<double> tangent(const State& state) const = 0;
        virtual std::vector<double> step_tangent(const State& before, const State& state) const = 0;
    };
    // From now on others take the steps, and this operator reads the states.
    void delegate(std::unique_ptr<JumpOperator> op, std::unique_ptr<const OtherSteps> steps) {
        operator_ = std::move(op);
        other_ = std::move(steps);
        contact_.row_stiffness = operator_->row_stiffness();
    }
    // d2E / dtheta2 at the state's adhesion and contact set, [patterns][patterns].
    std::vector<double> tangent(const State& state);
    // d conjugate / d theta of a step from `before` to `state` (step_tangent.hpp).
    std::vector<double> step_tangent(const State& before, const State& state);
    // Derivatives of a state, by parameters of the laws or of the loads, to which a step from `before` has led; those
    // of `before` are in its own sensitivity.
    Sensitivity differentiate(const State& before, const State& state, std::span<const FollowedParameter> parameters);
    // From now on every state gets its derivatives by these parameters; returns those of the initial state.
    Sensitivity follow(std::vector<FollowedParameter> parameters, const State& initial);
    // Returns the excess of the lower bound of a step over its increment, relative to the larger of energy and work. If
    // it is larger than eta, a state lower than `before` exists at its own time.
    double lower_excess(const State& state) const;

    // Returns the change of the energy of a state by other load factors, with its jumps and its adhesion held.
    double held_rise(const State& state, std::span<const double> theta) const {
        return lift_.rise(theta, state, spring_stiffness(pairs_, state.adhesion), false);
    }
    std::vector<double> factors(double time) const { return problem_.factors(time); }
    // True if all pairs that soften in a step, or are nearly loaded, have the same toughness before and after it.
    bool one_mode(const State& before, const State& after) {
        return !rule_->follows_path() || inner_path().one_mode(after, after.mixity, &before);
    }
    const PairLaws& pairs() const { return pairs_; }
    const ContactScene& contact() const { return contact_; }
    const JumpOperator& op() const { return *operator_; }
    JumpOperator& op() { return *operator_; }
    // The minimisation of a step that starts from these mixities.
    std::unique_ptr<StepRule> increment(const State& before, const PairMixities& mixity) const;
    // Takes what has changed in the problem (Problem::renewed). False: it cannot, and must be made anew.
    bool renew(Renewed what) {
        if (!operator_->renew(what)) return false;
        search_.reset();
        lift();
        return true;
    }
    // Tells where the nodes were before the next step, [mesh DOFs]: free parts keep these places, not those that the
    // response of the state before tells.
    void keep_places(std::vector<double> displacement) { kept_places_ = std::move(displacement); }
    // Gives the operator the memory that it had at a state.
    void recall(const State& state) { operator_->recall(state.memory); }
    const ReductionChoice& reduction() const { return design_.choice; }
    // Its operators have been taken out.
    const Design& design() const { return design_; }
    const std::vector<double>& initial_adhesion() const { return initial_adhesion_; }
    // Warns the host about the mixity of a step; true if it did.
    bool warn(const State& state) const { return rule_->warn_of_mixity_error(monitor_, state); }

private:
    void lift();
    Minimiser minimiser();
    void begin(State& next, const State& before, double time);
    // The state from which the minimisations of a step begin; false: its elastic displacements reached a limit.
    bool start(State& next, const State& before, double time);
    InnerPath inner_path();
    // begun: what is dissipated down to the adhesion of `next`, where the step is followed in parts. displaced: the
    // displacements of `next` are those of its adhesion.
    Result minimise(State next, const StepRule& step, const Dissipation* begun = nullptr, bool displaced = false);
    void refuse_runaway(const State& state, const StepRule& step);
    void record_step(State& next, const StepRule& step, const InnerPath* path = nullptr) const;
    void keep_lower(Result& best, State other, const StepRule& step, const Dissipation* begun = nullptr);
    // Result of continue_fronts(), which is needed where the dissipated energy depends on the path: how far fronts run
    // at a larger load, and the state on this path that is lowest at the load of the step.
    struct Continuation {
        State state;  // adhesion and mixity
        Dissipation dissipated;
        PathCosts costs;                                               // of the whole way and of the step before it
        double incremental = std::numeric_limits<double>::infinity();  // I, F L
        double farthest = 0.0;                                         // dissipated at the end of the way, F L
        bool given_up = false;                                         // it lies far above the step
        std::int64_t compared = 0;                                     // states on it
    };
    Continuation continue_fronts(Result& best, const StepRule& step, double extent);
    double compare_candidates(Result& best, const SearchResult& found, const StepRule& step,
                              const std::function<bool(const Candidate&)>& known);
    void search(Result& best, const StepRule& step);

    const Problem& problem_;
    Monitor& monitor_;
    std::vector<FollowedParameter> followed_;
    PairLaws pairs_;
    std::unique_ptr<const FreeParts> parts_;
    std::optional<PlacesBefore> places_;  // of the state before the present step
    std::vector<double> kept_places_;     // empty: the state before tells
    ContactScene contact_;
    std::optional<MixityRule> rule_;  // set together with the pairs
    PairGraph graph_;
    std::vector<double> initial_adhesion_;
    std::unique_ptr<JumpOperator> operator_;
    Design design_;
    Lift lift_;
    double stride_ = 1.0;
    std::unique_ptr<JumpOperator> twin_;  // for the search, so that its zone does not disturb that of the analysis
    std::optional<Search> search_;
    std::unique_ptr<const OtherSteps> other_;  // null: its own
};

}  // namespace delam
