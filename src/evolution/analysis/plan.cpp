// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/analysis/plan.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "base/machine/blas_threads.hpp"
#include "base/numbers.hpp"
#include "base/team.hpp"
#include "evolution/analysis/solver.hpp"
#include "evolution/step/backtrack.hpp"
#include "evolution/step/pairs_of_scene.hpp"
#include "scene/advice/scene_warnings.hpp"
#include "scene/check/kinematics.hpp"
#include "scene/check/step_control.hpp"
#include "scene/check/validate_stages.hpp"
#include "scene/stage.hpp"

namespace delam {

namespace {

constexpr const char* used = "used";
constexpr const char* left_out = "left out";

// Operations of Go and Gc at a mixity: two interaction criteria, each a few exponentials and logarithms of about 20.
constexpr double mixity_operations = 200.0;

// The data from which the items are made.
struct Basis {
    const Problem& problem;
    const ReductionChoice& choice;
    std::string description;  // of the operator
    std::string refusal;      // why it does not fit into the memory, "": it may
    std::span<const std::uint8_t> prescribed;
    const std::vector<std::shared_ptr<const GradientTerm>>& gradient;
    StepControl control;
};

// Two digits: predictions are good to a factor of two.
double rounded(double seconds) {
    if (!(seconds > 0.0)) return 0.0;
    const double unit = std::pow(10.0, std::floor(std::log10(seconds)) - 1.0);
    return unit * std::round(seconds / unit);
}

// Tells how many parts followed steps are expected to have.
PlanItem parts_of_steps(const ReductionChoice& choice) {
    const double parts = choice.parts.growth;
    if (!(parts > 0.0)) return {"parts of the steps", left_out, "steps are taken whole", 0.0, 0.0, "s"};
    return {"parts of the steps",
            used,
            text("predicted: ", std::round(parts), " in all steps together, if ", expected_share,
                 " of the pairs that adhere break, which nobody knows beforehand; twice as many take twice as long"),
            parts * choice.own().part / nominal_rate,
            0.0,
            "s"};
}

void add_realisations(std::vector<PlanItem>& items, const Basis& basis) {
    const ReductionChoice& choice = basis.choice;
    const std::string words = text(choice.forced ? "set by " : "chosen by predicted cost and memory: ", choice.reason);
    const struct {
        Realisation realisation;
        const char *subject, *name;
        const ReductionCost& cost;
    } all[] = {{Realisation::condensed, "condensed operator", "the condensed operator", choice.condensation},
               {Realisation::iterated, "iterated operator", "the iterated operator", choice.iteration},
               {Realisation::feti, "FETI", "FETI", choice.feti},
               {Realisation::engine, "engine", "the engine of the host", choice.engine}};
    std::string other;
    const ReductionCost* rival = nullptr;  // the cheapest of the others that were predicted
    for (const auto& [realisation, subject, name, cost] : all) {
        if (realisation == choice.realisation)
            other = name;
        else if (cost.setup > 0.0 && (rival == nullptr || cost.analysis() < rival->analysis()))
            rival = &cost;
    }
    const bool both = rival != nullptr && choice.own().setup > 0.0;
    for (const auto& [realisation, subject, name, cost] : all) {
        const bool own = realisation == choice.realisation;
        if (realisation == Realisation::engine && !own) continue;
        const std::string built =
            text(words, "; ", basis.description, "; cost of an analysis of ", nominal_steps, " steps");
        const std::string left = text(other, " is used instead, ", words,
                                      cost.setup > 0.0 ? "" : "; the cost of this one was not predicted");
        items.push_back({subject, own ? used : left_out, own ? built : left, own ? cost.analysis() : 0.0,
                         !both || cost.setup == 0.0 ? 0.0
                         : own                      ? rival->analysis() - cost.analysis()
                                                    : cost.analysis() - choice.own().analysis(),
                         "flop"});
    }
    const ReductionCost& own = choice.own();
    if (choice.realisation == Realisation::engine) {
        for (const char* what : {"time of a load step", "memory"})
            items.push_back({what, left_out, "not predicted: the engine of the host decides", 0.0, 0.0, "-"});
        return;
    }
    items.push_back({"time of a load step", used,
                     text("predicted at a nominal ", nominal_rate * 1e-9, " GF/s, after a set-up of ",
                          rounded(own.setup / nominal_rate), " s; ", nominal_steps, " steps then end after ",
                          rounded(own.analysis() / nominal_rate), " s"),
                     own.step / nominal_rate, 0.0, "s"});
    items.push_back(parts_of_steps(choice));
    const double bytes = own.bytes, most = own.most;
    const std::string limits = text(
        most > bytes ? text("; with as many directions and as large patches as iterations may have, ", most, " byte")
                     : std::string(),
        basis.refusal.empty() ? "" : "; ", basis.refusal);
    items.push_back({"memory", used,
                     choice.monolithic > 0.0
                         ? text("predicted peak of an analysis, ", std::round(10.0 * bytes / choice.monolithic) / 10.0,
                                " times that of one monolithic factorisation; saved against ",
                                choice.condensed() ? "FETI" : "the condensed operator", limits)
                         : text("predicted peak of an analysis", limits),
                     bytes, both ? rival->bytes - bytes : 0.0, "byte"});
}

constexpr double noticed = 0.5;  // s, of a wait for a cancellation

void add_reduction(std::vector<PlanItem>& items, const Basis& basis) {
    add_realisations(items, basis);
    const ReductionChoice& choice = basis.choice;
    const bool feti = choice.realisation == Realisation::feti;
    const bool engine = choice.realisation == Realisation::engine;
    const std::string name = choice.condensed() ? "the condensed operator" : "the iterated operator";
    if (feti)
        items.push_back(
            {"subdomains", used,
             text(choice.subdomains, basis.problem.options.subdomains > 0 ? " asked for" : " chosen by size",
                  ", predicted boundary ", std::round(choice.boundary), " DOFs each"),
             0.0, 0.0, "-"});
    else
        items.push_back(
            {"subdomains", left_out,
             engine ? std::string("the engine cuts the bodies as it likes") : text(name, " factors all bodies at once"),
             0.0, 0.0, "-"});
    const std::int64_t own = basis.problem.options.threads, blas = blas_threads();
    const std::string of_blas = blas > 0 ? text(blas) : std::string("an unknown number");
    const std::int64_t useful = useful_threads(own);
    items.push_back(
        {"threads", useful > 1 ? used : left_out,
         text(useful > 1 ? text(useful, " of the library") : std::string("the caller's alone"), " (option threads",
              own > useful ? text(" = ", own, ", of which this process has processors for ", processors()) : "",
              "): assembly of the bodies, large dense products", feti ? ", subdomains" : ", pieces of the bodies",
              "; the BLAS has ", of_blas, ", for large sparse factorisations"),
         0.0, 0.0, "-"});
    const double longest = choice.own().longest, ordering = choice.own().ordering / nominal_rate;
    const std::string before = ordering < noticed ? ""
                                                  : text("; also for an ordering by METIS before it, about ",
                                                         std::round(10.0 * ordering) / 10.0, " s");
    items.push_back(
        {"longest uninterruptible factorisation", used,
         text(longest, " operations at a nominal ", nominal_rate * 1e-9, " GF/s; a cancellation waits for it", before),
         longest / nominal_rate, 0.0, "s"});
}

// Pairs of an interface whose normal jump is determined by the constraints alone.
std::int64_t prescribed_pairs(const Basis& basis, std::int64_t first, std::int64_t pairs) {
    const std::int64_t dim = basis.problem.mesh->dimension();
    std::int64_t found = 0;
    for (std::int64_t p = first; p < first + pairs; ++p) found += basis.prescribed[index(p * dim)] != 0 ? 1 : 0;
    return found;
}

// Nothing else proves in advance that a pair stays open: whether it closes depends on the load path and on the damage.
PlanItem contact_of(const Basis& basis, std::size_t interface, std::int64_t first) {
    const Problem& problem = basis.problem;
    const std::int64_t pairs = problem.mesh->interfaces()[interface].pair_count();
    const auto all = static_cast<double>(pairs);
    const std::string subject = text("contact of interface ", interface);
    if (problem.interfaces[interface].bonded)
        return {subject, left_out, "bonded permanently: it neither opens nor closes", 0.0, all, "comparison/solve"};
    const std::int64_t prescribed = prescribed_pairs(basis, first, pairs);
    if (problem.options.contact == "always")
        return {
            subject, used, text("option contact = always: all ", pairs, " pairs are tested in every active-set step"),
            all,     0.0,  "comparison/solve"};
    if (prescribed == pairs && pairs > 0)
        return {subject, left_out, "supports and loads prescribe every normal jump: no pair can close",
                0.0,     all,      "comparison/solve"};
    return {subject,
            used,
            text(pairs - prescribed, " of ", pairs,
                 " pairs may close, and nothing proves beforehand that they stay open; the test costs one comparison "
                 "per pair until one closes, then one more solve for each change of the contact set"),
            all - static_cast<double>(prescribed),
            static_cast<double>(prescribed),
            "comparison/solve"};
}

PlanItem mixity_of(const Basis& basis, std::size_t interface) {
    const Problem& problem = basis.problem;
    const double work = mixity_operations * static_cast<double>(problem.mesh->interfaces()[interface].pair_count());
    const std::string subject = text("mixity of interface ", interface);
    const char* unit = "flop/step";
    if (problem.interfaces[interface].bonded)
        return {subject, left_out, "bonded permanently: no damage", 0.0, work, unit};
    if (problem.interfaces[interface].contact)
        return {subject, left_out, "contact without adhesion: no damage", 0.0, work, unit};
    if (problem.interfaces[interface].law->depends_on_mixity())
        return {subject,
                used,
                text("onset and toughness of the law depend on it; option mixity_rule = ", problem.options.mixity_rule),
                work,
                0.0,
                unit};
    if (problem.options.mixity == "always")
        return {subject, used, "option mixity = always, although the law does not depend on it", work, 0.0, unit};
    return {subject, left_out, "onset and toughness of the law are the same at every mixity", 0.0, work, unit};
}

// Factorisations of a coupled damage step, as counted in analyses.
constexpr double nominal_factorisations = 5.0;

PlanItem gradient_term(const Basis& basis) {
    const char* unit = "flop/damage step";
    const auto& terms = basis.gradient;
    if (terms.empty())
        return {"gradient term", left_out, "no law has kappa > 0: the damage step is pointwise", 0.0, 0.0, unit};
    std::string reason =
        "one bound-constrained problem for each interface with kappa > 0 instead of the pointwise damage step, and no "
        "Newton steps in the process zone;";
    double work = 0.0;
    for (const auto& term : terms) {
        reason += text(" kappa = ", term->kappa(), " couples ", term->coupled_pairs(), " of ", term->pairs(),
                       " pairs (faces of a notch are left out);");
        work += nominal_factorisations * term->operations();
    }
    reason.pop_back();
    return {"gradient term", used, reason, work, 0.0, unit};
}

std::vector<PlanItem> items_of(const Basis& basis) {
    std::vector<PlanItem> items;
    add_reduction(items, basis);
    std::int64_t first = 0;
    for (std::size_t i = 0; i < basis.problem.interfaces.size(); ++i) {
        items.push_back(contact_of(basis, i, first));
        items.push_back(mixity_of(basis, i));
        first += basis.problem.mesh->interfaces()[i].pair_count();
    }
    items.push_back(gradient_term(basis));
    const Options& options = basis.problem.options;
    const bool plain = options.minimisation == "alternate";
    items.push_back({"acceleration of the minimisation", plain ? left_out : used,
                     text(plain ? "option minimisation = alternate"
                          : basis.gradient.empty()
                              ? "Newton steps and debonding moves in the process zone, each checked by the energy"
                              : "extrapolated alternate minimisation, each step checked by the energy",
                          "; same stopping test: delta = ", options.damage_tolerance, ", at most ",
                          options.minimisation_limit, " iterations per step"),
                     0.0, 0.0, "-"});
    const double dofs = static_cast<double>(basis.problem.mesh->node_count() * basis.problem.mesh->dimension());
    const double recovery =
        4.0 * (basis.choice.factor_entries > 0.0 ? basis.choice.factor_entries : dofs * std::log2(dofs + 2.0));
    items.push_back({"displacements and stresses inside the bodies", left_out,
                     "recovered on request only: the fields displacement and stress and the kkt_ values ask for them",
                     0.0, recovery, "flop/step"});
    if (options.kinematics != "linear")
        items.push_back(
            {"large rotations", used,
             text("option kinematics = ", options.kinematics,
                  ": frames turn with cells and interfaces; each step condenses the bodies anew, once or twice"),
             0.0, 0.0, "-"});
    items.push_back({"following the load within a step", basis.control.name == "load" ? used : left_out,
                     basis.control.reason, 0.0, 0.0, "-"});
    const bool energetic = options.solution == "energetic";
    items.push_back({"energetic search", energetic ? used : left_out,
                     energetic
                         ? text("every front and new cracks, at most ", options.search_limit, " candidates per step")
                         : std::string("option solution = local: critical points reached from the state before"),
                     0.0, 0.0, "-"});
    items.push_back(
        {"backtracking", keeps_past(options) ? used : left_out,
         keeps_past(options)
             ? text("option backtracking = ", options.backtracking, ", eta = ", options.backtracking_tolerance,
                    ", at most ", options.backtracking_limit, " returns per step")
             : std::string("the two-sided energy estimate is reported, but causes no return to earlier steps"),
         0.0, 0.0, "-"});
    return items;
}

// Says when other supports hold; nothing: the same do all the time.
std::optional<PlanItem> stages_of(const Problem& problem) {
    const std::vector<double> times = changes_of(problem);
    if (times.empty()) return {};
    std::string words;
    for (const double time : times) words += text(words.empty() ? "" : ", ", time);
    return PlanItem{
        "supports that begin or end",
        used,
        text("at time ", words, ": the bodies are factorised anew there; what is said here is of the stage ",
             "before the first"),
        0.0,
        0.0,
        "-"};
}

// Says what may end a stage. rotates: rotations are large in it. follows: sensitivities are followed.
void add_stages(std::vector<PlanItem>& items, const Problem& whole, bool rotates, bool follows = false) {
    if (auto stages = stages_of(whole)) items.push_back(std::move(*stages));
    if (!may_turn(whole) || rotates) return;
    const std::string unknown = follows ? "sensitivities" : unknown_to_rotations(whole);
    items.push_back({"large rotations", left_out,
                     unknown.empty() ? std::string("option kinematics = auto: from the step in which small rotations "
                                                   "leave out too much, and which is then taken once more")
                                     : text("option kinematics = auto: they do not know ", unknown),
                     0.0, 0.0, "-"});
}

std::string figure(double value, const std::string& unit) { return unit == "-" ? text(value) : text(value, " ", unit); }

}  // namespace

std::vector<PlanItem> plan_of(const Solver& solver) {
    const JumpOperator& op = solver.stepper().op();
    std::vector<PlanItem> items =
        items_of({solver.problem(), solver.stepper().reduction(), op.description(), "", op.prescribed_rows(),
                  solver.observer().pairs().gradient, solver.control()});
    const bool follows = solver.states().committed().sensitivity.known();
    if (solver.stage() != nullptr) add_stages(items, *solver.stage()->whole, solver.stage()->stage.rotates, follows);
    return items;
}

Forecast forecast(const Problem& problem, Monitor& monitor) {
    validate_stages(problem, -infinite, [&monitor] { monitor.progress("check", 0, 0); });
    const std::vector<double> changes = changes_of(problem);
    std::optional<Problem> before;
    if (!changes.empty() || may_turn(problem)) before = scene_from(problem, -infinite);
    const Problem& first = before ? *before : problem;
    const Design design = design_operator(first, monitor);
    const ReductionCost& cost = design.choice.own();
    if (!design.refusal.empty()) monitor.log(1, design.refusal);
    warn_of_scene(first, monitor);
    Forecast found{items_of({first, design.choice, design.description, design.refusal, design.prescribed,
                             gradient_terms(first), used_step_control(first, first.options)}),
                   cost.setup / nominal_rate, cost.bytes};
    for (const double time : changes) {
        const Design later = design_operator(scene_from(problem, time), monitor);
        found.setup += later.choice.own().setup / nominal_rate;
        // While the first step of a stage is pending, the stage before is still there.
        found.memory = std::max(found.memory, cost.bytes + later.choice.own().bytes);
    }
    add_stages(found.plan, problem, false);
    return found;
}

std::string plan_in_words(const std::vector<PlanItem>& items) {
    std::string words;
    for (const PlanItem& item : items) {
        words += text(item.subject, ": ", item.decision, ", ", item.reason);
        if (item.cost != 0.0) words += " (cost " + figure(item.cost, item.unit) + (item.saving != 0.0 ? "" : ")");
        if (item.saving != 0.0)
            words += (item.cost != 0.0 ? ", saves " : " (saves ") + figure(item.saving, item.unit) + ")";
        words += "\n";
    }
    return words;
}

}  // namespace delam
