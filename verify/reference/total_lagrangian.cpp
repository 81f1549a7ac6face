// SPDX-License-Identifier: BSD-3-Clause
#include "total_lagrangian.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "factor.hpp"

namespace reference {

namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

// The shape function of a node at `at`, of the family of serendipity: 1/8 prod (1 + s x) (sum s x - 2) at corners, 1/4
// (1 - x^2) (1 + s y) (1 + s z) at middles of edges. place: -1, 0 or 1 along each axis.
double shape(const std::vector<int>& place, const std::vector<double>& at) {
    double product = 1.0, sum = 0.0;
    bool corner = true;
    for (std::size_t k = 0; k < place.size(); ++k) {
        if (place[k] == 0) {
            product *= 1.0 - at[k] * at[k];
            corner = false;
        } else {
            product *= 0.5 * (1.0 + place[k] * at[k]);
            sum += place[k] * at[k];
        }
    }
    return corner ? product * (sum - static_cast<double>(place.size()) + 1.0) : product;
}

// Returns its slope along an axis. The function is quadratic along each axis at most, so that central differences are
// exact but for rounding.
double slope(const std::vector<int>& place, std::vector<double> at, std::size_t axis) {
    const double x = at[axis];
    at[axis] = x + 0.5;
    const double above = shape(place, at);
    at[axis] = x - 0.5;
    return above - shape(place, at);
}

}  // namespace

struct TotalLagrangian::System {
    std::vector<double> force;  // [DOFs] of the solids on their nodes
    double energy = 0.0, rotation = 0.0;
    std::vector<std::size_t> row, column;
    std::vector<double> value;
    void add(std::size_t i, std::size_t j, double v) {
        row.push_back(i);
        column.push_back(j);
        value.push_back(v);
    }
};

TotalLagrangian::TotalLagrangian(int dimension, std::vector<double> nodes, std::vector<std::vector<std::int64_t>> cells,
                                 double young, double poisson)
    : dim_(static_cast<std::size_t>(dimension)),
      nodes_(std::move(nodes)),
      cells_(std::move(cells)),
      lame_(young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson))),
      shear_(0.5 * young / (1.0 + poisson)),
      master_(nodes_.size() / dim_),
      u_(nodes_.size(), 0.0) {
    std::iota(master_.begin(), master_.end(), 0);
    for (const auto& cell : cells_) points_.push_back(points_of(cell));
}

std::vector<TotalLagrangian::Point> TotalLagrangian::points_of(const std::vector<std::int64_t>& cell) const {
    std::vector<double> low(dim_, 1e300), high(dim_, -1e300), half(dim_);
    for (const std::int64_t node : cell)
        for (std::size_t k = 0; k < dim_; ++k) {
            const double x = nodes_[static_cast<std::size_t>(node) * dim_ + k];
            low[k] = std::min(low[k], x);
            high[k] = std::max(high[k], x);
        }
    double volume = 1.0;
    for (std::size_t k = 0; k < dim_; ++k) {
        half[k] = 0.5 * (high[k] - low[k]);
        volume *= half[k];
    }
    std::vector<std::vector<int>> place;
    for (const std::int64_t node : cell) {
        std::vector<int>& own = place.emplace_back();
        for (std::size_t k = 0; k < dim_; ++k) {
            const double x = nodes_[static_cast<std::size_t>(node) * dim_ + k];
            own.push_back(static_cast<int>(std::lround((x - 0.5 * (low[k] + high[k])) / half[k])));
        }
    }
    const std::array<double, 3> gauss{-std::sqrt(0.6), 0.0, std::sqrt(0.6)}, weight{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    std::vector<Point> points;
    const std::size_t count = dim_ == 2 ? 9 : 27;
    for (std::size_t p = 0; p < count; ++p) {
        const std::array<std::size_t, 3> index{p % 3, p / 3 % 3, p / 9};
        std::vector<double> at(dim_);
        Point point{{}, volume};
        for (std::size_t k = 0; k < dim_; ++k) {
            at[k] = gauss[index[k]];
            point.weight *= weight[index[k]];
        }
        for (const std::vector<int>& own : place)
            for (std::size_t k = 0; k < dim_; ++k) point.slope.push_back(slope(own, at, k) / half[k]);
        points.push_back(std::move(point));
    }
    return points;
}

void TotalLagrangian::tie(std::int64_t node, std::int64_t to) {
    const std::int64_t old = master_[static_cast<std::size_t>(node)];
    const std::int64_t own = master_[static_cast<std::size_t>(to)];
    std::replace(master_.begin(), master_.end(), old, own);
}

void TotalLagrangian::prescribe(std::int64_t node, int component, double value) {
    const auto master = static_cast<std::size_t>(master_[static_cast<std::size_t>(node)]);
    prescribed_[master * dim_ + static_cast<std::size_t>(component)] = value;
}

// Adds the energy S : E / 2 and the forces F S grad N, where F = I + grad u, E = (F^T F - I)/2 and S = lambda tr E I +
// 2 mu E, and the tangent of the forces.
void TotalLagrangian::add_cell(std::size_t cell, System& system) const {
    const std::vector<std::int64_t>& nodes = cells_[cell];
    const std::size_t n = nodes.size();
    std::vector<double> stiffness(n * dim_ * n * dim_, 0.0);
    for (const Point& point : points_[cell]) {
        Matrix f{}, e{}, s{};
        for (std::size_t i = 0; i < 3; ++i) f[i][i] = 1.0;
        for (std::size_t a = 0; a < n; ++a)
            for (std::size_t i = 0; i < dim_; ++i)
                for (std::size_t j = 0; j < dim_; ++j)
                    f[i][j] += u_[static_cast<std::size_t>(nodes[a]) * dim_ + i] * point.slope[a * dim_ + j];
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                for (std::size_t k = 0; k < 3; ++k) e[i][j] += 0.5 * f[k][i] * f[k][j];
                if (i == j) e[i][j] -= 0.5;
            }
        const double trace = e[0][0] + e[1][1] + e[2][2];
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                s[i][j] = 2.0 * shear_ * e[i][j] + (i == j ? lame_ * trace : 0.0);
                system.energy += 0.5 * point.weight * s[i][j] * e[i][j];
            }
        system.rotation = std::max(system.rotation, std::abs(std::atan2(f[1][0] - f[0][1], f[0][0] + f[1][1])));
        if (dim_ == 3)
            system.rotation = std::max(system.rotation, std::abs(std::atan2(f[2][0] - f[0][2], f[0][0] + f[2][2])));
        // B of a node: dE_jk = sym(F^T grad du) at the columns i of du.
        for (std::size_t a = 0; a < n; ++a) {
            const double* slope_a = &point.slope[a * dim_];
            for (std::size_t i = 0; i < dim_; ++i) {
                double pull = 0.0;
                for (std::size_t j = 0; j < dim_; ++j)
                    for (std::size_t k = 0; k < dim_; ++k) pull += f[i][j] * s[j][k] * slope_a[k];
                system.force[static_cast<std::size_t>(nodes[a]) * dim_ + i] += point.weight * pull;
            }
            for (std::size_t i = 0; i < dim_; ++i) {
                Matrix strain{}, stress{};  // of a unit displacement i of node a
                for (std::size_t j = 0; j < dim_; ++j)
                    for (std::size_t k = 0; k < dim_; ++k)
                        strain[j][k] = 0.5 * (f[i][j] * slope_a[k] + f[i][k] * slope_a[j]);
                const double own = strain[0][0] + strain[1][1] + strain[2][2];
                for (std::size_t j = 0; j < 3; ++j)
                    for (std::size_t k = 0; k < 3; ++k)
                        stress[j][k] = 2.0 * shear_ * strain[j][k] + (j == k ? lame_ * own : 0.0);
                for (std::size_t b = 0; b < n; ++b) {
                    const double* slope_b = &point.slope[b * dim_];
                    double geometric = 0.0;
                    for (std::size_t j = 0; j < dim_; ++j)
                        for (std::size_t k = 0; k < dim_; ++k) geometric += slope_a[j] * s[j][k] * slope_b[k];
                    for (std::size_t l = 0; l < dim_; ++l) {
                        double material = 0.0;
                        for (std::size_t j = 0; j < dim_; ++j)
                            for (std::size_t k = 0; k < dim_; ++k) material += stress[j][k] * f[l][j] * slope_b[k];
                        stiffness[(a * dim_ + i) * n * dim_ + b * dim_ + l] +=
                            point.weight * (material + (i == l ? geometric : 0.0));
                    }
                }
            }
        }
    }
    for (std::size_t a = 0; a < n * dim_; ++a)
        for (std::size_t b = 0; b < n * dim_; ++b)
            system.add(static_cast<std::size_t>(nodes[a / dim_]) * dim_ + a % dim_,
                       static_cast<std::size_t>(nodes[b / dim_]) * dim_ + b % dim_, stiffness[a * n * dim_ + b]);
}

// A node that would pass through the face is pushed back along the normal of the segment onto which it projects, whose
// ends take the reaction by the lever rule.
void TotalLagrangian::add_contact(System& system) const {
    constexpr double times = 10.0;  // a node gives a tenth of what a cell does
    using Place = std::array<double, 2>;
    const auto place = [&](std::int64_t node) {
        const auto n = static_cast<std::size_t>(node) * 2;
        return Place{nodes_[n] + u_[n], nodes_[n + 1] + u_[n + 1]};
    };
    for (const std::int64_t node : above_) {
        const Place x = place(node);
        // The segment whose middle is nearest.
        std::size_t nearest = 0;
        double least = 1e300;
        for (std::size_t i = 0; i + 1 < face_.size(); ++i) {
            const Place p = place(face_[i]), q = place(face_[i + 1]);
            const double away = std::hypot(x[0] - 0.5 * (p[0] + q[0]), x[1] - 0.5 * (p[1] + q[1]));
            if (away < least) least = away, nearest = i;
        }
        const Place p = place(face_[nearest]), q = place(face_[nearest + 1]);
        const double length = std::hypot(q[0] - p[0], q[1] - p[1]);
        const Place along{(q[0] - p[0]) / length, (q[1] - p[1]) / length}, normal{-along[1], along[0]};
        const double share = ((x[0] - p[0]) * along[0] + (x[1] - p[1]) * along[1]) / length;
        const double gap = (x[0] - p[0]) * normal[0] + (x[1] - p[1]) * normal[1];
        if (gap > 0.0) continue;
        const double penalty = times * shear_;
        const std::array<std::pair<std::int64_t, double>, 3> acts{
            {{node, 1.0}, {face_[nearest], share - 1.0}, {face_[nearest + 1], -share}}};
        for (const auto& [a, of_a] : acts)
            for (std::size_t k = 0; k < 2; ++k) {
                const std::size_t row = static_cast<std::size_t>(a) * 2 + k;
                system.force[row] += penalty * gap * of_a * normal[k];
                for (const auto& [b, of_b] : acts)
                    for (std::size_t l = 0; l < 2; ++l)
                        system.add(row, static_cast<std::size_t>(b) * 2 + l,
                                   penalty * of_a * of_b * normal[k] * normal[l]);
            }
    }
}

// The first iteration moves what is prescribed, and all else as the tangent of the state before says.
bool TotalLagrangian::iterate(double share, double before) {
    std::vector<std::int64_t> unknown(u_.size(), -1);  // of the master's DOFs
    std::int64_t count = 0;
    const auto master_dof = [&](std::size_t dof) {
        return static_cast<std::size_t>(master_[dof / dim_]) * dim_ + dof % dim_;
    };
    for (std::size_t dof = 0; dof < u_.size(); ++dof)
        if (master_dof(dof) == dof && !prescribed_.contains(dof)) unknown[dof] = count++;
    double scale = 0.0;
    for (int iteration = 0; iteration < 60; ++iteration) {
        System system;
        system.force.assign(u_.size(), 0.0);
        for (std::size_t cell = 0; cell < cells_.size(); ++cell) add_cell(cell, system);
        add_contact(system);
        std::vector<double> right(static_cast<std::size_t>(count), 0.0), all(u_.size(), 0.0);
        for (std::size_t dof = 0; dof < u_.size(); ++dof) all[master_dof(dof)] += system.force[dof];
        for (std::size_t dof = 0; dof < u_.size(); ++dof) {
            scale = std::max(scale, std::abs(all[dof]));
            if (unknown[dof] >= 0) right[static_cast<std::size_t>(unknown[dof])] -= all[dof];
        }
        double off = 0.0;
        for (const double r : right) off = std::max(off, std::abs(r));
        if (iteration > 0 && off <= 1e-9 * scale) return true;
        Triplets lower;
        for (std::size_t e = 0; e < system.value.size(); ++e) {
            const std::size_t i = master_dof(system.row[e]), j = master_dof(system.column[e]);
            if (unknown[i] < 0) continue;
            if (unknown[j] >= 0)
                lower.add(unknown[i], unknown[j], system.value[e]);
            else if (iteration == 0)
                right[static_cast<std::size_t>(unknown[i])] -= system.value[e] * (share - before) * prescribed_.at(j);
        }
        const std::vector<double> step = Factor(static_cast<std::size_t>(count), lower).solve(right);
        for (std::size_t dof = 0; dof < u_.size(); ++dof) {
            const std::size_t own = master_dof(dof);
            if (unknown[own] >= 0)
                u_[dof] += step[static_cast<std::size_t>(unknown[own])];
            else
                u_[dof] = share * prescribed_.at(own);
        }
    }
    return false;
}

TotalLagrangian::Result TotalLagrangian::solve(int steps) {
    std::fill(u_.begin(), u_.end(), 0.0);
    for (int k = 1; k <= steps; ++k)
        if (!iterate(static_cast<double>(k) / steps, static_cast<double>(k - 1) / steps))
            throw std::runtime_error("total Lagrangian: Newton's method does not converge in step " +
                                     std::to_string(k));
    System system;
    system.force.assign(u_.size(), 0.0);
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) add_cell(cell, system);
    Result result{system.energy, 0.0, system.rotation, u_};
    add_contact(system);
    for (std::size_t dof = 0; dof < u_.size(); ++dof) {
        const auto own = prescribed_.find(static_cast<std::size_t>(master_[dof / dim_]) * dim_ + dof % dim_);
        if (own != prescribed_.end()) result.conjugate += own->second * system.force[dof];
    }
    return result;
}

}  // namespace reference
