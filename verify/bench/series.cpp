// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "lse.hpp"
#include "machine.hpp"
#include "measure.hpp"

namespace bench {
namespace {

constexpr double long_analysis = 30.0;  // s; a longer analysis is not repeated
constexpr double counting_cap = 4.0;    // the counting analysis may take this many caps
constexpr int priced_systems = 24;      // factorisations timed when the baseline is priced instead of run

// All data of one method.
struct Entry {
    const Method* method = nullptr;
    std::optional<Choice> choice;  // library methods
    std::string refusal;
    std::vector<double> total, setup, factor, iterate;
    std::optional<Analysis> first;
    bool slow = false;  // measured once
    // The baseline alone.
    bool priced = false;
    std::vector<double> factor_times, solve_times;
    std::vector<std::int64_t> factorisations;
};

void keep(Entry& entry, Analysis analysis) {
    entry.total.push_back(analysis.total());
    entry.setup.push_back(analysis.setup);
    entry.factor.push_back(analysis.factor);
    entry.iterate.push_back(analysis.iterate);
    if (!entry.first) entry.first = std::move(analysis);
}

void run_baseline_round(Entry& entry, Stage& stage, bool wide, double cap) {
    BaselineOptions options;
    options.wide = wide;
    BaselineTimes times;
    Analysis analysis = run_baseline(stage, options, cap, entry.priced ? priced_systems : 0, &times);
    entry.factor_times.insert(entry.factor_times.end(), times.factor.begin(), times.factor.end());
    entry.solve_times.insert(entry.solve_times.end(), times.solve.begin(), times.solve.end());
    keep(entry, std::move(analysis));
}

// Equal in every digit: then both are the same method under two names.
bool same_analysis(const Analysis& a, const Analysis& b) {
    if (a.steps.size() != b.steps.size()) return false;
    for (std::size_t k = 0; k < a.steps.size(); ++k) {
        const StepRecord& x = a.steps[k];
        const StepRecord& y = b.steps[k];
        if (x.reaction != y.reaction || x.dissipated != y.dissipated || x.am_iterations != y.am_iterations)
            return false;
    }
    return true;
}

}  // namespace

void progress(const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); }

Price price(const Analysis& counted, double factor_seconds, double solve_seconds) {
    Price p;
    for (const StepRecord& r : counted.steps) p.solves += r.contact_iterations;
    // The first system of a step has the last matrix of the step before, and the first step begins twice (elastic).
    p.factorisations = std::max<std::int64_t>(0, p.solves - static_cast<std::int64_t>(counted.steps.size()) - 1);
    p.seconds = static_cast<double>(p.factorisations) * factor_seconds + static_cast<double>(p.solves) * solve_seconds;
    return p;
}

Json facts_of(const Stage& stage, Lse& lse, const std::string& scene, double cap) {
    std::int64_t primal = 0, dual = 0;
    REQUIRE(stage.scene, delam_problem_dofs, stage.scene.problem(), &primal, &dual);
    Json result;
    result["scene"] = scene;
    result["primal_dofs"] = primal;
    result["dual_dofs"] = dual;
    result["steps"] = stage.data.steps;
    result["delta"] = 1e-5;
    result["cap_s"] = cap;
    result["machine"] = machine();
    result["lse_index_width"] = lse.choose();
    result["lse_facts"] = lse.facts();
    return result;
}

Json measure_series(const std::string& scene, int repeat, double cap) {
    Stage stage = make_mesh(find_scene(scene));
    declare(stage, {});
    Lse lse(stage);
    Json result = facts_of(stage, lse, scene, cap);

    std::map<std::string, Entry> entries;
    for (const Method& method : methods()) {
        Entry& entry = entries[method.key];
        entry.method = &method;
        if (method.reduction != nullptr) entry.choice = resolve(stage, method, 1e-5, entry.refusal);
    }

    // The counting analysis shows how long the baseline would take, and warms up. A long one serves as the method's
    // measurement.
    // FETI counts where there is no condensed operator; its own measurement minimises jointly.
    const bool counts_itself = entries["condensed"].choice.has_value();
    Entry& counter = entries[counts_itself ? "condensed" : "feti"];
    Choice counting = *counter.choice;
    counting.minimisation = "alternate";
    progress(scene + ": counting the alternations (" + counter.method->key + ")");
    const Analysis counted = run_library(stage, counting, counting_cap * cap);
    if (counts_itself && (counted.capped || counted.total() > long_analysis)) {
        keep(counter, counted);
        counter.slow = true;
    }
    Entry& baseline = entries["baseline"];
    baseline.priced = price(counted, lse.measure(), 0.0).seconds > cap;
    progress(scene + ": the baseline is " + (baseline.priced ? "priced" : "run"));

    std::vector<double> lse_times[2];
    int turn = 0;
    const auto unit = [&] { lse_times[turn++ % 2].push_back(lse.measure()); };
    for (int round = 0; round < repeat; ++round) {
        unit();
        for (const Method& method : methods()) {
            Entry& entry = entries[method.key];
            if (entry.slow || (method.reduction != nullptr && !entry.choice)) continue;
            progress(scene + ": round " + std::to_string(round + 1) + ", " + method.key);
            if (method.reduction == nullptr) {
                run_baseline_round(entry, stage, lse.wide(), cap);
            } else {
                keep(entry, run_library(stage, *entry.choice, cap));
            }
            entry.slow = (entry.first->capped && !entry.priced) || entry.total.back() > long_analysis;
            unit();
        }
        if (turn % 2 != 0) unit();
    }

    std::vector<double> all = lse_times[0];
    all.insert(all.end(), lse_times[1].begin(), lse_times[1].end());
    const double one = median(all);
    result["lse_s"] = spread(all);
    result["noise_floor"] = {{"series_a", spread(lse_times[0])},
                             {"series_b", spread(lse_times[1])},
                             {"ratio_of_medians", median(lse_times[0]) / median(lse_times[1])}};

    double baseline_seconds = 0.0;
    for (const Method& method : methods()) {
        Entry& entry = entries[method.key];
        Json m;
        if (!entry.first) {
            m["skipped"] = entry.refusal;
            result["methods"][method.key] = m;
            continue;
        }
        double seconds = median(entry.total);
        std::string label = entry.first->capped ? "stopped by the cap: lower bound" : "measured";
        double iterate = median(entry.iterate);
        const std::string method_key = method.key;
        const auto& plain = entries["condensed"].first;
        if (method_key == "accelerated" && plain && same_analysis(*plain, *entry.first))
            label += ", the same analysis as condensed";
        if (method.reduction == nullptr) {
            m["factor_system_s"] = spread(entry.factor_times);
            m["rest_of_system_s"] = spread(entry.solve_times);
            if (entry.priced) {
                const Price p = price(counted, median(entry.factor_times), median(entry.solve_times));
                iterate = p.seconds;
                seconds = median(entry.setup) + median(entry.factor) + iterate;
                label = counted.capped ? "extrapolated, lower bound" : "extrapolated";
                m["extrapolated_from"] = {{"counted_on", counter.method->key},
                                          {"counted_steps", counted.steps.size()},
                                          {"factorisations", p.factorisations},
                                          {"linear_systems", p.solves},
                                          {"timed_factorisations", entry.factor_times.size()}};
            }
            baseline_seconds = seconds;
        }
        m["label"] = label;
        m["total_s"] = entry.priced ? Json{{"median", seconds}} : spread(entry.total);
        m["setup_s"] = spread(entry.setup);
        m["factor_s"] = spread(entry.factor);
        m["iterate_s"] = entry.priced ? Json{{"median", iterate}} : spread(entry.iterate);
        m["lse"] = seconds / one;
        // There is no ratio to a method that was stopped.
        if (baseline_seconds > 0.0 && method.reduction != nullptr && !entry.first->capped)
            m["baseline_over_this"] = baseline_seconds / seconds;
        m["counts"] = entry.priced ? counts(counted) : counts(*entry.first);
        if (m.contains("extrapolated_from"))  // and the system of the unloaded state
            m["counts"]["bulk_factorisations"] = m["extrapolated_from"]["factorisations"].get<double>() + 1.0;
        m["plan"] = entry.first->plan;
        if (!entry.priced) m["history"] = history(*entry.first);
        result["methods"][method.key] = m;
    }
    // Compares all methods that finished with each other.
    for (std::size_t i = 0; i < methods().size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const Entry& a = entries[methods()[j].key];
            const Entry& b = entries[methods()[i].key];
            if (!a.first || !b.first || a.first->steps.empty() || b.first->steps.empty()) continue;
            result["agreement"][std::string(a.method->key) + " / " + b.method->key] = compare(*a.first, *b.first);
        }
    }
    return result;
}

}  // namespace bench
