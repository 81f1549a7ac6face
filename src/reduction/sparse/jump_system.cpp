// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/jump_system.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"
#include "linalg/sparse/cholesky.hpp"
#include "linalg/sparse/sparse_elimination.hpp"

namespace delam {

namespace {

// The pattern of `a` with these entries in it, zero where they are missing. links: by rows.
SparseMatrix with_entries(SparseMatrix a, const SparseMatrix& links) {
    SparseMatrix out;
    bool missing = false;
    for (std::int64_t r = 0; r < a.rows && !missing; ++r) {
        const auto begin = a.column.begin() + a.start[index(r)], end = a.column.begin() + a.start[index(r) + 1];
        for (std::int64_t e = links.start[index(r)]; e < links.start[index(r) + 1] && !missing; ++e)
            missing = !std::binary_search(begin, end, links.column[index(e)]);
    }
    if (!missing) return a;
    out.rows = a.rows;
    out.columns = a.columns;
    out.column.reserve(a.column.size() + links.column.size());
    out.value.reserve(a.column.size() + links.column.size());
    for (std::int64_t r = 0; r < a.rows; ++r) {
        std::int64_t l = links.start[index(r)];
        const std::int64_t last = links.start[index(r) + 1];
        const auto before = [&](std::int64_t column) {
            for (; l < last && links.column[index(l)] < column; ++l) {
                out.column.push_back(links.column[index(l)]);
                out.value.push_back(0.0);
            }
        };
        for (std::int64_t e = a.start[index(r)]; e < a.start[index(r) + 1]; ++e) {
            before(a.column[index(e)]);
            if (l < last && links.column[index(l)] == a.column[index(e)]) ++l;
            out.column.push_back(a.column[index(e)]);
            out.value.push_back(a.value[index(e)]);
        }
        before(a.columns);
        out.start.push_back(static_cast<std::int64_t>(out.column.size()));
    }
    return out;
}

// All variables of a pair's rows act on each other.
SparseMatrix pair_links(const std::vector<JumpRow>& rows, std::size_t dim, std::int64_t count) {
    std::vector<Triplet> links;
    std::vector<std::int64_t> of_pair;
    for (std::size_t first = 0; first + dim <= rows.size(); first += dim) {
        of_pair.clear();
        for (std::size_t r = first; r < first + dim; ++r)
            for (const auto& [i, n] : rows[r].unknowns) of_pair.push_back(i);
        for (const std::int64_t i : of_pair)
            for (const std::int64_t j : of_pair) links.push_back({i, j, 0.0});
    }
    for (std::int64_t i = 0; i < count; ++i) links.push_back({i, i, 0.0});
    return from_triplets(count, count, std::move(links));
}

}  // namespace

JumpSystem::JumpSystem(const BodySystem& bodies, SparseMatrix transformed, const Poll& poll)
    : limits_(bodies.problem().options.limits),
      patterns_(bodies.problem().patterns.size()),
      matrix_(std::move(transformed)) {
    express_rows(bodies);
    call_if_set(poll);
    matrix_ =
        with_entries(std::move(matrix_), pair_links(rows_, index(bodies.problem().mesh->dimension()), matrix_.rows));
    for (std::int64_t r = 0; r < matrix_.rows; ++r) {
        const auto begin = matrix_.column.begin() + matrix_.start[index(r)],
                   end = matrix_.column.begin() + matrix_.start[index(r) + 1];
        diagonal_.push_back(matrix_.value[index(std::lower_bound(begin, end, r) - matrix_.column.begin())]);
    }
}

JumpSystem::JumpSystem(const BodySystem& bodies)
    : limits_(bodies.problem().options.limits),
      patterns_(bodies.problem().patterns.size()),
      first_(bodies.variables().leading) {
    matrix_.rows = matrix_.columns = bodies.variables().trailing();
    matrix_.start.assign(index(matrix_.rows) + 1, 0);
    diagonal_.assign(index(matrix_.rows), 0.0);
    express_rows(bodies);
}

// A row that the constraints prescribe has no variable. Other jumps that they bind stay variables: expressed by all
// others of an interface, they would fill the matrix.
void JumpSystem::express_rows(const BodySystem& bodies) {
    const JumpVariables& variables = bodies.variables();
    const std::int64_t trailing = variables.leading - first_;
    const std::vector<SolvedEquation> equations = solve_equations(variables);
    for (const SolvedEquation& solved : equations) {
        SparseVector& equation = equations_.emplace_back();
        equation.emplace_back(trailing + solved.pivot, 1.0);
        for (const auto& [t, c] : solved.entries) equation.emplace_back(trailing + t, -c);
        equation_right_.push_back(solved.prescribed);
    }
    row_of_.assign(index(count()), -1);
    std::vector<JumpRow> expressed = delam::express_rows(variables, equations);
    for (std::size_t r = 0; r < expressed.size(); ++r) {
        JumpRow row{{}, variables.row_offset[r]};
        for (const auto& [jump, n] : variables.row[r]) row.unknowns.emplace_back(trailing + variables.kept + jump, n);
        if (expressed[r].prescribed()) row = std::move(expressed[r]);
        const bool plain = row.offset.empty() && row.unknowns.size() == 1 && row.unknowns.front().second == 1.0 &&
                           row_of_[index(row.unknowns.front().first)] < 0;
        if (plain) row_of_[index(row.unknowns.front().first)] = static_cast<std::int64_t>(r);
        plain_.push_back(plain ? row.unknowns.front().first : -1);
        prescribed_.push_back(row.prescribed() ? 1 : 0);
        rows_.push_back(std::move(row));
    }
}

// Adds in place: a copy of the matrix would be one of the largest blocks of memory.
void JumpSystem::with_added(std::span<const Triplet> entries, const std::function<void(const SparseMatrix&)>& use) {
    struct Restored {
        SparseMatrix& matrix;
        std::vector<std::pair<std::size_t, double>> before;
        ~Restored() {
            for (std::size_t k = before.size(); k-- > 0;) matrix.value[before[k].first] = before[k].second;
        }
    } restored{matrix_, {}};
    restored.before.reserve(entries.size());
    for (const Triplet& t : entries) {
        const auto begin = matrix_.column.begin() + matrix_.start[index(t.row)],
                   end = matrix_.column.begin() + matrix_.start[index(t.row) + 1];
        const auto at = index(std::lower_bound(begin, end, t.column) - matrix_.column.begin());
        restored.before.emplace_back(at, matrix_.value[at]);
        matrix_.value[at] += t.value;
    }
    use(matrix_);
}

void JumpSystem::set(std::vector<Zone::Coupling> couplings, std::span<const std::uint8_t> held) {
    std::erase_if(couplings, [&](const Zone::Coupling& c) { return held[index(c.row)] + held[index(c.column)] > 0; });
    couplings_ = std::move(couplings);
    if (known_ && std::ranges::equal(held, held_)) return;
    known_ = false;
    held_.assign(held.begin(), held.end());
    hold();
    known_ = true;
}

void JumpSystem::hold() {
    std::vector<std::uint8_t> out(index(count()), 0);
    slaves_.clear();
    binding_.clear();
    binding_terms_.clear();
    gram_.reset();
    std::vector<std::int64_t> others;
    for (std::size_t e = 0; e < equations_.size(); ++e) others.push_back(-1 - static_cast<std::int64_t>(e));
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        if (held_[r] == 0 || prescribed_[r] != 0) continue;
        if (plain_[r] < 0)
            others.push_back(static_cast<std::int64_t>(r));
        else
            out[index(plain_[r])] = 1;
    }
    if (!others.empty()) bind(others, out);
    removed_.clear();
    for (std::size_t r = 0; r < rows_.size(); ++r)
        if (plain_[r] >= 0 && out[index(plain_[r])] != 0) removed_.push_back(plain_[r]);
}

// The pivot of a row is its largest coefficient, displacements (which come first) before jumps. out: removed variables.
// A constraint among removed variables alone takes back its first one, which occurs in no other.
void JumpSystem::bind(std::span<const std::int64_t> others, std::vector<std::uint8_t>& out) {
    SparseElimination solved;
    std::vector<std::int64_t> pivots;
    for (const std::int64_t at : others) {
        const SparseVector& terms = at < 0 ? equations_[index(-1 - at)] : rows_[index(at)].unknowns;
        SparseElimination::Row row{{}, std::vector<double>(patterns_, 0.0)};
        SparseVector kept;
        for (const auto& [i, c] : terms)
            if (out[index(i)] == 0) {
                row.terms[i] += c;
                kept.emplace_back(i, c);
            }
        if (at < 0)
            row.right = equation_right_[index(-1 - at)];
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

std::vector<double> JumpSystem::offsets(std::span<const double> theta) const {
    std::vector<double> o(rows_.size(), 0.0);
    for (std::size_t r = 0; r < rows_.size(); ++r)
        if (!rows_[r].offset.empty()) o[r] = dot(rows_[r].offset, theta);
    return o;
}

void JumpSystem::spread(std::span<double> x) const {
    for (const std::int64_t i : removed_) x[index(i)] = 0.0;
    for (const Slave& slave : slaves_) {
        double sum = 0.0;
        for (const auto& [i, c] : slave.masters) sum += c * x[index(i)];
        x[index(slave.pivot)] = sum;
    }
}

void JumpSystem::spread(std::span<double> x, std::span<const double> theta) const {
    spread(x);
    for (const Slave& slave : slaves_) x[index(slave.pivot)] += dot(slave.right, theta);
}

void JumpSystem::reduce(std::span<double> x) const {
    for (const std::int64_t i : removed_) x[index(i)] = 0.0;
    for (const Slave& slave : slaves_) x[index(slave.pivot)] = 0.0;
}

void JumpSystem::gather(std::span<double> force) const {
    for (const Slave& slave : slaves_) {
        for (const auto& [i, c] : slave.masters) force[index(i)] += c * force[index(slave.pivot)];
        force[index(slave.pivot)] = 0.0;
    }
    for (const std::int64_t i : removed_) force[index(i)] = 0.0;
}

void JumpSystem::gather_sizes(std::span<double> size) const {
    for (const Slave& slave : slaves_) {
        for (const auto& [i, c] : slave.masters) size[index(i)] += std::abs(c) * size[index(slave.pivot)];
        size[index(slave.pivot)] = 0.0;
    }
    for (const std::int64_t i : removed_) size[index(i)] = 0.0;
}

double JumpSystem::row_value(std::size_t row, std::span<const double> x) const {
    double sum = 0.0;
    for (const auto& [i, n] : rows_[row].unknowns) sum += n * x[index(i)];
    return sum;
}

void JumpSystem::add_row(std::size_t row, double factor, std::span<double> force) const {
    for (const auto& [i, n] : rows_[row].unknowns) force[index(i)] += n * factor;
}

void JumpSystem::add_couplings(std::span<const double> x, std::span<double> y) const {
    for (const Zone::Coupling& c : couplings_) add_row(index(c.row), c.value * row_value(index(c.column), x), y);
}

void JumpSystem::apply(std::span<const double> x, std::span<double> y) const {
    poll_cancel_reading("linear solve", matrix_.entries());
    multiply(matrix_, x, y);
    add_couplings(x, y);
}

void JumpSystem::factor_binding() const {
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

// The matrix is symmetric: its rows are its columns.
void JumpSystem::apply_sparse(std::span<const double> x, std::span<double> y) const {
    std::fill(y.begin(), y.end(), 0.0);
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (x[i] == 0.0) continue;
        for (std::int64_t e = matrix_.start[i]; e < matrix_.start[i + 1]; ++e)
            y[index(matrix_.column[index(e)])] += matrix_.value[index(e)] * x[i];
    }
    add_couplings(x, y);
}

void JumpSystem::apply(std::span<const double> x, std::span<double> y, std::span<const std::uint8_t> wanted) const {
    std::fill(y.begin(), y.end(), 0.0);
    for (std::size_t i = 0; i < wanted.size(); ++i)
        if (wanted[i] != 0) y[i] = matrix_row(i, x);
    for (const Slave& slave : slaves_) y[index(slave.pivot)] = matrix_row(index(slave.pivot), x);
    add_couplings(x, y);
}

void JumpSystem::apply(std::span<const double> x, std::span<double> y, std::span<double> size) const {
    for (std::size_t i = 0; i < x.size(); ++i) {
        double sum = 0.0, terms = 0.0;
        for (std::int64_t e = matrix_.start[i]; e < matrix_.start[i + 1]; ++e) {
            const double term = matrix_.value[index(e)] * x[index(matrix_.column[index(e)])];
            sum += term;
            terms += std::abs(term);
        }
        y[i] = sum;
        size[i] = terms;
    }
    for (const Zone::Coupling& c : couplings_) {
        const double force = c.value * row_value(index(c.column), x);
        for (const auto& [i, n] : rows_[index(c.row)].unknowns) {
            y[index(i)] += n * force;
            size[index(i)] += std::abs(n * force);
        }
    }
}

double JumpSystem::matrix_row(std::size_t i, std::span<const double> x) const {
    double sum = 0.0;
    for (std::int64_t e = matrix_.start[i]; e < matrix_.start[i + 1]; ++e)
        sum += matrix_.value[index(e)] * x[index(matrix_.column[index(e)])];
    return sum;
}

void JumpSystem::multiply_held(std::span<const double> x, std::span<double> y) const {
    std::fill(y.begin(), y.end(), 0.0);
    for (const std::int64_t i : removed_) y[index(i)] = matrix_row(index(i), x);
    for (const SparseVector& terms : binding_terms_)
        for (const auto& [i, c] : terms) y[index(i)] = matrix_row(index(i), x);
}

// The rows are independent and what is left over is theirs, so that the least-squares solution is the solution.
std::vector<double> JumpSystem::multipliers(std::span<double> left, std::span<double> force) const {
    std::vector<double> mu(equations_.size(), 0.0);
    if (!binding_.empty()) {
        if (gram_ == nullptr) factor_binding();
        std::vector<double> right(binding_.size(), 0.0), lambda(binding_.size());
        for (std::size_t b = 0; b < binding_.size(); ++b)
            for (const auto& [i, c] : binding_terms_[b]) right[b] += c * left[index(i)];
        gram_->solve(right, lambda);
        for (std::size_t b = 0; b < binding_.size(); ++b) {
            const std::int64_t at = binding_[b];
            const SparseVector& terms = at < 0 ? equations_[index(-1 - at)] : rows_[index(at)].unknowns;
            for (const auto& [i, c] : terms) left[index(i)] -= c * lambda[b];
            (at < 0 ? mu[index(-1 - at)] : force[index(at)]) += lambda[b];
        }
    }
    for (const std::int64_t i : removed_) force[index(row_of_[index(i)])] += left[index(i)];
    return mu;
}

}  // namespace delam
