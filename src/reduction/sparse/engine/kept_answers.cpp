// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/engine/kept_answers.hpp"

#include <cmath>

#include "base/numbers.hpp"

namespace delam {

namespace {

// Largest difference, relative to the largest variable, between a state and a combination of kept answers that stands
// for it.
constexpr double same_state = 1e-11;

}  // namespace

KeptAnswers::KeptAnswers(std::size_t places) : kept_(places) { clear(); }

void KeptAnswers::clear() {
    const auto places = static_cast<std::int64_t>(kept_.size());
    kept_.assign(kept_.size(), {});
    products_ = DenseMatrix(places, places);
}

std::size_t KeptAnswers::free_place(std::span<const double> start) const {
    std::size_t place = newest_;
    do {
        place = (place + 1) % kept_.size();
    } while (!start.empty() && start[place] != 0.0 && place != newest_);
    return place;
}

void KeptAnswers::keep(std::size_t place, std::span<const double> variables, std::span<const double> theta,
                       std::span<const double> products) {
    kept_[place] = {{variables.begin(), variables.end()}, {theta.begin(), theta.end()}, true};
    for (std::size_t s = 0; s < kept_.size(); ++s)
        products_(static_cast<std::int64_t>(place), static_cast<std::int64_t>(s)) =
            products_(static_cast<std::int64_t>(s), static_cast<std::int64_t>(place)) = products[s];
    newest_ = place;
}

void KeptAnswers::forget(std::size_t place) { kept_[place] = {}; }

void KeptAnswers::take_back(std::size_t before) {
    forget(newest_);
    newest_ = before;
}

std::vector<double> KeptAnswers::newest_alone() const {
    if (!kept_[newest_].there) return {};
    std::vector<double> weights(kept_.size(), 0.0);
    weights[newest_] = 1.0;
    return weights;
}

// Weights are valid if the combination has the variables of the state and its loads: where all pairs are bonded, the
// variables are zero at any load.
std::optional<std::vector<double>> KeptAnswers::weights_of(const EngineLayout& at, std::span<const double> x,
                                                           std::span<const double> theta,
                                                           std::vector<double> moved) const {
    const std::span<const double> weights = at.weights(x);
    std::vector<double> sum = std::move(moved);
    std::vector<double> loads(theta.size(), 0.0);
    for (std::size_t s = 0; s < kept_.size(); ++s) {
        if (weights[s] == 0.0) continue;
        if (!kept_[s].there) return {};
        add_scaled(weights[s], kept_[s].variables, sum);
        for (std::size_t p = 0; p < loads.size(); ++p) loads[p] += weights[s] * kept_[s].theta[p];
    }
    for (std::size_t p = 0; p < loads.size(); ++p)
        if (!(std::abs(loads[p] - theta[p]) <= same_state * max_abs(theta))) return {};
    const double allowed = same_state * max_abs(at.variables(x));
    for (std::size_t i = 0; i < sum.size(); ++i)
        if (!(std::abs(sum[i] - x[i]) <= allowed)) return {};
    return std::vector<double>(weights.begin(), weights.end());
}

double KeptAnswers::strain(std::span<const double> weights) const {
    double sum = 0.0;
    for (std::size_t s = 0; s < weights.size(); ++s)
        for (std::size_t t = 0; t < weights.size(); ++t)
            if (weights[s] != 0.0 && weights[t] != 0.0)
                sum += 0.5 * weights[s] * weights[t] *
                       products_(static_cast<std::int64_t>(s), static_cast<std::int64_t>(t));
    return sum;
}

}  // namespace delam
