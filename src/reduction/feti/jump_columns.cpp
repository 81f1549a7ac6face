// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/jump_columns.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "linalg/sparse/block.hpp"
#include "reduction/feti/lockstep_cg.hpp"

namespace delam {

namespace {

constexpr double tolerance = 1e-12;  // of the columns; soft motions of S are small differences of them

// Every row of a law at its full stiffness, rows that only touch at the bodies' own, bonded rows held.
Springs base_springs(const Problem& problem, std::span<const double> flexibility) {
    const auto dim = index(problem.mesh->dimension());
    Springs base{std::vector<double>(index(problem.jump_count()), 0.0),
                 std::vector<std::uint8_t>(index(problem.jump_count()), 0)};
    std::size_t row = 0;
    for (std::size_t f = 0; f < problem.interfaces.size(); ++f) {
        const InterfaceProperties& interface = problem.interfaces[f];
        for (const double weight : problem.mesh->interfaces()[f].weight)
            for (std::size_t c = 0; c < dim; ++c, ++row) {
                base.held[row] = interface.bonded ? 1 : 0;
                if (interface.bonded) continue;
                if (interface.law) base.stiffness[row] = weight * interface.law->stiffness(c);
                if (!(base.stiffness[row] > 0.0)) base.stiffness[row] = 1.0 / flexibility[row];
            }
    }
    return base;
}

}  // namespace

JumpColumns::JumpColumns(const Problem& problem, const std::vector<Subdomain>& subdomains, DualOperator& dual,
                         const DualLoads& loads, Monitor& monitor)
    : problem_(problem),
      subdomains_(subdomains),
      dual_(dual),
      loads_(loads),
      monitor_(monitor),
      width_(index(problem.options.limits.feti_group * problem.mesh->dimension())),
      base_(base_springs(problem, dual.flexibility_diagonal())),
      root_(base_.stiffness.size(), 0.0),
      soft_(root_.size(), 0),
      column_((root_.size() + width_ - 1) / width_) {
    for (std::size_t r = 0; r < root_.size(); ++r) {
        if (base_.held[r] != 0 || dual_.scaling().prescribed[r] != 0) continue;
        root_[r] = std::sqrt(base_.stiffness[r]);
        soft_[r] = base_.stiffness[r] * dual_.flexibility_diagonal()[r] < 1.0 ? 1 : 0;
    }
}

double JumpColumns::bytes(std::size_t groups) const {
    return 8.0 * static_cast<double>(groups) * static_cast<double>(width_) * static_cast<double>(root_.size());
}

// rest: the jumps of the bodies without forces, [rows][columns].
bool JumpColumns::solve(const DenseMatrix& right, const DenseMatrix& resultant, const DenseMatrix& rest,
                        DenseMatrix& kept) {
    Team team(useful_threads(problem_.options.threads));
    dual_.set(base_);
    if (dense_ == nullptr && right.rows <= problem_.options.limits.feti_dense_rows)
        dense_ = std::make_unique<DenseDual>(dual_, subdomains_, [this] { monitor_.progress("zone", 0, 0); });
    DenseMatrix lambda = dense_ != nullptr ? dense_->solve(right, resultant) : DenseMatrix(right.rows, right.columns);
    DenseMatrix jumps(right.rows, right.columns);
    const auto iterate = [&] {
        return lockstep_cg(dual_, team, right, resultant, tolerance, problem_.options.limits, lambda,
                           [&](std::int64_t iteration) { monitor_.progress("zone", iteration, 0); });
    };
    if (!iterate()) {  // a guess at the limit of rounding may leave no way down
        lambda = DenseMatrix(right.rows, right.columns);
        if (!iterate()) return false;
    }
    dual_.flexibility(team, lambda, jumps);
    kept = DenseMatrix(static_cast<std::int64_t>(root_.size()), right.columns);
    std::vector<double> residual(index(right.rows));
    for (std::int64_t c = 0; c < right.columns; ++c) {
        for (std::size_t i = 0; i < residual.size(); ++i) {
            const auto r = static_cast<std::int64_t>(i);
            residual[i] = dual_.active(i) ? jumps(r, c) + dual_.compliance()[i] * lambda(r, c) - right(r, c) : 0.0;
        }
        const std::vector<double> rigid = dual_.coarse().apply_transposed(dual_.coarse().rigid_coefficients(residual));
        for (std::size_t i = 0; i < root_.size(); ++i) {
            const auto r = static_cast<std::int64_t>(i);
            if (root_[i] == 0.0) continue;
            kept(r, c) = soft_[i] != 0 ? root_[i] * (rest(r, c) - jumps(r, c) + rigid[i]) : lambda(r, c) / root_[i];
        }
    }
    return true;
}

// The rest jump -1 of a row: the bodies jump by -U s, and the forces are Lambda.
bool JumpColumns::find(std::size_t group) {
    const std::size_t first = group * width_, last = std::min(first + width_, root_.size());
    const std::int64_t rows = dual_.rows().count(), columns = static_cast<std::int64_t>(width_);
    DenseMatrix right(rows, columns), kept;
    for (std::size_t r = first; r < last; ++r)
        if (root_[r] > 0.0) right(static_cast<std::int64_t>(r), static_cast<std::int64_t>(r - first)) = 1.0;
    if (!solve(right, DenseMatrix(dual_.coarse().size(), columns), DenseMatrix(rows, columns), kept)) return false;
    for (std::size_t r = first; r < last; ++r)
        for (std::size_t i = 0; i < root_.size() && root_[r] > 0.0; ++i)
            kept(static_cast<std::int64_t>(i), static_cast<std::int64_t>(r - first)) *=
                (soft_[i] != 0 ? -1.0 : 1.0) / root_[r];
    column_[group] = std::move(kept);
    return true;
}

bool JumpColumns::find_loads() {
    const auto patterns = static_cast<std::int64_t>(problem_.patterns.size());
    DenseMatrix right(dual_.rows().count(), patterns), resultant(dual_.coarse().size(), patterns);
    std::vector<double> theta(problem_.patterns.size(), 0.0);
    for (std::int64_t p = 0; p < patterns; ++p) {
        theta[index(p)] = 1.0;
        const DualLoads::Sum load = loads_.at(theta);
        theta[index(p)] = 0.0;
        std::copy(load.jump.begin(), load.jump.end(), column(right, p).begin());
        std::copy(load.resultant.begin(), load.resultant.end(), column(resultant, p).begin());
    }
    // Loads are scaled to size 1, whatever the units of a pattern, as in Feti::solve.
    std::vector<int> size;
    for (std::int64_t p = 0; p < patterns; ++p) {
        size.push_back(exponent(std::max(max_abs(column(right, p)), max_abs(column(resultant, p)))));
        scale_by_power(column(right, p), -size.back());
        scale_by_power(column(resultant, p), -size.back());
    }
    const DenseMatrix rest = right;
    dual_.set(base_);
    for (std::int64_t p = 0; p < patterns; ++p) dual_.mask(column(right, p));
    loaded_ = solve(right, resultant, rest, load_);
    for (std::int64_t p = 0; p < patterns && loaded_; ++p) scale_by_power(column(load_, p), size[index(p)]);
    return loaded_;
}

bool JumpColumns::energy(std::span<const std::int64_t> rows, DenseEnergy& out) {
    if (!loaded_ && !find_loads()) return false;
    for (const std::int64_t r : rows)
        if (column_[group_of(index(r))].rows == 0 && !find(group_of(index(r)))) return false;
    const Poll poll = [this] { monitor_.progress("zone", 0, 0); };
    const auto n = static_cast<std::int64_t>(rows.size()), patterns = load_.columns;
    DenseMatrix v(n, n), w(n, n);
    for (std::int64_t a = 0; a < n; ++a) {
        const std::size_t group = group_of(index(rows[index(a)]));
        const std::span<const double> own =
            column(column_[group], rows[index(a)] - static_cast<std::int64_t>(group * width_));
        for (std::int64_t i = 0; i < n; ++i) {
            const double unit = i == a ? 1.0 : 0.0, value = own[index(rows[index(i)])];
            const bool from_jump = soft_[index(rows[index(i)])] != 0;
            v(i, a) = from_jump ? value : unit - value;
            w(i, a) = from_jump ? unit - value : value;
        }
    }
    for (std::int64_t a = 0; a < n; ++a)
        for (std::int64_t i = a + 1; i < n; ++i) {
            v(i, a) = v(a, i) = 0.5 * (v(i, a) + v(a, i));
            w(i, a) = w(a, i) = 0.5 * (w(i, a) + w(a, i));
        }
    if (!factor_definite(v, poll)) return false;
    out.stiffness = w;
    solve_lower(v, w, 0, poll);
    add_gram(out.stiffness, w, poll);
    mirror_lower(out.stiffness);
    out.load = DenseMatrix(n, patterns);
    for (std::int64_t p = 0; p < patterns; ++p) {
        const std::span<double> load = column(out.load, p);
        for (std::size_t i = 0; i < load.size(); ++i) load[i] = load_(rows[i], p);
        solve_lower(v, load);
        solve_lower_transposed(v, load);
        for (std::size_t i = 0; i < load.size(); ++i) load[i] *= root_[index(rows[i])];
    }
    for (std::int64_t a = 0; a < n; ++a)
        for (std::int64_t i = 0; i < n; ++i)
            out.stiffness(i, a) *= root_[index(rows[index(i)])] * root_[index(rows[index(a)])];
    return true;
}

}  // namespace delam
