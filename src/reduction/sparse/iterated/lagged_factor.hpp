// SPDX-License-Identifier: BSD-3-Clause
// The factor of the whole, with the springs of the earlier moment at which it was made. A search solves other states
// and comes back: the factor of the state that it leaves is then kept beside the one in use.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "reduction/sparse/iterated/whole_factor.hpp"
#include "reduction/sparse/jump_system.hpp"

namespace delam {

class LaggedFactor {
public:
    // comes_back: keeps two factors.
    LaggedFactor(JumpSystem& system, bool comes_back, Monitor& monitor);

    // Returns the analysis of the whole, and its factor, where there is one.
    const WholeFactor& whole() const { return *whole_; }
    // Returns the springs of the factor, [rows]; held ones as springs. Empty: there is no factor.
    const std::vector<double>& springs() const { return springs_; }
    bool empty() const { return springs_.empty(); }
    std::int64_t factorisations() const { return factorisations_; }

    // Has no factor from now on. Keeps the present one for come_back(), if a saved state knows it.
    void leave();
    void factorise(std::vector<double> springs);
    // Notes that a saved state knows the present factor.
    void remember() { remembered_ = !springs_.empty(); }
    // Takes the factor that was left, if it has these springs. False: it has not.
    bool come_back(std::span<const double> springs);

private:
    JumpSystem& system_;
    Monitor& monitor_;
    bool comes_back_;
    bool remembered_ = false;  // a saved state knows the factor in use
    std::unique_ptr<WholeFactor> whole_, other_;
    std::vector<double> springs_, other_springs_;  // [rows]; empty: there is none
    std::int64_t factorisations_ = 0;
};

}  // namespace delam
