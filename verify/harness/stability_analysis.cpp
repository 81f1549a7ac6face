// SPDX-License-Identifier: BSD-3-Clause
// Stability over load steps: steps that break everything at once, cycles, no load at all, tolerances from loose to
// zero.
#include <algorithm>
#include <cmath>
#include <memory>

#include "stability.hpp"

namespace harness {
namespace {

using reference::LawData;
using reference::Scene;

// A bar with an interface of many pairs across it, pulled at its end: uniform, with K = young / 2 per area and unit
// height of both halves. The bar is three times stiffer than the softening slope, so there is one solution.
struct Series {
    static constexpr double k = 125e9, onset = 100.0, toughness = 250.0, side = 0.05;
    double peak = std::sqrt(2.0 * k * onset), d0 = peak / k, dc = 2.0 * toughness / peak;
    double slope = 0.5 * peak * peak / (toughness - onset), spring = 3.0 * slope;
    LawData law{k, k, onset, onset, toughness, toughness};

    Scene scene(const std::vector<double>& times, const std::vector<double>& ends, double delta) const {
        Scene s(2, {side}, {10}, {1.0, 1.0}, {2, 2}, DELAM_QUAD4);
        s.interface(0, 1);
        begin_standard(s);
        s.elastic(-1, 2.0 * spring, 0.0);
        s.law(0, law);
        s.hold(s.find(-1, {0.0, 0.0}, {side, 2.0}), {1.0, 0.0});
        s.hold(s.find(0, {0.0, 0.0}, {side, 0.0}), {0.0, 1.0});
        const auto end = s.find(1, {0.0, 2.0}, {side, 2.0});
        s.drive(end, {0.0, 1.0}, s.pattern("pull", times, ends), std::vector<double>(end.size(), 1.0));
        s.number("damage_tolerance", delta);
        return s;
    }
    // Jump and traction at the end displacement w, after the largest one so far.
    std::pair<double, double> state(double w, double most) const {
        if (w <= 0.0) return {0.0, w * spring};  // closed
        const double start = peak * (1.0 / spring + 1.0 / k);
        if (most <= start) return {w / (1.0 + k / spring), w / (1.0 / spring + 1.0 / k)};
        if (most >= dc) return {w, 0.0};
        const double jump = (most - slope * dc / spring) / (1.0 - slope / spring);
        const double secant = slope * (dc - jump) / jump;
        return {w / (1.0 + secant / spring), w / (1.0 / spring + 1.0 / secant)};
    }
};

double series_error(const Series& series, const Result& r, double w, double most) {
    const auto [jump, traction] = series.state(w, most);
    const double length = std::max({std::abs(w), most, series.d0}), stress = std::max(series.peak, std::abs(traction));
    double worst = 0.0;
    for (std::size_t p = 0; p < r.jump.size(); p += 2)
        worst = std::max({worst, std::abs(r.jump[p] - jump) / length, std::abs(r.traction[p] - traction) / stress,
                          std::abs(r.jump[p + 1]) / length});
    return worst;
}

// One step, up to a million times the displacement that breaks the interface.
void giant_step(Study& study) {
    if (study.wanted("one-step")) {
        for (const double load : study.range({0.1, 0.5, 0.9, 1.001, 1.5, 10, 1e2, 1e4, 1e6}, 4)) {
            const Series series;
            const double w = load * series.dc;
            Trial t = trial_of("one-step", "load / load of full debond", load);
            t.law = series.law;
            t.delta = 1e-12;
            t.scene = [=] { return series.scene({0.0, 1.0}, {0.0, w}, 1e-12); };
            t.reference = "closed form (series)";
            t.error = [=](const Result& r) { return series_error(series, r, w, w); };
            // The energy that the load would store if the interface held.
            t.least_traction = series.spring * w;
            t.least_force = t.least_traction * Series::side;
            t.least_energy = 0.5 * t.least_force * w;
            study.run(t);
        }
    }
    if (!study.wanted("one-step-cantilever")) return;
    for (const double load : study.range({0.1, 1, 10, 1e2, 1e3, 1e4, 1e6}, 3)) {
        Cantilever c;
        c.law = brittle;
        c.lift *= load;
        c.delta = 1e-9;
        Trial t = trial_of("one-step-cantilever", "lift / 1.5 mm", load);
        t.law = c.law;
        t.delta = c.delta;
        t.scene = [=] { return make_cantilever(c); };
        t.limit = 1e-9;
        study.run(t);
    }
}

// Pulled into softening, released, pressed and pulled again and again: only the first pull may damage.
void cycles(Study& study) {
    if (!study.wanted("cycles")) return;
    for (const double count : study.range({1, 2, 5, 10, 30, 100}, 3)) {
        const Series series;
        const double most = 0.8 * series.dc;
        std::vector<double> times{0.0}, ends{0.0}, loads;
        for (int i = 0; i < static_cast<int>(count); ++i)
            for (const double part : {0.5, 1.0, 0.3, 0.0, -0.7, 0.0}) {
                times.push_back(static_cast<double>(times.size()));
                ends.push_back(part * most);
            }
        Trial t = trial_of("cycles", "cycles", count);
        t.times.assign(times.begin() + 1, times.end());
        t.law = series.law;
        t.delta = 1e-12;
        t.scene = [=] { return series.scene(times, ends, 1e-12); };
        t.reference = "closed form (series)";
        t.error = [=](const Result& r) {
            return series_error(series, r, ends[r.step + 1], r.step == 0 ? 0.5 * most : most);
        };
        study.run(t);
    }
}

void cycles_cantilever(Study& study) {
    if (!study.wanted("cycles-cantilever")) return;
    for (const double count : study.range({1, 3, 10, 30}, 2)) {
        if (study.options().quick && count > 10) continue;
        Trial t = trial_of("cycles-cantilever", "cycles", count);
        Cantilever c;
        c.delta = 1e-9;
        c.lift = 1.2e-3;
        t.times.clear();
        std::vector<double> times{0.0}, lifts{0.0};
        for (int i = 0; i < static_cast<int>(count); ++i)
            for (const double part : {0.5, 1.0, 0.0, -0.6, 0.0}) {
                times.push_back(static_cast<double>(times.size()));
                lifts.push_back(part);
            }
        t.times.assign(times.begin() + 1, times.end());
        t.law = c.law;
        t.delta = c.delta;
        t.scene = [=] {
            Cantilever still = c;
            still.lift = 0.0;
            still.times = times;
            still.lifts = lifts;
            for (double& v : still.lifts) v *= c.lift;
            return make_cantilever(still);
        };
        study.run(t);
    }
}

// Exact zeros; and steps without any load before the first loaded one.
void no_load(Study& study) {
    if (!study.wanted("no-load")) return;
    for (const double steps : study.range({1, 2, 10, 100}, 3)) {
        Trial t = trial_of("no-load", "steps", steps);
        t.times.clear();
        for (int i = 1; i <= static_cast<int>(steps); ++i) t.times.push_back(i);
        Cantilever c;
        c.lift = 0.0;
        t.law = c.law;
        t.scene = [=] { return make_cantilever(c); };
        t.reference = "closed form (nothing moves)";
        t.error = [](const Result& r) {
            double worst =
                std::max({largest(r.displacement), largest(r.jump), largest(r.traction), largest(r.reaction)});
            for (const double v : {r.stored_bulk, r.stored_interface, r.load_potential})
                worst = std::max(worst, std::abs(v));
            if (r.realisation != Realisation::direct)
                worst = std::max({worst, std::abs(r.dissipated), std::abs(r.work)});
            return worst;
        };
        t.limit = 0.0;
        study.run(t);
    }
}

// Where only rounding is left, the alternations run to their limit.
Scene bounded(const Cantilever& c, double limit = 300) {
    Scene scene = make_cantilever(c);
    scene.number("minimisation_limit", limit);
    return scene;
}

// The stopping test of the minimisation: the error decreases with it, down to rounding, and with 0 the analysis still
// ends.
void tolerances(Study& study) {
    const std::vector<double> ends{0.0, 1.0};
    if (study.wanted("damage-tolerance")) {
        std::vector<double> deltas;
        for (int e = 2; e <= 16; ++e) deltas.push_back(std::pow(10.0, -e));
        deltas.push_back(1e-300);
        for (const double delta : study.range(deltas, 5)) {
            const Series series;
            const double w = 0.8 * series.dc;
            Trial t = trial_of("damage-tolerance", "delta", delta);
            t.times = {0.35, 0.7, 1.0};
            t.law = series.law;
            t.delta = delta;
            t.scene = [=] { return series.scene({0.0, 1.0}, {0.0, w}, delta); };
            t.reference = "closed form (series)";
            t.error = [=](const Result& r) { return series_error(series, r, r.time * w, r.time * w); };
            // Here each alternation leaves a third of the error, so that its last change is twice the remaining error.
            t.limit = 10.0 * delta + 1e-11;
            t.may_say = delta < 1e-14;
            study.run(t);
        }
    }
    if (study.wanted("damage-tolerance-cantilever")) {
        for (const double delta : study.range({1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-16, 1e-300}, 4)) {
            if (study.options().quick && delta < 1e-16) continue;  // 0 is a subject of its own
            Cantilever c;
            c.delta = delta;
            Trial t = trial_of("damage-tolerance-cantilever", "delta", delta);
            t.times = {0.25, 0.5, 0.75, 1.0};
            t.law = c.law;
            t.delta = delta;
            t.scene = [=] { return bounded(c); };
            t.may_say = delta < 1e-13;
            study.run(t);
        }
    }
    if (study.wanted("damage-tolerance-0")) {
        Cantilever c;
        c.delta = 0.0;
        Trial t = trial_of("damage-tolerance-0", "delta", 0.0);
        t.times = {0.25, 0.5, 0.75, 1.0};
        t.law = c.law;
        t.delta = 0.0;
        const double limit = study.options().quick ? 50 : 300;
        t.scene = [=] { return bounded(c, limit); };
        t.may_say = true;
        study.run(t);
    }
    if (!study.wanted("linear-tolerance")) return;
    for (const double tolerance : study.range({1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13, 1e-14, 1e-16}, 4)) {
        Cantilever c;
        c.lift = 1e-5;
        c.law = {1e14, 1e14, 1e30, 1e30, 1e30, 1e30};
        Trial t = trial_of("linear-tolerance", "linear_tolerance", tolerance);
        t.scene = [=] {
            Scene scene = make_cantilever(c);
            scene.number("linear_tolerance", tolerance);
            return scene;
        };
        t.condensed = false;
        t.left_out = "the tolerance is that of FETI's iterations: a factorisation has none";
        // The residual is relative, in the norm of the preconditioned dual system; the error of fields is a few times
        // as large.
        t.limit = 20.0 * tolerance + 1e-9;
        t.acceptance_limit = t.limit;
        t.may_say = tolerance < 1e-13;
        study.run(t);
    }
}

}  // namespace

void stability_analysis(Study& study) {
    giant_step(study);
    cycles(study);
    cycles_cantilever(study);
    no_load(study);
    tolerances(study);
}

}  // namespace harness
