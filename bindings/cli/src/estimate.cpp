// SPDX-License-Identifier: BSD-3-Clause
#include "estimate.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "delam/delam.h"
#include "number.hpp"
#include "rows.hpp"

namespace cli {

namespace {

constexpr std::string_view option_key = "backtracking_tolerance";

}  // namespace

double estimate_tolerance(const Scene& scene) {
    for (const SolverOption& option : scene.options)
        if (option.key == option_key)
            if (const auto* number = std::get_if<double>(&option.value)) return *number;
    for (std::int64_t i = 0; i < delam_option_count(); ++i) {
        const char* key = "";
        const char* initial = "";
        delam_option_info(i, &key, nullptr, nullptr, &initial, nullptr, nullptr);
        if (key == option_key) return number_in(initial);
    }
    return 0.0;
}

std::vector<std::int64_t> violated_steps(std::string_view history, double eta) {
    std::vector<std::int64_t> out;
    std::vector<std::map<std::string, double>> rows = rows_of(history);
    // Row 0 is the initial state, which is not the result of a step.
    for (std::size_t i = 1; i < rows.size(); ++i) {
        std::map<std::string, double>& of = rows[i];
        // The potential of dead loads is part of the stored energy; without dead loads there is no such column, and it
        // is 0.
        const double stored = of["stored_bulk"] + of["stored_interface"] + of["load_potential"];
        const double slack = eta * std::max(std::abs(stored), std::abs(of["work"]));
        // Negated, so that NaN counts as violated.
        if (!(of["lower"] - of["increment_lower"] <= slack && of["increment"] - of["upper"] <= slack))
            out.push_back(static_cast<std::int64_t>(of["step"]));
    }
    return out;
}

std::string estimate_line(const std::vector<std::int64_t>& steps, double eta) {
    if (steps.empty()) return "";
    return fmt::format("two-sided estimate violated in steps: {} (tolerance eta = {:g})\n", fmt::join(steps, ", "),
                       eta);
}

}  // namespace cli
