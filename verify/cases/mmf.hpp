// SPDX-License-Identifier: BSD-3-Clause
// The mixed-mode flexure test (single-leg bending): the two arms of the ENF, but the notched end is supported at the
// upper arm's interface corner, and the lower arm is free there. Beam theory: G_I/G_II = 4/3, so B = 3/7.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "enf.hpp"
#include "warnings.hpp"

namespace cases {

inline constexpr reference::LawData mmf_ductile{125e9, 125e9, 100.0, 100.0, 250.0, 250.0};
inline constexpr reference::LawData mmf_brittle{125e15, 125e15, 0.01, 0.01, 25.0, 25.0};

inline reference::Scene make_mmf(double h, const reference::LawData& law, const char* rule) {
    const auto along = static_cast<std::int64_t>(std::lround(enf_length / h));
    const auto through = static_cast<std::int64_t>(std::lround(enf_arm / h));
    reference::Scene scene(2, {enf_length}, {along}, {enf_arm, enf_arm}, {through, through}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(-1, 75e9, 0.3);
    REQUIRE(scene, delam_problem_set_formulation, scene.problem(), -1, "standard");
    scene.law(0, law);
    const auto x = enf_positions(scene);
    std::vector<std::int64_t> notch;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (x[i] < enf_notch - 0.25 * h) notch.push_back(static_cast<std::int64_t>(i));
    scene.adhesion(0, notch, std::vector<double>(notch.size(), 0.0));
    scene.hold(scene.find(1, {0.0, enf_arm}, {0.0, enf_arm}), {0.0, 1.0});
    const auto right = scene.find(0, {enf_length, 0.0}, {enf_length, 0.0});
    scene.hold(right, {1.0, 0.0});
    scene.hold(right, {0.0, 1.0});
    const auto press = scene.pattern("press", {0.0, enf_end_time}, {0.0, enf_final_load});
    const double top = 2.0 * enf_arm;
    const auto middle = scene.find(1, {0.5 * enf_length, top}, {0.5 * enf_length, top});
    scene.drive(middle, {0.0, -1.0}, press, std::vector<double>(middle.size(), 1.0));
    scene.text("reduction", "condensed");
    scene.text("mixity_rule", rule);
    return scene;
}

struct MmfAnalysis {
    double dissipated, front, defect, defect_slides;  // at the end
    double worst_error = 0.0;                         // of the mixity, in a step
    double solves = 0.0;
    int below = 0, above = 0, unfinished = 0;  // steps outside their bounds, or not converged
    std::vector<std::string> warnings;         // of the mode mixity
};

inline MmfAnalysis analyse_mmf(double h, const reference::LawData& law, const char* rule, int steps) {
    const reference::Scene scene = make_mmf(h, law, rule);
    const Warnings warnings(scene);
    reference::Solver solver(scene, 0.0);
    MmfAnalysis m{};
    for (int k = 1; k <= steps; ++k) {
        const std::int32_t status = solver.advance(enf_end_time * k / steps);
        scene.require(status < 0 ? status : 0, "delam_solver_advance");
        if (status != 0) ++m.unfinished;
        const double slack = 1e-9 * std::max(std::abs(solver.value("stored_bulk")), std::abs(solver.value("work")));
        if (solver.value("lower") > solver.value("increment_lower") + slack) ++m.below;
        if (solver.value("increment") > solver.value("upper") + slack) ++m.above;
        m.worst_error = std::max(m.worst_error, solver.value("mixity_error"));
        m.solves += solver.value("displacement_solves") + solver.value("newton_solves");
        solver.commit();
    }
    m.dissipated = solver.value("dissipated");
    m.front = solver.value("front");
    m.defect = solver.value("defect");
    m.defect_slides = solver.value("defect_slides");
    for (const std::string& line : warnings.lines)
        if (line.find("mode mixity") != std::string::npos) m.warnings.push_back(line);
    std::printf(
        "MMF, h %g mm, Go %g Gc %g, %s, %d steps: %.5g J/m over %.4g mm, %.4g J/m2; defect %.3g, PANM 15 %.3g J/m; "
        "bounds missed %d below, %d above; "
        "worst mixity error %.3f, %zu warnings; %.0f solves\n",
        1e3 * h, law.normal_onset, law.normal_toughness, rule, steps, m.dissipated, 1e3 * m.front,
        m.dissipated / m.front, m.defect, m.defect_slides, m.below, m.above, m.worst_error, m.warnings.size(),
        m.solves);
    return m;
}

}  // namespace cases
