// SPDX-License-Identifier: BSD-3-Clause
// Minimisation of a submodular set function by the minimum-norm point of its base polytope, with the dual bound.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace reference {

using Set = std::vector<std::uint8_t>;  // [n] 1: in the set
using SetFunction = std::function<double(const Set&)>;

struct SubmodularMinimum {
    Set best;            // of all sets that were evaluated
    double value = 0.0;  // its F
    // largest sum of min(x_i, 0) found: a lower bound of F if F is submodular. `dual` is its x.
    double bound = 0.0;
    std::vector<double> dual;
    // |x|^2 - min over vertices x.q, at the last point, over |x|^2: 0 at the minimum-norm point
    double wolfe_gap = 0.0;
    int major = 0, minor = 0;
    bool converged = false;
};

// F({}) = 0. `limit`: maximal number of greedy vertices, n evaluations each.
//
// For an order of the elements with prefixes S_i the greedy vector q_i = F(S_i) - F(S_{i-1}) is a vertex of the base
// polytope; x is a convex combination of such vertices. Then F(A) >= x(A) >= sum of min(x_i, 0) for every A (Edmonds).
// If marginals may grow by up to v, F(A+i) - F(A) >= F(B+i) - F(B) - v for A within B, then with S_{i-1} and its part
// within A
//     x(A) <= F(A) + v |A|,    hence    F(A) >= sum of min(x_i - v, 0).
// Source: S. Fujishige, S. Isotani, Pac. J. Optim. 7 (2011) 3-17; P. Wolfe, Math. Program. 11 (1976) 128-149.
SubmodularMinimum minimise_submodular(std::size_t n, const SetFunction& f, int limit);
// sum of min(x_i - v, 0)
double dual_bound(const std::vector<double>& x, double v);

}  // namespace reference
