// SPDX-License-Identifier: BSD-3-Clause
// Restarts of a preconditioned Krylov method: when the true residual of a solution is small enough, what its rounding
// excuses, and what one run of the recursion has to reach. The iterated operator and the engine on PETSc share this
// text; it needs nothing but the standard library.
//
//   round 0, 1, ..:  r = b - A x,  z = M r,  norm = sqrt(r^T z),  size = sqrt(2 energy) of the state
//                    stop if norm / max(size, norm) is small enough, or no smaller than a round ago
//                    else run the recursion from r until its own norm is at most goal()
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace delam {

// Tolerances below it are not asked for: it is what a decision about contact can still use.
inline constexpr double finest_tolerance = 1e-12;

struct RestartLimits {
#define DELAM_STEERING(type, name, value, reason) type name = value;
#include "base/restarts.inc"
#undef DELAM_STEERING
};

// The lowest size of a recursion's residual, and for how many iterations none was noticeably lower. noticed: a part of
// the lowest one, above which a residual has not moved.
class Lowest {
public:
    explicit Lowest(double noticed) : noticed_(noticed) {}
    // Returns true if no residual before was as low.
    bool take(double norm) {
        idle_ = norm < noticed_ * norm_ ? 0 : idle_ + 1;
        const bool lower = norm < norm_;
        norm_ = std::min(norm_, norm);
        return lower;
    }
    double norm() const { return norm_; }
    std::int64_t idle() const { return idle_; }

private:
    double noticed_;
    double norm_ = std::numeric_limits<double>::infinity();
    std::int64_t idle_ = 0;
};

class Restarts {
public:
    // rounded: what rounding leaves of the residual, as a part of the size of the state; 0: not known.
    Restarts(double tolerance, double rounded, const RestartLimits& limits = {})
        : limits_(limits), tolerance_(tolerance), rounded_(rounded) {}

    // Begins a round with the norm of the true residual and the size of the state.
    void begin(double norm, double size) {
        ++round_;
        before_ = norm_;
        norm_ = norm;
        size_ = size;
        relative_ = norm == 0.0 ? 0.0 : norm / std::max(size, norm);
        best_ = round_ == 0 || norm < before_;
        if (best_) least_ = relative_;
    }
    bool first() const { return round_ == 0; }
    // Lets a norm stay that is larger than what the tolerance allows.
    void allow(double norm) {
        if (norm_ > 0.0) tolerance_ = std::max(tolerance_, relative_ * norm / norm_);
    }
    // True if the round depends on what rounding leaves, and that is not known.
    bool needs_rounding() const { return relative_ > tolerance_ && round_ > 0 && !(rounded_ > 0.0) && size_ > 0.0; }
    void set_rounded(double rounded) { rounded_ = rounded; }
    // True if the residual is within the tolerance, or within what rounding leaves.
    bool reached() const {
        const double excused = (round_ == 0 ? limits_.restart_goal : limits_.restart_at_rounding) * rounded_;
        return relative_ <= tolerance_ || relative_ <= std::min(limits_.restart_largest_residual, excused);
    }
    // True if no earlier round had a smaller residual.
    bool best() const { return best_; }
    // True if another round would gain nothing.
    bool over() const { return !(norm_ <= limits_.restart_gained * before_) || round_ == limits_.restart_rounds; }
    // True if rounding explains the smallest residual of all rounds.
    bool excused() const {
        return least_ <= std::min(limits_.restart_largest_residual, limits_.restart_slack * rounded_);
    }
    // Returns the norm at which the recursion may stop.
    double goal() const { return limits_.restart_goal * std::max(tolerance_, rounded_) * std::max(size_, norm_); }
    // True if a recursion that has reached its goal may end the solve without another true residual.
    bool may_end() const { return rounded_ > 0.0 || !(tolerance_ < limits_.restart_far_from_rounding); }
    // Returns the norm that a recursion's residual and rounding leave together of a state of this size.
    double left(double norm, double size) const { return std::hypot(norm, rounded_ * size); }
    bool accepts(double left, double size) const {
        return left <= std::max(tolerance_, limits_.restart_at_rounding * rounded_) * size;
    }

    double norm() const { return norm_; }
    double relative() const { return relative_; }
    double tolerance() const { return tolerance_; }
    double rounded() const { return rounded_; }
    // The smallest residual of all rounds, relative.
    double least() const { return least_; }

private:
    RestartLimits limits_;
    double tolerance_, rounded_;
    int round_ = -1;
    double norm_ = std::numeric_limits<double>::infinity(), before_ = norm_, size_ = 0.0, relative_ = norm_,
           least_ = norm_;
    bool best_ = true;
};

}  // namespace delam
