// SPDX-License-Identifier: BSD-3-Clause
// An engine as a host could write one, without the library's own operators: the stiffness in compressed rows, one
// factor by CHOLMOD as the preconditioner, conjugate gradients.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/numbers.hpp"
#include "delam/experimental.h"
#include "linalg/dense/dense.hpp"
#include "linalg/sparse/cholesky.hpp"
#include "linalg/sparse/sparse.hpp"
#include "reduction/sparse/iterated/conjugate_gradients.hpp"

namespace unit {

using namespace delam;

class SerialEngine {
public:
    static constexpr std::int64_t kept = 8;
    // stiffness: over all DOFs of the mesh, which come first, and those that only the engine knows.
    explicit SerialEngine(SparseMatrix stiffness) : k_(std::move(stiffness)) {}

    delam_experimental_engine functions() {
        delam_experimental_engine e{};
        e.size = sizeof e;
        e.kept = kept;
        e.user = this;
        e.prepare = [](const delam_experimental_variables* v, double* diagonal, double* sizes, void* user) {
            return self(user).prepare(*v, diagonal, sizes);
        };
        e.set = [](const delam_experimental_entries* couplings, std::int64_t fixed_count, const std::int64_t* fixed,
                   std::int64_t pivot_count, const std::int64_t* pivots, const delam_experimental_entries* masters,
                   void* user) {
            return self(user).set(*couplings, {fixed, index(fixed_count)}, {pivots, index(pivot_count)}, *masters);
        };
        e.renew = [](const delam_experimental_entries* entries, double* paid, void* user) {
            return self(user).renew(*entries, *paid);
        };
        e.solve = [](const delam_experimental_request* request, delam_experimental_answer* answer, void* user) {
            return self(user).solve(*request, *answer);
        };
        e.recover = [](const double* weights, double* displacement, double* force, void* user) {
            return self(user).recover(weights, displacement, force);
        };
        e.release = [](void* user) { self(user).released += 1; };
        e.message = [](void* user) { return self(user).message.c_str(); };
        return e;
    }

    std::string message;
    std::int32_t fails = DELAM_OK;  // status that the next solve returns
    int released = 0, prepared = 0, renewed = 0, recovered = 0, solved = 0;
    double cost = 10.0;

private:
    using Values = std::vector<double>;
    static SerialEngine& self(void* user) { return *static_cast<SerialEngine*>(user); }

    std::int32_t prepare(const delam_experimental_variables& v, double* diagonal, double* sizes) {
        ++prepared;
        dofs_ = k_.rows;
        known_ = v.dofs;
        // The variables of this engine: DOFs, then jumps; replaced DOFs have an empty row and column.
        count_ = dofs_ + v.jump_count;
        const auto own = [&](std::int64_t variable) {
            return variable < v.dofs ? variable : variable - v.dofs + dofs_;
        };
        std::vector<std::uint8_t> replaced(index(dofs_), 0);
        std::vector<Triplet> t;
        for (std::int64_t r = 0; r < v.replaced_count; ++r) {
            replaced[index(v.replaced[r])] = 1;
            for (std::int64_t e = v.row_starts[r]; e < v.row_starts[r + 1]; ++e)
                t.push_back({v.replaced[r], own(v.columns[e]), v.coefficients[e]});
        }
        for (std::int64_t d = 0; d < dofs_; ++d)
            if (replaced[index(d)] == 0) t.push_back({d, d, 1.0});
        transform_ = from_triplets(dofs_, count_, std::move(t));
        SparseMatrix a = congruence(k_, transform_);
        std::vector<Triplet> all;
        for (std::int64_t i = 0; i < count_; ++i) {
            all.push_back({i, i, i < dofs_ && replaced[index(i)] != 0 ? 1.0 : 0.0});
            for (std::int64_t e = a.start[index(i)]; e < a.start[index(i) + 1]; ++e)
                all.push_back({i, a.column[index(e)], a.value[index(e)]});
        }
        a_ = from_triplets(count_, count_, std::move(all));
        diagonal_.assign(index(count_), 0.0);
        for (std::int64_t i = 0; i < count_; ++i)
            for (std::int64_t e = a_.start[index(i)]; e < a_.start[index(i) + 1]; ++e)
                if (a_.column[index(e)] == i) diagonal_[index(i)] = a_.value[index(e)];
        visible_.clear();
        for (std::int64_t i = 0; i < v.visible_count; ++i) visible_.push_back(own(v.visible[i]));
        for (std::size_t i = 0; i < visible_.size(); ++i) diagonal[i] = diagonal_[index(visible_[i])];
        lift_.assign(index(v.pattern_count), Values(index(dofs_), 0.0));
        force_ = lift_;
        load_.clear();
        for (std::int64_t p = 0; p < v.pattern_count; ++p) {
            for (std::int64_t e = v.lift_starts[p]; e < v.lift_starts[p + 1]; ++e)
                lift_[index(p)][index(v.lift_dofs[e])] = v.lift_values[e];
            for (std::int64_t e = v.force_starts[p]; e < v.force_starts[p + 1]; ++e)
                force_[index(p)][index(v.force_dofs[e])] = v.force_values[e];
            Values left = times(k_, lift_[index(p)]);
            for (std::size_t i = 0; i < left.size(); ++i) left[i] = force_[index(p)][i] - left[i];
            load_.push_back(transposed(left));
            sizes[p] = max_abs(load_.back());
        }
        for (auto& place : places_) place = {};
        return DELAM_OK;
    }

    std::int32_t set(const delam_experimental_entries& couplings, std::span<const std::int64_t> fixed,
                     std::span<const std::int64_t> pivots, const delam_experimental_entries& masters) {
        couplings_ = from_triplets(count_, count_, triplets(couplings));
        zero_.assign(index(count_), 0);
        for (const std::int64_t i : fixed) zero_[index(visible_[index(i)])] = 1;
        pivots_.clear();
        masters_.assign(pivots.size(), {});
        for (const std::int64_t i : pivots) pivots_.push_back(visible_[index(i)]);
        for (std::int64_t e = 0; e < masters.count; ++e)
            masters_[index(masters.rows[e])].emplace_back(visible_[index(masters.columns[e])], masters.values[e]);
        return DELAM_OK;
    }

    std::int32_t renew(const delam_experimental_entries& entries, double& its_cost) {
        ++renewed;
        its_cost = cost;
        std::vector<Triplet> all = triplets(entries);
        for (std::int64_t i = 0; i < count_; ++i)
            for (std::int64_t e = a_.start[index(i)]; e < a_.start[index(i) + 1]; ++e)
                all.push_back({i, a_.column[index(e)], a_.value[index(e)]});
        const SparseMatrix m = from_triplets(count_, count_, std::move(all));
        factor_ = std::make_unique<SparseCholesky>(m);
        if (factor_->factorise(m)) return DELAM_OK;
        message = "the preconditioner is not definite";
        return DELAM_ERROR_NUMERICAL;
    }

    std::int32_t solve(const delam_experimental_request& r, delam_experimental_answer& answer) {
        if (fails != DELAM_OK) {
            message = "as asked";
            return std::exchange(fails, DELAM_OK);
        }
        ++solved;
        Values b(index(count_), 0.0), rest(b);
        for (std::size_t p = 0; p < load_.size(); ++p) add_scaled(r.theta[p], load_[p], b);
        const Values loads = b;
        for (std::size_t i = 0; i < visible_.size(); ++i) b[index(visible_[i])] += r.force[i];
        for (std::size_t i = 0; i < pivots_.size(); ++i) rest[index(pivots_[i])] = r.right[i];
        const Values of_rest = act(rest);
        for (std::size_t i = 0; i < b.size(); ++i) b[i] -= of_rest[i];
        gather(b);
        Values x(b.size(), 0.0);
        begin(r, b, x);
        bool stopped = false;
        CgSystem cg;
        cg.apply = [&](std::span<const double> p, std::span<double> ap) {
            Values full(p.begin(), p.end());
            spread(full);
            Values y = act(full);
            gather(y);
            std::copy(y.begin(), y.end(), ap.begin());
        };
        cg.precondition = [&](std::span<const double> p, std::span<double> z) {
            factor_->solve(p, z);
            reduce(z);
        };
        cg.restart = [&](std::span<double> at, std::span<double> left) {
            cg.apply(at, left);
            for (std::size_t i = 0; i < b.size(); ++i) left[i] = b[i] - left[i];
        };
        const auto whole = [&](std::span<const double> at) {
            Values full(at.begin(), at.end());
            spread(full);
            for (std::size_t i = 0; i < rest.size(); ++i) full[i] += rest[i];
            return full;
        };
        const auto moved = [&](const Values& v) {
            Values u = times(transform_, v);
            for (std::size_t p = 0; p < lift_.size(); ++p) add_scaled(r.theta[p], lift_[p], u);
            return u;
        };
        cg.size = [&](std::span<const double> at) {
            const Values v = whole(at), u = moved(v);
            return std::sqrt(std::abs(dot(u, times(k_, u))) + std::abs(dot(v, times(couplings_, v))));
        };
        cg.rounding = [&](std::span<const double> at) {
            const Values v = whole(at);
            Values delta(v.size(), 0.0), z(v.size());
            for (std::size_t i = 0; i < v.size(); ++i) {
                delta[i] = std::abs(b[i]);
                for (const SparseMatrix* m : {&a_, &couplings_})
                    for (std::int64_t e = m->start[i]; e < m->start[i + 1]; ++e)
                        delta[i] += std::abs(m->value[index(e)] * v[index(m->column[index(e)])]);
                if (i % 3 == 0) delta[i] = -delta[i];
            }
            gather(delta);
            cg.precondition(delta, z);
            return std::numeric_limits<double>::epsilon() * std::sqrt(std::abs(dot(delta, z)));
        };
        cg.confirm = [](std::span<const double>, std::span<const double>) { return false; };
        cg.each_iteration = [&](std::int64_t) { stopped = stopped || r.poll(r.user) != 0; };
        if (r.enough != nullptr) cg.enough = [&](double first) { return r.enough(first, r.user); };
        const CgOutcome found = conjugate_gradients(cg, x, r.tolerance, r.limit);
        if (stopped || r.poll(r.user) != 0) return DELAM_CANCELLED;
        const Values v = whole(x), u = moved(v), stressed = times(k_, u);
        fill(r, answer, found, v, u, stressed, loads);
        answer.size = cg.size(x);
        return DELAM_OK;
    }

    void fill(const delam_experimental_request& r, delam_experimental_answer& answer, const CgOutcome& found,
              const Values& v, const Values& u, const Values& stressed, const Values& loads) {
        answer.first = found.first;
        answer.norm = found.norm;
        answer.least = found.least;
        answer.iterations = found.iterations;
        answer.converged = found.converged ? 1 : 0;
        answer.definite = found.definite ? 1 : 0;
        Values correction = found.correction.empty() ? Values(v.size(), 0.0) : found.correction;
        spread(correction);
        const Values image = times(a_, correction), inner = times(a_, v);
        for (std::size_t i = 0; i < visible_.size(); ++i) {
            const std::size_t at = index(visible_[i]);
            answer.values[i] = v[at];
            answer.balance[i] = loads[at] - inner[at];
            answer.correction[i] = correction[at];
            answer.correction_balance[i] = image[at];
        }
        double squares = 0.0;
        for (std::size_t i = 0; i < v.size(); ++i) squares += std::pow(diagonal_[i] * v[i] * v[i], 2);
        const double energy = dot(u, stressed);
        answer.rounding =
            energy != 0.0 ? std::numeric_limits<double>::epsilon() * std::sqrt(squares) / std::abs(energy) : 0.0;
        places_[index(r.place)] = answer.definite != 0 ? u : Values{};
        for (std::size_t s = 0; s < places_.size(); ++s) {
            answer.products[s] = places_[s].empty() ? 0.0 : dot(stressed, places_[s]);
        }
        variables_[index(r.place)] = v;
        for (std::size_t p = 0; p < lift_.size(); ++p) {
            answer.work[p] = dot(force_[p], u);
            answer.lifted[p] = dot(lift_[p], stressed);
        }
    }

    // The combination of kept answers, times the factor that makes its energy least.
    void begin(const delam_experimental_request& r, const Values& b, Values& x) {
        if (r.start == nullptr) return;
        for (std::size_t s = 0; s < places_.size(); ++s)
            if (r.start[s] != 0.0 && !places_[s].empty()) add_scaled(r.start[s], variables_[s], x);
        reduce(x);
        Values full = x;
        spread(full);
        Values image = act(full);
        const double curvature = dot(full, image), factor = curvature > 0.0 ? dot(x, b) / curvature : 0.0;
        for (double& value : x) value *= factor;
    }

    std::int32_t recover(const double* weights, double* displacement, double* force) {
        ++recovered;
        Values u(index(dofs_), 0.0);
        for (std::size_t s = 0; s < places_.size(); ++s)
            if (weights[s] != 0.0) add_scaled(weights[s], places_[s], u);
        const Values stressed = times(k_, u);
        std::copy_n(u.begin(), known_, displacement);
        std::copy_n(stressed.begin(), known_, force);
        return DELAM_OK;
    }

    std::vector<Triplet> triplets(const delam_experimental_entries& e) const {
        std::vector<Triplet> t;
        for (std::int64_t i = 0; i < e.count; ++i)
            t.push_back({visible_[index(e.rows[i])], visible_[index(e.columns[i])], e.values[i]});
        return t;
    }
    static Values times(const SparseMatrix& m, const Values& x) {
        Values y(index(m.rows), 0.0);
        multiply(m, x, y);
        return y;
    }
    Values transposed(const Values& f) const {
        Values y(index(count_), 0.0);
        multiply_transposed(transform_, f, y);
        return y;
    }
    Values act(const Values& x) const {
        Values y = times(a_, x);
        const Values c = times(couplings_, x);
        for (std::size_t i = 0; i < y.size(); ++i) y[i] += c[i];
        return y;
    }
    void reduce(std::span<double> x) const {
        for (std::size_t i = 0; i < x.size(); ++i)
            if (zero_[i] != 0) x[i] = 0.0;
        for (const std::int64_t p : pivots_) x[index(p)] = 0.0;
    }
    void spread(std::span<double> x) const {
        reduce(x);
        for (std::size_t p = 0; p < pivots_.size(); ++p) {
            double sum = 0.0;
            for (const auto& [i, c] : masters_[p]) sum += c * x[index(i)];
            x[index(pivots_[p])] = sum;
        }
    }
    void gather(Values& f) const {
        for (std::size_t p = 0; p < pivots_.size(); ++p)
            for (const auto& [i, c] : masters_[p]) f[index(i)] += c * f[index(pivots_[p])];
        reduce(f);
    }

    SparseMatrix k_, transform_, a_, couplings_;
    std::int64_t dofs_ = 0, known_ = 0, count_ = 0;  // known_: those of the mesh
    std::vector<std::int64_t> visible_, pivots_;
    std::vector<std::vector<std::pair<std::int64_t, double>>> masters_;
    std::vector<std::uint8_t> zero_;
    std::vector<Values> lift_, force_, load_;
    Values diagonal_;
    std::vector<Values> places_ = std::vector<Values>(index(kept)), variables_ = places_;  // u, v
    std::unique_ptr<SparseCholesky> factor_;
};

// A problem with an engine of its own.
struct Engined {
    Problem problem;
    SerialEngine engine;
    explicit Engined(const Problem& other) : problem(other), engine(BodySystem(other, {}).stiffness()) {
        problem.engine = std::make_shared<Engine>(engine.functions());
    }
};

}  // namespace unit
