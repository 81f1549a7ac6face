// SPDX-License-Identifier: BSD-3-Clause
// The scene enf: ductile end-notched flexure, h = 0.5 mm, 40 steps. In every step the energy balance, both bounds of
// the two-sided estimate, the KKT conditions checked outside the solver, and the displacement step against the direct
// reference.
#include <algorithm>

#include "acceptance.hpp"
#include "comparison.hpp"
#include "direct.hpp"
#include "enf.hpp"
#include "step_ledger.hpp"
#include "support.hpp"

namespace {

constexpr int steps = 40;

struct StepRecord {
    std::int32_t status;
    double stored, dissipated, work, load_potential;
    double lower, increment, upper;
    cases::StepLedger ledger;
    reference::Acceptance acceptance;
    reference::Comparison comparison;
    std::vector<double> adhesion;
};

std::vector<double> start_adhesion;

std::vector<StepRecord> analyse() {
    auto scene = cases::make_enf({});
    scene.text("step_control", "fixed");  // the closed forms are of whole steps
    const reference::Exported exported(scene);
    reference::DirectReference direct(scene);
    reference::Solver solver(scene, 0.0);
    start_adhesion = solver.field("adhesion");
    std::vector<StepRecord> records;
    for (int k = 1; k <= steps; ++k) {
        const double time = cases::enf_time(k, steps);
        StepRecord r{};
        r.status = solver.advance(time);
        if (r.status < 0) scene.require(r.status, "delam_solver_advance");
        solver.commit();
        r.stored = solver.value("stored_bulk") + solver.value("stored_interface");
        r.dissipated = solver.value("dissipated");
        r.work = solver.value("work");
        r.load_potential = solver.value("load_potential");
        r.lower = solver.value("lower");
        r.increment = solver.value("increment");
        r.upper = solver.value("upper");
        r.ledger = cases::read_ledger(solver, "press", 0.5 * cases::enf_final_load * time);
        r.adhesion = solver.field("adhesion");
        r.acceptance = reference::accept(solver, exported);
        r.comparison = reference::compare(solver, direct.solve(time, r.adhesion), exported, 1e-10);
        records.push_back(std::move(r));
    }
    return records;
}

// One analysis for all tests, computed before Check forks; the tests only read its numbers.
std::vector<StepRecord> records;
std::string analysis_failure;

void make_analysis() {
    if (!records.empty()) return;
    try {
        records = analyse();
    } catch (const std::exception& e) {
        analysis_failure = e.what();
    }
}
BEFORE_TESTS(make_analysis);

const std::vector<StepRecord>& all() {
    cases::expect(analysis_failure.empty(), analysis_failure);
    return records;
}

std::string at(std::size_t k) { return "step " + std::to_string(k + 1) + ": "; }

TEST(every_step_converges) {
    for (std::size_t k = 0; k < all().size(); ++k) {
        cases::expect(all()[k].status == DELAM_OK, at(k) + delam_status_name(all()[k].status));
    }
    cases::expect(all().size() == steps, "steps");
}

TEST(energy_balance) {
    const double work = all().back().work;
    cases::expect(work > 0.0, "the device does work");
    for (std::size_t k = 0; k < all().size(); ++k) {
        const auto& r = all()[k];
        cases::expect_below(std::abs(r.stored + r.dissipated - r.work), 1e-3 * work,
                            at(k) + "|stored + dissipated - work|");
        cases::expect(r.load_potential == 0.0, at(k) + "no dead load, no potential");
    }
}

TEST(two_sided_estimate) {
    double stored = 0.0;
    double dissipated = 0.0;
    for (std::size_t k = 0; k < all().size(); ++k) {
        const auto& r = all()[k];
        const double energy = std::max(std::abs(r.stored), std::abs(r.work));
        cases::expect_below(r.lower, r.increment + 1e-9 * energy, at(k) + "lower bound");
        cases::expect_below(r.increment, r.upper + 1e-9 * energy, at(k) + "upper bound");
        cases::expect_near(r.increment, r.stored - stored + r.dissipated - dissipated, 1e-12, energy,
                           at(k) + "increment");
        stored = r.stored;
        dissipated = r.dissipated;
    }
}

// All energies of the elastic, linear analysis are quadratic in the load: E_k = theta_k R_k / 2, so that the bounds are
// those of a step in which the stiffness changes at its beginning, or at its end. The work lies between them.
TEST(work_of_the_reactions) {
    cases::StepLedger before;
    before.adhesion = start_adhesion;
    for (std::size_t k = 0; k < all().size(); ++k) {
        const cases::StepLedger& b = all()[k].ledger;
        const double size = all().back().work;
        cases::expect_work(cases::Enf{}.law, before, b, 1e-11, size, at(k));
        const double squares = 0.5 * (b.factor * b.factor - before.factor * before.factor);
        cases::expect_near(b.lower, squares * b.reaction / b.factor, 1e-9, size, at(k) + "lower");
        if (k > 0) cases::expect_near(b.upper, squares * before.reaction / before.factor, 1e-9, size, at(k) + "upper");
        const double work = b.work - before.work;
        cases::expect(b.lower <= work + 1e-9 * size && work <= b.upper + 1e-9 * size, at(k) + "work within bounds");
        before = b;
    }
}

TEST(kkt_outside_the_solver) {
    for (std::size_t k = 0; k < all().size(); ++k) {
        cases::expect_below(all()[k].acceptance.worst(), 1e-10, at(k) + all()[k].acceptance.text());
    }
}

TEST(against_direct) {
    for (std::size_t k = 0; k < all().size(); ++k) {
        cases::expect_below(all()[k].comparison.worst(), 1e-8, at(k) + all()[k].comparison.text());
        cases::expect(all()[k].comparison.contacts == 0, at(k) + all()[k].comparison.text());
    }
}

TEST(irreversible) {
    double dissipated = 0.0;
    std::vector<double> adhesion = all().front().adhesion;
    for (std::size_t k = 0; k < all().size(); ++k) {
        cases::expect(all()[k].dissipated >= dissipated, at(k) + "dissipated falls");
        for (std::size_t p = 0; p < adhesion.size(); ++p) {
            cases::expect(all()[k].adhesion[p] <= adhesion[p], at(k) + "adhesion grows at pair " + std::to_string(p));
        }
        dissipated = all()[k].dissipated;
        adhesion = all()[k].adhesion;
    }
    cases::expect(dissipated > 0.0, "the interface is damaged in the end");
}

}  // namespace
