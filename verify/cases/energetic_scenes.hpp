// SPDX-License-Identifier: BSD-3-Clause
// Small scenes with several fronts, with none, or with floating parts, for energetic analyses; and the lowest energy
// among given sets of broken pairs, from displacement solves alone.
//
// All laws here dissipate G w zeta when a pair of weight w and adhesion zeta breaks (onset = toughness, the same in
// both modes, exponents 1). Loads are proportional and contact has no friction, so E(t, z) = t^2 E(1, z).
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "api.hpp"
#include "support.hpp"

namespace cases {

inline constexpr double toughness = 100.0;  // J/m2

inline reference::LawData griffith_like(double k, double scale = 1.0) {
    const double g = toughness * scale;
    return {k, k, g, g, g, g, 1.0};
}

inline std::vector<std::int64_t> pairs_where(const reference::Scene& scene, std::int64_t interface, double low,
                                             double high) {
    const reference::Pairs pairs = scene.pairs(interface);
    std::vector<std::int64_t> found;
    for (std::size_t p = 0; p < pairs.count(); ++p)
        if (const double x = scene.coordinate(pairs.node_a[p], 0); x > low && x < high)
            found.push_back(static_cast<std::int64_t>(p));
    return found;
}
inline void notch(reference::Scene& scene, std::int64_t interface, double low, double high) {
    const auto pairs = pairs_where(scene, interface, low, high);
    scene.adhesion(interface, pairs, std::vector<double>(pairs.size(), 0.0));
}

// Layers of 3 mm over 120 mm in squares of h: a simply supported beam pressed at mid-span down to `press`.
struct Beam {
    double h = 1.5e-3;
    int layers = 2;
    double left = 0.030, right = 0.024;  // lengths of the notches of the lowest interface, from either end
    double left_above = 0.0;             // of the second interface
    double press = 4e-3;                 // m, at time 1
    bool mirrored = false;
    double stiffness = 1e13;
    double units = 1.0, force = 1.0;  // lengths and forces (per thickness) are multiplied by these
};
inline constexpr double beam_length = 0.120, beam_layer = 3e-3;

inline reference::Scene make_beam(const Beam& b) {
    const double length = beam_length * b.units, layer = beam_layer * b.units, h = b.h * b.units;
    const auto n = static_cast<std::size_t>(b.layers);
    reference::Scene scene(2, {length}, {std::lround(length / h)}, std::vector<double>(n, layer),
                           std::vector<std::int64_t>(n, std::lround(layer / h)), DELAM_QUAD4);
    for (std::int32_t i = 0; i + 1 < b.layers; ++i) scene.interface(i, i + 1);
    scene.begin();
    scene.require(delam_problem_set_formulation(scene.problem(), -1, "incompatible"), "formulation");
    scene.elastic(-1, 75e9 * b.force / b.units, 0.0);
    for (int i = 0; i + 1 < b.layers; ++i)
        scene.law(i, griffith_like(b.stiffness * b.force / (b.units * b.units), b.force));
    const double end = length + h, e = 0.25 * h;
    const double first = (b.mirrored ? b.right : b.left) * b.units, last = (b.mirrored ? b.left : b.right) * b.units;
    if (first > 0.0) notch(scene, 0, -h, first - e);
    if (last > 0.0) notch(scene, 0, length - last + e, end);
    if (b.left_above > 0.0 && !b.mirrored) notch(scene, 1, -h, b.left_above * b.units - e);
    if (b.left_above > 0.0 && b.mirrored) notch(scene, 1, length - b.left_above * b.units + e, end);
    for (const double x : {0.0, length}) scene.hold(scene.find(0, {x, 0.0}, {x, 0.0}), {0.0, 1.0});
    const double fixed = b.mirrored ? 0.0 : length;
    scene.hold(scene.find(0, {fixed, 0.0}, {fixed, 0.0}), {1.0, 0.0});
    const double top = static_cast<double>(b.layers) * layer;
    const auto middle = scene.find(b.layers - 1, {0.5 * length, top}, {0.5 * length, top});
    scene.drive(middle, {0.0, -1.0}, scene.pattern("press", {0.0, 1.0}, {0.0, b.press * b.units}),
                std::vector<double>(middle.size(), 1.0));
    return scene;
}

// A slim block without lateral contraction, `cells` wide, on a stiff fixed one: a spring of K per area in series with
// the interface. held: laterally; otherwise the block floats once it has separated.
struct Block {
    std::int64_t cells = 12;
    double spring = 1e10, stiffness = 1e12;  // N/m3
    double width = 0.05;
    double end = 0.0;  // m, at time 1
    bool held = true;
};
inline double energetic_load(const Block& b) {
    return std::sqrt(2.0 * toughness * (1.0 / b.spring + 1.0 / b.stiffness));
}

inline reference::Scene make_block(const Block& b) {
    reference::Scene scene(2, {b.width}, {b.cells}, {1.0, 1.0}, {1, 1}, DELAM_QUAD4);
    scene.interface(0, 1);
    scene.begin();
    scene.elastic(0, 1e6 * b.spring, 0.0);
    scene.elastic(1, b.spring, 0.0);
    scene.law(0, griffith_like(b.stiffness));
    const auto lower = scene.find(0, {0.0, 0.0}, {b.width, 1.0});
    scene.hold(lower, {1.0, 0.0});
    scene.hold(lower, {0.0, 1.0});
    if (b.held) scene.hold(scene.find(1, {0.0, 1.0}, {b.width, 2.0}), {1.0, 0.0});
    const auto top = scene.find(1, {0.0, 2.0}, {b.width, 2.0});
    scene.drive(top, {0.0, 1.0}, scene.pattern("pull", {0.0, 1.0}, {0.0, b.end}), std::vector<double>(top.size(), 1.0));
    return scene;
}

inline double stored(const reference::Solver& s) {
    return s.value("stored_bulk") + s.value("stored_interface") + s.value("load_potential");
}
inline double total(const reference::Solver& s) { return stored(s) + s.value("dissipated"); }
inline double scale(const reference::Solver& s) { return std::max(std::abs(stored(s)), std::abs(s.value("work"))); }
inline void set_energetic(reference::Scene& scene, double search_tolerance = 1e-9) {
    scene.text("solution", "energetic");
    scene.number("search_tolerance", search_tolerance);
}
inline std::vector<double> all_weights(const reference::Scene& scene) {
    std::vector<double> w;
    for (std::size_t i = 0; i < scene.stiffness().size(); ++i) {
        const auto more = scene.pairs(static_cast<std::int64_t>(i)).weight;
        w.insert(w.end(), more.begin(), more.end());
    }
    return w;
}

// States in which each run of pairs is broken from its first pair up to any position, in all combinations.
class Rivals {
public:
    using Run = std::vector<std::size_t>;  // pairs of all interfaces, one after another
    Rivals(const reference::Scene& scene, const std::vector<Run>& runs) : weight_(all_weights(scene)) {
        reference::Solver solver(scene, 0.0);
        std::vector<std::size_t> at(runs.size(), 0);
        const std::vector<double> initial = solver.field("adhesion");
        while (true) {
            Rival r{initial, 0.0};
            for (std::size_t i = 0; i < runs.size(); ++i)
                for (std::size_t k = 0; k < at[i]; ++k) r.adhesion[runs[i][k]] = 0.0;
            solver.equilibrate(1.0, r.adhesion);
            r.energy = stored(solver);
            solver.rollback();
            list_.push_back(std::move(r));
            std::size_t i = 0;
            while (i < runs.size() && at[i] == runs[i].size()) at[i++] = 0;
            if (i == runs.size()) return;
            ++at[i];
        }
    }
    std::size_t count() const { return list_.size(); }
    // Least E(t, z) + D(before, z) over the states that can be reached from `before`.
    double least(double time, const std::vector<double>& before) const {
        double best = INFINITY;
        for (const Rival& r : list_) {
            double i = time * time * r.energy;
            for (std::size_t p = 0; p < before.size(); ++p) {
                const double z = before[p] - r.adhesion[p];
                if (z < -1e-9) i = INFINITY;
                if (r.adhesion[p] == 0.0) i += toughness * weight_[p] * before[p];
            }
            best = std::min(best, i);
        }
        return best;
    }

private:
    struct Rival {
        std::vector<double> adhesion;
        double energy;  // at time 1
    };
    std::vector<double> weight_;
    std::vector<Rival> list_;
};

inline Rivals::Run run(const reference::Scene& scene, std::int64_t interface, double low, double high,
                       bool from_high = false) {
    Rivals::Run r;
    std::size_t first = 0;
    for (std::int64_t i = 0; i < interface; ++i) first += scene.pairs(i).count();
    for (const std::int64_t p : pairs_where(scene, interface, low, high))
        r.push_back(first + static_cast<std::size_t>(p));
    if (from_high) std::reverse(r.begin(), r.end());
    return r;
}

// An analysis in which no step may have more energy than the rivals reachable from its start, or than the candidates of
// its search. Returns the dissipated energy of every step.
inline std::vector<double> analyse_below(const reference::Scene& scene, const Rivals& rivals, int steps,
                                         double tolerance = 1e-8) {
    reference::Solver solver(scene, 0.0);
    std::vector<double> dissipated;
    for (int k = 1; k <= steps; ++k) {
        const double time = static_cast<double>(k) / steps;
        const std::string where = "step " + std::to_string(k) + ": ";
        solver.step(time);
        // The step's own start, after the steps that it replaced.
        REQUIRE(scene, delam_solver_look, solver.get(), k - 1);
        const std::vector<double> before = solver.field("adhesion");
        const double spent = solver.value("dissipated");
        REQUIRE(scene, delam_solver_look, solver.get(), -1);
        const double rival = rivals.least(time, before) + spent;
        expect_below((total(solver) - rival) / scale(solver), tolerance, where + "energy above the rivals'");
        expect_below(-solver.value("search_margin") / scale(solver), 1e-9,
                     where + "energy above the search's candidates");
        expect_below(solver.value("search_gap") / scale(solver), 1e-8, where + "what the search may have missed");
        solver.commit();
        dissipated.push_back(solver.value("dissipated"));
    }
    return dissipated;
}

struct Jump {
    std::int64_t step = 0, interface = -1, first = -1, last = -1;
    double before = 0.0, time = 0.0, stored = 0.0, dissipated = 0.0, released = 0.0, debonded = 0.0;
};
inline std::vector<Jump> jumps(const reference::Solver& solver) {
    std::int64_t count = 0;
    const reference::Scene& scene = solver.scene();
    REQUIRE(scene, delam_solver_jump_count, solver.get(), &count);
    std::vector<Jump> all(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < all.size(); ++i) {
        Jump& j = all[i];
        REQUIRE(scene, delam_solver_jump, solver.get(), static_cast<std::int64_t>(i), &j.step, &j.before, &j.time,
                &j.stored, &j.dissipated, &j.released, &j.debonded, &j.interface, &j.first, &j.last);
    }
    return all;
}

}  // namespace cases
