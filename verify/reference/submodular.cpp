// SPDX-License-Identifier: BSD-3-Clause
#include "submodular.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace reference {
namespace {

using Vector = std::vector<double>;

double dot(const Vector& a, const Vector& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }

// Coefficients, with sum 1, of the point of least norm in the affine hull: (G + 1 1^T) mu = 1, lambda = mu / sum(mu),
// where G is the Gram matrix. Empty if the points are affinely dependent.
std::optional<Vector> affine_minimiser(const std::vector<Vector>& points) {
    const std::size_t m = points.size();
    double scale = 0.0;
    for (const Vector& p : points) scale = std::max(scale, dot(p, p));
    std::vector<Vector> l(m, Vector(m, 0.0));
    for (std::size_t i = 0; i < m; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double value = dot(points[i], points[j]) + scale;
            for (std::size_t k = 0; k < j; ++k) value -= l[i][k] * l[j][k];
            if (i != j)
                l[i][j] = value / l[j][j];
            else if (value > 1e-13 * scale)
                l[i][i] = std::sqrt(value);
            else
                return std::nullopt;
        }
    }
    Vector mu(m, 1.0);
    for (std::size_t i = 0; i < m; ++i) {
        for (std::size_t k = 0; k < i; ++k) mu[i] -= l[i][k] * mu[k];
        mu[i] /= l[i][i];
    }
    for (std::size_t i = m; i-- > 0;) {
        for (std::size_t k = i + 1; k < m; ++k) mu[i] -= l[k][i] * mu[k];
        mu[i] /= l[i][i];
    }
    const double sum = std::accumulate(mu.begin(), mu.end(), 0.0);
    for (double& v : mu) v /= sum;
    return mu;
}

}  // namespace

double dual_bound(const std::vector<double>& x, double v) {
    double sum = 0.0;
    for (const double value : x) sum += std::min(value - v, 0.0);
    return sum;
}

SubmodularMinimum minimise_submodular(std::size_t n, const SetFunction& f, int limit) {
    SubmodularMinimum result;
    result.best = Set(n, 0);
    // The vertex with the least product with x; every prefix of the order is a candidate for the minimiser.
    const auto greedy = [&](const Vector& x) {
        std::vector<std::size_t> order(n);
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });
        Set set(n, 0);
        Vector q(n, 0.0);
        double before = 0.0;
        for (const std::size_t i : order) {
            set[i] = 1;
            const double value = f(set);
            q[i] = value - before;
            before = value;
            if (value >= result.value) continue;
            result.value = value;
            result.best = set;
        }
        return q;
    };
    std::vector<Vector> points{greedy(Vector(n, 0.0))};
    Vector weight{1.0};
    Vector x = points[0];
    result.bound = dual_bound(x, 0.0);
    result.dual = x;
    while (result.major < limit) {
        ++result.major;
        const Vector q = greedy(x);
        const double norm = dot(x, x);
        result.wolfe_gap = (norm - dot(x, q)) / norm;
        if (result.wolfe_gap <= 1e-10) {
            result.converged = true;
            break;
        }
        if (std::find(points.begin(), points.end(), q) != points.end())
            break;  // rounding, or a function that is not submodular
        points.push_back(q);
        weight.push_back(0.0);
        bool independent = true;
        while (true) {
            ++result.minor;
            const auto affine = affine_minimiser(points);
            if (!affine) {
                independent = false;
                break;
            }
            // Moves towards the affine minimiser as far as the weights stay >= 0, and drops points whose weight becomes
            // 0.
            double part = 1.0;
            for (std::size_t i = 0; i < points.size(); ++i)
                if ((*affine)[i] <= 1e-12) part = std::min(part, weight[i] / (weight[i] - (*affine)[i]));
            for (std::size_t i = 0; i < points.size(); ++i) weight[i] = (1.0 - part) * weight[i] + part * (*affine)[i];
            if (part >= 1.0) break;
            for (std::size_t i = points.size(); i-- > 0;) {
                if (weight[i] > 1e-12) continue;
                points.erase(points.begin() + static_cast<std::ptrdiff_t>(i));
                weight.erase(weight.begin() + static_cast<std::ptrdiff_t>(i));
            }
            const double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
            for (double& w : weight) w /= sum;
        }
        x.assign(n, 0.0);
        for (std::size_t i = 0; i < points.size(); ++i)
            for (std::size_t j = 0; j < n; ++j) x[j] += weight[i] * points[i][j];
        if (const double bound = dual_bound(x, 0.0); bound > result.bound) {
            result.bound = bound;
            result.dual = x;
        }
        if (!independent) break;
    }
    return result;
}

}  // namespace reference
