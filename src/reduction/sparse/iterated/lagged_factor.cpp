// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/iterated/lagged_factor.hpp"

#include <algorithm>
#include <utility>

#include "reduction/sparse/spring_entries.hpp"

namespace delam {

LaggedFactor::LaggedFactor(JumpSystem& system, bool comes_back, Monitor& monitor)
    : system_(system), monitor_(monitor), comes_back_(comes_back) {
    monitor_.progress("analyse", 0, 0);
    whole_ = std::make_unique<WholeFactor>(system_, [this] { monitor_.progress("analyse", 0, 0); });
}

void LaggedFactor::leave() {
    if (comes_back_ && remembered_ && !springs_.empty()) {
        if (other_ == nullptr)
            other_ = std::make_unique<WholeFactor>(system_, [this] { monitor_.progress("analyse", 0, 0); });
        other_.swap(whole_);
        other_springs_ = std::move(springs_);
        remembered_ = false;
    }
    springs_.clear();
}

// An interrupted factorisation is never taken for a valid one.
void LaggedFactor::factorise(std::vector<double> springs) {
    springs_.clear();
    monitor_.progress("factor", factorisations_, 0);
    std::vector<Zone::Coupling> acting;
    for (std::size_t r = 0; r < springs.size(); ++r)
        if (springs[r] != 0.0)
            acting.push_back({static_cast<std::int64_t>(r), static_cast<std::int64_t>(r), springs[r]});
    ++factorisations_;
    whole_->factorise(spring_entries(system_, acting, std::vector<std::uint8_t>(springs.size(), 0)),
                      [this] { monitor_.progress("factor", factorisations_, 0); });
    springs_ = std::move(springs);
    remembered_ = false;
}

bool LaggedFactor::come_back(std::span<const double> springs) {
    if (!std::ranges::equal(springs, other_springs_)) return false;
    other_.swap(whole_);
    springs_.swap(other_springs_);
    return true;
}

}  // namespace delam
