// SPDX-License-Identifier: BSD-3-Clause
// Energy balance of the ductile ENF against the number of steps: both the defect and the summed band must shrink with
// the step.
#include <algorithm>
#include <cmath>

#include "enf.hpp"
#include "table.hpp"

namespace harness {

Table balance(const Options& options) {
    Table table;
    table.name = "balance";
    table.note =
        "Ductile ENF per metre of width: largest |stored + dissipated - work| over the final work, summed upper - "
        "lower (J/m), and "
        "violated bounds (beyond 1e-9 of the energy). slides: the same defect in the ledger of PANM 15 (2010).";
    table.columns = {"h_mm",       "steps",          "max_defect",     "max_defect_slides", "band_J_per_m",
                     "final_work", "lower_violated", "upper_violated", "am_iterations",     "not_converged"};
    for (const double h : {1e-3, 0.5e-3}) {
        for (const int steps : {20, 40, 80, 160}) {
            if (options.quick && (h < 1e-3 || steps > 80)) continue;
            progress("balance: h " + std::to_string(h) + ", " + std::to_string(steps) + " steps");
            cases::Enf e;
            e.h = h;
            auto scene = cases::make_enf(e);
            scene.text("step_control", "fixed");  // whole steps, whose errors fall with their length
            reference::Solver solver(scene, 0.0);
            double defect = 0.0;
            double defect_slides = 0.0;
            double band = 0.0;
            double am = 0.0;
            long low = 0;
            long high = 0;
            long refused = 0;
            for (int k = 1; k <= steps; ++k) {
                const std::int32_t status = solver.advance(cases::enf_time(k, steps));
                if (status < 0) scene.require(status, "delam_solver_advance");
                if (status != DELAM_OK) ++refused;
                solver.commit();
                const double bulk = solver.value("stored_bulk");
                const double work = solver.value("work");
                const double stored = bulk + solver.value("stored_interface");
                const double slides =
                    bulk + solver.value("stored_interface_slides") + solver.value("dissipated_slides");
                defect = std::max(defect, std::abs(stored + solver.value("dissipated") - work));
                defect_slides = std::max(defect_slides, std::abs(slides - work));
                band += solver.value("upper") - solver.value("lower");
                am += solver.value("am_iterations");
                const double slack = 1e-9 * std::max(std::abs(stored), std::abs(work));
                if (!(solver.value("lower") <= solver.value("increment_lower") + slack)) ++low;
                if (!(solver.value("increment") <= solver.value("upper") + slack)) ++high;
            }
            const double work = solver.value("work");
            table.rows.push_back(
                {h * 1e3, steps, defect / work, defect_slides / work, band, work, low, high, am, refused});
        }
    }
    return table;
}

}  // namespace harness
