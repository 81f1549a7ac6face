// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/minimise/energy_fall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "evolution/increment/increment.hpp"
#include "evolution/increment/step_account.hpp"
#include "linalg/dense/dense.hpp"

namespace delam {

namespace {

// Amplitudes are the size of the scene over powers of two: from rounding, where a thin strip has hardly begun to move,
// to all of it. A fall is known within a factor of two of its amplitude, which is enough to begin from. (Half and twice
// give the same digits of examples/blister and pass verify/cases/test_buckling.)
constexpr int halvings = 26;
// Falls that differ by less than this share of the deeper one count as alike, and faces that pass through each other by
// less than this share of their motion as faces that do not. Symmetric scenes leave 1e-9; half and twice decide alike
// unless a scene is nearly symmetric.
constexpr double alike = 1e-3;

// The energy of a state, at its adhesion, along a line of displacements.
class Line {
public:
    Line(const TurnedOperator& op, const PairLaws& pairs, const State& state, std::span<const double> from,
         std::span<const double> direction)
        : op_(op), pairs_(pairs), from_(from), direction_(direction), probe_(state) {}

    // Infinite where a cell is inside out.
    double energy(double amplitude) {
        std::vector<double> place(from_.begin(), from_.end());
        add_scaled(amplitude, direction_, place);
        try {
            op_.complete(probe_.theta, std::move(place), probe_.response);
        } catch (const Error& error) {
            if (error.status() != DELAM_LIMIT) throw;
            return std::numeric_limits<double>::infinity();
        }
        record_energies(pairs_, probe_);
        return probe_.ledger.energy();
    }
    // Returns that of the last energy().
    const Response& response() const { return probe_.response; }

private:
    const TurnedOperator& op_;
    const PairLaws& pairs_;
    std::span<const double> from_, direction_;
    State probe_;
};

// Tells how far faces have moved on a way, and pass through each other then: sums over the pairs, L. (Gaps that are
// rounding close in one of two directions, too, whether a state calls them closed or not.)
struct Passing {
    double moved = 0.0, through = 0.0;
};

Passing passing(const Response& before, const Response& after, std::size_t pairs) {
    Passing sum;
    for (std::size_t p = 0; p < pairs; ++p) {
        const std::size_t row = p * (before.jump.size() / pairs);
        sum.moved += std::abs(after.jump[row] - before.jump[row]);
        sum.through += std::max(0.0, -after.jump[row]);
    }
    return sum;
}

// The lowest state in one direction; without displacements the energy does not fall there by more than its rounding.
struct Found {
    EnergyFall fall;
    Passing passing;
};

Found lowest(Line& line, const State& state, double sign, double size, double rounding) {
    const double level = state.ledger.energy();
    Found best{{{}, level - rounding * std::abs(level), false}, {}};
    for (int n = halvings; n >= 0; --n) {
        const double energy = line.energy(sign * std::ldexp(size, -n));
        if (energy < best.fall.energy) {
            best.fall.displacement = line.response().multipliers;
            best.fall.energy = energy;
            best.passing = passing(state.response, line.response(), state.closed.size());
        } else if (!best.fall.displacement.empty() || !std::isfinite(energy)) {
            break;
        }
    }
    best.fall.penetrates = best.passing.through > alike * best.passing.moved;
    return best;
}

// True if the second one is where the bodies go.
bool prefers_second(const Found& first, const Found& second, double level) {
    if (first.fall.displacement.empty() || second.fall.displacement.empty()) return first.fall.displacement.empty();
    const double a = first.passing.through, b = second.passing.through;
    if (std::abs(a - b) > alike * std::max(first.passing.moved, second.passing.moved)) return b < a;
    return level - second.fall.energy > (1.0 + alike) * (level - first.fall.energy);
}

}  // namespace

std::optional<EnergyFall> energy_fall(const TurnedOperator& op, const PairLaws& pairs, const State& state,
                                      std::span<const double> mode) {
    Line line(op, pairs, state, state.response.multipliers, mode);
    const double size = scene_size(*op.problem().mesh);
    const double rounding = op.problem().options.limits.minimise_energy_rounding;
    Found along = lowest(line, state, 1.0, size, rounding), against = lowest(line, state, -1.0, size, rounding);
    if (prefers_second(along, against, state.ledger.energy())) along = std::move(against);
    if (along.fall.displacement.empty()) return std::nullopt;
    return std::move(along.fall);
}

double lowest_share(const TurnedOperator& op, const PairLaws& pairs, const State& state,
                    std::span<const double> displacement, std::span<const double> move) {
    Line line(op, pairs, state, displacement, move);
    const double level = line.energy(0.0);
    double share = 1.0, shorter = line.energy(0.5), at = line.energy(1.0), longer = line.energy(2.0);
    for (int n = 0; n < halvings && at < level && longer < at; ++n) {
        share *= 2.0;
        shorter = std::exchange(at, longer);
        longer = line.energy(2.0 * share);
    }
    for (int n = 0; n < halvings && !(at < level && at <= shorter); ++n) {
        share *= 0.5;
        longer = std::exchange(at, shorter);
        shorter = line.energy(0.5 * share);
    }
    if (!(at < level) || !std::isfinite(longer)) return share;
    // The lowest point of the parabola through share / 2, share and 2 share.
    const double up = (longer - at) / share, down = (at - shorter) / (0.5 * share);
    const double curvature = (up - down) / (0.75 * share), slope = (0.5 * up + down) / 1.5;
    if (!(curvature > 0.0)) return share;
    return std::clamp(share - slope / curvature, 0.5 * share, 2.0 * share);
}

}  // namespace delam
