// SPDX-License-Identifier: BSD-3-Clause
// The ledger of an analysis: stored + dissipated + released energy against the work, from the rows of history.csv.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "result/history/rows.hpp"
#include "scene/scene.hpp"

namespace cli {

struct Balance {
    std::int64_t step = 0;  // in which the ledger is off most
    double time = 0;
    double defect = 0;       // there: what is stored, dissipated and released since the start, less the work
    double work = 0;         // the largest of the analysis
    double last_defect = 0;  // at the end
    // Sums at the end, since the start; stored: with the potential of dead forces.
    double last_work = 0, stored = 0, dissipated = 0, released = 0;
    // The largest defect over the largest work; 0 if there is neither.
    [[nodiscard]] double relative() const;
    // The same over the dissipated energy, in an analysis without damage over the work.
    [[nodiscard]] double open() const;
};

// slides: the ledger of mixity_rule = variational, the columns that end in _slides.
Balance balance_of(const Rows& rows, bool slides);
std::string balance_line(const Balance& balance, const Scene& scene);
// The same where work, stored, dissipated and released energy do not know of each other, because steps follow their
// load. What single pairs released that popped is told apart from what jumps did.
struct JumpSum {
    std::size_t count = 0;
    double released = 0;  // by all of them
};
std::string energies_line(const Balance& balance, const JumpSum& jumps, const Scene& scene);

}  // namespace cli
