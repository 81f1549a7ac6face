// SPDX-License-Identifier: BSD-3-Clause
// The preconditioner of the reanalysis: patches, the whole, patches (multiplicative Schwarz, symmetric; B. Smith, P.
// Bjorstad, W. Gropp, Domain Decomposition, 1996), orthogonal to motions that nothing holds.
#pragma once

#include <span>
#include <vector>

#include "reduction/sparse/iterated/lagged_factor.hpp"
#include "reduction/sparse/iterated/patches.hpp"
#include "reduction/sparse/jump_system.hpp"

namespace delam {

class Schwarz {
public:
    // All three must outlive it.
    Schwarz(const JumpSystem& system, const Patches& patches, const LaggedFactor& factor)
        : system_(system), patches_(patches), factor_(factor) {}

    // Sets the motions, in variables, that nothing holds from now on: null vectors of the system.
    void set_free(std::vector<std::vector<double>> motions);
    bool any_free() const { return !null_.empty(); }
    // Removes the free motions from a vector of the reduced space.
    void project(std::span<double> x) const;
    // z = M r
    void apply(std::span<const double> r, std::span<double> z);

private:
    void subtract_image(std::span<const double> r);

    const JumpSystem& system_;
    const Patches& patches_;
    const LaggedFactor& factor_;
    std::vector<std::vector<double>> null_;  // free motions in the reduced space, orthonormal
    std::vector<double> work_, image_;
};

}  // namespace delam
