// SPDX-License-Identifier: BSD-3-Clause
#include "deck/deck_instants.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "text/toml_text.hpp"

namespace cli::abaqus {

namespace {

constexpr double most_increments = 100000;
// The default of smallest_step (src/scene/options.inc): a shorter least increment sets no limit. Half and twice of it
// is one halving more or less (ctest -R cli_decks).
constexpr double default_substep = 1e-4;

}  // namespace

void Instants::add(const Step& step, double begin) {
    const double wanted = std::ceil(step.period / step.increment * (1 - 1e-9));
    if (!(wanted + static_cast<double>(instants_.size()) <= most_increments))
        throw SceneFailure(step.place, fmt::format("{:.6g} increments of {}: at most {} in all steps", wanted,
                                                   step.increment, most_increments));
    const auto increments = static_cast<std::int64_t>(wanted);
    for (std::int64_t i = 1; i <= increments; ++i)
        instants_.push_back(begin + (i == increments
                                         ? step.period
                                         : step.period * static_cast<double>(i) / static_cast<double>(increments)));
    sizes_.push_back(step.period / static_cast<double>(increments));
    if (step.least_increment > default_substep * sizes_.back())
        substep_ = std::min(substep_, step.least_increment / sizes_.back());
}

std::string Instants::text(double end, const std::string& solver_keys) const {
    std::string solver = solver_keys;
    if (substep_ < 1) solver += fmt::format("smallest_step = {}\n", toml_number(substep_));
    if (!solver.empty()) solver = "[solver]\n" + solver + "\n";
    const auto [least, most] = std::minmax_element(sizes_.begin(), sizes_.end());
    if (*most - *least <= 1e-9 * *most)
        return fmt::format("[time]\nstart = 0.0\nend = {}\nsteps = {}\n\n", toml_number(end), instants_.size()) +
               solver;
    std::vector<double> all{0.0};
    all.insert(all.end(), instants_.begin(), instants_.end());
    return fmt::format("[time]\ninstants = {}\n\n", toml_list(all)) + solver;
}

}  // namespace cli::abaqus
