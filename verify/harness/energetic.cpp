// SPDX-License-Identifier: BSD-3-Clause
// Brittle ENF, 40 steps to 6 mm: plain alternate minimisation, backtracking and the search against the exhaustive scan
// of fronts; and the instant of the energetic jump against beam theory as the mesh is refined.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis.hpp"
#include "fronts.hpp"
#include "orders.hpp"
#include "table.hpp"

namespace harness {
namespace {

constexpr int steps = 40;
// The problem of the library, and the rule by which the scan records the same mixity. With exponents of 1 the toughness
// is the same at every mixity and the rule has no effect; with 2 the two histories record the mixities of their own
// states, which need not agree to the last digit.
struct Case {
    const char* specimen;
    double exponent;
    reference::MixityRule rule;
};
constexpr Case specimens[] = {{"enf-brittle", 2.0, reference::MixityRule::frozen},
                              {"enf-brittle", 1.0, reference::MixityRule::pure},
                              {"mmf-brittle", 2.0, reference::MixityRule::frozen},
                              {"mmf-brittle", 2.0, reference::MixityRule::converged}};

constexpr const char* methods[] = {"local", "backtracking", "energetic", "energetic-located"};

// Options equal to the library's defaults are not set, so that a library without these options runs too.
Choice choose(const std::string& method, reference::MixityRule rule) {
    Choice choice;
    if (method != "local") choice.texts.emplace_back("solution", method == "backtracking" ? "local" : "energetic");
    if (method == "energetic-located") choice.numbers.emplace_back("jump_tolerance", 1e-4);
    if (method == "backtracking") choice.texts.emplace_back("backtracking", "on");
    choice.texts.emplace_back("mixity_rule", rule == reference::MixityRule::converged ? "converged" : "frozen");
    return choice;
}

// First step in which the debonded length grew by at least a quarter of the scan's first jump: a process zone that
// develops ahead of a front is no jump. 0: none.
int first_jump(const Analysis& analysis, double scan_advance) {
    double before = 0.0;
    for (std::size_t k = 0; k < analysis.steps.size(); ++k) {
        if (analysis.steps[k].debonded - before > 0.25 * scan_advance) return static_cast<int>(k) + 1;
        before = analysis.steps[k].debonded;
    }
    return 0;
}

// Rows of all methods and of the scan.
void compare(Table& table, reference::Flexure data, const reference::Fronts& fronts, const Case& c, bool quick) {
    data.law.exponent = c.exponent;
    std::vector<double> loads;
    for (int k = 1; k <= steps; ++k) loads.push_back(data.final_load * k / steps);
    const auto scan = fronts.scan(loads, c.rule);
    int scan_step = 0;
    while (scan_step < steps && scan[static_cast<std::size_t>(scan_step)].front == 0) ++scan_step;
    for (const char* method : methods) {
        // To locate a jump takes ten times as long as an analysis; case/test_energetic_scan has it, too.
        if (quick && method == methods[3]) continue;
        progress(std::string("energetic: ") + c.specimen + ", " + method);
        const char* rule = c.rule == reference::MixityRule::pure ? "any" : reference::rule_name(c.rule);
        table.rows.push_back({c.specimen, c.exponent, rule, data.h * 1e3, data.patch * 1e3, method});
        std::vector<Cell>& row = table.rows.back();
        const Analysis analysis = run(data, steps, choose(method, c.rule));
        if (!analysis.refused.empty()) {
            while (row.size() + 1 < table.columns.size()) row.push_back("-");
            row.push_back(skipped(analysis.refused));
            continue;
        }
        double excess = -std::numeric_limits<double>::infinity();
        long above = 0;
        long refused = 0;
        for (std::size_t k = 0; k < analysis.steps.size(); ++k) {
            const double e = analysis.steps[k].total() / scan[k].total() - 1.0;
            excess = std::max(excess, e);
            above += e > 1e-6 ? 1 : 0;
            refused += analysis.steps[k].converged ? 0 : 1;
        }
        const double scan_advance =
            scan_step < steps ? fronts.list()[scan[static_cast<std::size_t>(scan_step)].front].advance : 0.0;
        const int move = first_jump(analysis, scan_advance);
        const auto at_jump = static_cast<std::size_t>(std::max(1, move) - 1);
        const Record& jump = analysis.steps[at_jump];
        const Record& end = analysis.steps.back();
        const reference::ScanStep& scan_end = scan.back();
        for (const Cell& cell : std::vector<Cell>{excess,
                                                  above,
                                                  move,
                                                  scan_step + 1,
                                                  move > 0 ? jump.load * 1e3 : nan,
                                                  (data.notch + jump.front) * 1e3,
                                                  fronts.position(scan[at_jump].front) * 1e3,
                                                  jump.drop(),
                                                  jump.released,
                                                  end.dissipated / end.front,
                                                  scan_end.dissipated / fronts.list()[scan_end.front].advance,
                                                  analysis.defect(),
                                                  analysis.first_jump * 1e3,
                                                  fronts.crossing(c.rule).load * 1e3,
                                                  analysis.spent.backtracks,
                                                  analysis.spent.am_iterations,
                                                  analysis.spent.newton_solves,
                                                  analysis.spent.displacement_solves,
                                                  analysis.spent.candidates,
                                                  refused,
                                                  ""})
            row.push_back(cell);
    }
}

}  // namespace

Table energetic(const Options& options) {
    Table table;
    table.name = "energetic";
    table.note =
        "Brittle specimens per metre of width, 40 steps to 6 mm. exponent: of the criterion, 1: the toughness does not "
        "depend on the mixity. excess: largest "
        "(stored + dissipated) / (the scan's) - 1 over the steps (1e-6 is allowed), and the steps in which it is "
        "larger. jump_step, jump_mm: first step that "
        "debonds a quarter of the scan's first jump or more, and its load; scan_step: the scan's. drop: energy of the "
        "state before, "
        "carried on to that step's load, less "
        "energy and dissipation of the state after. toughness: dissipated per length of the whole advance, J/m2, the "
        "library's and the scan's. located_mm: load of the first jump by bisection within the step; crossing_mm: load "
        "at which the scan's energies cross, steps apart from it. defect: "
        "largest |stored + dissipated - work|; a jump's release is part of it.";
    table.columns = {
        "specimen",      "exponent",      "mixity",     "h_mm",          "patch_mm",       "method",
        "excess",        "steps_above",   "jump_step",  "scan_step",     "jump_mm",        "front_mm",
        "scan_front_mm", "drop",          "released",   "toughness",     "scan_toughness", "defect",
        "located_mm",    "crossing_mm",   "backtracks", "am_iterations", "newton_solves",  "displacement_solves",
        "candidates",    "not_converged", "note"};
    for (const double h : {1e-3, 0.75e-3, 0.5e-3, 0.25e-3, 0.1e-3}) {
        for (const double patch : {0.0, 2e-3}) {
            if ((options.quick && h < 1e-3) || h < options.finest) continue;
            for (const char* family : {"enf-brittle", "mmf-brittle"}) {
                if (!options.wants(family)) continue;
                reference::Flexure data = reference::find_flexure(family);
                data.h = h;
                data.patch = patch;
                progress(std::string("energetic: scan of ") + family + ", h " + std::to_string(h) + ", patch " +
                         std::to_string(patch));
                const reference::Fronts fronts(data);
                for (const Case& c : specimens)
                    if (std::string(c.specimen) == family) compare(table, data, fronts, c, options.quick);
            }
        }
    }
    return table;
}

Table jump_instant(const Options& options) {
    constexpr double beam_load = 0.281e-3;
    constexpr double beam_front = 48.0e-3;
    constexpr double beam_onset = 0.302e-3;
    Table table;
    table.name = "jump-instant";
    table.note =
        "Brittle ENF, 2 mm patch supports and load: load where the energies of the initial and of another front cross "
        "(scan of fronts, any load), "
        "and the front after it, beside beam theory: 0.281 mm to 48.0 mm. griffith: load where the next pair alone "
        "pays. Differences to beam "
        "theory are relative; step: relative change to the row before; order: observed from three rows by Richardson "
        "(differences of successive "
        "rows, whose ratio of h need not be constant), richardson_mm: the limit that follows. The front is a minimum "
        "of a flat energy: it scatters by "
        "a few h. Frozen mixity; pure, converged: relative change of the jump's load by those rules.";
    table.columns = {
        "element",  "h_mm",          "jump_mm",     "to_beam",          "step", "order",    "richardson_mm",
        "front_mm", "front_to_beam", "griffith_mm", "griffith_to_beam", "pure", "converged"};
    for (const char* element : {"quad4", "quad4-incompatible", "quad8"}) {
        std::vector<double> sizes, jumps;
        for (const double h : options.quick ? std::vector<double>{1e-3, 0.75e-3, 0.6e-3}
                                            : std::vector<double>{1e-3, 0.75e-3, 0.5e-3, 0.25e-3, 0.125e-3, 0.1e-3}) {
            if (h < options.finest) continue;
            if (std::string(element) == "quad8" && h < 0.2e-3) continue;
            progress(std::string("jump-instant: ") + element + ", h " + std::to_string(h));
            reference::Flexure data = reference::find_flexure("enf-brittle");
            data.h = h;
            data.patch = 2e-3;
            data.element = element;
            const reference::Fronts fronts(data);
            const auto crossing = fronts.crossing(reference::MixityRule::frozen);
            const auto griffith = fronts.crossing(reference::MixityRule::frozen, true);
            sizes.push_back(h);
            jumps.push_back(crossing.load);
            const std::size_t n = jumps.size();
            const double order = order_of_values(sizes, jumps);
            const auto to_rule = [&](reference::MixityRule rule) {
                return options.quick ? nan : fronts.crossing(rule).load / crossing.load - 1.0;
            };
            table.rows.push_back({element, h * 1e3, crossing.load * 1e3, crossing.load / beam_load - 1.0,
                                  n > 1 ? jumps[n - 1] / jumps[n - 2] - 1.0 : nan, order,
                                  std::isfinite(order) ? richardson(sizes, jumps, order) * 1e3 : nan,
                                  fronts.position(crossing.front) * 1e3,
                                  fronts.position(crossing.front) / beam_front - 1.0, griffith.load * 1e3,
                                  griffith.load / beam_onset - 1.0, to_rule(reference::MixityRule::pure),
                                  to_rule(reference::MixityRule::converged)});
        }
    }
    return table;
}

}  // namespace harness
