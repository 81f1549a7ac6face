// SPDX-License-Identifier: BSD-3-Clause
// The cost of an energetic analysis relative to a local one, and its findings: three concepts on the same scene in one
// process.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "clock.hpp"
#include "lse.hpp"
#include "machine.hpp"
#include "measure.hpp"

namespace bench {
namespace {

constexpr double violation = 1e-3;  // eta, of max(|stored|, work)
// Energies in J/m, lengths in m. Names of values whose columns a history has.
constexpr const char* columns[] = {"reaction",
                                   "stored_bulk",
                                   "stored_interface",
                                   "dissipated",
                                   "work",
                                   "lower",
                                   "increment",
                                   "upper",
                                   "increment_lower",
                                   "defect",
                                   "debonded_length",
                                   "search_candidates",
                                   "search_gap",
                                   "search_margin",
                                   "revisions"};
constexpr const char* effort[] = {"am_iterations", "displacement_solves", "newton_solves", "search_candidates"};

// A value by key; NaN if this library does not have it.
using Values = std::map<std::string, double>;

Values read(const reference::Solver& solver) {
    Values values;
    const auto add = [&](const std::string& key, const std::string& name) {
        double value = 0.0;
        values[name] = delam_solver_value(solver.get(), key.c_str(), &value) == DELAM_OK ? value : nan;
    };
    add("load:press", "load");
    for (const char* key : columns) add(key == std::string("reaction") ? "reaction:press" : key, key);
    for (const char* key : effort) add(key, key);
    add("backtracks", "backtracks");
    add("revised_from", "revised_from");
    return values;
}

// The final history: steps that backtracking has replaced are read again.
struct Course {
    std::vector<Values> steps;
    Values spent;  // effort, including steps that were replaced later, but not tries that found nothing lower

    void count(const Values& now) {
        for (const char* key : effort) spent[key] += now.at(key);
    }
    void see(reference::Solver& solver, int k) {
        const auto at = [](int step) { return static_cast<std::size_t>(step - 1); };
        steps.resize(at(k) + 1);
        steps[at(k)] = read(solver);
        count(steps[at(k)]);
        spent["backtracks"] += steps[at(k)].at("backtracks");
        const double from = steps[at(k)].at("revised_from");
        if (!(from < k)) return;
        for (int i = static_cast<int>(from); i < k; ++i) {
            REQUIRE(solver.scene(), delam_solver_look, solver.get(), i);
            Values again = read(solver);
            if (again.at("revisions") != steps[at(i)].at("revisions")) count(again);
            steps[at(i)] = std::move(again);
        }
        REQUIRE(solver.scene(), delam_solver_look, solver.get(), -1);
    }
};

double scale_of(const Values& v) {
    return std::max(std::abs(v.at("stored_bulk") + v.at("stored_interface")), std::abs(v.at("work")));
}

// The step that debonds most; the largest violation of the two-sided estimate
//   lower <= increment <= upper;
// the largest gap and the smallest margin of the search.
Json findings(const Course& course) {
    Json f;
    std::size_t jump = 0;
    double advance = 0.0;
    double before = 0.0;
    Json violated = Json::array();
    double worst = -std::numeric_limits<double>::infinity();
    double gap = 0.0, relative_gap = 0.0, margin = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < course.steps.size(); ++k) {
        const Values& v = course.steps[k];
        const double length = v.at("debonded_length");
        if (length - before > advance) {
            advance = length - before;
            jump = k + 1;
        }
        before = length;
        const double scale = scale_of(v);
        const double excess =
            std::max(v.at("lower") - v.at("increment_lower"), v.at("increment") - v.at("upper")) / scale;
        worst = std::max(worst, excess);
        if (excess > violation) violated.push_back({{"step", k + 1}, {"excess", excess}});
        if (!(v.at("search_candidates") > 0.0)) continue;
        gap = std::max(gap, v.at("search_gap"));
        relative_gap = std::max(relative_gap, v.at("search_gap") / scale);
        margin = std::min(margin, v.at("search_margin"));
    }
    f["jump"] = Json();
    if (jump > 0) {
        const Values& v = course.steps[jump - 1];
        f["jump"] = {{"step", jump},
                     {"load", v.at("load")},
                     {"advance", advance},
                     {"released", v.at("upper") - v.at("increment")},
                     {"spent", v.at("dissipated") - (jump > 1 ? course.steps[jump - 2].at("dissipated") : 0.0)}};
    }
    f["violated"] = violated;
    f["worst_excess"] = worst;
    if (!course.steps.empty()) f["defect_end"] = course.steps.back().at("defect");
    // JSON has no infinity: an unbounded gap is null.
    if (std::isfinite(margin)) f["search"] = {{"gap", gap}, {"gap_relative", relative_gap}, {"margin", margin}};
    f["spent"] = course.spent;
    for (const Values& v : course.steps) {
        f["history"]["load"].push_back(v.at("load"));
        for (const char* key : columns) f["history"][key].push_back(v.at(key));
    }
    return f;
}

struct SeriesEntry {
    std::optional<Choice> choice;
    std::string refusal;
    std::vector<double> total, factor, iterate, processor;
    std::vector<double> units;     // total over the mean of the LSE measured before and after it
    std::vector<double> to_local;  // total over that of the local analysis of the same round
    std::optional<Analysis> first;
    Course course;
};

}  // namespace

Json measure_concepts(const std::string& scene, int repeat, double cap) {
    Stage stage = make_mesh(find_scene(scene));
    declare(stage, {});
    Lse lse(stage);
    Json result = facts_of(stage, lse, scene, cap);
    result["eta"] = violation;

    // Round 0 warms up and records the history.
    std::map<std::string, SeriesEntry> entries;
    for (const Method& method : concepts()) {
        SeriesEntry& entry = entries[method.key];
        entry.choice = resolve(stage, method, 1e-5, entry.refusal);
        if (!entry.choice) continue;
        progress(scene + ": course, " + method.key);
        entry.first = run_library(stage, *entry.choice, cap,
                                  [&](reference::Solver& solver, int k) { entry.course.see(solver, k); });
    }

    std::vector<double> lse_times[2], lse_processor;
    int turn = 0;
    const auto unit = [&] {
        const ProcessorClock processor;
        lse_times[turn % 2].push_back(lse.measure());
        lse_processor.push_back(processor.seconds());
        return lse_times[turn++ % 2].back();
    };
    for (int round = 0; round < repeat; ++round) {
        double before = unit();
        double local = nan;
        for (const Method& method : concepts()) {
            SeriesEntry& entry = entries[method.key];
            if (!entry.choice || entry.first->capped) continue;
            progress(scene + ": round " + std::to_string(round + 1) + ", " + method.key);
            const Analysis analysis = run_library(stage, *entry.choice, cap);
            const double after = unit();
            entry.total.push_back(analysis.total());
            entry.factor.push_back(analysis.setup + analysis.factor);
            entry.iterate.push_back(analysis.iterate);
            entry.processor.push_back(analysis.processor);
            entry.units.push_back(analysis.total() / (0.5 * (before + after)));
            if (method.solution == nullptr) local = analysis.total();
            entry.to_local.push_back(analysis.total() / local);
            before = after;
        }
        if (turn % 2 != 0) unit();
    }

    std::vector<double> all = lse_times[0];
    all.insert(all.end(), lse_times[1].begin(), lse_times[1].end());
    const double one = median(all);
    result["lse_s"] = spread(all);
    result["lse_processor_s"] = spread(lse_processor);
    result["noise_floor"] = {{"series_a", spread(lse_times[0])},
                             {"series_b", spread(lse_times[1])},
                             {"ratio_of_medians", median(lse_times[0]) / median(lse_times[1])}};
    for (const Method& method : concepts()) {
        SeriesEntry& entry = entries[method.key];
        Json& m = result["methods"][method.key];
        if (!entry.first) {
            m["skipped"] = entry.refusal;
            continue;
        }
        m["label"] = entry.first->capped ? "stopped by the cap: lower bound" : "measured";
        if (entry.total.empty()) {
            entry.total = {entry.first->total()};
            entry.factor = {entry.first->setup + entry.first->factor};
            entry.iterate = {entry.first->iterate};
        } else {
            m["lse_by_round"] = spread(entry.units);
            m["to_local"] = spread(entry.to_local);
            m["processor_s"] = spread(entry.processor);
            m["lse_processor"] = median(entry.processor) / median(lse_processor);
        }
        m["total_s"] = spread(entry.total);
        m["before_first_step_s"] = spread(entry.factor);
        m["steps_s"] = spread(entry.iterate);
        m["lse"] = median(entry.total) / one;
        m["counts"] = counts(*entry.first);
        m["plan"] = entry.first->plan;
        m.update(findings(entry.course));
        for (const StepRecord& r : entry.first->steps) m["history"]["seconds"].push_back(r.seconds);
    }
    return result;
}

}  // namespace bench
