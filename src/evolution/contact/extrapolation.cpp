// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/contact/extrapolation.hpp"

#include "base/numbers.hpp"
#include "linalg/dense/dense.hpp"

namespace delam {

namespace {

constexpr std::size_t depth = 5;
// Nearly parallel differences carry no new information: a ridge of this size keeps the small system solvable. (Measured
// by verify/bench/constants.py on 60 random scenes: half and twice decide alike.)
constexpr double ridge = 1e-10;

}  // namespace

std::vector<double> Extrapolation::next(std::span<const double> z, std::span<const double> image) {
    std::vector<double> residual(z.size());
    for (std::size_t i = 0; i < z.size(); ++i) residual[i] = image[i] - z[i];
    if (!last_z_.empty()) {
        Difference d{{image.begin(), image.end()}, residual};
        for (std::size_t i = 0; i < z.size(); ++i) {
            d.image[i] -= last_image_[i];
            d.residual[i] -= last_image_[i] - last_z_[i];
        }
        differences_.push_back(std::move(d));
        if (differences_.size() > depth) differences_.pop_front();
    }
    last_z_.assign(z.begin(), z.end());
    last_image_.assign(image.begin(), image.end());

    std::vector<double> out(image.begin(), image.end());
    const auto n = static_cast<std::int64_t>(differences_.size());
    DenseMatrix gram(n, n);
    std::vector<double> gamma(differences_.size());
    for (std::int64_t j = 0; j < n; ++j) {
        const Difference& a = differences_[index(j)];
        gamma[index(j)] = dot(a.residual, residual);
        for (std::int64_t i = j; i < n; ++i) gram(i, j) = dot(differences_[index(i)].residual, a.residual);
        gram(j, j) *= 1.0 + ridge;
    }
    if (n == 0 || !factor_definite(gram)) return out;
    solve_lower(gram, gamma);
    solve_lower_transposed(gram, gamma);
    for (std::size_t j = 0; j < gamma.size(); ++j) add_scaled(-gamma[j], differences_[j].image, out);
    return out;
}

}  // namespace delam
