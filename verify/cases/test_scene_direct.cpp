// SPDX-License-Identifier: BSD-3-Clause
// Scene files of examples/ at a coarse size: each realisation of the jump operator against the direct reference, at
// states of their analyses.
#include <string>
#include <vector>

#include "scene_file.hpp"
#include "support.hpp"

namespace {

struct Case {
    const char* name;
    std::vector<std::string> settings;
    std::vector<std::size_t> steps;
    std::int64_t subdomains;  // 0: those of the library's choice
    double bound = 1e-8;
    bool rounding = false;  // FETI may stop above its linear tolerance, and contacts near zero may be open or closed
};

const Case scenes[] = {
    {"mmb", {"geometry.divisions=100", "time.steps=20"}, {5, 12, 20}, 0},
    // Between its inner rollers the moment is constant and nothing presses the arms together: forces of contacts are
    // rounding there.
    {"4enf", {"geometry.divisions=100", "time.steps=22"}, {5, 14, 22}, 6, 1e-8, true},
    // A strip of 200 mm by 0.265 mm in a beam that opens by centimetres: the residual of FETI stalls, and overlaps of
    // 1e-11 of the opening are forces on springs of 1e13 N/m3 that the direct solution shows.
    {"dcb-double", {"geometry.divisions=40", "time.steps=8"}, {2, 5, 8}, 0, 1e-7, true},
    {"enf-3d", {"geometry.divisions=[24, 4]", "time.steps=6"}, {3, 6}, 0},
    // Fibres float; control nodes have units of their own, so that the motions that involve them lose half their digits
    // once.
    {"fibres-30", {"mesh.fibres=6", "mesh.cells_around=16", "mesh.gap=0.3", "time.steps=10"}, {2, 5, 10}, 0, 2e-9},
};

LOOP_TEST(scene_files, 0, std::size(scenes)) {
    const Case& scene = scenes[loop];
    if (std::string(scene.name) == "enf-3d" && !cases::whole()) return;
    reference::SceneFile file = reference::read_scene_file(
        std::string(DELAM_EXAMPLES) + "/" + scene.name + "/" + scene.name + ".toml", scene.settings);
    for (const reference::Judged& row : reference::judge(file, scene.steps, scene.subdomains)) {
        const std::string where = std::string(scene.name) + " at " + std::to_string(row.time) + ", " +
                                  std::to_string(100.0 * row.debonded) + " % debonded, " + std::to_string(row.closed) +
                                  " closed, ";
        for (const reference::Answer& answer : row.answers) {
            const std::string of = where + answer.realisation + ": ";
            cases::expect(scene.rounding || !answer.stalled, of + "converges");
            cases::expect(scene.rounding || answer.difference.contacts == 0, of + "the same contacts");
            cases::expect_below(answer.difference.worst(), scene.bound, of + answer.difference.text());
        }
    }
}

}  // namespace
