// SPDX-License-Identifier: BSD-3-Clause
// Analyses with a gradient term: a cantilever of two arms peeled apart, in the plane and in space. Every step is
// checked from outside against energies and optimality conditions written independently for 2-node faces.
#include <algorithm>
#include <cstdio>
#include <cstring>

#include "condensed_scenes.hpp"
#include "small_analysis.hpp"

namespace {

using cases::LawData;
using cases::Scene;
using reference::Solver;

constexpr double notch = 0.01, length = 0.04, ply = 0.002;

struct Peel {
    LawData law{1e12, 1e12, 50.0, 50.0, 300.0, 300.0};
    double h = 1e-3;
    int dimension = 2;
    int through = 2;  // cells of an arm
    int plies = 2;
    double opening = 4e-4;  // m, at time 1
    std::int32_t cell = DELAM_QUAD4;
    const char* reduction = "condensed";
    const char* minimisation = "accelerated";
    double delta = 1e-7;
};

LawData with(LawData law, double kappa) {
    law.gradient = kappa;
    return law;
}
constexpr LawData ductile{1e12, 1e12, 50.0, 50.0, 300.0, 300.0};
constexpr LawData griffith{1e13, 1e13, 300.0, 300.0, 300.0, 300.0, 1.0};
// Over 3 mm the gradient energy of a full change of adhesion is about the toughness.
constexpr double kappa = 300.0 * 3e-3 * 3e-3;

// Both faces of the left end, moved apart by the opening; the right end is held.
Scene make(const Peel& p) {
    const int d = p.dimension;
    const auto count = static_cast<std::size_t>(p.plies);
    const auto along = static_cast<std::int64_t>(std::lround(length / p.h));
    Scene scene(d, d == 2 ? std::vector<double>{length} : std::vector<double>{length, 0.006},
                d == 2 ? std::vector<std::int64_t>{along} : std::vector<std::int64_t>{along, 3},
                std::vector<double>(count, ply), std::vector<std::int64_t>(count, p.through), p.cell);
    for (int i = 0; i + 1 < p.plies; ++i) scene.interface(i, i + 1);
    scene.begin();
    scene.elastic(-1, 70e9, 0.3);
    if (p.cell == DELAM_QUAD4 || p.cell == DELAM_HEX8)
        scene.require(delam_problem_set_formulation(scene.problem(), -1, "incompatible"), "formulation");
    for (int i = 0; i + 1 < p.plies; ++i) {
        LawData law = p.law;
        if (i == 1) law.gradient = 0.0;  // the second interface has none
        scene.law(i, law);
        std::vector<std::int64_t> open;
        const auto pairs = scene.pairs(i);
        for (std::size_t k = 0; k < pairs.count(); ++k)
            if (scene.coordinate(pairs.node_a[k], 0) < notch - 1e-7) open.push_back(static_cast<std::int64_t>(k));
        scene.adhesion(i, open, std::vector<double>(open.size(), 0.0));
    }
    const auto end = cases::nodes_where(scene, -1, [&](const double* x) { return x[0] > length - 1e-6; });
    for (int k = 0; k < d; ++k) scene.hold(end, cases::unit(d, k));
    const auto load = scene.pattern("peel", {0.0, 1.0}, {0.0, 1.0});
    const auto left = [](const double* x) { return x[0] < 1e-6; };
    const auto top = cases::nodes_where(scene, p.plies - 1, left), bottom = cases::nodes_where(scene, 0, left);
    scene.drive(top, cases::unit(d, d - 1), load, std::vector<double>(top.size(), 0.5 * p.opening));
    scene.drive(bottom, cases::unit(d, d - 1), load, std::vector<double>(bottom.size(), -0.5 * p.opening));
    scene.text("reduction", p.reduction);
    if (std::string(p.reduction) == "feti") scene.number("subdomains", 3);
    scene.text("minimisation", p.minimisation);
    scene.text("step_control", "fixed");  // one minimisation a step, by two methods
    scene.number("damage_tolerance", p.delta);
    scene.number("minimisation_limit", 20000);
    return scene;
}

double energy(const Solver& solver) { return solver.value("stored_bulk") + solver.value("stored_interface"); }

// An interface of 2-node faces along x, pair after pair: energies and optimality of the present state.
struct Outside {
    std::vector<double> x, weight, zeta, y;
    double kappa, stored, gradient;

    Outside(const Solver& solver, const Peel& p) : zeta(solver.field("adhesion")), kappa(p.law.gradient) {
        const auto pairs = solver.scene().pairs(0);
        weight = pairs.weight;
        const auto jump = solver.field("jump");
        for (std::size_t i = 0; i < pairs.count(); ++i) {
            x.push_back(solver.scene().coordinate(pairs.node_a[i], 0));
            const double open = std::max(0.0, jump[2 * i]), slip = jump[2 * i + 1];
            y.push_back(0.5 * p.law.normal_stiffness * open * open + 0.5 * p.law.tangential_stiffness * slip * slip);
        }
        stored = gradient = 0.0;
        for (std::size_t i = 0; i < x.size(); ++i) stored += weight[i] * zeta[i] * y[i];
        for (std::size_t i = 0; i + 1 < x.size(); ++i)
            if (adhered(i))
                gradient += 0.5 * kappa * (zeta[i + 1] - zeta[i]) * (zeta[i + 1] - zeta[i]) / (x[i + 1] - x[i]);
    }
    bool adhered(std::size_t i) const { return x[i] > notch - 1e-7; }
    // Largest move of a pair along the projected gradient, scaled by its own curvature; delta allows about as much.
    double defect(const Peel& p, const std::vector<double>& old) const {
        double worst = 0.0;
        const double go = p.law.normal_onset, gc = p.law.normal_toughness,
                     d = gc - go;  // one toughness for both modes here
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (!adhered(i)) continue;
            double force = weight[i] * (y[i] - gc * gc * go / std::pow(go + d * zeta[i], 2));
            double stiff = weight[i] * 2.0 * gc * gc * go * d / std::pow(go + d * zeta[i], 3);
            for (const std::size_t j : {i - 1, i + 1}) {
                if (j >= x.size() || !adhered(j)) continue;
                force += kappa * (zeta[i] - zeta[j]) / std::abs(x[i] - x[j]);
                stiff += kappa / std::abs(x[i] - x[j]);
            }
            worst = std::max(worst, std::abs(std::clamp(zeta[i] - force / stiff, 0.0, old[i]) - zeta[i]));
        }
        return worst;
    }
};

struct Analysis {
    std::vector<double> reaction, stored, dissipated, zeta, x;
    double alternations = 0.0, balance = 0.0, front = 0.0;
};

Analysis analyse(const Peel& p, int steps, const std::string& where) {
    const Scene scene = make(p);
    Solver solver(scene, 0.0);
    Analysis m;
    for (int k = 1; k <= steps; ++k) {
        const auto old = solver.field("adhesion");
        const std::string at = where + ", step " + std::to_string(k);
        solver.step(static_cast<double>(k) / steps);
        const double scale = energy(solver) + solver.value("dissipated");
        cases::expect_below((solver.value("increment") - solver.value("upper")) / scale, 1e-9,
                            at + ": increment above the upper estimate");
        if (p.dimension == 2 && p.plies == 2 && p.cell == DELAM_QUAD4) {
            const Outside seen(solver, p);
            cases::expect_near(solver.value("stored_interface"), seen.stored + seen.gradient, 1e-12, scale,
                               at + ": stored in the interface");
            cases::expect_below(seen.defect(p, old), 2.0 * p.delta, at + ": adhesion is not a minimiser");
        }
        m.reaction.push_back(solver.value("reaction:peel"));
        m.stored.push_back(energy(solver));
        m.dissipated.push_back(solver.value("dissipated"));
        m.alternations += solver.value("am_iterations");
        solver.commit();
    }
    m.zeta = solver.field("adhesion");
    for (const auto node : scene.pairs(0).node_a) m.x.push_back(scene.coordinate(node, 0));
    m.balance = m.stored.back() + m.dissipated.back() - solver.value("work");
    m.front = solver.value("front");
    std::printf("%s: %.0f alternations, stored %.9g, dissipated %.9g, defect of the balance %.3e, front %.6g mm\n",
                where.c_str(), m.alternations, m.stored.back(), m.dissipated.back(), m.balance, 1e3 * m.front);
    return m;
}

void expect_same(const Analysis& a, const Analysis& b, double tolerance, const std::string& where) {
    double force = 0.0, total = 0.0;
    for (std::size_t k = 0; k < b.stored.size(); ++k) {
        force = std::max(force, std::abs(b.reaction[k]));
        total = std::max(total, b.stored[k] + b.dissipated[k]);
    }
    for (std::size_t k = 0; k < b.stored.size(); ++k) {
        const std::string at = where + ", step " + std::to_string(k + 1);
        cases::expect_near(a.reaction[k], b.reaction[k], tolerance, force, at + ": reaction");
        cases::expect_near(a.stored[k], b.stored[k], tolerance, total, at + ": stored");
        cases::expect_near(a.dissipated[k], b.dissipated[k], tolerance, total, at + ": dissipated");
    }
}

// ---- both minimisations, both operators, plane and space -----------------------------------------------------------

LOOP_TEST(accelerated_is_plain, 0, 6) {
    if (loop == 3 && !cases::whole()) return;  // half of the time of all
    Peel p;
    p.law = with(ductile, kappa);
    std::string where = "plane";
    if (loop == 1) p.plies = 3, p.opening = 5e-4, where = "two interfaces, one with the term";
    if (loop >= 2) p.dimension = 3, p.h = 2e-3, p.through = 1;
    if (loop == 2) p.cell = DELAM_HEX8, where = "bricks";
    if (loop == 3) p.cell = DELAM_TET10, p.h = 4e-3, where = "quadratic tetrahedra";
    if (loop == 4) p.cell = DELAM_HEX20, p.h = 4e-3, where = "quadratic bricks";
    if (loop == 5) p.dimension = 2, p.cell = DELAM_QUAD8, p.h = 2e-3, where = "quadratic cells";
    const int steps = loop < 2 ? 10 : 5;
    const Analysis fast = analyse(p, steps, where + ", accelerated");
    p.minimisation = "alternate";
    const Analysis plain = analyse(p, steps, where + ", plain");
    expect_same(fast, plain, 1e-5, where);
    cases::expect(plain.dissipated.back() > 0.0, where + ": nothing was damaged");
    cases::expect_below(fast.alternations, plain.alternations, where + ": alternations");
    p.minimisation = "accelerated";
    p.reduction = "feti";
    expect_same(analyse(p, steps, where + ", feti"), plain, 1e-5, where + ", feti");
}

// ---- the profile of the process zone depends on kappa, not on the mesh ---------------------------------------------

LOOP_TEST(profile_converges, 0, 2) {
    Peel p;
    p.law = with(loop == 0 ? ductile : griffith, kappa);
    p.delta = 1e-6;
    if (loop == 1) p.opening = 8e-4;
    const std::string where = loop == 0 ? "bilinear" : "Griffith";
    std::vector<Analysis> level;
    for (const double h : {2e-3, 1e-3, 0.5e-3, 0.25e-3}) {
        p.h = h;
        p.through = static_cast<int>(std::lround(ply / h));
        level.push_back(analyse(p, 10, where + ", h = " + std::to_string(1e3 * h) + " mm"));
    }
    std::vector<double> distance, slope;  // in L1 from the finest, mm; 1/mm
    for (std::size_t l = 0; l < level.size(); ++l) {
        const Analysis &a = level[l], &b = level.back();
        double sum = 0.0;
        for (std::size_t i = 0; i < a.x.size(); ++i) {
            std::size_t near = 0;
            for (std::size_t j = 0; j < b.x.size(); ++j)
                if (std::abs(b.x[j] - a.x[i]) < std::abs(b.x[near] - a.x[i])) near = j;
            sum += std::abs(a.zeta[i] - b.zeta[near]) * length / static_cast<double>(a.x.size() - 1);
        }
        distance.push_back(1e3 * sum);
        double steepest = 0.0;
        for (std::size_t i = 1; i < a.x.size(); ++i)
            if (a.x[i - 1] > notch - 1e-7)
                steepest = std::max(steepest, std::abs(a.zeta[i] - a.zeta[i - 1]) / (a.x[i] - a.x[i - 1]));
        slope.push_back(1e-3 * steepest);
        std::printf("%s, level %zu: %.4g mm from the finest profile, steepest %.4g /mm\n", where.c_str(), l,
                    distance.back(), slope.back());
    }
    // First order in h, because half of the weight of the pair at the tip lies in the notch. The Griffith front jumps,
    // to a position that depends on it.
    for (std::size_t l = 1; l < distance.size(); ++l)
        cases::expect_below(distance[l], 0.8 * distance[l - 1], where + ": distance to the finest");
    cases::expect_below(distance[2], loop == 0 ? 0.02 : 0.3, where + ": distance of the last but one");
    // The slope of the zone does not depend on the cells, as it does without the term (there it doubles each time).
    for (std::size_t l = 2; l < slope.size(); ++l)
        cases::expect_near(slope[l], slope[l - 1], 0.08, slope[l - 1], where + ": steepest");
}

// ---- limits of kappa -----------------------------------------------------------------------------------------------

TEST(small_kappa_is_the_pointwise_analysis) {
    Peel p;
    p.law = ductile;
    p.delta = 1e-9;
    const Analysis without = analyse(p, 6, "kappa = 0");
    std::vector<double> distance;
    for (const double part : {1e-3, 1e-4, 1e-5}) {
        p.law = with(ductile, part * kappa);
        const Analysis small = analyse(p, 6, "kappa times " + std::to_string(part));
        double moved = 0.0;
        for (std::size_t i = 0; i < small.zeta.size(); ++i)
            moved = std::max(moved, std::abs(small.zeta[i] - without.zeta[i]));
        distance.push_back(moved);
        std::printf("kappa times %g moves the adhesion by %.3e\n", part, moved);
    }
    cases::expect(distance[2] < 0.13 * distance[1] && distance[1] < 0.2 * distance[0], "first order in kappa");
}

// Zero is a value, and equals no value in every digit.
TEST(kappa_zero_changes_no_digit) {
    Peel p;
    p.law = ductile;
    const Scene without = make(p);
    Scene zero = make(p);
    delam_law* law = nullptr;
    zero.require(delam_law_create(zero.context(), "piecewise-linear", &law), "law");
    const std::pair<const char*, double> parameters[] = {
        {"normal_stiffness", 1e12}, {"tangential_stiffness", 1e12}, {"normal_onset", 50.0},
        {"tangential_onset", 50.0}, {"normal_toughness", 300.0},    {"tangential_toughness", 300.0},
        {"gradient", 0.0}};
    for (const auto& [key, value] : parameters) zero.require(delam_law_set(law, key, value), key);
    cases::expect(delam_law_set(law, "gradient", -1.0) == DELAM_ERROR_ARGUMENT, "a negative kappa is taken");
    cases::expect(std::string(delam_context_message(zero.context())).find("'gradient' = -1 must be finite and >= 0") !=
                      std::string::npos,
                  delam_context_message(zero.context()));
    REQUIRE(zero, delam_problem_set_law, zero.problem(), 0, law);
    delam_law_destroy(&law);
    std::vector<std::int64_t> open;
    for (std::int64_t i = 0; i < 10; ++i) open.push_back(i);
    zero.adhesion(0, open, std::vector<double>(open.size(), 0.0));
    Solver a(without, 0.0), b(zero, 0.0);
    for (int k = 1; k <= 8; ++k) {
        a.step(k / 8.0);
        b.step(k / 8.0);
        cases::expect_same(a, cases::read_bits(a), cases::read_bits(b), "step " + std::to_string(k));
        a.commit();
        b.commit();
    }
    cases::expect(std::strstr(delam_solver_plan(a.get()), "gradient term: left out, no law has kappa > 0") != nullptr,
                  delam_solver_plan(a.get()));
    p.law = with(ductile, kappa);
    const Scene scene = make(p);
    Solver c(scene, 0.0);
    cases::expect(std::strstr(delam_solver_plan(c.get()), "gradient term: used") != nullptr,
                  delam_solver_plan(c.get()));
    cases::expect(std::strstr(delam_solver_plan(c.get()), "couples 31 of 41 pairs") != nullptr,
                  delam_solver_plan(c.get()));
}

// ---- the ledger -----------------------------------------------------------------------------------------------------

TEST(ledger_closes) {
    Peel p;
    p.law = with(ductile, kappa);
    p.law.exponent = 1.0;  // one toughness for every mixity: the ledger has only the defect of the finite steps
    std::vector<double> defect;
    for (const int steps : {10, 20, 40, 80}) {
        const Analysis m = analyse(p, steps, std::to_string(steps) + " steps");
        defect.push_back(std::abs(m.balance) / (m.stored.back() + m.dissipated.back()));
    }
    for (std::size_t i = 1; i < defect.size(); ++i)
        cases::expect_below(defect[i], 0.6 * defect[i - 1], "defect of the energy balance");
    cases::expect_below(defect.back(), 2e-3, "defect of the energy balance, 80 steps");
}

// ---- save, load, continue -------------------------------------------------------------------------------------------

TEST(resumed_analysis) {
    Peel p;
    p.law = with(ductile, kappa);
    const Scene scene = make(p), again = make(p);
    Solver whole(scene, 0.0), resumed(again, 0.0);
    for (int k = 1; k <= 4; ++k) {
        whole.step(k / 8.0);
        whole.commit();
    }
    again.require(resumed.load(whole.save()), "delam_solver_load");
    for (int k = 5; k <= 8; ++k) {
        whole.step(k / 8.0);
        resumed.step(k / 8.0);
        whole.commit();
        resumed.commit();
    }
    cases::expect_same(whole, cases::read_bits(whole), cases::read_bits(resumed), "resumed");
    p.law.gradient *= 2.0;
    const Scene other = make(p);
    Solver foreign(other, 0.0);
    cases::expect(foreign.load(whole.save()) == DELAM_ERROR_SNAPSHOT, "a snapshot of another kappa is taken");
}

}  // namespace
