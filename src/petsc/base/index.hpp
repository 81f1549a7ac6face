// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace delam::petsc {

// An index that is known not to be negative. (This library sees nothing of the core but its public headers.)
template <class Integer>
constexpr std::size_t at(Integer i) noexcept {
    return static_cast<std::size_t>(i);
}

}  // namespace delam::petsc
