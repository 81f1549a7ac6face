// SPDX-License-Identifier: BSD-3-Clause
#include "analysis.hpp"

#include "clock.hpp"

namespace bench {
namespace {

// Cancels a call of the library when its time is over.
class Deadline {
public:
    Deadline(const reference::Scene& scene, double seconds) : scene_(&scene), seconds_(seconds) {
        REQUIRE(scene, delam_context_set_progress, scene.context(), &Deadline::ask, this);
    }
    ~Deadline() { delam_context_set_progress(scene_->context(), nullptr, nullptr); }
    Deadline(const Deadline&) = delete;
    Deadline& operator=(const Deadline&) = delete;

private:
    static std::int32_t ask(const char*, std::int64_t, std::int64_t, void* user) {
        const auto* self = static_cast<const Deadline*>(user);
        return self->clock_.seconds() > self->seconds_ ? 1 : 0;
    }
    const reference::Scene* scene_;
    double seconds_;
    Clock clock_;
};

StepRecord read(const reference::Solver& solver, std::int32_t status) {
    const auto whole = [&](const char* key) { return static_cast<std::int64_t>(solver.value(key)); };
    StepRecord r;
    r.time = solver.value("time");
    r.load = solver.value("load:press");
    r.reaction = solver.value("reaction:press");
    r.stored_bulk = solver.value("stored_bulk");
    r.stored_interface = solver.value("stored_interface");
    r.dissipated = solver.value("dissipated");
    r.damage_change = solver.value("damage_change");
    r.am_iterations = whole("am_iterations");
    r.displacement_solves = whole("displacement_solves");
    r.contact_iterations = whole("contact_iterations");
    r.linear_iterations = whole("linear_iterations");
    r.status = status;
    return r;
}

// A value that an older library may not have.
double optional_value(const reference::Solver& solver, const char* key) {
    double value = -1.0;
    return delam_solver_value(solver.get(), key, &value) == DELAM_OK ? value : -1.0;
}

}  // namespace

const std::vector<Method>& methods() {
    static const std::vector<Method> list = {{"baseline", nullptr, nullptr},
                                             {"feti", "feti", "accelerated"},
                                             {"condensed", "condensed", "alternate"},
                                             {"accelerated", "condensed", "accelerated"}};
    return list;
}

const std::vector<Method>& concepts() {
    static const std::vector<Method> list = {{"local", "condensed", "accelerated"},
                                             {"backtracking", "condensed", "accelerated", "local", "on"},
                                             {"energetic", "condensed", "accelerated", "energetic"}};
    return list;
}

const Method& find_method(const std::string& key) {
    for (const auto* list : {&methods(), &concepts()}) {
        for (const Method& m : *list) {
            if (key == m.key) return m;
        }
    }
    throw reference::Failure(0, "method '" + key +
                                    "' is not known: baseline, feti, condensed, accelerated, local, backtracking, "
                                    "energetic");
}

std::optional<Choice> resolve(Stage& stage, const Method& method, double delta, std::string& refusal) {
    const Choice full{method.reduction, method.minimisation, delta, method.solution, method.backtracking};
    if (declare(stage, full, &refusal)) return full;
    const std::string reduction = method.reduction;
    const std::string minimisation = method.minimisation;
    std::string unused;
    Choice less = full;
    if (reduction == "feti" && !declare(stage, {method.reduction, nullptr, delta}, &unused)) less.reduction = nullptr;
    if (minimisation == "alternate" && !declare(stage, {nullptr, method.minimisation, delta}, &unused))
        less.minimisation = nullptr;
    if (declare(stage, less, &refusal)) return less;
    return std::nullopt;
}

Analysis run_library(Stage& stage, const Choice& choice, double cap,
                     const std::function<void(reference::Solver&, int)>& at_step) {
    Analysis analysis;
    const Deadline deadline(stage.scene, cap);
    const ProcessorClock processor;
    Clock clock;
    std::string refusal;
    if (!declare(stage, choice, &refusal)) throw reference::Failure(0, refusal);
    REQUIRE(stage.scene, delam_problem_check, stage.scene.problem());
    analysis.setup = clock.lap();
    std::optional<reference::Solver> solver;
    try {
        solver.emplace(stage.scene, 0.0);
    } catch (const reference::Failure& failure) {
        if (failure.status() != DELAM_CANCELLED) throw;
        analysis.factor = clock.lap();
        analysis.capped = true;
        return analysis;
    }
    analysis.factor = clock.lap();
    for (int k = 1; k <= stage.data.steps; ++k) {
        clock.lap();
        const std::int32_t status = solver->advance(step_time(stage.data, k));
        if (status == DELAM_CANCELLED) {
            analysis.iterate += clock.lap();
            analysis.capped = true;
            break;
        }
        if (status < 0) stage.scene.require(status, "delam_solver_advance");
        solver->commit();
        const double seconds = clock.lap();
        analysis.iterate += seconds;
        analysis.steps.push_back(read(*solver, status));
        analysis.steps.back().seconds = seconds;
        analysis.processor = processor.seconds();
        if (at_step) at_step(*solver, k);
    }
    analysis.bulk_factorisations = optional_value(*solver, "bulk_factorisations");
    analysis.field_recoveries = optional_value(*solver, "field_recoveries");
    analysis.plan = delam_solver_plan(solver->get());
    return analysis;
}

Analysis run_baseline(Stage& stage, const BaselineOptions& options, double cap, std::int64_t pricing,
                      BaselineTimes* times, const std::function<void(Baseline&, int)>& at_step) {
    Analysis analysis;
    const Clock whole;
    Clock clock;
    if (!declare(stage, {nullptr, nullptr, options.delta})) throw reference::Failure(0, "baseline: scene refused");
    REQUIRE(stage.scene, delam_problem_check, stage.scene.problem());
    analysis.setup = clock.lap();
    Baseline baseline(stage.scene, stage.data.law, stage.adhesion, options);
    analysis.factor = clock.lap();
    const auto stop = [&] { return whole.seconds() > cap || (pricing > 0 && baseline.factorisations() > pricing); };
    for (int k = 1; k <= stage.data.steps; ++k) {
        clock.lap();
        const auto record = baseline.advance(step_time(stage.data, k), stop);
        analysis.iterate += clock.lap();
        if (!record) {
            analysis.capped = true;
            break;
        }
        analysis.steps.push_back(*record);
        if (at_step) at_step(baseline, k);
    }
    analysis.bulk_factorisations = static_cast<double>(baseline.factorisations());
    analysis.plan = std::string("monolithic CHOLMOD, ") + (options.wide ? "64" : "32") + "-bit indices, ordering " +
                    baseline.factor().ordering() + ", " + std::to_string(baseline.system().unknowns()) + " unknowns\n";
    if (times != nullptr) *times = {baseline.factor_seconds(), baseline.solve_seconds()};
    return analysis;
}

Json counts(const Analysis& analysis) {
    StepRecord sum;
    std::int64_t refused = 0;
    std::int64_t most = 0;
    for (const StepRecord& r : analysis.steps) {
        sum.am_iterations += r.am_iterations;
        sum.displacement_solves += r.displacement_solves;
        sum.contact_iterations += r.contact_iterations;
        sum.linear_iterations += r.linear_iterations;
        most = std::max(most, r.am_iterations);
        if (r.status != DELAM_OK) ++refused;
    }
    return {{"steps", analysis.steps.size()},
            {"am_iterations", sum.am_iterations},
            {"am_iterations_worst_step", most},
            {"displacement_solves", sum.displacement_solves},
            {"active_set_steps", sum.contact_iterations},
            {"linear_iterations", sum.linear_iterations},
            {"bulk_factorisations", analysis.bulk_factorisations},
            {"field_recoveries", analysis.field_recoveries},
            {"not_converged", refused}};
}

Json history(const Analysis& analysis) {
    Json h;
    for (const char* key : {"load", "reaction", "stored_bulk", "stored_interface", "dissipated", "am_iterations"})
        h[key] = Json::array();
    for (const StepRecord& r : analysis.steps) {
        h["load"].push_back(r.load);
        h["reaction"].push_back(r.reaction);
        h["stored_bulk"].push_back(r.stored_bulk);
        h["stored_interface"].push_back(r.stored_interface);
        h["dissipated"].push_back(r.dissipated);
        h["am_iterations"].push_back(r.am_iterations);
    }
    return h;
}

}  // namespace bench
