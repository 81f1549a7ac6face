// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/step/zone_newton.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "evolution/increment/extrapolation.hpp"
#include "reduction/zone/zone.hpp"

namespace delam {

namespace {

constexpr double noise = 1e-11;  // of the largest jump or force in the zone: rounding
// Of the terms of the zone's energy: what it changes by when the jumps of one state are found from all bodies or within
// the zone. A plain step never adds energy, but on a stiff interface an avalanche begins with steps that free less than
// this. Rises cannot add up: the caller compares the energy of the whole before and after.
constexpr double energy_noise = 1e-11;
constexpr std::int64_t longest_wait = 8;    // plain steps between two attempts of what has failed
constexpr std::int64_t contact_steps = 30;  // active-set steps of one Newton step; beyond them the step is not taken
// A pair joins the zone when its driving energy is above this part of what damages it.
constexpr double nearly_loaded = 0.7;

double largest(std::span<const double> values) {
    double m = 0.0;
    for (const double v : values) m = std::max(m, std::abs(v));
    return m;
}

// Pairs of the zone with all their rows; rows of other pairs have constant springs.
struct ZonePair {
    std::size_t pair;
    std::size_t first;  // row of the zone: normal, then tangents
};

// What failed is tried again after 1, 2, 4, 8, 8 ... steps.
class Patience {
public:
    bool try_now() {
        if (wait_ == 0) return true;
        --wait_;
        return false;
    }
    bool report(bool success) {
        next_ = success ? 1 : std::min(2 * next_, longest_wait);
        wait_ = success ? 0 : next_;
        return success;
    }

private:
    std::int64_t next_ = 1;
    std::int64_t wait_ = 0;
};

class Leap {
public:
    Leap(const ZoneNewton& newton, State& state, StepMixity& mixity, std::span<const double> adhesion_old,
         const Springs& springs_, Zone& zone)
        : newton_(newton),
          state_(state),
          mixity_(mixity),
          toughness_(mixity.toughness()),
          old_(adhesion_old),
          dim_(static_cast<std::size_t>(newton.pairs.dimension)),
          zone_(zone) {
        const std::vector<std::int64_t>& rows = zone_.jump_rows();
        const std::span<const std::uint8_t> prescribed = newton_.op.prescribed_rows();
        held_.resize(rows.size());
        spring_.assign(rows.size(), 0.0);
        normal_.assign(rows.size(), 0);
        for (std::size_t z = 0; z < rows.size(); ++z) {
            const auto row = static_cast<std::size_t>(rows[z]);
            const bool given = prescribed[row] != 0;  // by the device: neither held nor let go
            held_[z] = given ? 0 : springs_.held[row];
            spring_[z] = springs_.stiffness[row];
            normal_[z] = row % dim_ == 0 && newton_.contact.bonded[row / dim_] == 0 && !given ? 1 : 0;
        }
        for (std::size_t z = 0; z + dim_ <= rows.size(); ++z) {
            const auto row = static_cast<std::size_t>(rows[z]);
            if (row % dim_ != 0 || static_cast<std::size_t>(rows[z + dim_ - 1]) != row + dim_ - 1) continue;
            const std::size_t pair = row / dim_;
            if (newton_.pairs.law[pair] == nullptr || old_[pair] <= 0.0) continue;
            members_.push_back({pair, z});
            for (std::size_t c = 0; c < dim_; ++c) spring_[z + c] = 0.0;
        }
    }

    // Returns the energy that new mixities alone have added.
    double run();

private:
    // Where an iterate stands: jumps of all zone rows, energy, adhesion of the members.
    struct Point {
        std::vector<double> unknowns;
        std::vector<double> jump;
        std::vector<double> adhesion;
        double energy = 0.0;
        double size = 0.0;  // of the terms that the energy is the sum of
    };

    Point point(std::vector<double> unknowns) const;
    // Model about a point: tangents of the members scaled between secant (0) and full (1), with one of them debonded
    // (or none: -1).
    bool model(const Point& at, std::span<const double> adhesion, double fraction, std::int64_t debonded);
    // Minimiser of the model under contact; false: indefinite, or the contact set did not settle.
    bool minimise(const Point& at, std::span<const double> adhesion, double fraction, std::int64_t debonded,
                  Point& out);
    // The point between `at` and `to` on which the energy falls; false: none.
    bool descend(const Point& at, Point& to) const;
    std::int64_t weakest(const Point& at) const;
    // The point shows its mixities: those of members that took part in its displacements, adhesion `carried` > 0. True:
    // the toughness in use, and with it energy and adhesions of the point, have changed.
    bool look(Point& at, std::span<const double> carried);
    bool curved(const ZonePair& m) const {
        return mixity_.rule() == MixityRule::variational && newton_.pairs.mixed(m.pair);
    }
    std::array<double, 9> tangent(const ZonePair& m, const Point& at, double zeta, double fraction) const;

    const ZoneNewton& newton_;
    State& state_;
    StepMixity& mixity_;
    std::span<const Toughness> toughness_;
    double added_ = 0.0;
    std::span<const double> old_;
    std::size_t dim_;
    Zone& zone_;
    std::vector<std::uint8_t> held_;
    std::vector<std::uint8_t> normal_;
    std::vector<double> spring_;  // of rows that belong to no member
    std::vector<ZonePair> members_;
    std::vector<Zone::Coupling> couplings_;
    std::vector<double> row_force_;
};

Leap::Point Leap::point(std::vector<double> unknowns) const {
    Point at;
    at.jump = zone_.jumps(state_.theta, unknowns);
    at.energy = zone_.energy_of(state_.theta, unknowns);
    at.size = std::abs(at.energy);
    const auto add = [&](double term) {
        at.energy += term;
        at.size += std::abs(term);
    };
    for (std::size_t z = 0; z < spring_.size(); ++z) add(0.5 * spring_[z] * at.jump[z] * at.jump[z]);
    at.unknowns = std::move(unknowns);
    for (const ZonePair& m : members_) {
        const std::span<const double> local = std::span<const double>(at.jump).subspan(m.first, dim_);
        if (curved(m)) {
            const VariationalPair pair = mixity_.variational(m.pair);
            at.adhesion.push_back(pair.minimiser(local, old_[m.pair]));
            add(newton_.pairs.weight[m.pair] * pair.energy(local, at.adhesion.back()));
            continue;
        }
        const Law& law = *newton_.pairs.law[m.pair];
        const double driving = driving_energy(law, local).total();
        const double zeta = law.minimiser(toughness_[m.pair], driving, old_[m.pair]);
        at.adhesion.push_back(zeta);
        add(newton_.pairs.weight[m.pair] * (zeta * driving + law.dissipated(toughness_[m.pair], zeta)));
    }
    return at;
}

// Tangents C, and the force h = C j - w zeta K j of their affine part.
bool Leap::model(const Point& at, std::span<const double> adhesion, double fraction, std::int64_t debonded) {
    couplings_.clear();
    row_force_.assign(spring_.size(), 0.0);
    const auto add = [&](std::size_t r, std::size_t q, double value) {
        couplings_.push_back({static_cast<std::int64_t>(r), static_cast<std::int64_t>(q), value});
    };
    for (std::size_t z = 0; z < spring_.size(); ++z)
        if (spring_[z] > 0.0) add(z, z, spring_[z]);
    for (std::size_t i = 0; i < members_.size(); ++i) {
        if (static_cast<std::int64_t>(i) == debonded) continue;
        const ZonePair& m = members_[i];
        if (curved(m)) {
            // The force of the model is C j - h, that of the pair at its own jump j.
            const std::span<const double> local = std::span<const double>(at.jump).subspan(m.first, dim_);
            const VariationalPair pair = mixity_.variational(m.pair);
            const double weight = newton_.pairs.weight[m.pair];
            std::array<double, 9> c{};
            if (fraction > 0.0) {
                c = pair.tangent(local, old_[m.pair]);
            } else {
                const Law& law = *newton_.pairs.law[m.pair];
                const double scale = adhesion[i] + pair.proximal(local, adhesion[i]);
                for (std::size_t r = 0; r < dim_; ++r)
                    c[r * dim_ + r] = scale * (r == 0 ? law.normal_stiffness : law.tangential_stiffness);
            }
            const std::array<double, 3> force = pair.force(local, adhesion[i]);
            for (std::size_t r = 0; r < dim_; ++r) {
                row_force_[m.first + r] -= weight * force[r];
                for (std::size_t q = 0; q < dim_; ++q) {
                    if (c[r * dim_ + q] == 0.0) continue;
                    add(m.first + r, m.first + q, weight * c[r * dim_ + q]);
                    row_force_[m.first + r] += weight * c[r * dim_ + q] * local[q];
                }
            }
            continue;
        }
        const std::array<double, 9> full = tangent(m, at, adhesion[i], fraction),
                                    secant = tangent(m, at, adhesion[i], 0.0);
        for (std::size_t r = 0; r < dim_; ++r)
            for (std::size_t q = 0; q < dim_; ++q) {
                if (full[r * dim_ + q] == 0.0) continue;
                add(m.first + r, m.first + q, full[r * dim_ + q]);
                row_force_[m.first + r] += (full[r * dim_ + q] - secant[r * dim_ + q]) * at.jump[m.first + q];
            }
    }
    return zone_.factor(couplings_, held_);
}

bool Leap::minimise(const Point& at, std::span<const double> adhesion, double fraction, std::int64_t debonded,
                    Point& out) {
    const std::vector<std::uint8_t> before = held_;
    for (std::int64_t step = 0; step < contact_steps; ++step) {
        newton_.monitor.progress("minimise", state_.counts.am_iterations, 0);
        ++state_.counts.newton_solves;
        if (!model(at, adhesion, fraction, debonded)) break;
        const Zone::Solution solution = zone_.solve(state_.theta, row_force_);
        if (!solution.balanced) break;
        const std::vector<double> jump = zone_.jumps(state_.theta, solution.unknowns);
        std::vector<double> force(jump.size());
        for (std::size_t z = 0; z < force.size(); ++z) force[z] = -row_force_[z];
        for (const Zone::Coupling& c : couplings_)
            force[static_cast<std::size_t>(c.row)] += c.value * jump[static_cast<std::size_t>(c.column)];
        zone_.complete_forces(state_.theta, solution, force);
        const double jump_scale = noise * std::max(largest(jump), newton_.contact.jump_floor(state_.theta));
        const double force_scale = noise * std::max(largest(force), newton_.contact.force_floor(state_.theta));
        bool settled = true;
        for (std::size_t z = 0; z < held_.size(); ++z) {
            if (normal_[z] == 0) continue;
            if (held_[z] != 0 ? force[z] > force_scale : jump[z] < -jump_scale) {
                held_[z] ^= 1;
                settled = false;
            }
        }
        if (!settled) continue;
        out = point(solution.unknowns);
        return true;
    }
    held_ = before;
    return false;
}

bool Leap::descend(const Point& at, Point& to) const {
    const double rounding = 1e-14 * (std::abs(at.energy) + std::abs(to.energy));
    for (int halvings = 0; halvings < 7; ++halvings) {
        if (halvings > 0) {
            std::vector<double> between(at.unknowns.size());
            for (std::size_t i = 0; i < between.size(); ++i)
                between[i] = at.unknowns[i] + 0.5 * (to.unknowns[i] - at.unknowns[i]);
            to = point(std::move(between));
        }
        if (to.energy <= at.energy + rounding) return true;
    }
    return false;
}

// w [zeta K + zeta'(Y) (K j)(K j)^T] of a member, with slope for zeta'; row-major.
std::array<double, 9> Leap::tangent(const ZonePair& m, const Point& at, double zeta, double fraction) const {
    const Law& law = *newton_.pairs.law[m.pair];
    const double weight = newton_.pairs.weight[m.pair];
    double pull[3] = {law.normal_stiffness * std::max(0.0, at.jump[m.first]), 0.0, 0.0};
    for (std::size_t c = 1; c < dim_; ++c) pull[c] = law.tangential_stiffness * at.jump[m.first + c];
    const double driving = driving_energy(law, std::span<const double>(at.jump).subspan(m.first, dim_)).total();
    const double slope = fraction > 0.0 ? fraction * law.slope(toughness_[m.pair], driving, old_[m.pair]) : 0.0;
    std::array<double, 9> c{};
    for (std::size_t r = 0; r < dim_; ++r) {
        for (std::size_t q = 0; q < dim_; ++q) c[r * dim_ + q] = weight * slope * pull[r] * pull[q];
        c[r * dim_ + r] += weight * zeta * (r == 0 ? law.normal_stiffness : law.tangential_stiffness);
    }
    return c;
}

// The softening pair nearest to its end: the one that plain steps would break next.
std::int64_t Leap::weakest(const Point& at) const {
    std::int64_t found = -1;
    double least = 1.0;
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const double left = at.adhesion[i] / old_[members_[i].pair];
        if (at.adhesion[i] <= 0.0 || !(left < least)) continue;
        least = left;
        found = static_cast<std::int64_t>(i);
    }
    return found;
}

bool Leap::look(Point& at, std::span<const double> carried) {
    bool changed = false;
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const ZonePair& m = members_[i];
        if (!(carried[i] > 0.0) || !newton_.pairs.mixed(m.pair)) continue;
        const Driving y =
            driving_energy(*newton_.pairs.law[m.pair], std::span<const double>(at.jump).subspan(m.first, dim_));
        const Toughness before = toughness_[m.pair];
        if (!mixity_.look(m.pair, y)) continue;
        changed = true;
        const auto spent = [&](const Toughness& t) {
            const Law& law = *newton_.pairs.law[m.pair];
            return law.dissipated(t, at.adhesion[i]) - law.dissipated(t, old_[m.pair]);
        };
        added_ += newton_.pairs.weight[m.pair] * (spent(toughness_[m.pair]) - spent(before));
    }
    if (changed) at = point(std::move(at.unknowns));
    return changed;
}

double Leap::run() {
    if (members_.empty()) return 0.0;
    Point at = point([&] {
        std::vector<double> x(static_cast<std::size_t>(zone_.energy().rows()), 0.0);
        const std::vector<std::int64_t>& rows = zone_.jump_rows();
        for (std::size_t z = 0; z < rows.size(); ++z)
            if (const JumpRow& row = zone_.rows()[z];
                row.offset.empty() && row.unknowns.size() == 1 && row.unknowns.front().second == 1.0)
                x[static_cast<std::size_t>(row.unknowns.front().first)] =
                    state_.response.jump[static_cast<std::size_t>(rows[z])];
        return x;
    }());
    Extrapolation extrapolation;
    std::vector<double> used = at.adhesion;
    Patience newton_patience, move_patience;
    for (std::int64_t step = 0; step < newton_.limit; ++step) {
        Point next;
        std::vector<double> carried = at.adhesion;
        const std::vector<std::uint8_t> before = held_;
        const bool newton = newton_patience.try_now() &&
                            newton_patience.report(minimise(at, at.adhesion, 1.0, -1, next) && descend(at, next));
        bool taken = newton;
        if (!taken && move_patience.try_now()) {
            held_ = before;
            const std::int64_t pair = weakest(at);
            taken = move_patience.report(pair >= 0 && minimise(at, at.adhesion, 0.0, pair, next) &&
                                         next.energy < at.energy);
            if (taken) {
                ++state_.counts.debond_moves;
                carried[static_cast<std::size_t>(pair)] = 0.0;
            }
        }
        if (taken) {
            extrapolation.forget();
            used = next.adhesion;
        } else {
            held_ = before;
            std::vector<double> ahead = extrapolation.next(used, at.adhesion);
            for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] = std::clamp(ahead[i], 0.0, old_[members_[i].pair]);
            taken = minimise(at, ahead, 0.0, -1, next) && next.energy < at.energy;
            if (taken) carried = ahead;
            used = std::move(ahead);
        }
        if (!taken) {
            held_ = before;
            extrapolation.forget();
            used = at.adhesion;
            if (!minimise(at, at.adhesion, 0.0, -1, next) || next.energy > at.energy + energy_noise * at.size) {
                held_ = before;
                break;
            }
        }
        const bool renewed = look(next, carried);
        double change = 0.0;
        for (std::size_t i = 0; i < members_.size(); ++i)
            change = std::max(change, std::abs(next.adhesion[i] - at.adhesion[i]));
        at = std::move(next);
        // Newton's method squares the error: the next one would be far below delta.
        if (newton && !renewed ? change * change <= 0.01 * newton_.tolerance : change <= newton_.tolerance) break;
    }
    for (std::size_t i = 0; i < members_.size(); ++i) state_.adhesion[members_[i].pair] = at.adhesion[i];
    const std::vector<std::int64_t>& rows = zone_.jump_rows();
    for (std::size_t z = 0; z < rows.size(); ++z)
        if (normal_[z] != 0) state_.closed[static_cast<std::size_t>(rows[z]) / dim_] = held_[z];
    if (mixity_.rule() == MixityRule::variational)
        for (std::size_t z = 0; z < rows.size(); ++z)
            state_.response.jump[static_cast<std::size_t>(rows[z])] = held_[z] != 0 ? 0.0 : at.jump[z];
    return added_;
}

}  // namespace

std::optional<double> ZoneNewton::leap(State& state, StepMixity& mixity, std::span<const double> adhesion_old) const {
    const auto dim = static_cast<std::size_t>(pairs.dimension);
    Springs springs{spring_stiffness(pairs, state.adhesion), {}};
    springs.held.assign(springs.stiffness.size(), 0);
    std::vector<std::uint8_t> wanted(springs.stiffness.size(), 0);
    for (std::size_t p = 0; p < adhesion_old.size(); ++p) {
        const bool bonded = contact.bonded[p] != 0;
        for (std::size_t c = 0; c < dim; ++c)
            springs.held[p * dim + c] = bonded || (c == 0 && state.closed[p] != 0) ? 1 : 0;
        if (bonded || pairs.law[p] == nullptr || adhesion_old[p] <= 0.0) continue;
        const double driving = driving_energy(pairs, p, state.response.jump).total();
        const bool partly = mixity.rule() == MixityRule::variational && adhesion_old[p] < 1.0;
        if (partly || state.adhesion[p] < adhesion_old[p] ||
            pairs.law[p]->minimiser(mixity.toughness()[p], driving / nearly_loaded, adhesion_old[p]) < adhesion_old[p])
            for (std::size_t c = 0; c < dim; ++c) wanted[p * dim + c] = 1;
    }
    Zone* zone = op.zone(springs, wanted, false);
    if (zone == nullptr) return std::nullopt;
    return Leap(*this, state, mixity, adhesion_old, springs, *zone).run();
}

}  // namespace delam
