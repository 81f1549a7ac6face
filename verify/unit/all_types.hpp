// SPDX-License-Identifier: BSD-3-Clause
// Every cell type of the library, so that tests over all types meet a new one by themselves.
#pragma once

#include "mesh/cell_type.hpp"

inline constexpr auto all_types = [] {
    std::array<delam::CellType, delam::cell_rows.size()> types{};
    for (std::size_t i = 0; i < types.size(); ++i) types[i] = delam::cell_rows[i].type;
    return types;
}();
