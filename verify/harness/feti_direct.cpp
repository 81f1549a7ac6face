// SPDX-License-Identifier: BSD-3-Clause
// Worst relative differences between FETI and the direct reference over the ductile analysis, for one displacement step
// per load step.
#include "../cases/feti_direct.hpp"

#include <algorithm>

#include "table.hpp"

namespace harness {

Table feti_direct(const Options& options) {
    const int stride = options.quick ? 8 : 4;  // every step: cases/test_long_feti_direct
    Table table;
    table.name = "feti-direct";
    const double h = options.quick ? 1e-3 : 0.5e-3;
    table.note =
        std::string("Ductile ENF, h = ") + (options.quick ? "1" : "0.5") + " mm: worst relative differences over " +
        std::to_string(40 / stride) +
        " states of the analysis (max norm over the interface), contacts that differ, Krylov iterations in all, "
        "states whose linear solves stalled above the tolerance; kkt: worst violation of the primal KKT "
        "conditions, from "
        "exported fields.";
    table.columns = {
        "subdomains", "preconditioner", "gluing",           "jump",     "traction",          "displacement",
        "reaction",   "stored_bulk",    "stored_interface", "contacts", "linear_iterations", "stalled",
        "kkt",        "outcome"};
    progress("feti-direct: the analysis and the direct solutions");
    const cases::DirectStates states(h, stride);
    for (const std::int64_t subdomains : {2, 8, 32}) {
        for (const char* preconditioner : {"series", "dirichlet", "lumped", "none"}) {
            for (const char* gluing : {"orthonormal", "redundant"}) {
                if (options.quick && (subdomains != 8 || gluing[0] == 'r')) continue;
                const cases::FetiChoice choice{subdomains, preconditioner, gluing};
                progress("feti-direct: " + choice.text());
                reference::Comparison worst;
                double iterations = 0.0, kkt = 0.0;
                long stalled = 0;
                std::string outcome = "ok";
                try {
                    cases::solve_all(
                        states, choice,
                        [&](std::size_t, const reference::Comparison& c, std::int32_t status, double linear) {
                            worst.jump = std::max(worst.jump, c.jump);
                            worst.traction = std::max(worst.traction, c.traction);
                            worst.displacement = std::max(worst.displacement, c.displacement);
                            worst.reaction = std::max(worst.reaction, c.reaction);
                            worst.stored_bulk = std::max(worst.stored_bulk, c.stored_bulk);
                            worst.stored_interface = std::max(worst.stored_interface, c.stored_interface);
                            worst.contacts += c.contacts;
                            iterations += linear;
                            if (status != DELAM_OK) ++stalled;
                        },
                        &kkt);
                } catch (const reference::Failure& failure) {
                    outcome = delam_status_name(failure.status());
                }
                table.rows.push_back({static_cast<long>(subdomains), preconditioner, gluing, worst.jump, worst.traction,
                                      worst.displacement, worst.reaction, worst.stored_bulk, worst.stored_interface,
                                      worst.contacts, iterations, stalled, kkt, outcome});
            }
        }
    }
    return table;
}

}  // namespace harness
