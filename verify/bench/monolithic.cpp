// SPDX-License-Identifier: BSD-3-Clause
#include "monolithic.hpp"

#include <algorithm>
#include <cmath>

namespace bench {
namespace {

struct Term {
    std::int32_t unknown;
    double factor;
};

// Rows of T, one per degree of freedom, and C.
struct Unknowns {
    std::vector<std::vector<Term>> row;
    std::vector<double> constant;  // C, [dofs][patterns]
    std::vector<std::int32_t> jump;
    std::int32_t count = 0;
};

std::size_t index(std::int64_t i) { return static_cast<std::size_t>(i); }

Unknowns choose_unknowns(const reference::Exported& exported) {
    const auto d = index(exported.dimension);
    Unknowns u;
    u.row.resize(exported.dofs);
    u.constant.assign(exported.dofs * exported.patterns, 0.0);

    // The constraint of each degree of freedom, and the degree of freedom that it eliminates: the one with the largest
    // weight.
    std::vector<std::int64_t> constraint(exported.dofs, -1);
    std::vector<bool> eliminated(exported.dofs, false);
    const auto& c = exported.constraints;
    std::vector<std::size_t> pivots;
    for (std::size_t r = 0; r < c.rows(); ++r) {
        auto pivot = index(c.start[r]);
        for (auto e = index(c.start[r]); e < index(c.start[r + 1]); ++e) {
            const auto dof = index(c.column[e]);
            if (constraint[dof] >= 0)
                throw reference::Failure(0, "monolithic: a degree of freedom is constrained twice");
            constraint[dof] = static_cast<std::int64_t>(r);
            if (std::abs(c.value[e]) > std::abs(c.value[pivot])) pivot = e;
        }
        pivots.push_back(pivot);
        eliminated[index(c.column[pivot])] = true;
    }

    std::vector<bool> on_face_b(exported.dofs / d, false);
    for (const auto& pairs : exported.interfaces) {
        for (const auto node : pairs.node_b) on_face_b[index(node)] = true;
    }
    for (std::size_t dof = 0; dof < exported.dofs; ++dof) {
        if (exported.alive[dof] && !eliminated[dof] && !on_face_b[dof / d]) u.row[dof] = {{u.count++, 1.0}};
    }
    for (std::size_t r = 0; r < c.rows(); ++r) {
        const double pivot_value = c.value[pivots[r]];
        const auto dof = index(c.column[pivots[r]]);
        for (auto e = index(c.start[r]); e < index(c.start[r + 1]); ++e) {
            if (e == pivots[r]) continue;
            u.row[dof].push_back({u.row[index(c.column[e])].at(0).unknown, -c.value[e] / pivot_value});
        }
        for (std::size_t p = 0; p < exported.patterns; ++p)
            u.constant[dof * exported.patterns + p] = exported.prescribed[r * exported.patterns + p] / pivot_value;
    }
    std::vector<bool> seen(exported.dofs / d, false);
    for (const auto& pairs : exported.interfaces) {
        for (std::size_t k = 0; k < pairs.count(); ++k) {
            const auto a = index(pairs.node_a[k]);
            const auto b = index(pairs.node_b[k]);
            if (seen[a] || seen[b] || on_face_b[a])
                throw reference::Failure(0, "monolithic: a node belongs to several pairs");
            seen[a] = seen[b] = true;
            const std::int32_t first = u.count;
            for (std::size_t x = 0; x < d; ++x) {
                if (constraint[a * d + x] >= 0 || constraint[b * d + x] >= 0)
                    throw reference::Failure(0, "monolithic: a node of a pair is constrained");
                u.row[b * d + x] = u.row[a * d + x];
                for (std::size_t n = 0; n < d; ++n) {
                    const double f = pairs.frame[(k * d + n) * d + x];
                    if (f != 0.0) u.row[b * d + x].push_back({first + static_cast<std::int32_t>(n), f});
                }
            }
            for (std::size_t n = 0; n < d; ++n) u.jump.push_back(u.count++);
        }
    }
    return u;
}

// Upper triangle of T^T K T: sorts the entries into their columns, then sums duplicates.
UpperMatrix transform(const reference::Csr& k, const Unknowns& u) {
    const auto n = index(u.count);
    const auto each = [&](const auto& visit) {
        for (std::size_t i = 0; i < k.rows(); ++i) {
            for (const Term& left : u.row[i]) {
                for (auto e = index(k.start[i]); e < index(k.start[i + 1]); ++e) {
                    for (const Term& right : u.row[index(k.column[e])]) {
                        if (left.unknown <= right.unknown)
                            visit(left.unknown, right.unknown, left.factor * k.value[e] * right.factor);
                    }
                }
            }
        }
    };
    std::vector<std::int32_t> start(n + 1, 0);
    each([&](std::int32_t, std::int32_t column, double) { ++start[index(column) + 1]; });
    for (std::size_t j = 0; j < n; ++j) start[j + 1] += start[j];
    std::vector<std::pair<std::int32_t, double>> entry(index(start[n]));
    std::vector<std::int32_t> next(start.begin(), start.end() - 1);
    each([&](std::int32_t row, std::int32_t column, double value) {
        entry[index(next[index(column)]++)] = {row, value};
    });
    UpperMatrix upper;
    upper.start.reserve(n + 1);
    for (std::size_t j = 0; j < n; ++j) {
        const auto first = entry.begin() + start[j];
        const auto last = entry.begin() + start[j + 1];
        std::stable_sort(first, last, [](const auto& a, const auto& b) { return a.first < b.first; });
        for (auto e = first; e != last; ++e) {
            if (e != first && e->first == upper.row.back()) {
                upper.value.back() += e->second;
            } else {
                upper.row.push_back(e->first);
                upper.value.push_back(e->second);
            }
        }
        if (upper.row.empty() || upper.row.back() != static_cast<std::int32_t>(j))
            throw reference::Failure(0, "monolithic: an unknown without stiffness");
        upper.start.push_back(static_cast<std::int32_t>(upper.row.size()));
    }
    return upper;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

}  // namespace

Monolithic::Monolithic(const reference::Scene& scene) {
    const reference::Exported exported(scene);
    const Unknowns u = choose_unknowns(exported);
    patterns_ = exported.patterns;
    jump_ = u.jump;
    for (const auto& pairs : exported.interfaces)
        weight_.insert(weight_.end(), pairs.weight.begin(), pairs.weight.end());
    base_ = transform(exported.stiffness, u);
    current_ = base_;

    // Off-diagonal entries of the jumps, in their columns and along their rows.
    std::vector<std::int32_t> row_of(unknowns(), -1);
    for (std::size_t r = 0; r < jump_.size(); ++r) row_of[index(jump_[r])] = static_cast<std::int32_t>(r);
    crossing_start_.assign(jump_.size() + 1, 0);
    const auto each = [&](const auto& visit) {
        for (std::size_t j = 0; j < base_.size(); ++j) {
            for (auto e = base_.start[j]; e < base_.start[j + 1] - 1; ++e) {
                const std::int32_t i = base_.row[index(e)];
                if (row_of[index(i)] >= 0) visit(row_of[index(i)], Crossing{e, static_cast<std::int32_t>(j)});
                if (row_of[j] >= 0) visit(row_of[j], Crossing{e, i});
            }
        }
    };
    each([&](std::int32_t row, Crossing) { ++crossing_start_[index(row) + 1]; });
    for (std::size_t r = 0; r < jump_.size(); ++r) crossing_start_[r + 1] += crossing_start_[r];
    crossing_.resize(index(crossing_start_.back()));
    std::vector<std::int32_t> next(crossing_start_.begin(), crossing_start_.end() - 1);
    each([&](std::int32_t row, Crossing crossing) { crossing_[index(next[index(row)]++)] = crossing; });

    // Loads.
    lift_.assign(patterns_, std::vector<double>(unknowns(), 0.0));
    dead_ = lift_;
    a_.assign(patterns_ * patterns_, 0.0);
    potential_ = a_;
    for (std::size_t p = 0; p < patterns_; ++p) {
        for (std::size_t i = 0; i < exported.dofs; ++i) {
            double kc = 0.0;
            for (auto e = index(exported.stiffness.start[i]); e < index(exported.stiffness.start[i + 1]); ++e)
                kc += exported.stiffness.value[e] * u.constant[index(exported.stiffness.column[e]) * patterns_ + p];
            for (const Term& t : u.row[i]) {
                lift_[p][index(t.unknown)] += t.factor * kc;
                dead_[p][index(t.unknown)] += t.factor * exported.forces[p][i];
            }
            for (std::size_t q = 0; q < patterns_; ++q) {
                a_[q * patterns_ + p] += u.constant[i * patterns_ + q] * kc;
                potential_[p * patterns_ + q] += exported.forces[p][i] * u.constant[i * patterns_ + q];
            }
        }
    }
}

const UpperMatrix& Monolithic::assemble(const std::vector<double>& spring, const std::vector<std::uint8_t>& held) {
    std::copy(base_.value.begin(), base_.value.end(), current_.value.begin());
    for (std::size_t r = 0; r < jump_.size(); ++r) {
        if (held[r] == 0) {
            current_.value[index(base_.start[index(jump_[r]) + 1]) - 1] += spring[r];
            continue;
        }
        for (auto e = crossing_start_[r]; e < crossing_start_[r + 1]; ++e)
            current_.value[index(crossing_[index(e)].at)] = 0.0;
    }
    return current_;
}

void Monolithic::right_side(const std::vector<double>& theta, const std::vector<std::uint8_t>& held,
                            std::vector<double>& b) const {
    b.assign(unknowns(), 0.0);
    for (std::size_t p = 0; p < patterns_; ++p) {
        for (std::size_t i = 0; i < b.size(); ++i) b[i] += theta[p] * (dead_[p][i] - lift_[p][i]);
    }
    for (std::size_t r = 0; r < jump_.size(); ++r) {
        if (held[r] != 0) b[index(jump_[r])] = 0.0;
    }
}

double Monolithic::held_force(std::size_t row, const std::vector<double>& v, const std::vector<double>& theta) const {
    double unbalance = 0.0;  // of the row of K0 v + lift - dead; the jump itself is zero
    for (auto e = crossing_start_[row]; e < crossing_start_[row + 1]; ++e) {
        const Crossing& crossing = crossing_[index(e)];
        unbalance += base_.value[index(crossing.at)] * v[index(crossing.other)];
    }
    const auto j = index(jump_[row]);
    for (std::size_t p = 0; p < patterns_; ++p) unbalance += theta[p] * (lift_[p][j] - dead_[p][j]);
    return -unbalance;
}

double Monolithic::work_of_dead_loads(const std::vector<double>& v, const std::vector<double>& theta) const {
    double work = 0.0;
    for (std::size_t p = 0; p < patterns_; ++p) {
        work += theta[p] * dot(dead_[p], v);
        for (std::size_t q = 0; q < patterns_; ++q) work += theta[p] * potential_[p * patterns_ + q] * theta[q];
    }
    return work;
}

std::vector<double> Monolithic::conjugate(const std::vector<double>& v, const std::vector<double>& theta) const {
    std::vector<double> r(patterns_, 0.0);
    for (std::size_t p = 0; p < patterns_; ++p) {
        r[p] = dot(lift_[p], v) - dot(dead_[p], v);
        for (std::size_t q = 0; q < patterns_; ++q) {
            const double dead = potential_[p * patterns_ + q] + potential_[q * patterns_ + p];
            r[p] += theta[q] * (a_[p * patterns_ + q] - dead);
        }
    }
    return r;
}

}  // namespace bench
