// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/bodies/kept_states.hpp"

namespace delam::petsc {

void KeptStates::keep(std::size_t place, Vec v, const std::vector<double>& theta) {
    State& state = states_[place];
    bodies_.comm().together([&] { state.theta = theta; });
    if (state.v == nullptr) state.v = bodies_.vector();
    check(VecCopy(v, state.v));
}

std::vector<double> KeptStates::combine(std::span<const double> weights, Vec v) const {
    std::vector<double> theta(bodies_.patterns(), 0.0);
    check(VecSet(v, 0.0));
    for (std::size_t s = 0; s < count; ++s) {
        if (weights[s] == 0.0) continue;
        if (states_[s].v == nullptr) fail(DELAM_ERROR_STATE, "place ", s, " holds no answer");
        check(VecAXPY(v, weights[s], states_[s].v));
        for (std::size_t p = 0; p < theta.size(); ++p) theta[p] += weights[s] * states_[s].theta[p];
    }
    return theta;
}

std::vector<double> KeptStates::products(Vec force, std::span<const double> lifted) const {
    std::vector<double> products(count, 0.0);
    for (std::size_t s = 0; s < count; ++s) {
        if (states_[s].v == nullptr) continue;
        check(VecDot(states_[s].v, force, &products[s]));
        for (std::size_t p = 0; p < lifted.size(); ++p) products[s] += states_[s].theta[p] * lifted[p];
    }
    return products;
}

}  // namespace delam::petsc
