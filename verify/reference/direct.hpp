// SPDX-License-Identifier: BSD-3-Clause
// One displacement step solved as a single problem: all bodies, springs, supports and contacts in one symmetric system.
//
// The unknowns of a node pair are the displacement of one node and the jump in the local frame, so that a stiff spring
// lies on the diagonal and a closed contact drops its unknown. Supports are eliminated (elimination.hpp). Contact has
// an active set of its own. Every body must be held by supports, springs or closed contacts; a free one is refused
// (Failure). Where supports and bonds are redundant, the tractions and reactions among them are not unique, and those
// of the redundant rows are zero.
#pragma once

#include <functional>
#include <vector>

#include "elimination.hpp"
#include "exported.hpp"
#include "factor.hpp"

namespace reference {

struct State {
    std::vector<double> displacement;  // [dofs]
    std::vector<double> jump;          // [pairs][dim], local, normal first
    std::vector<double> traction;      // [pairs][dim], tension positive
    std::vector<bool> contact;         // [pairs]
    std::vector<double> reaction;      // [constraints]
    std::vector<double> pattern;       // [patterns], conjugate of each factor
    double stored_bulk = 0.0;
    double stored_interface = 0.0;
    int contact_iterations = 0;
};

class DirectReference {
public:
    explicit DirectReference(const Scene& scene);

    // adhesion: [pairs], interface after interface. The first guess is the contact set of the last solve.
    State solve(double time, const std::vector<double>& adhesion);

    const Exported& exported() const { return exported_; }

    // Called with each linear system: the number of unknowns and the lower triangle of the matrix.
    std::function<void(std::size_t, const Triplets&)> on_matrix;

private:
    struct Pair {
        std::size_t interface_index;
        std::int64_t node_a, node_b;
        double weight;
        const double* frame;
    };
    struct System;

    void choose_unknowns();
    Affine combination(const std::vector<std::pair<std::int64_t, double>>& dof_terms) const;
    State solve_linear(const std::vector<double>& values, const std::vector<double>& force,
                       const std::vector<double>& adhesion) const;
    void recover_multipliers(const System& system, const std::vector<long double>& unbalance, State& state) const;
    bool update_contact(const State& state, const std::vector<double>& adhesion, bool one_at_a_time);
    double spring(std::size_t pair, int component, const std::vector<double>& adhesion) const;
    std::vector<std::pair<std::int64_t, double>> jump_dofs(std::size_t pair, int component) const;

    const Scene* scene_;
    Exported exported_;
    std::vector<Pair> pairs_;
    std::vector<bool> is_jump_;         // of each unknown
    std::vector<Affine> displacement_;  // DOF as a function of the unknowns
    std::vector<Affine> jump_;          // [pairs][dim] as functions of the unknowns
    std::vector<bool> closed_;
    std::vector<double> factor_;  // of the patterns, at the time of the solve
    bool first_ = true;
};

}  // namespace reference
