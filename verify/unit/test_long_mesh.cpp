// SPDX-License-Identifier: BSD-3-Clause
// Partitions of every cell type into each number of parts up to 64, each computed twice.

#include "check.hpp"
#include "partitions.hpp"

LOOP_TEST(partitions, 0, all_types.size()) {
    const auto always = [](std::int64_t) { return true; };
    unit::check_partitions(all_types[static_cast<std::size_t>(loop)], always, always);
}
