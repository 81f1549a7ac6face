// SPDX-License-Identifier: BSD-3-Clause
// FETI against the direct reference on the states of one ductile ENF analysis: one displacement step per load step at
// the exported adhesion.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "acceptance.hpp"
#include "comparison.hpp"
#include "direct.hpp"
#include "enf.hpp"

namespace cases {

// Direct solutions of every `stride`-th of the 40 steps, on squares of h.
struct DirectStates {
    DirectStates(double h, int stride);

    struct Entry {
        double time;
        std::vector<double> adhesion;
        reference::State state;
    };
    Enf enf;
    reference::Scene scene;
    reference::Exported exported;
    std::vector<Entry> entries;
};

inline DirectStates::DirectStates(double h, int stride) : enf{h}, scene(make_enf(enf)), exported(scene) {
    constexpr int steps = 40;
    const auto analysis = enf_analysis(enf, steps);
    reference::DirectReference direct(scene);
    for (int k = stride; k <= steps; k += stride) {
        const double time = enf_time(k, steps);
        const auto& adhesion = analysis[static_cast<std::size_t>(k)];
        entries.push_back({time, adhesion, direct.solve(time, adhesion)});
    }
}

struct FetiChoice {
    std::int64_t subdomains;
    const char* preconditioner;
    const char* gluing;
    std::string text() const { return std::to_string(subdomains) + " subdomains, " + preconditioner + ", " + gluing; }
};

// Calls `each` for every state: its index, the comparison, the status and the Krylov iterations. The contact set of one
// state is the first guess of the next, as in an analysis. Preconditioners that are not made for compliant interfaces
// may stall just above the linear tolerance and report it (DELAM_NOT_CONVERGED); the test compares the state in which
// they end with the reference's.
template <class Each>
void solve_all(const DirectStates& states, const FetiChoice& choice, Each&& each, double* worst_kkt = nullptr) {
    Enf e = states.enf;
    e.subdomains = choice.subdomains;
    e.preconditioner = choice.preconditioner;
    e.gluing = choice.gluing;
    e.linear_limit = 3000;
    const bool may_stall = e.preconditioner != "series";
    const auto scene = make_enf(e);
    reference::Solver solver(scene, 0.0);
    for (std::size_t i = 0; i < states.entries.size(); ++i) {
        const auto& entry = states.entries[i];
        const std::int32_t status = delam_solver_equilibrate(solver.get(), entry.time, entry.adhesion.data());
        if (status != DELAM_NOT_CONVERGED || !may_stall) scene.require(status, "delam_solver_equilibrate");
        each(i, reference::compare(solver, entry.state, states.exported, 1e-10), status,
             solver.value("linear_iterations"));
        if (worst_kkt != nullptr) *worst_kkt = std::max(*worst_kkt, reference::accept(solver, states.exported).worst());
        solver.commit();
    }
}

}  // namespace cases
