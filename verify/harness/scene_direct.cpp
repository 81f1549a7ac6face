// SPDX-License-Identifier: BSD-3-Clause
// States of a scene file's analysis: each realisation of the jump operator against the direct reference.
#include "scene_file.hpp"
#include "table.hpp"

namespace harness {

Table scene_direct(const Options& options) {
    if (options.scene.empty()) throw reference::Failure(DELAM_ERROR_ARGUMENT, "--scene FILE is needed");
    reference::SceneFile file = reference::read_scene_file(options.scene, options.settings);
    const std::size_t steps = file.times.size() - 1,
                      stride = std::max<std::size_t>(1, steps / (options.quick ? 4 : 10));
    std::vector<std::size_t> judged;
    for (std::size_t k = stride; k <= steps; k += stride) judged.push_back(k);
    progress("scene-direct: " + options.scene + ", " + std::to_string(file.scene.node_count()) + " nodes, " +
             std::to_string(file.scene.pair_count()) + " pairs");
    Table table;
    table.name = "scene-direct";
    table.note =
        options.scene + ": " + std::to_string(file.scene.node_count()) + " nodes, " +
        std::to_string(file.scene.pair_count()) +
        " pairs. One displacement step at the adhesion of a condensed analysis: largest relative differences to "
        "the direct solution; kkt: "
        "worst violation of the primal KKT conditions, from exported fields.";
    table.columns = {"time",
                     "debonded",
                     "closed",
                     "realisation",
                     "jump",
                     "traction",
                     "displacement",
                     "reaction",
                     "stored_bulk",
                     "stored_interface",
                     "contacts",
                     "linear_iterations",
                     "stalled",
                     "kkt",
                     "kkt_gap",
                     "kkt_pressure",
                     "kkt_complementarity",
                     "kkt_equilibrium"};
    for (const reference::Judged& row : reference::judge(file, judged, 0))
        for (const reference::Answer& answer : row.answers) {
            const reference::Comparison& c = answer.difference;
            const reference::Acceptance& kkt = answer.kkt;
            table.rows.push_back({row.time, row.debonded, row.closed, answer.realisation, c.jump, c.traction,
                                  c.displacement, c.reaction, c.stored_bulk, c.stored_interface, c.contacts,
                                  answer.linear_iterations, answer.stalled ? 1 : 0, kkt.worst(), kkt.gap, kkt.pressure,
                                  kkt.complementarity, kkt.equilibrium});
        }
    return table;
}

}  // namespace harness
