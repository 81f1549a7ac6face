// SPDX-License-Identifier: BSD-3-Clause
// One scene file at several sizes: what the library's own choice of operator costs, in linear-solve equivalents that
// are measured between the load steps of the same analysis; what refactoring in every solve would cost; whether the
// last state fulfils the conditions of equilibrium and contact, computed outside the solver; and how cost and memory
// grow. Processor time, so that other programs on the machine disturb little.
#include <algorithm>
#include <cstdio>
#include <iterator>

#include "acceptance.hpp"
#include "clock.hpp"
#include "machine.hpp"
#include "measure.hpp"
#include "report.hpp"
#include "scene_matrix.hpp"
#include "tables.hpp"
#include "watch.hpp"

namespace bench {

namespace {

constexpr int usual_units = 4;  // linear solves measured during an analysis, besides the one before
// Stages in which the library waits for one factorisation; the plan says how long that takes.
constexpr const char* factoring[] = {"factor", "analyse"};

// Linear solves of one matrix, [measured] seconds.
struct Unit {
    explicit Unit(const UpperMatrix& a) : matrix(a) {}

    const UpperMatrix& matrix;
    std::vector<double> whole, refactored;  // with the analysis of the pattern, and without
    double peak = 0.0, entries = 0.0;       // bytes, of L
    std::string ordering;

    void measure() {
        std::vector<double> x;
        const ProcessorClock clock;
        SparseFactor factor(matrix);
        const double analysed = clock.seconds();
        factor.factorise();
        factor.solve(std::vector<double>(matrix.size(), 1.0), x);
        whole.push_back(clock.seconds());
        refactored.push_back(whole.back() - analysed);
        peak = factor.peak_bytes();
        entries = factor.entries();
        ordering = factor.ordering();
    }
};

struct SizedAnalysis {
    double seconds = 0.0, setup = 0.0, peak = 0.0;  // s of processor time; bytes above the use before
    std::size_t steps = 0, not_converged = 0;
    double alternations = 0.0, iterations = 0.0, solves = 0.0, factors = 0.0, dissipated = 0.0, defect = 0.0;
    double iterating = 0.0, most_iterations = 0.0;  // solves that iterate; iterations of the longest
    std::map<std::string, double> silence;          // s of processor time without a poll of cancellations, by stage
    double kkt = nan;
    std::string kkt_text;

    double silent(bool in_factors) const {
        double longest = 0.0;
        for (const auto& [stage, silent_for] : silence)
            if ((std::find(std::begin(factoring), std::end(factoring), stage) != std::end(factoring)) == in_factors)
                longest = std::max(longest, silent_for);
        return longest;
    }
};

SizedAnalysis analyse(const reference::SceneFile& file, double cap, std::size_t units, Unit& unit) {
    SizedAnalysis out;
    reset_peak_memory();
    const double before = peak_memory();
    Watch watch(file.scene.context());
    const ProcessorClock setup;
    reference::Solver solver(file.scene, file.times.front());
    out.seconds = out.setup = setup.seconds();
    double work = 0.0;
    const std::size_t steps = file.times.size() - 1;
    for (std::size_t k = 1; k <= steps && out.seconds < cap; ++k) {
        watch.resume();
        const ProcessorClock clock;
        const std::int32_t status = solver.advance(file.times[k]);
        if (status == DELAM_NOT_CONVERGED)
            ++out.not_converged;
        else
            file.scene.require(status, "delam_solver_advance");
        solver.commit();
        out.seconds += clock.seconds();
        out.alternations += solver.value("am_iterations");
        out.iterations += solver.value("linear_iterations");
        out.solves += solver.value("contact_iterations") + solver.value("newton_solves");
        work = std::max(work, std::abs(solver.value("work")));
        out.defect = std::max(out.defect, std::abs(solver.value("defect")));
        ++out.steps;
        out.peak = std::max(out.peak, peak_memory() - before);
        if (k * units / steps != (k - 1) * units / steps) {
            unit.measure();
            reset_peak_memory();
        }
    }
    out.iterating = watch.solves();
    out.most_iterations = watch.most_iterations();
    out.silence = watch.silence();
    out.factors = solver.value("bulk_factorisations");
    out.dissipated = solver.value("dissipated");
    if (work > 0.0) out.defect /= work;
    const reference::Acceptance kkt = reference::accept(solver, reference::Exported(file.scene));
    out.kkt = kkt.worst();
    out.kkt_text = kkt.text();
    return out;
}

}  // namespace

Json size_table(const Settings& settings) {
    const double cap = settings.cap > 0.0 ? settings.cap : 1e9;
    const auto units = static_cast<std::size_t>(settings.repeat > 0 ? settings.repeat - 1 : usual_units);
    if (settings.scenes.size() != 1) throw reference::Failure(0, "size: one --scene is needed");
    std::vector<std::string> sizes = settings.sizes;
    if (sizes.empty()) sizes.emplace_back();
    Json result = Json::array();
    std::vector<Row> rows;
    std::vector<double> unknowns, seconds, memory;
    for (const std::string& size : sizes) {
        progress(settings.scenes.front() + " " + size);
        std::vector<std::string> words = settings.settings;
        if (!size.empty()) words.push_back(size);
        const reference::SceneFile file = reference::read_scene_file(settings.scenes.front(), words);
        const UpperMatrix matrix = undamaged_matrix(file);
        Unit unit(matrix);
        unit.measure();
        progress("LSE " + number(unit.whole.front()) + " s, factorisation and solve " +
                 number(unit.refactored.front()) + " s, order " + unit.ordering);
        const SizedAnalysis a = analyse(file, cap, units, unit);
        const double lse = median(unit.whole), refactored = a.solves * median(unit.refactored);
        const bool whole = a.steps + 1 == file.times.size();
        if (whole) {
            unknowns.push_back(static_cast<double>(matrix.size()));
            seconds.push_back(a.seconds);
            memory.push_back(a.peak);
        }
        result.push_back({{"scene", settings.scenes.front()},
                          {"settings", words},
                          {"nodes", file.scene.node_count()},
                          {"pairs", file.scene.pair_count()},
                          {"unknowns", matrix.size()},
                          {"entries_L", unit.entries},
                          {"lse_ordering", unit.ordering},
                          {"lse_s", spread(unit.whole)},
                          {"factor_and_solve_s", spread(unit.refactored)},
                          {"analysis_s", a.seconds},
                          {"setup_s", a.setup},
                          {"steps", a.steps},
                          {"whole", whole},
                          {"not_converged", a.not_converged},
                          {"alternations", a.alternations},
                          {"solves", a.solves},
                          {"linear_iterations", a.iterations},
                          {"solves_that_iterate", a.iterating},
                          {"iterations_at_worst", a.most_iterations},
                          {"silence_s", a.silence},
                          {"factors", a.factors},
                          {"dissipated", a.dissipated},
                          {"defect_of_work", a.defect},
                          {"kkt", a.kkt},
                          {"kkt_text", a.kkt_text},
                          {"peak_MB", 1e-6 * a.peak},
                          {"lse_MB", 1e-6 * unit.peak}});
        rows.push_back({size,
                        std::to_string(matrix.size()),
                        std::to_string(a.steps) + (whole ? "" : " (cap)"),
                        std::to_string(a.not_converged),
                        number(lse),
                        number(a.seconds),
                        number(a.seconds / lse),
                        number(a.setup / lse),
                        number(refactored / a.seconds),
                        number(a.alternations),
                        number(a.solves),
                        number(a.iterations),
                        number(a.iterations / a.iterating),
                        number(a.most_iterations),
                        number(a.factors),
                        number(1e-6 * a.peak),
                        number(1e-6 * unit.peak),
                        number(a.defect, "%.1e"),
                        number(a.kkt, "%.1e"),
                        number(a.silent(true), "%.2g"),
                        number(a.silent(false), "%.2g")});
    }
    print_rows({"size",         "unknowns",        "steps",
                "not_conv",     "LSE_s",           "analysis_s",
                "analysis/LSE", "setup/LSE",       "refactoring/analysis",
                "alternations", "solves",          "iterations",
                "mean",         "worst",           "factors",
                "peak_MB",      "LSE_MB",          "defect",
                "KKT",          "silent_factor_s", "silent_s"},
               rows);
    if (unknowns.size() > 1)
        std::printf("\nexponents of the unknowns: analysis %s, memory %s\n",
                    number(exponent(unknowns, seconds), "%.2f").c_str(),
                    number(exponent(unknowns, memory), "%.2f").c_str());
    return result;
}

}  // namespace bench
