// SPDX-License-Identifier: BSD-3-Clause
// The mixities of all pairs.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "law/mixity.hpp"

namespace delam {

struct PairMixities {
    std::vector<double> shear;   // [pairs] B
    std::vector<double> second;  // [pairs] S; empty: 0 everywhere, no law has two toughnesses in shear

    PairMixities() = default;
    PairMixities(std::vector<double> b, std::vector<double> s = {}) : shear(std::move(b)), second(std::move(s)) {}
    bool operator==(const PairMixities&) const = default;

    std::size_t size() const { return shear.size(); }
    Mixity operator[](std::size_t pair) const { return {shear[pair], second.empty() ? 0.0 : second[pair]}; }
    void set(std::size_t pair, const Mixity& mixity) {
        shear[pair] = mixity.shear;
        if (second.empty() && mixity.second != 0.0) second.assign(shear.size(), 0.0);
        if (!second.empty()) second[pair] = mixity.second;
    }
};

}  // namespace delam
