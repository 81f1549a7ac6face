// SPDX-License-Identifier: BSD-3-Clause
// A state x of bodies that an engine solves is
//
//   [variables v | T^T (f - K u) there | f_p^T u | U_p^T K u | weights | rigid],
//
// whose parts are all linear, so that combinations of states need no solve. weights: which kept answers u_s of the
// engine make up the state, u = sum of w_s u_s + R rigid, R the rigid motions of floating parts.
#pragma once

#include <cstddef>
#include <span>

namespace delam {

class EngineLayout {
public:
    EngineLayout(std::size_t variables, std::size_t patterns, std::size_t kept, std::size_t motions)
        : balance_(variables),
          done_(balance_ + variables),
          lifted_(done_ + patterns),
          weights_(lifted_ + patterns),
          rigid_(weights_ + kept),
          size_(rigid_ + motions) {}

    std::size_t size() const { return size_; }
    bool has_motions() const { return rigid_ < size_; }

    // The parts of a state; Value: double, or const double.
    template <class Value>
    std::span<Value> variables(std::span<Value> x) const {
        return x.first(balance_);
    }
    template <class Value>
    std::span<Value> balance(std::span<Value> x) const {
        return x.subspan(balance_, done_ - balance_);
    }
    template <class Value>
    std::span<Value> done(std::span<Value> x) const {
        return x.subspan(done_, lifted_ - done_);
    }
    template <class Value>
    std::span<Value> lifted(std::span<Value> x) const {
        return x.subspan(lifted_, weights_ - lifted_);
    }
    template <class Value>
    std::span<Value> weights(std::span<Value> x) const {
        return x.subspan(weights_, rigid_ - weights_);
    }
    template <class Value>
    std::span<Value> rigid(std::span<Value> x) const {
        return x.subspan(rigid_, size_ - rigid_);
    }

private:
    std::size_t balance_, done_, lifted_, weights_, rigid_, size_;  // beginnings
};

}  // namespace delam
