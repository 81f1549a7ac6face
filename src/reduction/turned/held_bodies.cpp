// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/turned/held_bodies.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/memory_limit.hpp"
#include "base/numbers.hpp"
#include "reduction/sparse/spring_entries.hpp"

namespace delam {

std::unique_ptr<HeldBodies> HeldBodies::of(const Problem& problem, const BodySystem* system, Springs springs,
                                           const Poll& poll) {
    if (problem.engine != nullptr) return nullptr;
    std::unique_ptr<const BodySystem> own;
    if (system == nullptr) own = std::make_unique<const BodySystem>(problem, poll);
    const BodySystem& bodies = own ? *own : *system;
    const double most = memory_limit(problem.options.memory_limit).bytes;
    return factorised(std::make_shared<const Bodies>(Bodies{std::move(own), bodies, bodies.transformed(poll), most}),
                      std::move(springs), poll);
}

std::unique_ptr<HeldBodies> HeldBodies::with(Springs springs, const Poll& poll) const {
    return factorised(bodies_, std::move(springs), poll);
}

std::unique_ptr<HeldBodies> HeldBodies::factorised(std::shared_ptr<const Bodies> bodies, Springs springs,
                                                   const Poll& poll) {
    std::unique_ptr<HeldBodies> held(new HeldBodies(std::move(bodies), std::move(springs), poll));
    const double bytes = held->factor_.size().entries * sizeof(double);
    if (bytes > held->bodies_->most_bytes || !held->factor_.factorise(held->matrix_)) return nullptr;
    return held;
}

HeldBodies::HeldBodies(std::shared_ptr<const Bodies> bodies, Springs springs, const Poll& poll)
    : bodies_(std::move(bodies)), springs_(std::move(springs)), matrix_(with_springs()), factor_(matrix_, 0, poll) {}

std::vector<double> HeldBodies::solve(std::span<const double> force) const {
    const BodySystem& system = bodies_->system;
    std::vector<double> f(index(matrix_.rows)), v(f.size()), u(index(system.dofs()), 0.0);
    multiply_transposed(system.variables().transform, force, f);
    factor_.solve(f, v);
    system.add_variables(v, u);
    return u;
}

SparseMatrix HeldBodies::with_springs() const {
    const SparseMatrix& bodies = bodies_->transformed;
    std::vector<double> diagonal(index(bodies.rows), 0.0);
    std::vector<Triplet> entries;
    for (std::int64_t r = 0; r < bodies.rows; ++r)
        for (std::int64_t e = bodies.start[index(r)]; e < bodies.start[index(r) + 1]; ++e)
            if (bodies.column[index(e)] == r) diagonal[index(r)] = bodies.value[index(e)];
    // Adds a spring on a sum of variables from `first` on; one without a stiffness is so stiff that it holds them.
    const auto add = [&](const SparseVector& row, std::int64_t first, double stiffness, bool holds) {
        for (const auto& [i, a] : row)
            if (holds) stiffness = std::max(stiffness, held_as * diagonal[index(first + i)]);
        for (const auto& [i, a] : row)
            for (const auto& [j, b] : row) entries.push_back({first + i, first + j, a * b * stiffness});
    };
    const JumpVariables& variables = bodies_->system.variables();
    for (std::size_t r = 0; r < variables.row.size(); ++r)
        if (springs_.held[r] != 0 || springs_.stiffness[r] > 0.0)
            add(variables.row[r], variables.leading + variables.kept, springs_.stiffness[r], springs_.held[r] != 0);
    for (const JumpVariables::Equation& equation : variables.equations)
        add(equation.entries, variables.leading, 0.0, true);
    return sum(bodies, from_triplets(bodies.rows, bodies.columns, std::move(entries)));
}

}  // namespace delam
