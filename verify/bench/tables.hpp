// SPDX-License-Identifier: BSD-3-Clause
// The tables of delam_bench: each measures, prints text on standard output, and returns everything as JSON.
#pragma once

#include <string>
#include <vector>

#include "stats.hpp"

namespace bench {

struct Settings {
    bool quick = false;
    int repeat = 0;                     // 0: the table's own choice
    double cap = 0.0;                   // s; 0: the table's own choice
    std::vector<std::string> scenes;    // empty: the table's own
    std::vector<int> threads;           // empty: 1 and 2
    std::vector<std::string> settings;  // KEY=VALUE for scene files
    std::vector<std::string> sizes;     // KEY=VALUE, one for each size of a scene file
};

Json analysis_table(const Settings& settings);
Json precision_table(const Settings& settings);
Json methods_table(const Settings& settings);
Json growth_table(const Settings& settings);
Json energetic_table(const Settings& settings);
#ifdef DELAM_SCENE_FILES
Json scene_file_table(const Settings& settings);
Json size_table(const Settings& settings);
Json side_by_side_table(const Settings& settings);
#endif

}  // namespace bench
