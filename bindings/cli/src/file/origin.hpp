// SPDX-License-Identifier: BSD-3-Clause
// running/origin.json: when a run began and how often it was resumed. These are no part of state.bin, so that two runs
// of a scene write the same one.
#pragma once

#include <cstdint>
#include <string>

namespace cli {

struct Origin {
    std::string started;       // as now_text(); "": unknown
    std::int64_t resumed = 0;  // number of times
};

std::string packed(const Origin& origin);
// Nothing is known from a file that is missing or damaged: it only tells a history.
Origin read_origin(const std::string& path);

}  // namespace cli
