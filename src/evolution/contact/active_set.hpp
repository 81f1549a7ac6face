// SPDX-License-Identifier: BSD-3-Clause
// Frictionless unilateral contact as an active set, over anything that can be solved with given rows held:
//
//   u_n >= 0,   lambda_n <= 0,   u_n lambda_n = 0        (u_n: normal jump, lambda_n: force of the pair, tension > 0).
//
// A closed row is held at u_n = 0 and may only push; an open one follows its spring and must not penetrate. The
// primal-dual active set (Hintermueller, Ito, Kunisch, SIAM J. Optim. 13, 2002) moves every row that violates its side
// at once and needs 3 to 4 solves from a good start. It can cycle: once a set comes back, FeasibleDescent
// goes on.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "base/numbers.hpp"
#include "reduction/operator/zone.hpp"

namespace delam {

// unbalanced: no equilibrium, because a part that nothing holds carries a load. failed: no unique minimum, or an
// iteration that did not converge.
enum class ContactSolve { solved, unbalanced, failed };

// The rows of a system that may open and close, in ascending order.
struct ContactRows {
    std::vector<std::size_t> row;     // among the system's jumps and forces
    std::vector<std::uint8_t> level;  // coarse sets have high levels (contact_levels.hpp); empty: all rows have level 0
    std::uint8_t least = 0;           // the search ends with the rows of this level and above
    std::uint8_t first = 0;           // and begins with those of this one
    bool on(std::size_t i, std::uint8_t at) const { return level.empty() || level[i] >= at; }
};

// solve(closed): with these contact rows held, the others free. Afterwards jump() and force() return those of all rows,
// and jump_floor() and force_floor() return sizes below which a jump or force may be rounding (0: unknown).
template <class S>
concept ContactSystem = requires(S system, const std::vector<std::uint8_t>& closed) {
    { system.solve(closed) } -> std::same_as<ContactSolve>;
    { system.jump() } -> std::convertible_to<std::span<const double>>;
    { system.force() } -> std::convertible_to<std::span<const double>>;
    { system.jump_floor() } -> std::convertible_to<double>;
    { system.force_floor() } -> std::convertible_to<double>;
};

struct ActiveSet {
    ContactSolve last = ContactSolve::solved;  // anything else: the search ended there
    bool settled = false;                      // no row violates its side
    bool descended = false;                    // the feasible descent was needed
    std::int64_t solves = 0;
    std::int64_t doubts = 0;  // sets of which a solve left open whether a row violates its side
};

// Violations below this part of the largest jump or force are rounding of the solve. (Measured by
// verify/bench/constants.py on 250 random scenes: half and twice decide alike.)
inline constexpr double contact_rounding = 1e-11;
// Forces below this part of the forces of which they are the difference are rounding, too. (Measured with
// verify/cases/contact/random_scenes.py --hard: half and twice decide alike; with 1e-14 rounding holds blocks that are
// free, seeds 9438 and 9813. Arms 100 times longer than thick, delam_harness stability --quick --subject slender, keep
// pulls of 1.5e-9 of the largest traction, with half 1.7e-9, with twice 8.6e-9; the report allows 1e-8.)
inline constexpr double force_rounding = 3e-14;

// Answers of an iteration: error() is what the last one leaves open. rough(): a set cannot end with such an answer.
// tighten(): the next ones leave less open; false: they cannot. guesses: so many sets may follow from signs that are in
// doubt in the tightest answers. (Estimates of what is open are ten times and more too large: the signs mostly hold.)
template <class S>
concept InexactSystem = requires(S system) {
    { system.error() } -> std::same_as<SolveError>;
    { system.rough() } -> std::same_as<bool>;
    { system.tighten() } -> std::same_as<bool>;
    { S::guesses } -> std::convertible_to<std::int64_t>;
};

// Returns the error of a solve, within which its answer says nothing about contact. (Measured on an ENF in space with
// answers off by 1e-6: 153,000 active-set steps in the first five load steps where it was taken to say something, one
// for each solve otherwise.)
template <ContactSystem S>
SolveError left_open(const S& system) {
    if constexpr (InexactSystem<S>)
        return system.error();
    else
        return {};
}

// Returns the least jump and force that say something about contact.
template <ContactSystem S>
SolveError least_of_contact(const S& system, const SolveError& open = {}) {
    return {std::max(open.jump, contact_rounding * std::max(max_abs(system.jump()), system.jump_floor())),
            std::max(open.force, contact_rounding * std::max(max_abs(system.force()), system.force_floor()))};
}

// Contact rows on the wrong side by more than `open` and rounding, as positions in `rows`; only those on this level or
// above.
template <ContactSystem S>
std::vector<std::size_t> contact_violators(const S& system, const ContactRows& rows,
                                           const std::vector<std::uint8_t>& closed, std::uint8_t level,
                                           const SolveError& open = {}) {
    const std::span<const double> jump = system.jump(), force = system.force();
    const auto [least_jump, least_force] = least_of_contact(system, open);
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < rows.row.size(); ++i) {
        if (!rows.on(i, level)) continue;
        const std::size_t r = rows.row[i];
        if (closed[i] != 0 ? force[r] > least_force : jump[r] < -least_jump) found.push_back(i);
    }
    return found;
}

// Systems with tangents that may be negative say so: without `softens` a system is positive definite, or nearly so.
template <class S>
concept SofteningSystem = requires(const S& system) {
    { system.softens() } -> std::same_as<bool>;
};

// Two equilibria of one system, A x + N^T lambda = b with lambda = 0 in free rows, differ by d with
//
//   d^T A d = -(u1 - u0) (lambda1 - lambda0),     summed over the contact rows.
//
// Where this is negative, A is not positive definite, and moving rows from one side to the other need not end. An
// iteration does not see that if its preconditioner is as indefinite.
class Curvature {
public:
    // True if this equilibrium and the one before show, beyond the errors of both, that A is indefinite.
    template <ContactSystem S>
    bool negative(const S& system, const ContactRows& rows, const std::vector<std::uint8_t>& closed,
                  const SolveError& open) {
        std::vector<double> jump, force;
        for (std::size_t i = 0; i < rows.row.size(); ++i) {
            jump.push_back(system.jump()[rows.row[i]]);
            force.push_back(closed[i] != 0 ? system.force()[rows.row[i]] : 0.0);
        }
        const double rounded = contact_rounding;
        const SolveError doubtful{open.jump + open_.jump + rounded * max_abs(system.jump()),
                                  open.force + open_.force + rounded * max_abs(system.force())};
        double work = 0.0, doubt = 0.0;
        for (std::size_t i = 0; i < jump_.size(); ++i) {
            const double u = jump[i] - jump_[i], f = force[i] - force_[i];
            if (f == 0.0) continue;
            work -= u * f;
            doubt += doubtful.jump * std::abs(f) + doubtful.force * std::abs(u);
        }
        jump_ = std::move(jump);
        force_ = std::move(force);
        open_ = open;
        return work < -doubt;
    }

private:
    std::vector<double> jump_, force_;  // of the equilibrium before; empty: none
    SolveError open_;
};

// Systems of which only the energy is wanted may say that the rows on the wrong side hardly matter.
template <class S>
concept EnergySystem = requires(S system, const std::vector<std::uint8_t>& closed, std::span<const std::size_t> wrong) {
    { system.negligible(closed, wrong) } -> std::same_as<bool>;
};

// Systems with parts that may float. settle() moves those that nothing holds, by as little as keeps their faces from
// penetrating: its jumps are then those of the moved parts. Rows that are closed without a force do not hold a part;
// where they open, settle() changes `closed`. Returns rows to close, because no motion keeps them apart. After a solve
// that a dead force has left unbalanced, caught() returns open rows that stop the part which it moves; none: nothing
// does.
template <class S>
concept FloatingSystem = requires(S system, const ContactRows& rows, std::vector<std::uint8_t>& closed,
                                  std::uint8_t level, const SolveError& least) {
    { system.settle(rows, closed, level, least) } -> std::same_as<std::vector<std::size_t>>;
    { system.caught(rows, closed) } -> std::same_as<std::vector<std::size_t>>;
};

// The active set that cannot cycle (Nocedal, Wright, Numerical Optimization, 2nd ed., 16.5). A point without
// penetration moves towards the minimiser of the present set as far as no open row penetrates. Rows that stop it close;
// if none does, rows that pull open. Energy is convex along the way to a minimiser, so that it falls in each step of
// some length, whatever rigid motions of free parts that minimiser has, and no set whose minimiser was reached comes
// back. In steps of no length (several rows at one corner) a set may come back; from then on rows open one at a time,
// that of least index (R. Bland, Math. Oper. Res. 2, 1977).
class FeasibleDescent {
public:
    // Starts with all contact rows at zero.
    explicit FeasibleDescent(std::size_t rows) : at_(rows, 0.0) {}

    // jump, force: of the contact rows at the minimiser of this set. Changes the set; false: it is the contact set.
    bool step(std::span<const double> jump, std::span<const double> force, const SolveError& least,
              std::vector<std::uint8_t>& closed) {
        double part = 1.0;
        std::vector<double> stop(at_.size(), 2.0);  // part of the way at which an open row is at zero
        for (std::size_t i = 0; i < at_.size(); ++i)
            if (closed[i] == 0 && jump[i] < -least.jump) part = std::min(part, stop[i] = at_[i] / (at_[i] - jump[i]));
        bool changed = false;
        for (std::size_t i = 0; i < at_.size(); ++i) {
            at_[i] = closed[i] != 0 ? 0.0 : std::max(0.0, at_[i] + part * (jump[i] - at_[i]));
            if (!(stop[i] <= part)) continue;
            closed[i] = 1;
            at_[i] = 0.0;
            changed = true;
        }
        if (changed) return true;
        for (std::size_t i = 0; i < at_.size(); ++i) {
            if (closed[i] == 0 || !(force[i] > least.force) || (changed && one_at_a_time_)) continue;
            closed[i] = 0;
            changed = true;
        }
        one_at_a_time_ = one_at_a_time_ || (changed && !seen_.emplace(closed.begin(), closed.end()).second);
        return changed;
    }

private:
    std::vector<double> at_;      // jumps of the contact rows, none negative
    std::set<std::string> seen_;  // sets from which rows have been opened
    bool one_at_a_time_ = false;
};

// closed: [contact rows], on entry the starting set, on return the contact set.
template <ContactSystem S>
ActiveSet find_active_set(S& system, const ContactRows& rows, std::vector<std::uint8_t>& closed, std::int64_t limit) {
    ActiveSet result;
    std::set<std::string> seen;  // contact sets, as bytes
    [[maybe_unused]] Curvature curvature;
    std::uint8_t level = rows.first;
    std::optional<FeasibleDescent> descent;
    [[maybe_unused]] std::int64_t guesses = 0;
    while (true) {
        result.last = system.solve(closed);
        ++result.solves;
        if constexpr (FloatingSystem<S>) {
            if (result.last == ContactSolve::unbalanced && result.solves < limit) {
                const std::vector<std::size_t> caught = system.caught(rows, closed);
                for (const std::size_t i : caught) closed[i] = 1;
                if (!caught.empty()) continue;
            }
        }
        if (result.last != ContactSolve::solved) return result;
        const SolveError open = left_open(system);
        const auto wrong_rows = [&](bool settle) {
            std::vector<std::size_t> blocked;
            if constexpr (FloatingSystem<S>)
                if (settle) blocked = system.settle(rows, closed, level, least_of_contact(system, open));
            std::vector<std::size_t> wrong = contact_violators(system, rows, closed, level, open);
            for (const std::size_t i : blocked)
                if (closed[i] == 0) wrong.push_back(i);
            std::sort(wrong.begin(), wrong.end());
            wrong.erase(std::unique(wrong.begin(), wrong.end()), wrong.end());
            return wrong;
        };
        // The descent opens rows at a minimiser alone: parts are not settled before it has arrived.
        std::vector<std::size_t> wrong = wrong_rows(!descent);
        if (descent && wrong.empty()) wrong = wrong_rows(true);
        while (wrong.empty() && level > rows.least) {
            --level;
            wrong = wrong_rows(true);
            seen.clear();
            descent.reset();
        }
        if constexpr (InexactSystem<S>) {
            if (wrong.empty() && system.rough() && system.tighten()) {
                seen.clear();
                descent.reset();
                continue;
            }
            const bool doubtful = wrong.empty() && !contact_violators(system, rows, closed, level).empty();
            if (doubtful) ++result.doubts;
            if (doubtful && result.solves < limit) {
                if (system.tighten()) continue;
                if (guesses++ < S::guesses) wrong = contact_violators(system, rows, closed, level);
            }
        }
        if constexpr (SofteningSystem<S>) {
            if (system.softens() && !wrong.empty() && curvature.negative(system, rows, closed, open)) {
                result.last = ContactSolve::failed;
                return result;
            }
        }
        result.settled = wrong.empty();
        if constexpr (EnergySystem<S>) result.settled = system.negligible(closed, wrong);
        if (result.settled || result.solves >= limit) return result;
        if (!descent && !seen.emplace(closed.begin(), closed.end()).second) {
            result.descended = true;
            descent.emplace(rows.row.size());
        }
        if (!descent) {
            for (const std::size_t i : wrong) closed[i] ^= 1;
            continue;
        }
        std::vector<double> jump, force;
        for (std::size_t i = 0; i < rows.row.size(); ++i) {
            const bool in = rows.on(i, level);
            jump.push_back(in ? system.jump()[rows.row[i]] : 0.0);
            force.push_back(in ? system.force()[rows.row[i]] : 0.0);
        }
        if (!descent->step(jump, force, least_of_contact(system, open), closed))
            for (const std::size_t i : wrong) closed[i] = 1;
    }
}

}  // namespace delam
