// SPDX-License-Identifier: BSD-3-Clause
// The two-sided energy estimate and the balance against the number of steps, T/20 ... T/640: violated steps, width of
// the band, defect in both ledgers, for every specimen and every mixity rule.
#include <algorithm>
#include <cmath>

#include "march.hpp"
#include "orders.hpp"
#include "table.hpp"

namespace harness {
namespace {

constexpr double eta = 1e-3;  // tolerance of the estimate in PANM 15 (2010), "Material data"

Choice choose(const std::string& solution, const std::string& rule) {
    Choice choice;
    // Defaults are not set, so that a library without these options runs too.
    if (solution != "local") choice.texts.emplace_back("solution", solution);
    choice.texts.emplace_back("mixity_rule", rule);
    return choice;
}

void series(Table& table, const Options& options, const std::string& name, double h, const std::string& solution,
            const std::string& rule) {
    std::vector<double> sizes, defects, slides, bands;
    for (const int steps : {20, 40, 80, 160, 320, 640}) {
        if ((options.quick && steps > 80) || (options.most_steps > 0 && steps > options.most_steps)) continue;
        progress("estimate: " + name + ", h " + std::to_string(h) + ", " + solution + ", " + rule + ", " +
                 std::to_string(steps) + " steps");
        reference::Flexure data = reference::find_flexure(name);
        data.h = h;
        const std::vector<Cell> who{name, h * 1e3, solution, rule, steps};
        March march;
        std::string note;
        try {
            march = run(data, steps, choose(solution, rule));
            if (!march.refused.empty()) note = skipped(march.refused);
        } catch (const reference::Failure& failure) {
            note = std::string("failed: ") + failure.what();
        }
        table.rows.push_back(who);
        std::vector<Cell>& row = table.rows.back();
        if (!note.empty()) {
            while (row.size() + 1 < table.columns.size()) row.push_back("-");
            row.push_back(note);
            if (!march.refused.empty()) return;
            continue;
        }
        long low = 0, high = 0, low_eta = 0, high_eta = 0, refused = 0, listed = 0;
        double worst = 0.0, band = 0.0, drop = 0.0;
        std::string where;
        for (std::size_t k = 0; k < march.steps.size(); ++k) {
            const Record& r = march.steps[k];
            const double below = r.lower_violation();
            const double over = r.upper_violation();
            band += r.upper - r.lower;
            drop = std::max(drop, r.drop());
            refused += r.converged ? 0 : 1;
            low += below > 1e-9 ? 1 : 0;
            high += over > 1e-9 ? 1 : 0;
            low_eta += below > eta ? 1 : 0;
            high_eta += over > eta ? 1 : 0;
            worst = std::max({worst, below, over});
            if (!(below > eta || over > eta)) continue;
            if (listed == 0) where = "steps";
            if (listed < 12) where.append(" ").append(std::to_string(k + 1));
            if (++listed == 13) where.append(" ...");
        }
        const double work = march.steps.back().work;
        sizes.push_back(1.0 / steps);
        defects.push_back(march.defect() / work);
        slides.push_back(march.defect_slides() / work);
        bands.push_back(band);
        for (const Cell& cell :
             std::vector<Cell>{low_eta, high_eta, low, high, worst, band, order_of_errors(sizes, bands), defects.back(),
                               order_of_errors(sizes, defects), slides.back(), order_of_errors(sizes, slides), drop,
                               march.spent.backtracks, refused, where})
            row.push_back(cell);
    }
}

}  // namespace

Table estimate(const Options& options) {
    Table table;
    table.name = "estimate";
    table.note =
        "Two-sided estimate, per metre of width, point supports, 6 mm. low, high: steps that violate the lower and the "
        "upper bound by more than "
        "eta = 1e-3 of max(|E|, work), then those by more than 1e-9; worst: largest violation on that scale. band: sum "
        "of upper - lower; defect, "
        "defect_slides: largest |stored + dissipated - work| over the final work in the booked ledger and that of "
        "PANM 15; order_: observed in "
        "the step, from the row before. drop: largest energy that one step released. note: steps that violate eta.";
    table.columns = {"specimen",     "h_mm",       "solution",   "mixity",        "steps",
                     "low_eta",      "high_eta",   "low",        "high",          "worst",
                     "band",         "order_band", "defect",     "order_defect",  "defect_slides",
                     "order_slides", "drop",       "backtracks", "not_converged", "note"};
    for (const char* name : {"enf-ductile", "enf-brittle", "mmf-ductile", "mmf-brittle"}) {
        if (!options.wants(name)) continue;
        for (const double h : {1e-3, 0.5e-3}) {
            if ((options.quick && h < 1e-3) || h < options.finest) continue;
            for (const char* solution : {"local", "energetic"}) {
                if (!options.solution.empty() && options.solution != solution) continue;
                for (const std::string rule : {"frozen", "converged", "variational"})
                    // The variational rule refuses a toughness that varies by more than twice the onset.
                    if (rule != "variational" || std::string(name).find("ductile") != std::string::npos)
                        series(table, options, name, h, solution, rule);
            }
        }
    }
    return table;
}

}  // namespace harness
