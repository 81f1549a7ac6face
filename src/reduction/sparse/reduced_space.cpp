// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/reduced_space.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"
#include "linalg/sparse/sparse_elimination.hpp"

namespace delam {

void ReducedSpace::hold(std::span<const std::uint8_t> held) {
    if (known_ && std::ranges::equal(held, held_)) return;
    known_ = false;
    held_.assign(held.begin(), held.end());
    std::vector<std::uint8_t> out(index(count_), 0);
    slaves_.clear();
    binding_.clear();
    binding_terms_.clear();
    gram_.reset();
    std::vector<std::int64_t> others;
    for (std::size_t e = 0; e < rows_.equations().size(); ++e) others.push_back(-1 - static_cast<std::int64_t>(e));
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        if (held_[r] == 0 || rows_.prescribed()[r] != 0) continue;
        if (rows_.variable_of(r) < 0)
            others.push_back(static_cast<std::int64_t>(r));
        else
            out[index(rows_.variable_of(r))] = 1;
    }
    if (!others.empty()) bind(others, out);
    removed_.clear();
    for (std::size_t r = 0; r < rows_.size(); ++r)
        if (rows_.variable_of(r) >= 0 && out[index(rows_.variable_of(r))] != 0)
            removed_.push_back(rows_.variable_of(r));
    known_ = true;
}

// The pivot of a row is its largest coefficient, displacements (which come first) before jumps. out: removed variables.
// A constraint among removed variables alone takes back its first one, which occurs in no other.
void ReducedSpace::bind(std::span<const std::int64_t> others, std::vector<std::uint8_t>& out) {
    SparseElimination solved;
    std::vector<std::int64_t> pivots;
    for (const std::int64_t at : others) {
        const SparseVector& terms = at < 0 ? rows_.equations()[index(-1 - at)] : rows_[index(at)].unknowns;
        SparseElimination::Row row{{}, std::vector<double>(rows_.patterns(), 0.0)};
        SparseVector kept;
        for (const auto& [i, c] : terms)
            if (out[index(i)] == 0) {
                row.terms[i] += c;
                kept.emplace_back(i, c);
            }
        if (at < 0)
            row.right = rows_.equation_right(index(-1 - at));
        else
            for (std::size_t p = 0; p < rows_[index(at)].offset.size(); ++p) row.right[p] = -rows_[index(at)].offset[p];
        solved.reduce(row);
        if (row.terms.empty()) {
            if (at >= 0) continue;
            const auto& [first, c] = terms.front();
            out[index(first)] = 0;
            row.terms[first] = c;
            kept.emplace_back(first, c);
        }
        auto pivot = row.terms.begin();
        for (auto term = row.terms.begin(); term != row.terms.end(); ++term)
            if (std::abs(term->second) > (1.0 + 1e-9) * std::abs(pivot->second)) pivot = term;
        pivots.push_back(pivot->first);
        solved.solve(row, pivot->first);
        binding_.push_back(at);
        binding_terms_.push_back(std::move(kept));
    }
    solved.close();
    for (const std::int64_t p : pivots) {
        const SparseElimination::Solution& solution = *solved.find(p);
        slaves_.push_back({p, solution.terms, solution.right});
    }
}

void ReducedSpace::spread(std::span<double> x) const {
    for (const std::int64_t i : removed_) x[index(i)] = 0.0;
    for (const Slave& slave : slaves_) {
        double sum = 0.0;
        for (const auto& [i, c] : slave.masters) sum += c * x[index(i)];
        x[index(slave.pivot)] = sum;
    }
}

void ReducedSpace::spread(std::span<double> x, std::span<const double> theta) const {
    spread(x);
    for (const Slave& slave : slaves_) x[index(slave.pivot)] += dot(slave.right, theta);
}

void ReducedSpace::reduce(std::span<double> x) const {
    for (const std::int64_t i : removed_) x[index(i)] = 0.0;
    for (const Slave& slave : slaves_) x[index(slave.pivot)] = 0.0;
}

void ReducedSpace::gather(std::span<double> force) const {
    for (const Slave& slave : slaves_) {
        for (const auto& [i, c] : slave.masters) force[index(i)] += c * force[index(slave.pivot)];
        force[index(slave.pivot)] = 0.0;
    }
    for (const std::int64_t i : removed_) force[index(i)] = 0.0;
}

void ReducedSpace::gather_sizes(std::span<double> size) const {
    for (const Slave& slave : slaves_) {
        for (const auto& [i, c] : slave.masters) size[index(i)] += std::abs(c) * size[index(slave.pivot)];
        size[index(slave.pivot)] = 0.0;
    }
    for (const std::int64_t i : removed_) size[index(i)] = 0.0;
}

void ReducedSpace::factor_binding() const {
    const auto n = static_cast<std::int64_t>(binding_.size());
    std::map<std::int64_t, SparseVector> users;
    for (std::size_t b = 0; b < binding_.size(); ++b)
        for (const auto& [i, c] : binding_terms_[b]) users[i].emplace_back(static_cast<std::int64_t>(b), c);
    std::vector<Triplet> triplets;
    for (const auto& [i, list] : users)
        for (const auto& [a, c] : list)
            for (const auto& [b, d] : list) triplets.push_back({a, b, c * d});
    const SparseMatrix gram = from_triplets(n, n, std::move(triplets));
    auto factor = std::make_unique<SparseCholesky>(gram);
    if (!factor->factorise(gram))
        fail(DELAM_ERROR_NUMERICAL, "the ", n, " rows that bind several jumps to each other are dependent");
    gram_ = std::move(factor);
}

// The rows are independent and what is left over is theirs, so that the least-squares solution is the solution.
std::vector<double> ReducedSpace::multipliers(std::span<double> left, std::span<double> force) const {
    std::vector<double> mu(rows_.equations().size(), 0.0);
    if (!binding_.empty()) {
        if (gram_ == nullptr) factor_binding();
        std::vector<double> right(binding_.size(), 0.0), lambda(binding_.size());
        for (std::size_t b = 0; b < binding_.size(); ++b)
            for (const auto& [i, c] : binding_terms_[b]) right[b] += c * left[index(i)];
        gram_->solve(right, lambda);
        for (std::size_t b = 0; b < binding_.size(); ++b) {
            const std::int64_t at = binding_[b];
            const SparseVector& terms = at < 0 ? rows_.equations()[index(-1 - at)] : rows_[index(at)].unknowns;
            for (const auto& [i, c] : terms) left[index(i)] -= c * lambda[b];
            (at < 0 ? mu[index(-1 - at)] : force[index(at)]) += lambda[b];
        }
    }
    for (const std::int64_t i : removed_) force[index(rows_.row_of(i))] += left[index(i)];
    return mu;
}

}  // namespace delam
