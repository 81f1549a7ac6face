// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/minimise/zone_newton.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "evolution/contact/extrapolation.hpp"
#include "evolution/contact/zone_system.hpp"

namespace delam {

namespace {

// A failed method is tried again after 1, 2, 4, 8, 8 ... steps.
class Backoff {
public:
    explicit Backoff(std::int64_t longest) : longest_(longest) {}
    bool try_now() {
        if (wait_ == 0) return true;
        --wait_;
        return false;
    }
    bool report(bool success) {
        next_ = success ? 1 : std::min(2 * next_, longest_);
        wait_ = success ? 0 : next_;
        return success;
    }

private:
    std::int64_t longest_;
    std::int64_t next_ = 1;
    std::int64_t wait_ = 0;
};

class Descent {
public:
    Descent(const ZoneNewton& newton, State& state, const Increment& increment, StepMixities& mixities,
            const Springs& springs, Zone& zone);
    // So many steps at most, until one changes the damage by less than the tolerance. Returns the energy added by new
    // mixities alone.
    double run(std::int64_t limit, double tolerance);
    bool ended() const { return ended_; }                  // it has settled, or no step lowers the energy
    bool newton() const { return newton_step_; }           // its last step was a whole one of Newton's method
    double first_change() const { return first_change_; }  // and last_change(): of the damage, in its steps
    double last_change() const { return last_change_; }

private:
    // An iterate: jumps of all zone rows, energy, adhesion of the members.
    struct Point {
        std::vector<double> unknowns;
        std::vector<double> jump;
        std::vector<double> adhesion;
        double energy = 0.0;
        double size = 0.0;  // sum of the absolute terms of the energy
    };
    // A step from one point to the next: its outcome, and the adhesions with which the displacements were computed.
    struct Move {
        bool taken = false;
        bool newton = false;
        std::vector<double> carried;
        Point to;
    };

    std::span<const double> local(const Point& at, std::size_t member) const {
        return std::span<const double>(at.jump).subspan(members_[member].first, dim_);
    }
    Point start() const;
    Point point(std::vector<double> unknowns) const;
    Point between(const Point& from, const Point& to, double part) const;
    // Loads the system with models of the members about a point: their tangents between secant (0) and full (1), one
    // of them debonded (or none: -1).
    void model(const Point& at, std::span<const double> adhesion, double fraction, std::int64_t debonded);
    // Minimiser of the model with contact; false: indefinite, unbalanced, or the contact set did not converge.
    bool minimise(const Point& at, std::span<const double> adhesion, double fraction, std::int64_t debonded,
                  Point& out);
    // A point between `at` and `to` with less energy, at which pairs change one by one if asked for; false: none.
    bool descend(const Point& at, Point& to, bool singly);
    // Pairs that break, and pairs at rest that begin to soften, from one point to another.
    struct Changes {
        std::int64_t broken = 0, begun = 0;
    };
    Changes changes(const Point& from, const Point& to) const;
    bool one_by_one(const Point& from, const Point& to) const;
    // Ends the way from `at` to `to` before the energy rises and, if the member does not break on it, before a pair at
    // rest begins to soften: another equilibrium, in which plain steps would end, may lie there. Where the lowest state
    // is sought, the end is enough. False: at once.
    bool fall(const Point& at, Point& to, std::size_t member) const;
    std::int64_t weakest(const Point& at) const;
    Move step(const Point& at);
    Move staggered_step(const Point& at, const std::vector<std::uint8_t>& closed);
    // The largest eigenvalue of what softening takes off the stiffness relative to the secant one: the tangents are
    // indefinite from 1 on. None: the zone cannot tell.
    std::optional<double> softening(const Point& at);
    // A step of Newton's method with so much of the tangents that it remains definite.
    Move damped_step(const Point& at, double softening, const std::vector<std::uint8_t>& closed);
    // Shows the point's mixities: those of the members whose adhesion `carried` was positive. True: the toughness in
    // use has changed, and with it the energy and adhesions of the point.
    bool observe(Point& at, std::span<const double> carried);
    void hand_over(const Point& at);

    const ZoneNewton& newton_;
    const Limits& limits_;
    State& state_;
    const Increment& increment_;
    StepMixities& mixities_;
    std::size_t dim_;
    Zone& zone_;
    ZoneSystem system_;
    std::vector<ZoneSystem::Pair> members_;  // pairs that may damage
    std::vector<double> spring_;             // [zone rows], of rows that belong to no member
    std::vector<std::uint8_t> closed_;       // [contact rows]
    double added_ = 0.0;
    bool ended_ = false, newton_step_ = false;
    double first_change_ = infinite, last_change_ = infinite;
    bool halved_ = false;  // descend() has gone a part of the way only
    Extrapolation extrapolation_;
    std::vector<double> used_;  // adhesions from which the last extrapolation started
    Backoff newton_backoff_{limits_.newton_longest_wait}, move_backoff_{limits_.newton_longest_wait};
    bool indefinite_ = false;                      // the last model had no minimum
    bool softens_ = false;                         // the last tangents were indefinite
    std::int64_t staggered_ = 0;                   // staggered steps since Newton's method has succeeded
    double growth_ = limits_.newton_least_growth;  // by which damped steps exceed staggered ones along the softest mode
};

Descent::Descent(const ZoneNewton& newton, State& state, const Increment& increment, StepMixities& mixities,
                 const Springs& springs, Zone& zone)
    : newton_(newton),
      limits_(newton.limits),
      state_(state),
      increment_(increment),
      mixities_(mixities),
      dim_(index(newton.contact.dimension)),
      zone_(zone),
      system_(zone, newton.contact, newton.op.prescribed_rows(), springs.held, state.theta,
              [this] { newton_.monitor.progress("minimise", state_.effort.am_iterations, 0); }),
      closed_(system_.entered_closed()) {
    system_.stay_near(state.response.jump);
    for (const std::int64_t row : zone.jump_rows()) spring_.push_back(springs.stiffness[index(row)]);
    for (const ZoneSystem::Pair& p : system_.pairs()) {
        if (increment.pairs().law[p.pair] == nullptr || increment.adhesion_before()[p.pair] <= 0.0) continue;
        members_.push_back(p);
        std::fill_n(spring_.begin() + static_cast<std::ptrdiff_t>(p.first), dim_, 0.0);
    }
}

Descent::Point Descent::start() const { return point(zone_.unknowns_at(state_.theta, state_.response)); }

Descent::Point Descent::point(std::vector<double> unknowns) const {
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
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const PairMinimum m = increment_.minimum(members_[i].pair, local(at, i));
        at.adhesion.push_back(m.adhesion);
        add(increment_.pairs().weight[members_[i].pair] * m.energy);
    }
    return at;
}

Descent::Point Descent::between(const Point& from, const Point& to, double part) const {
    std::vector<double> unknowns(from.unknowns);
    for (std::size_t i = 0; i < unknowns.size(); ++i) unknowns[i] += part * (to.unknowns[i] - from.unknowns[i]);
    return point(std::move(unknowns));
}

void Descent::model(const Point& at, std::span<const double> adhesion, double fraction, std::int64_t debonded) {
    std::vector<Zone::Coupling> couplings;
    std::vector<double> row_force(spring_.size(), 0.0);
    const auto add = [&](std::size_t r, std::size_t q, double value) {
        couplings.push_back({static_cast<std::int64_t>(r), static_cast<std::int64_t>(q), value});
    };
    for (std::size_t z = 0; z < spring_.size(); ++z)
        if (spring_[z] > 0.0) add(z, z, spring_[z]);
    for (std::size_t i = 0; i < members_.size(); ++i) {
        if (static_cast<std::int64_t>(i) == debonded) continue;
        const PairModel m = increment_.model(members_[i].pair, local(at, i), adhesion[i], fraction);
        for (std::size_t r = 0; r < dim_; ++r) {
            row_force[members_[i].first + r] = m.force[r];
            for (std::size_t q = 0; q < dim_; ++q)
                if (const double c = m.tangent[r * dim_ + q]; c != 0.0)
                    add(members_[i].first + r, members_[i].first + q, c);
        }
    }
    system_.load_model(std::move(couplings), std::move(row_force));
}

bool Descent::minimise(const Point& at, std::span<const double> adhesion, double fraction, std::int64_t debonded,
                       Point& out) {
    model(at, adhesion, fraction, debonded);
    std::vector<std::uint8_t> closed = closed_;
    const ActiveSet found = find_active_set(system_, system_.contact_rows(), closed, limits_.newton_contact_steps);
    state_.effort.newton_solves += found.solves;
    indefinite_ = found.last == ContactSolve::failed;
    if (!found.settled) return false;
    closed_ = std::move(closed);
    out = point(system_.solution().unknowns);
    return true;
}

Descent::Changes Descent::changes(const Point& from, const Point& to) const {
    Changes found;
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const double whole = increment_.adhesion_before()[members_[i].pair];
        if (from.adhesion[i] > 0.0 && !(to.adhesion[i] > 0.0)) ++found.broken;
        if (!(from.adhesion[i] < whole) && to.adhesion[i] < whole) ++found.begun;
    }
    return found;
}

// True if at most one pair breaks and, if one does, no pair that was at rest begins to soften.
bool Descent::one_by_one(const Point& from, const Point& to) const {
    const Changes found = changes(from, to);
    return found.broken == 0 || (found.broken == 1 && found.begun == 0);
}

bool Descent::descend(const Point& at, Point& to, bool singly) {
    const double rounding = zone_.energy_rounding() * (std::abs(at.energy) + std::abs(to.energy));
    for (std::int64_t n = 0; n < limits_.newton_halvings; ++n) {
        halved_ = n > 0;
        if (n > 0) to = between(at, to, 0.5);
        if (to.energy <= at.energy + rounding && (!singly || one_by_one(at, to))) return true;
    }
    return false;
}

bool Descent::fall(const Point& at, Point& to, std::size_t member) const {
    if (newton_.lowest) return to.energy < at.energy;
    const std::int64_t parts = limits_.newton_parts_of_move;
    const bool breaks = !(to.adhesion[member] > 0.0);
    Point least = at;
    for (std::int64_t n = 1; n <= parts; ++n) {
        const double part = static_cast<double>(n) / static_cast<double>(parts);
        Point next = n < parts ? between(at, to, part) : std::move(to);
        if (!(next.energy < least.energy) || (!breaks && changes(at, next).begun > 0)) {
            to = std::move(least);
            return n > 1;
        }
        least = std::move(next);
    }
    to = std::move(least);
    return true;
}

// The softening pair nearest to complete debonding: the one that plain steps would break next.
std::int64_t Descent::weakest(const Point& at) const {
    std::int64_t found = -1;
    double least = 1.0;
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const double left = at.adhesion[i] / increment_.adhesion_before()[members_[i].pair];
        if (at.adhesion[i] <= 0.0 || !(left < least)) continue;
        least = left;
        found = static_cast<std::int64_t>(i);
    }
    return found;
}

// Newton's method; otherwise moves one pair to its debonded branch; otherwise a damped step; otherwise one of the
// staggered scheme.
Descent::Move Descent::step(const Point& at) {
    const std::vector<std::uint8_t> before = closed_;
    Move move;
    move.carried = at.adhesion;
    std::optional<double> soft;
    if (softens_) soft = softening(at);
    softens_ = soft && *soft >= 1.0;
    if (!softens_ && newton_backoff_.try_now()) {
        const bool found = minimise(at, at.adhesion, 1.0, -1, move.to);
        move.newton = found && descend(at, move.to, false);
        if (!move.newton && indefinite_ && staggered_ >= limits_.newton_staggered) {
            closed_ = before;
            if (!soft) soft = softening(at);
            softens_ = soft.has_value();
            if (soft) soft = std::max(*soft, 1.0);
        }
        if (!softens_) newton_backoff_.report(move.newton);
    }
    move.taken = move.newton;
    if (!move.taken && !(soft && *soft < limits_.newton_own_branch) && move_backoff_.try_now()) {
        closed_ = before;
        const std::int64_t pair = weakest(at);
        move.taken = move_backoff_.report(pair >= 0 && minimise(at, at.adhesion, 0.0, pair, move.to) &&
                                          fall(at, move.to, index(pair)));
        if (move.taken) {
            ++state_.effort.debond_moves;
            move.carried[index(pair)] = 0.0;
        }
    }
    if (!move.taken && softens_) move = damped_step(at, *soft, before);
    if (!move.taken) {
        ++staggered_;
        return staggered_step(at, before);
    }
    if (move.newton) staggered_ = 0;
    extrapolation_.forget();
    used_ = move.to.adhesion;
    return move;
}

// With the secant stiffness H and the loss P of the pairs, H - f P is definite for f below 1 over the largest
// eigenvalue of H^-1 P, which the pairs' flexibility gives.
std::optional<double> Descent::softening(const Point& at) {
    if (!zone_.offers_flexibility()) return {};
    std::vector<std::vector<Zone::RowForce>> forces;
    DenseMatrix loss(static_cast<std::int64_t>(dim_), static_cast<std::int64_t>(dim_));
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const PairModel full = increment_.model(members_[i].pair, local(at, i), at.adhesion[i], 1.0),
                        secant = increment_.model(members_[i].pair, local(at, i), at.adhesion[i], 0.0);
        bool any = false;
        for (std::size_t e = 0; e < dim_ * dim_; ++e) {
            loss.value[e] = secant.tangent[e] - full.tangent[e];
            any = any || loss.value[e] != 0.0;
        }
        if (!any) continue;
        const Eigen modes = eigen_symmetric(loss);
        for (std::size_t m = 0; m < dim_; ++m) {
            if (!(modes.value[m] > 1e-12 * modes.value[dim_ - 1])) continue;
            forces.emplace_back();
            for (std::size_t r = 0; r < dim_; ++r)
                forces.back().push_back({static_cast<std::int64_t>(members_[i].first + r),
                                         std::sqrt(modes.value[m]) * modes.vector.value[m * dim_ + r]});
        }
    }
    if (forces.empty()) return 0.0;
    model(at, at.adhesion, 0.0, -1);
    const std::optional<DenseMatrix> work = system_.flexibility(closed_, forces);
    if (!work) return {};
    std::vector<double> mode(forces.size(), 1.0), image(mode.size());
    double value = 0.0;
    for (std::int64_t n = 0; n < limits_.newton_power_steps; ++n) {
        multiply(*work, mode, image);
        const double before = value;
        value = dot(mode, image) / dot(mode, mode);
        const double size = std::sqrt(dot(image, image));
        if (!(size > 0.0)) break;
        for (std::size_t i = 0; i < mode.size(); ++i) mode[i] = image[i] / size;
        if (std::abs(value - before) <= limits_.newton_power_tolerance * value) break;
    }
    return value;
}

// Staggered steps leave an unstable equilibrium by a factor of H^-1 P a step, which may take thousands. This one goes
// on to where the energy grows again, or one more pair is broken: a crack that ran past an equilibrium would stay open.
Descent::Move Descent::damped_step(const Point& at, double softening, const std::vector<std::uint8_t>& closed) {
    Move move;
    move.carried = at.adhesion;
    closed_ = closed;
    const double fraction = (1.0 - 1.0 / growth_) / softening;
    move.taken =
        minimise(at, at.adhesion, fraction, -1, move.to) && descend(at, move.to, true) && move.to.energy < at.energy;
    for (std::int64_t n = 0; n < limits_.newton_halvings && move.taken; ++n) {
        Point nearer = between(at, move.to, 0.5);
        if (!(nearer.energy < move.to.energy)) break;
        move.to = std::move(nearer);
        halved_ = true;
    }
    growth_ = move.taken && !halved_ ? std::min(limits_.newton_growth_rate * growth_, limits_.newton_most_growth)
                                     : std::max(growth_ / limits_.newton_growth_rate, limits_.newton_least_growth);
    return move;
}

// Extrapolated from the steps before as long as that lowers the energy, otherwise plain.
Descent::Move Descent::staggered_step(const Point& at, const std::vector<std::uint8_t>& closed) {
    Move move;
    closed_ = closed;
    std::vector<double> ahead = extrapolation_.next(used_, at.adhesion);
    for (std::size_t i = 0; i < ahead.size(); ++i)
        ahead[i] = std::clamp(ahead[i], 0.0, increment_.adhesion_before()[members_[i].pair]);
    move.taken = minimise(at, ahead, 0.0, -1, move.to) && move.to.energy < at.energy;
    move.carried = move.taken ? ahead : at.adhesion;
    used_ = std::move(ahead);
    if (move.taken) return move;
    closed_ = closed;
    extrapolation_.forget();
    used_ = at.adhesion;
    move.taken = minimise(at, at.adhesion, 0.0, -1, move.to) &&
                 !(move.to.energy > at.energy + limits_.newton_energy_rounding * at.size);
    if (!move.taken) closed_ = closed;
    return move;
}

bool Descent::observe(Point& at, std::span<const double> carried) {
    const PairLaws& pairs = increment_.pairs();
    bool changed = false;
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const std::size_t pair = members_[i].pair;
        if (!(carried[i] > 0.0) || !pairs.mixed(pair)) continue;
        const double before = increment_.dissipated(pair, at.adhesion[i]);
        if (!mixities_.observe(pair, driving_energy(*pairs.law[pair], local(at, i)))) continue;
        changed = true;
        added_ += pairs.weight[pair] * (increment_.dissipated(pair, at.adhesion[i]) - before);
    }
    if (changed) at = point(std::move(at.unknowns));
    return changed;
}

// Jumps from which the next displacement step may start.
void Descent::hand_over(const Point& at) {
    for (std::size_t i = 0; i < members_.size(); ++i) state_.adhesion[members_[i].pair] = at.adhesion[i];
    zone_.keep(at.unknowns, state_.response);
    const std::vector<std::uint8_t> held = system_.held(closed_);
    for (std::size_t z = 0; z < at.jump.size(); ++z)
        state_.response.jump[index(zone_.jump_rows()[z])] = held[z] != 0 ? 0.0 : at.jump[z];
    for (std::size_t i = 0; i < closed_.size(); ++i)
        state_.closed[index(zone_.jump_rows()[system_.contact_rows().row[i]]) / dim_] = closed_[i];
}

double Descent::run(std::int64_t limit, double tolerance) {
    ended_ = members_.empty();
    if (ended_) return 0.0;
    Point at = start();
    used_ = at.adhesion;
    double least = infinite;
    std::int64_t idle = 0;
    for (std::int64_t n = 0; n < limit && !ended_; ++n) {
        Move move = step(at);
        ended_ = !move.taken;
        if (ended_) break;
        const bool renewed = observe(move.to, move.carried);
        double change = 0.0;
        for (std::size_t i = 0; i < members_.size(); ++i)
            change = std::max(
                change, increment_.change(
                            members_[i].pair, at.adhesion[i], move.to.adhesion[i],
                            driving_energy(*increment_.pairs().law[members_[i].pair], local(move.to, i)).total()));
        at = std::move(move.to);
        // Newton's method squares the error, but for what its solve has left: the next change would be far below the
        // tolerance.
        if (n == 0) first_change_ = change;
        last_change_ = change;
        idle = change < 0.5 * least ? 0 : idle + 1;
        least = std::min(least, change);
        newton_step_ = move.newton && !halved_;
        const bool squared = move.newton && !renewed;
        ended_ =
            squared ? change * std::max(100.0 * change, system_.solution().left) <= tolerance : change <= tolerance;
        // The descent also ends if only the rounding of the solves is left.
        ended_ = ended_ || (squared && 100.0 * change * change <= tolerance && idle >= limits_.newton_most_idle &&
                            system_.solution().left > limits_.newton_met_rounding);
    }
    hand_over(at);
    state_.effort.linear_iterations += system_.iterations();
    return added_;
}

// Rows of the pairs that damage, or nearly do.
std::vector<std::uint8_t> loaded_rows(const ZoneNewton& newton, const State& state, const Increment& increment) {
    const auto dim = index(newton.contact.dimension);
    const PairLaws& pairs = increment.pairs();
    std::vector<std::uint8_t> wanted(state.adhesion.size() * dim, 0);
    for (std::size_t p = 0; p < state.adhesion.size(); ++p) {
        if (newton.contact.bonded[p] != 0 || pairs.law[p] == nullptr || increment.adhesion_before()[p] <= 0.0) continue;
        const auto jump = std::span<const double>(state.response.jump).subspan(p * dim, dim);
        if (!increment.damages(p, state.adhesion[p], jump, newton.limits.newton_nearly_loaded)) continue;
        std::fill_n(wanted.begin() + static_cast<std::ptrdiff_t>(p * dim), dim, std::uint8_t{1});
    }
    return wanted;
}

}  // namespace

std::optional<double> ZoneNewton::run(State& state, const Increment& increment, StepMixities& mixities) const {
    const auto springs = [&] {
        return Springs{spring_stiffness(increment.pairs(), state.adhesion), held_rows(contact, state.closed)};
    };
    double added = 0.0, last_change = infinite;
    bool newton = false;
    for (std::int64_t n = 0; n < limit; ++n) {
        const std::vector<std::uint8_t> wanted = loaded_rows(*this, state, increment);
        // The softening part is minimised to its end with the rest of the bodies at rest, before all of them move by a
        // step.
        Zone* part = zones->part(state.theta, state.response, wanted);
        if (part != nullptr) {
            Descent descent(*this, state, increment, mixities, springs(), *part);
            added += descent.run(std::min(limit, limits.newton_steps_in_part),
                                 std::max(tolerance, limits.newton_part_of_change * std::min(1.0, last_change)));
            // A step of Newton's method is at its end if the part that it has linearised no longer changes.
            if (newton && descent.ended() && descent.first_change() <= tolerance) break;
        }
        const Springs acting = springs();
        Zone* zone = zones->zone(acting, wanted, false);
        if (zone == nullptr) return std::nullopt;
        Descent descent(*this, state, increment, mixities, acting, *zone);
        added += descent.run(part != nullptr ? 1 : limit, tolerance);
        if (part == nullptr || descent.ended()) break;
        newton = descent.newton();
        last_change = descent.last_change();
    }
    return added;
}

}  // namespace delam
