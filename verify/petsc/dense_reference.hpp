// SPDX-License-Identifier: BSD-3-Clause
// Computes what an engine should answer, by dense matrices in long double and Gauss' elimination.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "layered_model.hpp"

namespace verify {

using Wide = std::vector<long double>;

struct Acting {  // places in `visible`
    struct Entry {
        std::int64_t row, column;
        double value;
    };
    std::vector<Entry> couplings, masters;  // rows of masters: places in pivots
    Indices fixed, pivots;
    Values right, force, theta;
};

struct Expected {
    Wide v, u, force, values, balance;
    long double stored = 0;
    Wide work, lifted;
};

class DenseReference {
public:
    // stiffness: of all DOFs, also those that only the engine knows; dofs of the view come first.
    DenseReference(std::int64_t all_dofs, const delam_experimental_variables& v, std::vector<Wide> stiffness)
        : n_(all_dofs), count_(all_dofs + v.jump_count), k_(std::move(stiffness)) {
        const auto own = [&](std::int64_t i) { return i < v.dofs ? i : i - v.dofs + n_; };
        t_.assign(at(n_), Wide(at(count_), 0));
        std::vector<bool> replaced(at(n_), false);
        for (std::int64_t r = 0; r < v.replaced_count; ++r) {
            replaced[at(v.replaced[r])] = true;
            for (std::int64_t e = v.row_starts[r]; e < v.row_starts[r + 1]; ++e)
                t_[at(v.replaced[r])][at(own(v.columns[e]))] += v.coefficients[e];
        }
        for (std::int64_t i = 0; i < n_; ++i)
            if (!replaced[at(i)]) t_[at(i)][at(i)] = 1;
        for (std::int64_t i = 0; i < v.visible_count; ++i) visible_.push_back(own(v.visible[i]));
        for (std::int64_t p = 0; p < v.pattern_count; ++p) {
            lift_.emplace_back(at(n_), 0);
            force_.emplace_back(at(n_), 0);
            for (std::int64_t e = v.lift_starts[p]; e < v.lift_starts[p + 1]; ++e)
                lift_.back()[at(v.lift_dofs[e])] += v.lift_values[e];
            for (std::int64_t e = v.force_starts[p]; e < v.force_starts[p + 1]; ++e)
                force_.back()[at(v.force_dofs[e])] += v.force_values[e];
        }
        a_.assign(at(count_), Wide(at(count_), 0));
        std::vector<std::vector<std::pair<std::size_t, long double>>> rows(at(n_));
        for (std::size_t i = 0; i < at(n_); ++i)
            for (std::size_t j = 0; j < at(count_); ++j)
                if (t_[i][j] != 0) rows[i].emplace_back(j, t_[i][j]);
        for (std::size_t i = 0; i < at(n_); ++i)
            for (std::size_t j = 0; j < at(n_); ++j)
                if (k_[i][j] != 0)
                    for (const auto& [r, x] : rows[i])
                        for (const auto& [c, y] : rows[j]) a_[r][c] += x * k_[i][j] * y;
    }

    long double diagonal(std::size_t visible) const { return a_[at(visible_[visible])][at(visible_[visible])]; }
    Wide load(std::size_t pattern) const {
        Wide left = times(k_, lift_[pattern]);
        for (std::size_t i = 0; i < left.size(); ++i) left[i] = force_[pattern][i] - left[i];
        return transposed(left);
    }

    Expected solve(const Acting& acting) const {
        std::vector<Wide> a = a_;
        for (const auto& e : acting.couplings) a[at(visible_[at(e.row)])][at(visible_[at(e.column)])] += e.value;
        Wide b(at(count_), 0), rest(b);
        for (std::size_t p = 0; p < lift_.size(); ++p) {
            const Wide l = load(p);
            for (std::size_t i = 0; i < b.size(); ++i) b[i] += acting.theta[p] * l[i];
        }
        for (std::size_t i = 0; i < acting.force.size(); ++i) b[at(visible_[i])] += acting.force[i];
        std::vector<std::map<std::size_t, long double>> spread(at(count_));
        for (std::size_t i = 0; i < spread.size(); ++i)
            if (a[i][i] != 0) spread[i][i] = 1;
        for (const std::int64_t f : acting.fixed) spread[at(visible_[at(f)])].clear();
        for (std::size_t i = 0; i < acting.pivots.size(); ++i) {
            spread[at(visible_[at(acting.pivots[i])])].clear();
            rest[at(visible_[at(acting.pivots[i])])] = acting.right[i];
        }
        for (const auto& e : acting.masters) {
            const auto master = at(visible_[at(e.column)]);
            if (spread[master].contains(master)) spread[at(visible_[at(acting.pivots[at(e.row)])])][master] += e.value;
        }
        const Wide of_rest = times(a, rest);
        for (std::size_t i = 0; i < b.size(); ++i) b[i] -= of_rest[i];
        std::vector<Wide> m(at(count_), Wide(at(count_), 0));
        Wide g(at(count_), 0);
        for (std::size_t i = 0; i < at(count_); ++i)
            for (const auto& [r, x] : spread[i]) {
                g[r] += x * b[i];
                for (std::size_t j = 0; j < at(count_); ++j)
                    if (a[i][j] != 0)
                        for (const auto& [c, y] : spread[j]) m[r][c] += x * a[i][j] * y;
            }
        for (std::size_t i = 0; i < at(count_); ++i)
            if (m[i][i] == 0) m[i][i] = 1;
        const Wide y = eliminate(m, g);
        Expected out;
        out.v = rest;
        for (std::size_t i = 0; i < at(count_); ++i)
            for (const auto& [c, x] : spread[i]) out.v[i] += x * y[c];
        fill(acting, out);
        return out;
    }

private:
    static Wide times(const std::vector<Wide>& m, const Wide& x) {
        Wide y(m.size(), 0);
        for (std::size_t i = 0; i < m.size(); ++i)
            for (std::size_t j = 0; j < x.size(); ++j) y[i] += m[i][j] * x[j];
        return y;
    }
    static long double dot(const Wide& a, const Wide& b) {
        long double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
        return sum;
    }
    Wide transposed(const Wide& f) const {
        Wide y(at(count_), 0);
        for (std::size_t i = 0; i < f.size(); ++i)
            for (std::size_t j = 0; j < y.size(); ++j) y[j] += t_[i][j] * f[i];
        return y;
    }
    static Wide eliminate(std::vector<Wide>& m, Wide b) {
        const std::size_t n = b.size();
        for (std::size_t c = 0; c < n; ++c) {
            for (std::size_t r = c + 1; r < n; ++r) {
                if (m[r][c] == 0) continue;
                const long double share = m[r][c] / m[c][c];
                for (std::size_t j = c; j < n; ++j) m[r][j] -= share * m[c][j];
                b[r] -= share * b[c];
            }
        }
        for (std::size_t c = n; c-- > 0;) {
            for (std::size_t j = c + 1; j < n; ++j) b[c] -= m[c][j] * b[j];
            b[c] /= m[c][c];
        }
        return b;
    }
    void fill(const Acting& acting, Expected& out) const {
        out.u = times(t_, out.v);
        Wide f(at(n_), 0);
        for (std::size_t p = 0; p < lift_.size(); ++p)
            for (std::size_t i = 0; i < at(n_); ++i) {
                out.u[i] += acting.theta[p] * lift_[p][i];
                f[i] += acting.theta[p] * force_[p][i];
            }
        out.force = times(k_, out.u);
        for (std::size_t i = 0; i < f.size(); ++i) f[i] -= out.force[i];
        const Wide balance = transposed(f);
        for (const std::int64_t i : visible_) {
            out.values.push_back(out.v[at(i)]);
            out.balance.push_back(balance[at(i)]);
        }
        out.stored = dot(out.u, out.force);
        for (std::size_t p = 0; p < lift_.size(); ++p) {
            out.work.push_back(dot(force_[p], out.u));
            out.lifted.push_back(dot(lift_[p], out.force));
        }
    }

    std::int64_t n_, count_;
    std::vector<Wide> k_, t_, a_, lift_, force_;
    Indices visible_;
};

}  // namespace verify
