// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "petsc/bodies/bodies.hpp"

namespace delam::petsc {

// The answers that the engine keeps, in places that rank 0 chooses, and combinations of them. All calls are collective,
// with the same arguments on all ranks.
class KeptStates {
public:
    static constexpr std::size_t count = 8;

    explicit KeptStates(const Bodies& bodies) : bodies_(bodies) {}

    void keep(std::size_t place, Vec v, const std::vector<double>& theta);
    void forget(std::size_t place) { states_[place] = {}; }
    // v = sum of weights times the kept vectors; returns the same of their theta.
    std::vector<double> combine(std::span<const double> weights, Vec v) const;
    // u.K u_s for each place s, from T^T K u and U_p.(K u).
    std::vector<double> products(Vec force, std::span<const double> lifted) const;

private:
    struct State {
        OwnedVec v;
        std::vector<double> theta;
    };

    const Bodies& bodies_;
    std::array<State, count> states_;
};

}  // namespace delam::petsc
