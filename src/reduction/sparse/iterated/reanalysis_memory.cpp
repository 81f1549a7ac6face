// SPDX-License-Identifier: BSD-3-Clause
// Data of the reanalysis in a saved state: the springs of the whole factor and the choice of the patches.
#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "reduction/sparse/iterated/reanalysis.hpp"

namespace delam {

namespace {

constexpr std::size_t numbers = 3;  // between the springs and the seeds

}  // namespace

// Springs of the whole factor [rows], the operations that a new one would have saved, the rounding of a residual, the
// iterations of its first solve, then the seeds of the patches.
std::vector<double> Reanalysis::memory() {
    remembered_ = !lagged_.empty();
    return history();
}

std::vector<double> Reanalysis::history() const {
    std::vector<double> m = lagged_;
    if (m.empty()) return m;
    m.push_back(renewal_.excess());
    m.push_back(rounded_);
    m.push_back(renewal_.first());
    for (const std::int64_t i : patches_.seeds()) m.push_back(static_cast<double>(i));
    return m;
}

void Reanalysis::require_memory(std::span<const double> memory) const {
    if (memory.empty()) return;
    const auto damaged = [](bool yes) {
        if (yes) fail(DELAM_ERROR_SNAPSHOT, "snapshot holds springs or patches that the iterated operator cannot have");
    };
    const std::size_t rows = system_.rows().size();
    damaged(memory.size() < rows + numbers);
    for (std::size_t i = 0; i < rows; ++i) damaged(!(memory[i] >= 0.0 && std::isfinite(memory[i])));
    damaged(!(memory[rows + 1] >= 0.0 && memory[rows + 1] < 1.0));
    damaged(!renewal_.allows(memory[rows], memory[rows + 2]));
    for (std::size_t i = rows + numbers; i < memory.size(); ++i)
        damaged(!(memory[i] >= 0.0 && memory[i] < static_cast<double>(system_.count())) ||
                memory[i] != std::floor(memory[i]) || (i > rows + numbers && !(memory[i] > memory[i - 1])));
}

void Reanalysis::recall(std::span<const double> memory) {
    if (std::ranges::equal(memory, history())) return;
    if (memory.empty()) {
        swap_factor_out();
        lagged_.clear();
        patches_.forget();
        renewal_.renewed();
        rounded_ = 0.0;
        return;
    }
    require_memory(memory);
    const std::size_t rows = system_.rows().size();
    std::vector<double> springs(memory.begin(), memory.begin() + static_cast<std::ptrdiff_t>(rows));
    for (double& s : springs) s += 0.0;  // negative zero would be saved with its sign
    std::vector<std::int64_t> seeds;
    for (std::size_t i = rows + numbers; i < memory.size(); ++i) seeds.push_back(static_cast<std::int64_t>(memory[i]));
    if (springs != lagged_ && springs == other_springs_) {
        patches_.forget();
        other_factor_.swap(whole_);
        lagged_.swap(other_springs_);
    } else if (springs != lagged_) {
        renew(std::move(springs));
    }
    remembered_ = true;
    patches_.forget();
    patches_.cover(seeds, true, [this] { monitor_.progress("patch", 0, 0); });
    renewal_.restore(memory[rows], memory[rows + 2]);
    rounded_ = memory[rows + 1] + 0.0;
}

}  // namespace delam
