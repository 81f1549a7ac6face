// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/turned/mixing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"

namespace delam {

namespace {

// Says when steps are combined, and which. (A flexure specimen of cells of 0.1 mm, `delam run examples/enf/enf.toml
// --set geometry.h=0.0001 --set time.end=1.1 --set time.steps=22`, takes 63 linear steps in its six load steps with
// large rotations; with half of most_steps 74, with twice of least_steps, of which the rule needs three, 77, and 63
// with twice of most_steps and with half and twice of slow and of near. verify/cases/test_turned_sliding.cpp and
// test_turned_energetic.cpp pass in the same time, within its noise of a tenth, with half and twice of same_adhesion,
// and with a hundredth and a hundred times of rounding.)
struct MixingLimits {
    std::size_t most_steps = 8;   // of which the next one is combined
    std::size_t least_steps = 3;  // at the same damage, before any are combined,
    double slow = 0.5;            // if the last leaves more than this share of what the two before have left
    double near = 0.05;           // of the load: steps that leave more out of balance are far from where they lead
    double same_adhesion = 1e-3;  // an adhesion that changes by more belongs to another damage
    double rounding = 1e-8;       // of the largest move: directions in which the moves differ by less say nothing
};
constexpr MixingLimits mixing_limits;

bool alike(std::span<const double> a, std::span<const double> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](double x, double y) { return std::abs(x - y) <= mixing_limits.same_adhesion; });
}

}  // namespace

std::vector<double> difference(std::span<const double> a, std::span<const double> b) {
    std::vector<double> d(a.begin(), a.end());
    add_scaled(-1.0, b, d);
    return d;
}

void Mixing::add(Iterate from, Iterate result, std::span<const double> adhesion, Balance balance) {
    if (!alike(adhesion_, adhesion) || balance.off > mixing_limits.near) {
        steps_.clear();
        needed_ = false;
    }
    adhesion_.assign(adhesion.begin(), adhesion.end());
    const std::size_t n = steps_.size();
    if (n + 1 >= mixing_limits.least_steps) {
        const Balance &last = steps_[n - 1].balance, &before = steps_[n - 2].balance;
        const bool comes_nearer = balance.off <= mixing_limits.slow * std::min(last.off, before.off);
        const bool falls = balance.energy < std::min(last.energy, before.energy);
        needed_ = needed_ || (!comes_nearer && !falls);
    }
    steps_.push_back({difference(result.displacement, from.displacement), std::move(result), balance});
    if (steps_.size() > mixing_limits.most_steps) steps_.pop_front();
}

// The parts c minimise the energy of m - sum c_i d_i with the last move m and d_i = m - m_i; from the results r the
// steps go on with r - sum c_i (r - r_i).
Iterate Mixing::mixed(const Forces& forces) const {
    const Step& last = steps_.back();
    const auto n = static_cast<std::int64_t>(steps_.size()) - 1;
    std::vector<std::vector<double>> differ, stiff;
    for (std::int64_t i = 0; i < n; ++i) {
        differ.push_back(difference(last.move, steps_[index(i)].move));
        stiff.push_back(forces(differ.back()));
    }
    DenseMatrix products(n, n);
    std::vector<double> right, parts(index(n), 0.0);
    for (std::int64_t i = 0; i < n; ++i) {
        for (std::int64_t j = 0; j < n; ++j) products(i, j) = dot(differ[index(i)], stiff[index(j)]);
        right.push_back(dot(stiff[index(i)], last.move));
    }
    const Eigen spectrum = eigen_symmetric(std::move(products));
    for (std::int64_t k = 0; k < n; ++k) {
        if (!(spectrum.value[index(k)] > mixing_limits.rounding * mixing_limits.rounding * spectrum.value.back()))
            continue;
        const std::span<const double> v = column(spectrum.vector, k);
        add_scaled(dot(v, right) / spectrum.value[index(k)], v, parts);
    }
    Iterate next = last.result;
    for (std::int64_t i = 0; i < n; ++i) {
        const Iterate& earlier = steps_[index(i)].result;
        add_scaled(-parts[index(i)], difference(last.result.displacement, earlier.displacement), next.displacement);
        add_scaled(-parts[index(i)], difference(last.result.row_force, earlier.row_force), next.row_force);
    }
    return next;
}

}  // namespace delam
