// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/turned/linear_buckling.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/memory_limit.hpp"
#include "base/numbers.hpp"
#include "linalg/sparse/cholesky.hpp"
#include "reduction/operator/body_system.hpp"
#include "reduction/sparse/spring_entries.hpp"
#include "reduction/turned/buckling_mode.hpp"

namespace delam {

namespace {

// A ratio is known to a per cent, or to a thousandth where it is small: it says how near the bodies are to buckling.
// (Of examples/mmb, 4enf, enf-ductile and laminate-thermal it is .0606, .0678, .0089, .0068 in 21, 15, 7, 50 solves,
// with half of `least` .0612, .0692, .0098, .0070 in 34, 29, 13, 56, with twice .0597, .0675, .0034, 0 in 14, 11, 3,
// 17, and to all digits .0612, .0692, .0099, .0070.)
constexpr ModeAccuracy enough{1e-2, 0.15};
// A mode presses faces into each other where their jump closes by more than this share of its largest jump: less is
// rounding, or the rim of what opens. (Half and twice give the same ratios of examples/mmb, 4enf, laminate-thermal and
// blister, and verify/cases/test_buckling passes; half and twice of held_as change them by less than 1e-9.)
constexpr double pressed = 1e-3;

// The bodies with the springs on their interfaces, factorised, in the variables that include the jumps.
class HeldBodies {
public:
    // transformed: of the bodies, which must outlive this.
    HeldBodies(const BodySystem& bodies, const SparseMatrix& transformed, const Springs& springs, const Poll& poll)
        : bodies_(bodies), matrix_(with_springs(transformed, springs)), factor_(matrix_, 0, poll) {}

    double bytes() const { return factor_.size().entries * sizeof(double); }
    bool factorise() { return factor_.factorise(matrix_); }
    // Returns the displacements under forces, both [mesh DOFs].
    std::vector<double> solve(std::span<const double> force) const {
        std::vector<double> f(index(matrix_.rows)), v(f.size()), u(index(bodies_.dofs()), 0.0);
        multiply_transposed(bodies_.variables().transform, force, f);
        factor_.solve(f, v);
        bodies_.add_variables(v, u);
        return u;
    }

private:
    SparseMatrix with_springs(const SparseMatrix& bodies, const Springs& springs) const {
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
        const JumpVariables& variables = bodies_.variables();
        for (std::size_t r = 0; r < variables.row.size(); ++r)
            if (springs.held[r] != 0 || springs.stiffness[r] > 0.0)
                add(variables.row[r], variables.leading + variables.kept, springs.stiffness[r], springs.held[r] != 0);
        for (const JumpVariables::Equation& equation : variables.equations)
            add(equation.entries, variables.leading, 0.0, true);
        return sum(bodies, from_triplets(bodies.rows, bodies.columns, std::move(entries)));
    }

    const BodySystem& bodies_;
    SparseMatrix matrix_;
    SparseCholesky factor_;
};

// True if a mode with either sign presses faces that touch into each other.
bool held_by_faces(std::span<const double> jump, std::span<const std::uint8_t> touching) {
    double opens = 0.0, closes = 0.0, most = 0.0;
    for (std::size_t r = 0; r < jump.size(); ++r) {
        most = std::max(most, std::abs(jump[r]));
        if (touching[r] == 0) continue;
        opens = std::max(opens, jump[r]);
        closes = std::max(closes, -jump[r]);
    }
    return std::min(opens, closes) > pressed * most;
}

}  // namespace

double critical_ratio(const Problem& problem, Springs springs, std::span<const std::uint8_t> touching,
                      const InitialStress& stress, const Poll& poll) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    if (problem.engine != nullptr) return unknown;
    const BodySystem bodies(problem, poll);
    const SparseMatrix transformed = bodies.transformed(poll);
    double factor = unknown;
    for (const bool all_hold : {false, true}) {
        for (std::size_t r = 0; r < touching.size() && all_hold; ++r)
            if (touching[r] != 0) springs.held[r] = 1;
        HeldBodies held(bodies, transformed, springs, poll);
        if (held.bytes() > memory_limit(problem.options.memory_limit).bytes || !held.factorise()) return factor;
        const BucklingMode mode = buckling_mode(
            index(bodies.dofs()), [&](std::span<const double> f) { return held.solve(f); },
            [&](std::span<const double> v) { return stress.softening(v); }, enough);
        factor = std::max(mode.factor, 0.0);
        if (factor == 0.0 || !held_by_faces(bodies.jump(mode.displacement), touching)) break;
    }
    return factor;
}

}  // namespace delam
