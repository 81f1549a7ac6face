// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/growth_events.hpp"

#include <algorithm>
#include <cmath>

#include "evolution/minimise/proportional_loads.hpp"

namespace delam {

namespace {

// The scenes of a film that comes off tell: with 0.003 and 0.01 one jump is cut into several, with 0.03 and 0.1 it is
// one. Growth that beam theory calls stable needs 1 to 4. (Measured by verify/bench/constants.py with
// verify/cases/load_path/steps.py --all: half and twice keep one jump and move its load by 1.5 and 1.8 %. In 10 to 300
// steps, that load spreads by 0.3, 1.6 and 3.4 % with half of the number, with it and with twice of it. Half of it
// keeps the pops of examples/mmb from being told in 20 steps: 1.8 % of the dissipated energy stays open, after 3983
// iterations instead of 1658.)
constexpr double eps = 0.03;
// With few pairs, this part of an interface may come apart in one event. (Half and twice change no digit there.)
constexpr double of_an_interface = 0.5;

// Where nothing is left between fronts, so many pairs of each are a jump: the last ligament snaps however fine the mesh
// is. (Measured on a DCB with two notches: half changes nothing; with twice, a ligament of ten coarse pairs, of which
// four are left to dissipate, is told as pops.)
constexpr double pairs_of_last = 1.0;

bool flat(double rise, const Advance& advance) {
    return advance.area > 0.0 && rise <= eps * advance.area / advance.whole;
}

}  // namespace

bool flat(const GrowthPart& part) { return flat(part.rise, part.advance); }

bool single_pairs(const Advance& advance) {
    const double pairs = advance.met ? pairs_of_last : pairs_of_jump;
    return advance.area <= std::min(pairs * advance.row, of_an_interface * advance.whole);
}

void GrowthEvents::add(const GrowthPart& part, const State& before, const State& after) {
    const double released = after.ledger.released - before.ledger.released;
    if (part.pops && !flat(part) && released > 0.0) {
        pops += std::max<std::int64_t>(1, std::llround(part.advance.area / part.advance.row));
        popped += released;
    }
    Advance together = whole_.advance;
    together.area += part.advance.area;
    together.row = std::max(together.row, part.advance.row);
    together.whole = std::max(together.whole, part.advance.whole);
    together.met = part.advance.met;
    const bool goes_on = open_ && part.advance.area > 0.0 && flat(whole_.rise + part.rise, together);
    if (open_ && !goes_on) end();
    if (!open_ && flat(part)) {
        open_ = true;
        whole_ = {};
        together = part.advance;
        begin_ = before;
        begin_.time = part.start;
        // The conjugates grow with the load at fixed damage, up to that at which the state jumps.
        if (const std::optional<double> a = load_ratio(before.theta, after.theta))
            for (double& q : begin_.response.conjugate) q /= *a;
    }
    if (!open_) return;
    whole_.advance = together;
    whole_.rise += part.rise;
    end_ = after;
}

void GrowthEvents::end() {
    if (!open_) return;
    open_ = false;
    if (single_pairs(whole_.advance)) {
        pops += std::max<std::int64_t>(1, std::llround(whole_.advance.area / whole_.advance.row));
        popped += end_.ledger.released - begin_.ledger.released;
        return;
    }
    jumps.push_back(describe_jump(pairs_, graph_, begin_, end_));
}

}  // namespace delam
