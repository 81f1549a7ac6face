// SPDX-License-Identifier: BSD-3-Clause
// Krylov iterations of one displacement step of the ENF under a unit load, per linear solve: the contact search repeats
// the solve, so the sum is divided by the number of active-set steps.
#include <algorithm>
#include <cmath>

#include "enf.hpp"
#include "table.hpp"

namespace harness {
namespace {

constexpr double limit = 5000;
// Relative residual, large enough that rounding does not affect the comparison (some preconditioners stall near 1e-12).
constexpr double tolerance = 1e-10;

// Adhesion over the interface; always 0 within the notch.
struct Damage {
    const char* name;
    double (*zeta)(double s);  // s from 0 at the left end to 1 at the right end
    bool notch;
};
constexpr Damage damages[] = {{"intact", [](double) { return 1.0; }, false},
                              {"notched", [](double) { return 1.0; }, true},
                              {"linear", [](double s) { return s; }, false},
                              {"power 4", [](double s) { return s * s * s * s; }, false}};

struct Outcome {
    Cell iterations{"limit"};
    double residual = 0.0;
};

Outcome one_solve(const cases::Enf& e, const Damage& damage) {
    auto scene = cases::make_enf(e);
    scene.number("linear_tolerance", tolerance);
    const auto x = cases::enf_positions(scene);
    std::vector<double> adhesion;
    for (const double position : x) {
        const bool notched = damage.notch && position < cases::enf_notch - 0.25 * e.h;
        adhesion.push_back(notched ? 0.0 : damage.zeta(position / cases::enf_length));
    }
    reference::Solver solver(scene, 0.0);
    const std::int32_t status = delam_solver_equilibrate(solver.get(), 1.0, adhesion.data());
    if (status < 0) scene.require(status, "delam_solver_equilibrate");
    Outcome outcome;
    outcome.residual = solver.value("linear_residual");
    if (status != DELAM_OK) return outcome;
    const double solves = std::max(1.0, solver.value("contact_iterations"));
    outcome.iterations = Cell(static_cast<long>(std::lround(solver.value("linear_iterations") / solves)));
    return outcome;
}

}  // namespace

Table pcg(const Options& options) {
    Table table;
    table.name = "pcg";
    table.note =
        "Krylov iterations per linear solve of one displacement step (3 mm) of the ENF, relative residual 1e-10, "
        "orthonormal gluing. H/h is kept where h is halved and the subdomains are four times as many.";
    table.columns = {"h_mm", "subdomains", "damage", "preconditioner", "k_N_per_m3", "iterations", "residual"};
    const auto add = [&](double h, std::int64_t subdomains, const Damage& damage, const char* preconditioner,
                         double k) {
        cases::Enf e;
        e.h = h;
        e.subdomains = subdomains;
        e.preconditioner = preconditioner;
        e.law.normal_stiffness = e.law.tangential_stiffness = k;
        e.linear_limit = limit;
        progress("pcg: h " + std::to_string(h) + ", " + std::to_string(subdomains) + ", " + preconditioner + ", " +
                 damage.name);
        const auto outcome = one_solve(e, damage);
        table.rows.push_back({h * 1e3, static_cast<long>(subdomains), damage.name, preconditioner, k,
                              outcome.iterations, outcome.residual});
    };
    const std::vector<double> stiffness = options.quick
                                              ? std::vector<double>{1e9, 1.25e11, 1e15, 1e20}
                                              : std::vector<double>{1e9, 1e10, 1.25e11, 1e13, 1e15, 1.25e17, 1e20};
    for (const char* preconditioner : {"series", "dirichlet", "lumped", "none"}) {
        for (const std::int64_t subdomains : {2, 8, 32}) {
            if (options.quick && subdomains == 8) continue;
            for (const Damage& damage : damages) {
                for (const double k : stiffness) add(0.5e-3, subdomains, damage, preconditioner, k);
            }
        }
    }
    struct Level {
        double h;
        std::int64_t subdomains;
    };
    const Level levels[] = {{1e-3, 8}, {0.5e-3, 32}, {0.25e-3, 128}};
    for (const char* preconditioner : {"series", "dirichlet", "lumped"}) {
        for (const Level& level : levels) {
            if (options.quick && level.subdomains > 32) continue;
            for (const double k : {1.25e11, 1e15, 1e20}) add(level.h, level.subdomains, damages[3], preconditioner, k);
        }
    }
    return table;
}

}  // namespace harness
