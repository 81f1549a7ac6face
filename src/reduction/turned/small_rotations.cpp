// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/turned/small_rotations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "body/rotation.hpp"
#include "linalg/dense/dense.hpp"
#include "reduction/turned/linear_buckling.hpp"

namespace delam {

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
// The largest error that leaving out a factorisation makes of an error of rotations, a fiftieth of what a run tells;
// half and twice only factorise more and less often.
constexpr double negligible = 1e-4;

void poll() { poll_cancel("buckling"); }

// Returns the strains  q = 1/2 W^T W  that the rotations W of displacement gradients add, in place of these.
std::vector<double> strains_of_rotations(std::vector<double> slopes, std::size_t dim) {
    for (std::size_t c = 0; c < slopes.size(); c += dim * dim) {
        const std::span<double> slope = std::span(slopes).subspan(c, dim * dim);
        std::array<double, 9> skew{}, square{};
        for (std::size_t i = 0; i < dim; ++i)
            for (std::size_t j = 0; j < dim; ++j) skew[i * dim + j] = 0.5 * (slope[i * dim + j] - slope[j * dim + i]);
        for (std::size_t i = 0; i < dim; ++i)
            for (std::size_t j = 0; j < dim; ++j)
                for (std::size_t k = 0; k < dim; ++k)
                    square[i * dim + j] += 0.5 * skew[k * dim + i] * skew[k * dim + j];
        std::copy_n(square.begin(), dim * dim, slope.begin());
    }
    return slopes;
}

double largest_rotation(std::span<const double> slopes, std::size_t dim) {
    return slopes.empty() ? undefined : largest_length(rotations(slopes, dim), dim == 2 ? 1 : 3);
}

}  // namespace

// Strains q that rotations add have the energy
//
//     |int s : q|  +  min over v of  1/2 int (e(v) + q) : C : (e(v) + q) + springs,
//
// the work of the stresses s, and their own as far as further displacements v, which the interfaces hold, do not
// relieve them (O. Zienkiewicz, R. Taylor, The Finite Element Method 2, 2000, chapter 10).
SmallRotations::SmallRotations(const Problem& problem, const BodySystem* bodies, const std::vector<BodyModel>& models,
                               Moved moved, double stored, std::function<Holding()> holding)
    : problem_(problem),
      bodies_(bodies),
      largest_(largest_rotation(moved.slopes, index(problem.mesh->dimension()))),
      stress_(*problem.mesh, std::move(moved.stress)),
      membrane_(*problem.mesh,
                centre_stress(*problem.mesh, models, std::vector<double>(moved.displacement.size(), 0.0),
                              strains_of_rotations(std::move(moved.slopes), index(problem.mesh->dimension())), {})),
      membrane_work_(membrane_.work_on_rotations(moved.displacement)),
      energy_{std::abs(stress_.work_on_rotations(moved.displacement)) / stored, 0.5 * membrane_work_ / stored},
      holding_(std::move(holding)) {}

double SmallRotations::error() {
    const double of_strains = 0.5 * largest_ * largest_;
    const auto [work, unrelieved] = energy_;
    const double share = work + (unrelieved > negligible ? unrelieved_share() * unrelieved : 0.0);
    return std::isfinite(share) ? std::max(of_strains, share) : of_strains;  // squares of tiny loads are 0
}

// The minimum over v is  1/2 int q : C : q - 1/2 f . (K + springs)^-1 f  with the forces f of the stresses C : q.
double SmallRotations::unrelieved_share() {
    if (!(membrane_work_ > 0.0) || held() == nullptr) return 0.0;
    const std::vector<double> force = membrane_.forces();
    return std::max(0.0, 1.0 - dot(force, held_->solve(force)) / membrane_work_);
}

double SmallRotations::buckling_ratio() {
    if (problem_.mesh->cell_count() == 0 || held() == nullptr) return undefined;
    return critical_ratio(*held_, touching_, stress_, poll);
}

const HeldBodies* SmallRotations::held() {
    if (tried_) return held_.get();
    Holding now = holding_();
    touching_ = std::move(now.touching);
    held_ = HeldBodies::of(problem_, bodies_, std::move(now.springs), poll);
    tried_ = true;  // not where a cancellation or a lack of memory has ended it
    return held_.get();
}

}  // namespace delam
