// SPDX-License-Identifier: BSD-3-Clause
// Active-set steps per displacement solve over the ductile analysis, compared with "usually converges in 3-4
// iterations" in Zeman, Kruzik, Gruber (PANM 15, 2010), "Active set strategy". Cold: the first solve under load, by a
// solver without history. Warm: solves that start from the contact set of the previous one.
#include <algorithm>

#include "enf.hpp"
#include "table.hpp"

namespace harness {

Table contact(const Options& options) {
    constexpr int steps = 40;
    Table table;
    table.name = "contact";
    table.note =
        "Active-set steps per displacement solve, ductile ENF, h = 0.5 mm, 40 steps. cold: equilibrium at the state of "
        "a step by a "
        "fresh solver, worst of the steps looked at; the other columns: the march itself.";
    table.columns = {"subdomains", "cold", "cold_worst", "first_step_first", "max",
                     "max_first",  "mean", "solves",     "not_converged",    "pairs_in_contact_end"};
    const std::vector<std::int64_t> counts =
        options.quick ? std::vector<std::int64_t>{2, 8} : std::vector<std::int64_t>{2, 8, 32};
    for (const std::int64_t subdomains : counts) {
        progress("contact: " + std::to_string(subdomains) + " subdomains");
        cases::Enf e;
        e.subdomains = subdomains;
        const auto scene = cases::make_enf(e);
        reference::Solver solver(scene, 0.0);
        double first = 0.0;
        double worst = 0.0;
        double worst_first = 0.0;
        double sum = 0.0;
        double solves = 0.0;
        double cold = 0.0;
        double cold_worst = 0.0;
        long refused = 0;
        for (int k = 1; k <= steps; ++k) {
            const std::int32_t status = solver.advance(cases::enf_time(k, steps));
            if (status < 0) scene.require(status, "delam_solver_advance");
            if (status != DELAM_OK) ++refused;
            solver.commit();
            if (k == 1) first = solver.value("contact_iterations_first");
            worst = std::max(worst, solver.value("contact_iterations_max"));
            worst_first = std::max(worst_first, solver.value("contact_iterations_first"));
            sum += solver.value("contact_iterations");
            solves += solver.value("displacement_solves");
            if (k != 1 && k % 10 != 0) continue;
            reference::Solver fresh(scene, 0.0);
            fresh.equilibrate(cases::enf_time(k, steps), solver.field("adhesion"));
            const double alone = fresh.value("contact_iterations");
            if (k == 1) cold = alone;
            cold_worst = std::max(cold_worst, alone);
        }
        table.rows.push_back({static_cast<long>(subdomains), cold, cold_worst, first, worst, worst_first,
                              solves > 0.0 ? sum / solves : 0.0, solves, refused, solver.value("contact_pairs")});
    }
    return table;
}

}  // namespace harness
