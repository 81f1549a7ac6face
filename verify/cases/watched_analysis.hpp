// SPDX-License-Identifier: BSD-3-Clause
// An analysis checked from outside the library in every step, for any method of minimisation: the end state is a
// critical point, adhesion never grows, and the energy is not above that of the elastic answer from which the step
// starts.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "acceptance.hpp"
#include "api.hpp"
#include "support.hpp"

namespace cases {

// Damage steps at the exported jumps by the library's law alone, interface after interface; bonded ones have none.
class DamageProbe {
public:
    DamageProbe(const reference::Scene& scene, const std::vector<reference::LawData>& laws) : scene_(scene) {
        for (std::size_t i = 0; i < scene.stiffness().size(); ++i) {
            delam_law* raw = nullptr;
            const reference::LawData& data = laws[std::min(i, laws.size() - 1)];
            REQUIRE(scene, delam_law_create, scene.context(), "piecewise-linear", &raw);
            laws_.emplace_back(raw);
            const std::pair<const char*, double> parameters[] = {
                {"normal_stiffness", data.normal_stiffness}, {"tangential_stiffness", data.tangential_stiffness},
                {"normal_onset", data.normal_onset},         {"tangential_onset", data.tangential_onset},
                {"normal_toughness", data.normal_toughness}, {"tangential_toughness", data.tangential_toughness},
                {"onset_exponent_1", data.exponent},         {"onset_exponent_2", data.exponent},
                {"toughness_exponent_1", data.exponent},     {"toughness_exponent_2", data.exponent}};
            for (const auto& [key, value] : parameters) scene.require(delam_law_set(raw, key, value), key);
            counts_.push_back(scene.pairs(static_cast<std::int64_t>(i)).count());
        }
    }

    // Largest change of adhesion that one more damage step would make.
    double defect(const reference::Solver& solver, const std::vector<double>& old) const {
        const auto d = static_cast<std::size_t>(scene_.dimension());
        auto jump = solver.field("jump");
        const auto mixity = solver.field("mixity");
        const auto adhesion = solver.field("adhesion");
        for (std::size_t p = 0; p < old.size(); ++p) jump[p * d] = std::max(0.0, jump[p * d]);
        double change = 0.0;
        std::size_t first = 0;
        for (std::size_t i = 0; i < laws_.size(); first += counts_[i++]) {
            if (scene_.stiffness()[i].bonded) continue;
            std::vector<double> next(counts_[i]);
            REQUIRE(scene_, delam_law_respond, laws_[i].get(), scene_.dimension(),
                    static_cast<std::int64_t>(counts_[i]), jump.data() + first * d, mixity.data() + first,
                    old.data() + first, next.data(), nullptr);
            for (std::size_t p = 0; p < next.size(); ++p)
                change = std::max(change, std::abs(next[p] - adhesion[first + p]));
        }
        return change;
    }

private:
    const reference::Scene& scene_;
    std::vector<reference::Law> laws_;
    std::vector<std::size_t> counts_;
};

struct WatchedStep {
    double reaction, stored, dissipated, increment, defect;
};

struct Watched {
    std::vector<WatchedStep> steps;
    double solves = 0.0, newton = 0.0, alternations = 0.0, moves = 0.0;
    double worst_defect = 0.0;
    std::vector<double> adhesion;
};

inline double energy(const reference::Solver& solver) {
    return solver.value("stored_bulk") + solver.value("stored_interface") + solver.value("load_potential");
}

struct Watch {
    std::vector<reference::LawData> laws;
    std::vector<double> times;
    std::string reaction;  // of which pattern
    double delta = 1e-5;
    double kkt = 1e-10;
    bool fixed_point = true;  // require a damage defect <= delta
    // A step followed in parts: what a part has taken stays, so that the end is at rest from its own adhesion on.
    bool in_parts = false;
    int kkt_every = 5;
};

inline Watched watch(const reference::Scene& scene, const Watch& w, const std::string& where) {
    reference::Solver solver(scene, 0.0);
    const DamageProbe probe(scene, w.laws);
    const reference::Exported exported(scene);
    Watched result;
    for (std::size_t k = 0; k < w.times.size(); ++k) {
        const std::string at = where + ", step " + std::to_string(k + 1);
        const auto old = solver.field("adhesion");
        const double dissipated = solver.value("dissipated");
        solver.equilibrate(w.times[k], {});
        const double elastic = energy(solver);
        solver.rollback();
        solver.step(w.times[k]);
        const double spent = solver.value("dissipated") - dissipated;
        const double scale = std::abs(elastic) + solver.value("stored_bulk") + solver.value("dissipated");
        expect_below((energy(solver) + spent - elastic) / scale, 1e-11, at + ": the energy has risen");
        expect_below((solver.value("increment") - solver.value("upper")) / scale, 1e-9,
                     at + ": increment above the upper estimate");
        const auto adhesion = solver.field("adhesion");
        for (std::size_t p = 0; p < old.size(); ++p)
            expect(adhesion[p] <= old[p] && adhesion[p] >= 0.0, at + ": adhesion of pair " + std::to_string(p));
        const double defect = probe.defect(solver, w.in_parts ? adhesion : old);
        if (w.fixed_point)
            expect_below(defect, w.delta * (1.0 + 1e-6) + 1e-12, at + ": one more damage step moves an adhesion");
        if ((static_cast<int>(k) + 1) % w.kkt_every == 0 || k + 1 == w.times.size()) {
            const auto accepted = reference::accept(solver, exported);
            expect_below(accepted.worst(), w.kkt, at + ": " + accepted.text());
        }
        result.steps.push_back({solver.value("reaction:" + w.reaction),
                                solver.value("stored_bulk") + solver.value("stored_interface"),
                                solver.value("dissipated"), solver.value("increment"), defect});
        result.worst_defect = std::max(result.worst_defect, defect);
        result.solves += solver.value("displacement_solves");
        result.newton += solver.value("newton_solves");
        result.alternations += solver.value("am_iterations");
        result.moves += solver.value("debond_moves");
        solver.commit();
    }
    result.adhesion = solver.field("adhesion");
    std::printf(
        "%s: %.0f alternations, %.0f displacement solves, %.0f Newton solves, %.0f moves, worst damage defect %.1e; "
        "end: stored %.9g "
        "dissipated %.9g\n",
        where.c_str(), result.alternations, result.solves, result.newton, result.moves, result.worst_defect,
        result.steps.back().stored, result.steps.back().dissipated);
    return result;
}

// Reactions over the largest reaction, energies over the largest total.
inline void expect_same_analysis(const Watched& a, const Watched& b, double tolerance, const std::string& where) {
    double force = 0.0, total = 0.0;
    for (const WatchedStep& s : b.steps) {
        force = std::max(force, std::abs(s.reaction));
        total = std::max(total, s.stored + s.dissipated);
    }
    for (std::size_t k = 0; k < b.steps.size(); ++k) {
        const std::string at = where + ", step " + std::to_string(k + 1);
        expect_near(a.steps[k].reaction, b.steps[k].reaction, tolerance, force, at + ": reaction");
        expect_near(a.steps[k].stored, b.steps[k].stored, tolerance, total, at + ": stored");
        expect_near(a.steps[k].dissipated, b.steps[k].dissipated, tolerance, total, at + ": dissipated");
    }
}

inline std::vector<double> even_times(double end, int steps) {
    std::vector<double> t;
    for (int k = 1; k <= steps; ++k) t.push_back(end * k / steps);
    return t;
}

}  // namespace cases
