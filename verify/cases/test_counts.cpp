// SPDX-License-Identifier: BSD-3-Clause
// Machine-independent numbers that the method promises: Krylov iterations against the stiffness of the interface and at
// constant H/h, the energy balance against the number of steps, active-set steps over the analysis. The bounds are
// slightly above the measured values, which the test prints.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "enf.hpp"
#include "support.hpp"

namespace {

// ---- Krylov iterations of one displacement step ----------------------------------------------------------------

// Adhesion over the interface, s from 0 at the left end to 1 at the right end; 0 within the notch where there is one.
struct Damage {
    const char* name;
    double (*zeta)(double s);
    bool notch;
};
constexpr Damage damages[] = {{"intact", [](double) { return 1.0; }, false},
                              {"notched", [](double) { return 1.0; }, true},
                              {"linear", [](double s) { return s; }, false},
                              {"power 4", [](double s) { return s * s * s * s; }, false}};
constexpr int damage_count = static_cast<int>(std::size(damages));

// Iterations of one linear solve: the contact search repeats the solve, so the sum is divided by the active-set steps.
double iterations(double h, std::int64_t subdomains, const Damage& damage, double k) {
    cases::Enf e;
    e.h = h;
    e.subdomains = subdomains;
    e.law.normal_stiffness = e.law.tangential_stiffness = k;
    auto scene = cases::make_enf(e);
    scene.number("linear_tolerance", 1e-10);  // looser than the default: rounding must not take part in the count
    std::vector<double> adhesion;
    for (const double x : cases::enf_positions(scene)) {
        const bool notched = damage.notch && x < cases::enf_notch - 0.25 * h;
        adhesion.push_back(notched ? 0.0 : damage.zeta(x / cases::enf_length));
    }
    reference::Solver solver(scene, 0.0);
    solver.equilibrate(1.0, adhesion);  // throws unless it converges
    return solver.value("linear_iterations") / std::max(1.0, solver.value("contact_iterations"));
}

std::string place(const Damage& damage, std::int64_t subdomains, double k) {
    char text[100];
    std::snprintf(text, sizeof text, "%s, %d subdomains, k = %.3g: ", damage.name, static_cast<int>(subdomains), k);
    return text;
}

// loop: damage and number of subdomains.
LOOP_TEST(iterations_do_not_see_the_stiffness, 0, 2 * damage_count) {
    if (loop >= damage_count && loop % 2 == 0 && !cases::whole()) return;
    const Damage& damage = damages[loop % damage_count];
    const std::int64_t subdomains = loop < damage_count ? 2 : 8;
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (const double k : {1e9, 1.25e11, 1e13, 1e15, 1e20}) {
        if ((k == 1.25e11 || k == 1e15) && !cases::whole()) continue;
        const double count = iterations(1e-3, subdomains, damage, k);
        std::printf("krylov: %s%.1f\n", place(damage, subdomains, k).c_str(), count);
        cases::expect(count > 0.0, place(damage, subdomains, k) + "nothing was counted");
        cases::expect_below(count, 35.0, place(damage, subdomains, k) + "Krylov iterations");
        least = std::min(least, count);
        most = std::max(most, count);
    }
    cases::expect_below(most / least, 2.25, std::string(damage.name) + ", most / least over all k");
}

LOOP_TEST(iterations_at_constant_ratio, 0, damage_count) {
    if (loop % 2 == 0 && !cases::whole()) return;
    const Damage& damage = damages[loop];
    for (const double k : {1.25e11, 1e15, 1e20}) {
        const double coarse = iterations(1e-3, 8, damage, k);
        const double fine = iterations(0.5e-3, 32, damage, k);
        std::printf("ratio: %s%.1f to %.1f\n", place(damage, 32, k).c_str(), coarse, fine);
        cases::expect_below(fine / coarse, 1.6, place(damage, 32, k) + "growth of the Krylov iterations");
    }
}

// ---- the ductile analysis, h = 1 mm ----------------------------------------------------------------------------

struct Analysis {
    int steps = 0;
    int not_converged = 0;
    double work = 0.0;
    double defect = 0.0;  // largest |stored + dissipated - work|
    double band = 0.0;    // upper - lower, summed
    double solves = 0.0;
    double contact = 0.0;  // active-set steps, summed
    double contact_worst = 0.0;
    double fallbacks = 0.0;
};

Analysis analyse(int steps, std::int64_t subdomains) {
    cases::Enf e;
    e.h = 1e-3;
    e.subdomains = subdomains;
    auto scene = cases::make_enf(e);
    scene.text("step_control", "fixed");  // whole steps, whose work has errors that halve with them
    reference::Solver solver(scene, 0.0);
    Analysis m;
    m.steps = steps;
    for (int k = 1; k <= steps; ++k) {
        const std::int32_t status = solver.advance(cases::enf_time(k, steps));
        if (status < 0) scene.require(status, "delam_solver_advance");
        if (status != DELAM_OK) ++m.not_converged;
        solver.commit();
        m.work = solver.value("work");
        const double stored = solver.value("stored_bulk") + solver.value("stored_interface");
        m.defect = std::max(m.defect, std::abs(stored + solver.value("dissipated") - m.work));
        m.band += solver.value("upper") - solver.value("lower");
        m.solves += solver.value("displacement_solves");
        m.contact += solver.value("contact_iterations");
        m.contact_worst = std::max(m.contact_worst, solver.value("contact_iterations_max"));
        m.fallbacks += solver.value("contact_fallbacks");
    }
    std::printf(
        "analysis: %d steps, %d subdomains: defect / work %.3e, band %.6g J/m, %.0f solves, active-set steps mean "
        "%.3f, "
        "max %.0f, %.0f fallbacks, %d not converged\n",
        steps, static_cast<int>(subdomains), m.defect / m.work, m.band, m.solves, m.contact / m.solves, m.contact_worst,
        m.fallbacks, m.not_converged);
    return m;
}

// Computed once before Check forks; the tests only read the numbers.
std::vector<Analysis> analyses;
Analysis cut_analysis;  // 40 steps with 8 subdomains
std::string analysis_failure;

void make_analyses() {
    if (!analyses.empty()) return;
    try {
        for (const int steps : {20, 40, 80}) analyses.push_back(analyse(steps, 2));
        cut_analysis = analyse(40, 8);
    } catch (const std::exception& e) {
        analysis_failure = e.what();
    }
}
BEFORE_TESTS(make_analyses);

TEST(balance_closes_with_the_step) {
    cases::expect(analysis_failure.empty(), analysis_failure);
    for (std::size_t i = 1; i < analyses.size(); ++i) {
        const Analysis& coarse = analyses[i - 1];
        const Analysis& fine = analyses[i];
        const std::string at = std::to_string(fine.steps) + " steps: ";
        cases::expect(fine.work > 0.0, at + "the device does work");
        cases::expect_below(fine.defect / fine.work, 0.5 * coarse.defect / coarse.work, at + "defect of the balance");
        cases::expect_near(fine.band, 0.5 * coarse.band, 0.1, 0.5 * coarse.band, at + "summed upper - lower");
    }
}

TEST(contact_is_found_quickly) {
    cases::expect(analysis_failure.empty(), analysis_failure);
    for (const Analysis& m : {analyses.at(1), cut_analysis}) {
        cases::expect(m.not_converged == 0, std::to_string(m.not_converged) + " steps did not converge");
        cases::expect(m.solves > 0.0, "nothing was solved");
        cases::expect_below(m.contact / m.solves, 2.0, "mean active-set steps per displacement solve");
        cases::expect_below(m.contact_worst, 60.0, "active-set steps of the worst displacement solve");
        cases::expect(m.fallbacks == 0.0, "contact_fallbacks " + std::to_string(m.fallbacks));
    }
}

}  // namespace
