// SPDX-License-Identifier: BSD-3-Clause
#include "dense_engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace fuzz {

namespace {

using Values = std::vector<double>;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

double dot(const Values& a, const Values& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

Dense product(const Dense& a, const Dense& b) {
    Dense c(a.rows, b.columns);
    for (std::size_t i = 0; i < a.rows; ++i)
        for (std::size_t k = 0; k < a.columns; ++k) {
            const double f = a(i, k);
            if (f == 0.0) continue;
            for (std::size_t j = 0; j < b.columns; ++j) c(i, j) += f * b(k, j);
        }
    return c;
}

Dense transposed(const Dense& a) {
    Dense t(a.columns, a.rows);
    for (std::size_t i = 0; i < a.rows; ++i)
        for (std::size_t j = 0; j < a.columns; ++j) t(j, i) = a(i, j);
    return t;
}

// Cholesky's factorisation in the place of a, then the solution in the place of x; whether a is positive definite.
// Rows without entries are left out.
bool solve_in_place(Dense& a, Values& x) {
    const std::size_t n = a.rows;
    std::vector<bool> empty(n, false);
    for (std::size_t i = 0; i < n; ++i) {
        empty[i] = std::all_of(&a.value[i * n], &a.value[i * n] + n, [](double v) { return v == 0.0; });
        if (empty[i]) a(i, i) = 1.0, x[i] = 0.0;
    }
    for (std::size_t j = 0; j < n; ++j) {
        const double before = a(j, j);
        double pivot = before;
        for (std::size_t k = 0; k < j; ++k) pivot -= a(j, k) * a(j, k);
        if (!(pivot > 1e-13 * before)) return false;
        pivot = std::sqrt(pivot);
        a(j, j) = pivot;
        for (std::size_t i = j + 1; i < n; ++i) {
            double sum = a(i, j);
            for (std::size_t k = 0; k < j; ++k) sum -= a(i, k) * a(j, k);
            a(i, j) = sum / pivot;
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) x[i] -= a(i, k) * x[k];
        x[i] /= a(i, i);
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) x[i] -= a(k, i) * x[k];
        x[i] /= a(i, i);
    }
    return true;
}

}  // namespace

Values Dense::times(const Values& x) const {
    Values y(rows, 0.0);
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c) y[r] += (*this)(r, c) * x[c];
    return y;
}

Values Dense::transposed_times(const Values& x) const {
    Values y(columns, 0.0);
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c) y[c] += (*this)(r, c) * x[r];
    return y;
}

Dense stiffness_of(const delam_mesh* mesh, const delam_problem* problem) {
    std::int64_t dofs = 0, nodes = 0;
    std::int32_t dimension = 0;
    delam_problem_dofs(problem, &dofs, nullptr);
    Dense all(at(dofs), at(dofs));
    if (mesh != nullptr) delam_mesh_size(mesh, &dimension, &nodes, nullptr, nullptr, nullptr);
    bool fits = nodes > 0 && nodes * dimension == dofs;
    std::vector<std::int32_t> bodies(at(nodes));
    if (fits) delam_mesh_node_bodies(mesh, nodes, bodies.data());
    const std::int32_t last = fits ? *std::max_element(bodies.begin(), bodies.end()) : -1;
    for (std::int32_t body = 0; body <= last && fits; ++body) {
        std::vector<std::size_t> own;
        for (std::size_t n = 0; n < bodies.size(); ++n)
            for (std::size_t d = 0; d < at(dimension) && bodies[n] == body; ++d) own.push_back(n * at(dimension) + d);
        std::int64_t rows = 0, entries = 0;
        if (own.empty() ||
            delam_problem_body_matrix(problem, body, &rows, &entries, nullptr, nullptr, nullptr) != DELAM_OK)
            continue;
        fits = at(rows) == own.size();
        if (!fits) break;
        std::vector<std::int64_t> starts(at(rows + 1)), columns(at(entries));
        Values values(at(entries));
        delam_problem_body_matrix(problem, body, nullptr, nullptr, starts.data(), columns.data(), values.data());
        for (std::size_t r = 0; r < own.size(); ++r)
            for (std::int64_t e = starts[r]; e < starts[r + 1]; ++e)
                all(own[r], own[at(columns[at(e)])]) += values[at(e)];
    }
    if (fits) return all;
    Dense other(at(dofs), at(dofs));
    for (std::size_t i = 0; i < other.rows; ++i) other(i, i) = 1000.0;
    return other;
}

bool DenseEngine::spoils(Nonsense what) { return awake && nonsense == what; }

bool DenseEngine::fails() {
    if (++calls > calls_at_most && awake) {
        fail_with = DELAM_ERROR_NUMERICAL;
        return failed = true;
    }
    if (!awake || fail_in < 0 || fail_in-- > 0) return false;
    failed = failed || fail_with != DELAM_OK;
    return fail_with != DELAM_OK;
}

void DenseEngine::spoil(double* values, std::size_t count) {
    if (count == 0) return;
    if (spoils(Nonsense::not_finite)) values[count - 1] = std::nan(""), failed = true;
    if (spoils(Nonsense::huge)) values[0] = 1e300, failed = true;
}

delam_experimental_engine DenseEngine::functions() {
    delam_experimental_engine e{};
    e.size = sizeof e;
    e.kept = 8;
    e.user = this;
    e.prepare = [](const delam_experimental_variables* v, double* diagonal, double* load_sizes, void* user) {
        auto& own = *static_cast<DenseEngine*>(user);
        if (own.fails()) return own.fail_with;
        own.prepare(*v, diagonal, load_sizes);
        return std::int32_t{DELAM_OK};
    };
    e.set = [](const delam_experimental_entries* couplings, std::int64_t fixed_count, const std::int64_t* fixed,
               std::int64_t pivot_count, const std::int64_t* pivots, const delam_experimental_entries* masters,
               void* user) {
        auto& own = *static_cast<DenseEngine*>(user);
        if (own.fails()) return own.fail_with;
        own.set(*couplings, fixed_count, fixed, pivot_count, pivots, *masters);
        return std::int32_t{DELAM_OK};
    };
    e.renew = [](const delam_experimental_entries*, double* cost, void* user) {
        auto& own = *static_cast<DenseEngine*>(user);
        if (own.fails()) return own.fail_with;
        *cost = 10.0;
        own.spoil(cost, 1);
        return std::int32_t{DELAM_OK};
    };
    e.solve = [](const delam_experimental_request* request, delam_experimental_answer* answer, void* user) {
        auto& own = *static_cast<DenseEngine*>(user);
        return own.fails() ? own.fail_with : own.solve(*request, *answer);
    };
    e.recover = [](const double* weights, double* displacement, double* force, void* user) {
        auto& own = *static_cast<DenseEngine*>(user);
        if (own.fails()) return own.fail_with;
        own.recover(weights, displacement, force);
        if (force != nullptr) own.spoil(force, own.k_.rows);
        return std::int32_t{DELAM_OK};
    };
    e.release = [](void* user) { ++static_cast<DenseEngine*>(user)->released; };
    e.message = [](void* user) -> const char* {
        auto& own = *static_cast<DenseEngine*>(user);
        if (own.spoils(Nonsense::no_message)) return nullptr;
        own.message_ = "as asked: " + std::to_string(own.fail_with);
        return own.message_.c_str();
    };
    return e;
}

void DenseEngine::prepare(const delam_experimental_variables& v, double* diagonal, double* load_sizes) {
    const std::size_t dofs = at(v.dofs), count = dofs + at(v.jump_count);
    // A problem of another size got the engine: zeros beyond its own stiffness.
    Dense k(dofs, dofs);
    for (std::size_t i = 0; i < std::min(dofs, k_.rows); ++i)
        for (std::size_t j = 0; j < std::min(dofs, k_.rows); ++j) k(i, j) = k_(i, j);
    k_ = std::move(k);
    t_ = Dense(dofs, count);
    std::vector<bool> replaced(dofs, false);
    for (std::int64_t r = 0; r < v.replaced_count; ++r) {
        replaced[at(v.replaced[r])] = true;
        for (std::int64_t e = v.row_starts[r]; e < v.row_starts[r + 1]; ++e)
            t_(at(v.replaced[r]), at(v.columns[e])) += v.coefficients[e];
    }
    for (std::size_t i = 0; i < dofs; ++i)
        if (!replaced[i]) t_(i, i) = 1.0;
    a_ = product(transposed(t_), product(k_, t_));
    visible_.clear();
    for (std::int64_t i = 0; i < v.visible_count; ++i) visible_.push_back(at(v.visible[i]));
    for (std::size_t i = 0; i < visible_.size(); ++i) diagonal[i] = a_(visible_[i], visible_[i]);
    spoil(diagonal, visible_.size());
    lift_.assign(at(v.pattern_count), Values(dofs, 0.0));
    force_ = lift_;
    load_.clear();
    for (std::size_t p = 0; p < lift_.size(); ++p) {
        for (std::int64_t e = v.lift_starts[p]; e < v.lift_starts[p + 1]; ++e)
            lift_[p][at(v.lift_dofs[e])] += v.lift_values[e];
        for (std::int64_t e = v.force_starts[p]; e < v.force_starts[p + 1]; ++e)
            force_[p][at(v.force_dofs[e])] += v.force_values[e];
        Values left = k_.times(lift_[p]);
        for (std::size_t i = 0; i < dofs; ++i) left[i] = force_[p][i] - left[i];
        load_.push_back(t_.transposed_times(left));
        load_sizes[p] = 0.0;
        for (const double f : load_[p]) load_sizes[p] = std::max(load_sizes[p], std::abs(f));
    }
    spoil(load_sizes, load_.size());
    kept_.assign(8, {});
    set({0, nullptr, nullptr, nullptr}, 0, nullptr, 0, nullptr, {0, nullptr, nullptr, nullptr});
}

// spread_: all variables by those that are neither zero nor expressed; these have empty columns.
void DenseEngine::set(const delam_experimental_entries& couplings, std::int64_t fixed_count, const std::int64_t* fixed,
                      std::int64_t pivot_count, const std::int64_t* pivots, const delam_experimental_entries& masters) {
    const std::size_t count = t_.columns;
    couplings_ = Dense(count, count);
    for (std::int64_t e = 0; e < couplings.count; ++e)
        couplings_(visible_[at(couplings.rows[e])], visible_[at(couplings.columns[e])]) += couplings.values[e];
    spread_ = Dense(count, count);
    for (std::size_t i = 0; i < count; ++i) spread_(i, i) = 1.0;
    pivots_.clear();
    for (std::int64_t i = 0; i < fixed_count; ++i) spread_(visible_[at(fixed[i])], visible_[at(fixed[i])]) = 0.0;
    for (std::int64_t i = 0; i < pivot_count; ++i) {
        pivots_.push_back(visible_[at(pivots[i])]);
        spread_(pivots_.back(), pivots_.back()) = 0.0;
    }
    for (std::int64_t e = 0; e < masters.count; ++e) {
        const std::size_t master = visible_[at(masters.columns[e])];
        if (spread_(master, master) != 0.0) spread_(pivots_[at(masters.rows[e])], master) += masters.values[e];
    }
}

std::int32_t DenseEngine::solve(const delam_experimental_request& request, delam_experimental_answer& answer) {
    if (request.poll(request.user) != 0) return DELAM_CANCELLED;
    const std::size_t count = t_.columns;
    Values b(count, 0.0), rest(count, 0.0);
    for (std::size_t p = 0; p < load_.size(); ++p)
        for (std::size_t i = 0; i < count; ++i) b[i] += request.theta[p] * load_[p][i];
    for (std::size_t i = 0; i < visible_.size(); ++i) b[visible_[i]] += request.force[i];
    for (std::size_t i = 0; i < pivots_.size(); ++i) rest[pivots_[i]] = request.right[i];
    Dense whole = a_;
    for (std::size_t i = 0; i < whole.value.size(); ++i) whole.value[i] += couplings_.value[i];
    const Values of_rest = whole.times(rest);
    for (std::size_t i = 0; i < count; ++i) b[i] -= of_rest[i];
    Values x = spread_.transposed_times(b);
    const Values loaded = x;
    Dense reduced = product(transposed(spread_), product(whole, spread_));
    const bool definite = solve_in_place(reduced, x) && !spoils(Nonsense::indefinite);
    answer.definite = definite ? 1 : 0;
    answer.iterations = 1;
    if (!definite) {
        kept_[at(request.place)].clear();
        return DELAM_OK;
    }
    answer.first = std::sqrt(std::abs(dot(loaded, x)));
    answer.norm = 0.0;
    if (request.enough != nullptr) request.enough(answer.first, request.user);
    Values v = spread_.times(x);
    for (std::size_t i = 0; i < count; ++i) v[i] += rest[i];
    keep(request, answer, v);
    spoil(answer.values, visible_.size());
    spoil(answer.products, kept_.size());
    if (spoils(Nonsense::negative_iterations)) answer.iterations = -5, failed = true;
    if (spoils(Nonsense::many_iterations)) answer.iterations = std::numeric_limits<std::int64_t>::max(), failed = true;
    return DELAM_OK;
}

void DenseEngine::keep(const delam_experimental_request& request, delam_experimental_answer& answer, const Values& v) {
    const std::size_t count = t_.columns;
    Values u = t_.times(v), loads(count, 0.0);
    for (std::size_t p = 0; p < lift_.size(); ++p) {
        for (std::size_t i = 0; i < u.size(); ++i) u[i] += request.theta[p] * lift_[p][i];
        for (std::size_t i = 0; i < count; ++i) loads[i] += request.theta[p] * load_[p][i];
    }
    const Values stressed = k_.times(u), inner = a_.times(v);
    double coupled = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < count; ++j) coupled += std::abs(v[i] * couplings_(i, j) * v[j]);
        squares += std::pow(a_(i, i) * v[i] * v[i], 2);
    }
    for (std::size_t i = 0; i < visible_.size(); ++i) {
        answer.values[i] = v[visible_[i]];
        answer.balance[i] = loads[visible_[i]] - inner[visible_[i]];
        answer.correction[i] = answer.correction_balance[i] = 0.0;
    }
    const double energy = std::abs(dot(u, stressed));
    answer.size = std::sqrt(energy + coupled);
    answer.least = 1.0;
    answer.rounding = energy > 0.0 ? std::numeric_limits<double>::epsilon() * std::sqrt(squares) / energy : 0.0;
    answer.converged = spoils(Nonsense::not_converged) ? 0 : 1;
    kept_[at(request.place)] = u;
    for (std::size_t s = 0; s < kept_.size(); ++s)
        answer.products[s] = kept_[s].empty() ? 0.0 : dot(stressed, kept_[s]);
    for (std::size_t p = 0; p < lift_.size(); ++p) {
        answer.work[p] = dot(force_[p], u);
        answer.lifted[p] = dot(lift_[p], stressed);
    }
}

void DenseEngine::recover(const double* weights, double* displacement, double* force) const {
    if (force == nullptr) return;  // for those whom the engine serves, here nobody
    Values u(k_.rows, 0.0);
    for (std::size_t s = 0; s < kept_.size(); ++s)
        for (std::size_t i = 0; i < kept_[s].size() && weights[s] != 0.0; ++i) u[i] += weights[s] * kept_[s][i];
    const Values stressed = k_.times(u);
    std::copy(u.begin(), u.end(), displacement);
    std::copy(stressed.begin(), stressed.end(), force);
}

}  // namespace fuzz
