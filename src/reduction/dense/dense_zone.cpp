// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/dense/dense_zone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "linalg/dense/echelon.hpp"
#include "reduction/operator/jump_operator.hpp"

namespace delam {

namespace {

// Coefficients of dependent rows below the first are rounding; the second is the part of the largest jump of a motion
// below which it does not move a row. (Measured by verify/bench/constants.py on 250 random scenes: from a hundredth to
// a hundred times both decide alike.)
constexpr double dependent = 1e-10;
constexpr double rounded = 1e-11;

// y = S x, cheap where few x are not zero.
void multiply_few(const DenseMatrix& s, std::span<const double> x, std::span<double> y) {
    const auto zeros = index(std::count(x.begin(), x.end(), 0.0));
    if (2 * zeros < x.size()) {
        multiply_symmetric(s, x, y);
        return;
    }
    std::fill(y.begin(), y.end(), 0.0);
    for (std::size_t j = 0; j < x.size(); ++j)
        if (x[j] != 0.0) add_scaled(x[j], std::span<const double>(s.value).subspan(j * x.size(), x.size()), y);
}

}  // namespace

ZoneMotions ZoneMotions::of(const DenseMatrix& rigid, const DeadWork& dead_work, std::span<const std::uint8_t> active,
                            std::span<const std::int64_t> row_of) {
    ZoneMotions motions{DenseMatrix(static_cast<std::int64_t>(row_of.size()), 0), DenseMatrix(rigid.columns, 0),
                        &dead_work};
    if (rigid.columns == 0) return motions;
    motions.combination = split_motions(rigid, active).free;
    const DenseMatrix free = multiply(rigid, motions.combination);
    motions.unknowns = DenseMatrix(motions.unknowns.rows, free.columns);
    for (std::int64_t c = 0; c < free.columns; ++c)
        for (std::size_t i = 0; i < row_of.size(); ++i)
            motions.unknowns(static_cast<std::int64_t>(i), c) = free(row_of[i], c);
    orthonormalise(motions.unknowns, motions.combination);
    return motions;
}

DenseZone::DenseZone(const DenseEnergy& energy, std::vector<JumpRow> rows, std::vector<std::int64_t> jump_rows,
                     ZoneMotions motions, Poll poll)
    : energy_(&energy),
      rows_(std::move(rows)),
      jump_rows_(std::move(jump_rows)),
      rigid_(std::move(motions.unknowns)),
      combination_(std::move(motions.combination)),
      dead_work_(motions.dead_work),
      poll_(std::move(poll)) {
    std::vector<std::uint8_t> taken(index(energy.rows()), 0);
    rows_of_.assign(index(energy.rows()), 0);
    for (const JumpRow& row : rows_) {
        for (const auto& [i, n] : row.unknowns) ++rows_of_[index(i)];
        const bool plain = row.offset.empty() && row.unknowns.size() == 1 && row.unknowns.front().second == 1.0 &&
                           taken[index(row.unknowns.front().first)] == 0;
        if (plain) taken[index(row.unknowns.front().first)] = 1;
        plain_.push_back(plain ? row.unknowns.front().first : -1);
        with_offsets_ = with_offsets_ || !row.offset.empty();
    }
    if (rigid_.columns == 0) return;
    rigid_rows_ = DenseMatrix(static_cast<std::int64_t>(rows_.size()), rigid_.columns);
    for (std::int64_t c = 0; c < rigid_.columns; ++c)
        for (std::size_t r = 0; r < rows_.size(); ++r)
            for (const auto& [i, n] : rows_[r].unknowns)
                rigid_rows_(static_cast<std::int64_t>(r), c) += n * rigid_(i, c);
    shifted_ = energy.stiffness;
    double rho = 0.0;
    for (std::int64_t i = 0; i < shifted_.rows; ++i) rho = std::max(rho, shifted_(i, i));
    for (std::int64_t c = 0; c < rigid_.columns; ++c)
        for (std::int64_t j = 0; j < shifted_.rows; ++j)
            for (std::int64_t i = 0; i < shifted_.rows; ++i) shifted_(i, j) += rho * rigid_(i, c) * rigid_(j, c);
}

// The first held row that equals an unknown removes that unknown; each other held row expresses one unknown by the
// rest.
void DenseZone::hold(std::span<const std::uint8_t> held) {
    held_.assign(held.begin(), held.end());
    std::vector<std::uint8_t> out(index(energy_->rows()), 0);
    bound_rows_.clear();
    for (std::size_t r = 0; r < rows_.size(); ++r) {
        if (held_[r] == 0) continue;
        if (plain_[r] >= 0)
            out[index(plain_[r])] = 1;
        else
            bound_rows_.push_back(static_cast<std::int64_t>(r));
    }
    bound_.clear();
    free_.clear();
    std::vector<std::int64_t> candidates;
    for (std::int64_t i = 0; i < energy_->rows(); ++i)
        if (out[index(i)] == 0) candidates.push_back(i);
    if (bound_rows_.empty()) {
        free_ = std::move(candidates);
        binding_ = DenseMatrix(0, static_cast<std::int64_t>(free_.size()));
        operations_ = DenseMatrix();
        return;
    }
    std::vector<std::int64_t> column(index(energy_->rows()), -1);
    for (std::size_t j = 0; j < candidates.size(); ++j) column[index(candidates[j])] = static_cast<std::int64_t>(j);
    DenseMatrix q(static_cast<std::int64_t>(bound_rows_.size()), static_cast<std::int64_t>(candidates.size()));
    for (std::int64_t i = 0; i < q.rows; ++i)
        for (const auto& [u, n] : rows_[index(bound_rows_[index(i)])].unknowns)
            if (column[index(u)] >= 0) q(i, column[index(u)]) += n;
    const Echelon echelon = reduced_echelon(std::move(q), 0, dependent);
    for (const std::int64_t p : echelon.pivot) {
        bound_.push_back(candidates[index(p)]);
        out[index(bound_.back())] = 1;
    }
    std::vector<std::int64_t> rest;
    for (std::size_t j = 0; j < candidates.size(); ++j) {
        if (out[index(candidates[j])] != 0) continue;
        rest.push_back(static_cast<std::int64_t>(j));
        free_.push_back(candidates[j]);
    }
    binding_ = DenseMatrix(static_cast<std::int64_t>(bound_.size()), static_cast<std::int64_t>(free_.size()));
    for (std::int64_t j = 0; j < binding_.columns; ++j)
        for (std::int64_t i = 0; i < binding_.rows; ++i) binding_(i, j) = -echelon.rows(i, rest[index(j)]);
    operations_ = echelon.operations;
}

std::vector<double> DenseZone::apply(std::span<const double> x) const {
    std::vector<double> y(x.size());
    multiply_symmetric(matrix(), x, y);
    for (const Triplet& s : springs_) y[index(s.row)] += s.value * x[index(s.column)];
    return y;
}

// E y: the effect of the free unknowns on all.
std::vector<double> DenseZone::expand(std::span<const double> reduced) const {
    std::vector<double> x(index(energy_->rows()), 0.0), bound(bound_.size());
    multiply(binding_, reduced, bound);
    for (std::size_t i = 0; i < free_.size(); ++i) x[index(free_[i])] = reduced[i];
    for (std::size_t i = 0; i < bound_.size(); ++i) x[index(bound_[i])] = bound[i];
    return x;
}

// E^T g
std::vector<double> DenseZone::reduce(std::span<const double> full) const {
    std::vector<double> w(free_.size(), 0.0), on_bound(bound_.size());
    for (std::size_t i = 0; i < bound_.size(); ++i) on_bound[i] = full[index(bound_[i])];
    multiply_transposed(binding_, on_bound, w);
    for (std::size_t i = 0; i < free_.size(); ++i) w[i] += full[index(free_[i])];
    return w;
}

std::vector<double> DenseZone::offsets(std::span<const double> theta) const {
    std::vector<double> o(rows_.size(), 0.0);
    for (std::size_t r = 0; r < rows_.size(); ++r)
        if (!rows_[r].offset.empty()) o[r] = dot(rows_[r].offset, theta);
    return o;
}

bool DenseZone::factor(std::span<const Coupling> couplings, std::span<const std::uint8_t> held) {
    hold(held);
    couplings_.assign(couplings.begin(), couplings.end());
    springs_.clear();
    for (const Coupling& c : couplings_) {
        if (held_[index(c.row)] != 0 || held_[index(c.column)] != 0) continue;
        for (const auto& [i, a] : rows_[index(c.row)].unknowns)
            for (const auto& [j, b] : rows_[index(c.column)].unknowns) springs_.push_back({i, j, a * b * c.value});
    }
    return factor_free() && (rigid_.columns == 0 || factor_motions());
}

// Uses a factor in which nothing is bound or, where that is not positive definite, one of this problem's own.
bool DenseZone::factor_free() {
    const BoundUnknowns unknowns{free_, bound_, binding_};
    by_updates_ = true;
    if (updated_.update(matrix(), springs_, unknowns, poll_)) return updated_.definite();
    if (bound_.empty()) {
        assemble(unknowns);
        return updated_.renew(factor_, springs_, free_, energy_->rows(), poll_);
    }
    if (UpdatedFactor::pays(free_.size() + bound_.size(), unknowns.touched())) {
        std::vector<std::int64_t> all(free_);
        all.insert(all.end(), bound_.begin(), bound_.end());
        std::sort(all.begin(), all.end());
        const DenseMatrix none(0, static_cast<std::int64_t>(all.size()));
        assemble({all, {}, none});
        if (updated_.renew(factor_, springs_, all, energy_->rows(), poll_) &&
            updated_.update(matrix(), springs_, unknowns, poll_))
            return updated_.definite();
    }
    by_updates_ = false;
    assemble(unknowns);
    ++bound_factors_;
    return factor_definite(factor_, poll_);
}

void DenseZone::solve_free(std::span<double> x, bool again) {
    if (by_updates_) {
        updated_.solve(x, again);
        return;
    }
    solve_lower(factor_, x);
    solve_lower_transposed(factor_, x);
}

// Writes into factor_ the lower triangle of A_ff + A_fb M + M^T A_bf + M^T A_bb M, where A = S + C and bound = M free.
void DenseZone::assemble(const BoundUnknowns& unknowns) {
    const DenseMatrix& s = matrix();
    const std::span<const std::int64_t> free_of = unknowns.free, bound_of = unknowns.bound;
    const auto n = static_cast<std::int64_t>(free_of.size()), bound = static_cast<std::int64_t>(bound_of.size());
    std::vector<std::int64_t> place(index(energy_->rows()), -1);  // among free, then bound
    for (std::int64_t i = 0; i < n; ++i) place[index(free_of[index(i)])] = i;
    for (std::int64_t i = 0; i < bound; ++i) place[index(bound_of[index(i)])] = n + i;

    factor_.rows = factor_.columns = n;  // in the memory of an earlier one; its upper triangle is not set
    factor_.value.resize(index(n * n));
    for (std::int64_t j = 0; j < n; ++j) {
        const double* column = s.value.data() + free_of[index(j)] * s.rows;
        double* out = factor_.value.data() + j * n;
        for (std::int64_t i = j; i < n; ++i) out[i] = column[free_of[index(i)]];
    }
    DenseMatrix cross(bound, n), corner(bound, bound);  // A_bf, A_bb
    for (std::int64_t j = 0; j < bound; ++j) {
        const double* column = s.value.data() + bound_of[index(j)] * s.rows;
        for (std::int64_t i = 0; i < n; ++i) cross(j, i) = column[free_of[index(i)]];
        for (std::int64_t i = 0; i < bound; ++i) corner(i, j) = column[bound_of[index(i)]];
    }
    for (const Triplet& t : springs_) {
        const std::int64_t i = place[index(t.row)], j = place[index(t.column)];
        if (i < 0 || j < 0) continue;
        if (i < n && j < n)
            factor_(i, j) += t.value;
        else if (i >= n && j < n)
            cross(i - n, j) += t.value;
        else if (i >= n && j >= n)
            corner(i - n, j - n) += t.value;
    }
    if (bound == 0) return;
    DenseMatrix half = multiply(corner, unknowns.binding);
    for (std::size_t i = 0; i < half.value.size(); ++i) half.value[i] = 0.5 * half.value[i] + cross.value[i];
    const DenseMatrix product = multiply_transposed(unknowns.binding, half);
    for (std::int64_t j = 0; j < n; ++j)
        for (std::int64_t i = j; i < n; ++i) factor_(i, j) += product(i, j) + product(j, i);
}

// The Schur complement in the rigid motions that active rows hold. False: not positive definite.
bool DenseZone::factor_motions() {
    const auto n = static_cast<std::int64_t>(free_.size());
    std::vector<std::uint8_t> active(held_);
    for (const Coupling& c : couplings_)
        if (c.value != 0.0) active[index(c.row)] = 1;
    motions_ = split_motions(rigid_rows_, active);
    const DenseMatrix z = multiply(rigid_, motions_.held);
    motion_x_ = DenseMatrix(z.rows, z.columns);
    motion_y_ = z;
    for (double& v : motion_y_.value) v = -v;
    motion_coupling_ = DenseMatrix(n, z.columns);
    DenseMatrix schur(z.columns, z.columns);
    for (std::int64_t c = 0; c < z.columns; ++c) {
        std::vector<double> on_free(index(n));
        for (std::int64_t i = 0; i < n; ++i) on_free[index(i)] = z(free_[index(i)], c);
        const std::vector<double> x = expand(on_free);
        std::copy(x.begin(), x.end(), motion_x_.value.begin() + c * z.rows);
    }
    for (std::size_t i = 0; i < motion_y_.value.size(); ++i) motion_y_.value[i] += motion_x_.value[i];
    const auto column = [](const DenseMatrix& a, std::int64_t c) {
        return std::span<const double>(a.value).subspan(index(c * a.rows), index(a.rows));
    };
    for (std::int64_t c = 0; c < z.columns; ++c) {
        std::vector<double> image(index(z.rows)), springs(image.size(), 0.0);
        multiply_few(shifted_, column(motion_y_, c), image);  // held unknowns alone, where none is bound
        for (const Triplet& t : springs_) springs[index(t.row)] += t.value * column(motion_x_, c)[index(t.column)];
        for (std::int64_t d = 0; d < z.columns; ++d)
            schur(d, c) = dot(column(motion_y_, d), image) + dot(column(motion_x_, d), springs);
        for (std::size_t i = 0; i < image.size(); ++i) image[i] += springs[i];
        const std::vector<double> w = reduce(image);
        std::copy(w.begin(), w.end(), motion_coupling_.value.begin() + c * n);
    }
    motion_stiffness_ = schur;
    motion_solved_ = motion_coupling_;
    for (std::int64_t c = 0; c < z.columns; ++c)
        solve_free(std::span<double>(motion_solved_.value).subspan(index(c * n), index(n)), false);
    subtract_product(schur, motion_coupling_, motion_solved_);
    motion_scale_.assign(index(z.columns), 0.0);
    for (std::int64_t c = 0; c < z.columns; ++c) {
        if (!(schur(c, c) > 0.0)) return false;
        motion_scale_[index(c)] = 1.0 / std::sqrt(schur(c, c));
    }
    for (std::int64_t c = 0; c < z.columns; ++c)
        for (std::int64_t d = c; d < z.columns; ++d) schur(d, c) *= motion_scale_[index(c)] * motion_scale_[index(d)];
    motion_factor_ = std::move(schur);
    return factor_definite(motion_factor_);
}

// True if no free motion gets work of the loads.
bool DenseZone::balances(std::span<const double> theta, std::span<const double> row_force) const {
    for (std::int64_t c = 0; rigid_.columns > 0 && c < motions_.free.columns; ++c) {
        const auto free = std::span<const double>(motions_.free.value)
                              .subspan(index(c * motions_.free.rows), index(motions_.free.rows));
        std::vector<double> whole(index(combination_.rows));
        multiply(combination_, free, whole);
        double work = 0.0, magnitude = 0.0;
        for (std::size_t r = 0; r < row_force.size(); ++r) {
            if (held_[r] != 0 || row_force[r] == 0.0) continue;
            double moved = 0.0;
            for (std::size_t k = 0; k < free.size(); ++k)
                moved += rigid_rows_(static_cast<std::int64_t>(r), static_cast<std::int64_t>(k)) * free[k];
            work += moved * row_force[r];
            magnitude += std::abs(row_force[r]) * std::max(std::abs(moved), rounded * max_abs(rigid_rows_.value));
        }
        if (!dead_work_->balances(theta, whole, work, magnitude)) return false;
    }
    return true;
}

// Free unknowns and held motions, from the loads on them.
void DenseZone::solve_together(std::vector<double>& y, std::vector<double>& alpha, bool again) {
    solve_free(y, again);
    if (alpha.empty()) return;
    std::vector<double> carried(alpha.size()), correction(y.size());
    multiply_transposed(motion_coupling_, y, carried);
    for (std::size_t c = 0; c < alpha.size(); ++c) alpha[c] = motion_scale_[c] * (alpha[c] - carried[c]);
    solve_lower(motion_factor_, alpha);
    solve_lower_transposed(motion_factor_, alpha);
    for (std::size_t c = 0; c < alpha.size(); ++c) alpha[c] *= motion_scale_[c];
    multiply(motion_solved_, alpha, correction);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] -= correction[i];
}

DenseZone::Solution DenseZone::solve(std::span<const double> theta, std::span<const double> row_force) {
    Solution solution;
    std::vector<double> g(index(energy_->rows()));
    multiply(energy_->load, theta, g);
    const auto pull = [&](std::size_t row, double force) {
        for (const auto& [i, n] : rows_[row].unknowns) g[index(i)] += n * force;
    };
    for (std::size_t r = 0; r < row_force.size(); ++r)
        if (held_[r] == 0 && row_force[r] != 0.0) pull(r, row_force[r]);
    std::vector<double> fixed(bound_.size(), 0.0);
    if (with_offsets_) {
        const std::vector<double> offset = offsets(theta);
        for (const Coupling& c : couplings_)
            if (held_[index(c.row)] == 0 && held_[index(c.column)] == 0)
                pull(index(c.row), -c.value * offset[index(c.column)]);
        for (std::size_t b = 0; b < bound_.size(); ++b)
            for (std::size_t i = 0; i < bound_rows_.size(); ++i)
                fixed[b] -= operations_(static_cast<std::int64_t>(b), static_cast<std::int64_t>(i)) *
                            offset[index(bound_rows_[i])];
    }
    const std::vector<double> load = g;
    std::vector<double> start(g.size(), 0.0);
    for (std::size_t b = 0; b < bound_.size(); ++b) start[index(bound_[b])] = fixed[b];
    if (std::any_of(fixed.begin(), fixed.end(), [](double v) { return v != 0.0; })) {
        // The shift of y does not act on what is fixed.
        std::vector<double> image(g.size());
        multiply_few(energy_->stiffness, start, image);
        for (const Triplet& t : springs_) image[index(t.row)] += t.value * start[index(t.column)];
        for (std::size_t i = 0; i < g.size(); ++i) g[i] -= image[i];
    }

    solution.balanced = balances(theta, row_force);
    if (!solution.balanced) return solution;

    std::vector<double> y = reduce(g), alpha(index(rigid_.columns > 0 ? motion_x_.columns : 0)), moved(g.size(), 0.0);
    if (!alpha.empty()) multiply_transposed(motion_x_, g, alpha);
    const std::vector<double> on_free = y, on_motions = alpha;
    solve_together(y, alpha, true);
    if (refine_ && by_updates_ && updated_.changed()) {
        // An updated factor leaves a residual that a new one would not. A step of refinement removes it.
        std::vector<double> left = reduce(apply(expand(y))), motions(alpha.size()), coupled(y.size());
        if (!alpha.empty()) multiply(motion_coupling_, alpha, coupled);
        for (std::size_t i = 0; i < left.size(); ++i) left[i] = on_free[i] - left[i] - coupled[i];
        if (!alpha.empty()) {
            std::vector<double> own(alpha.size());
            multiply_transposed(motion_coupling_, y, motions);
            multiply(motion_stiffness_, alpha, own);
            for (std::size_t c = 0; c < own.size(); ++c) motions[c] = on_motions[c] - motions[c] - own[c];
        }
        solve_together(left, motions, false);
        add_scaled(1.0, left, y);
        add_scaled(1.0, motions, alpha);
    }
    if (!alpha.empty()) multiply(motion_x_, alpha, moved);
    solution.unknowns = expand(y);
    for (std::size_t i = 0; i < moved.size(); ++i) solution.unknowns[i] += moved[i] + start[i];

    solution.multiplier.assign(rows_.size(), 0.0);
    if (bound_.empty()) return solution;
    std::vector<double> spring(g.size(), 0.0);
    for (const Triplet& t : springs_) spring[index(t.row)] += t.value * solution.unknowns[index(t.column)];
    for (std::size_t b = 0; b < bound_.size(); ++b) {
        const auto u = index(bound_[b]);
        const auto column = std::span<const double>(energy_->stiffness.value)
                                .subspan(u * index(energy_->rows()), index(energy_->rows()));
        const double left = load[u] - spring[u] - dot(column, solution.unknowns);
        for (std::size_t i = 0; i < bound_rows_.size(); ++i)
            solution.multiplier[index(bound_rows_[i])] +=
                operations_(static_cast<std::int64_t>(b), static_cast<std::int64_t>(i)) * left;
    }
    return solution;
}

std::optional<DenseMatrix> DenseZone::flexibility(std::span<const std::vector<RowForce>> forces) {
    const auto sets = static_cast<std::int64_t>(forces.size());
    DenseMatrix on_free(static_cast<std::int64_t>(free_.size()), sets), free(on_free.rows, sets);
    DenseMatrix on_motions(rigid_.columns > 0 ? motion_x_.columns : 0, sets), motions(on_motions.rows, sets);
    const auto column = [](DenseMatrix& a, std::int64_t c) {
        return std::span<double>(a.value).subspan(index(c * a.rows), index(a.rows));
    };
    for (std::int64_t c = 0; c < sets; ++c) {
        std::vector<double> g(index(energy_->rows()), 0.0);
        for (const RowForce& f : forces[index(c)])
            for (const auto& [i, n] : rows_[index(f.row)].unknowns)
                if (held_[index(f.row)] == 0) g[index(i)] += n * f.value;
        std::vector<double> y = reduce(g), alpha(index(motions.rows));
        if (!alpha.empty()) multiply_transposed(motion_x_, g, alpha);
        std::copy(y.begin(), y.end(), column(on_free, c).begin());
        std::copy(alpha.begin(), alpha.end(), column(on_motions, c).begin());
        solve_together(y, alpha, false);
        std::copy(y.begin(), y.end(), column(free, c).begin());
        std::copy(alpha.begin(), alpha.end(), column(motions, c).begin());
    }
    DenseMatrix work = multiply_transposed(on_free, free);
    for (std::int64_t c = 0; c < sets; ++c)
        for (std::int64_t d = 0; d < sets; ++d) work(d, c) += dot(column(on_motions, d), column(motions, c));
    return work;
}

void DenseZone::complete_forces(std::span<const double> theta, const Solution& solution,
                                std::span<double> row_force) const {
    std::vector<double> left(index(energy_->rows()));
    multiply(energy_->load, theta, left);
    std::vector<std::int64_t> needed;
    for (std::size_t r = 0; r < rows_.size(); ++r)
        if (plain_[r] >= 0 && held_[r] != 0) needed.push_back(plain_[r]);
    if (2 * needed.size() < left.size()) {
        for (const std::int64_t i : needed)
            left[index(i)] -=
                dot(std::span<const double>(energy_->stiffness.value).subspan(index(i) * left.size(), left.size()),
                    solution.unknowns);
    } else {
        std::vector<double> image(left.size());
        multiply_symmetric(energy_->stiffness, solution.unknowns, image);
        for (std::size_t i = 0; i < left.size(); ++i) left[i] -= image[i];
    }
    for (const std::int64_t r : bound_rows_) row_force[index(r)] = solution.multiplier[index(r)];
    for (std::size_t r = 0; r < rows_.size(); ++r)
        if (plain_[r] < 0 || held_[r] == 0)
            for (const auto& [i, n] : rows_[r].unknowns) left[index(i)] -= n * row_force[r];
    for (std::size_t r = 0; r < rows_.size(); ++r)
        if (plain_[r] >= 0 && held_[r] != 0) row_force[r] = left[index(plain_[r])];
}

double DenseZone::energy_of(std::span<const double> theta, std::span<const double> unknowns) {
    std::vector<double> load(unknowns.size()), image(unknowns.size());
    multiply(energy_->load, theta, load);
    multiply_symmetric(energy_->stiffness, unknowns, image);
    return 0.5 * dot(unknowns, image) - dot(unknowns, load);
}

double DenseZone::energy_of_moving(std::span<const std::size_t> rows, std::span<const double> d) const {
    double sum = 0.0;
    for (std::size_t j = 0; j < rows.size(); ++j) {
        const std::int64_t unknown = plain_[rows[j]];
        if (unknown < 0 || rows_of_[index(unknown)] > 1) return std::numeric_limits<double>::infinity();
        const double* column = energy_->stiffness.value.data() + unknown * energy_->rows();
        double force = 0.0;
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (plain_[rows[i]] >= 0) force += column[plain_[rows[i]]] * d[i];
        sum += 0.5 * force * d[j];
    }
    return sum;
}

std::vector<double> DenseZone::unknowns_at(std::span<const double>, const Response& response) {
    std::vector<double> x(index(energy_->rows()), 0.0);
    for (std::size_t r = 0; r < rows_.size(); ++r)
        if (plain_[r] >= 0) x[index(plain_[r])] = response.jump[index(jump_rows_[r])];
    return x;
}

std::vector<double> DenseZone::jumps(std::span<const double> theta, std::span<const double> unknowns) const {
    std::vector<double> j = offsets(theta);
    for (std::size_t r = 0; r < rows_.size(); ++r)
        for (const auto& [i, n] : rows_[r].unknowns) j[r] += n * unknowns[index(i)];
    return j;
}

}  // namespace delam
