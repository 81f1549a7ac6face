// SPDX-License-Identifier: BSD-3-Clause
// The floating point environment of a call: rounding to nearest, denormal numbers as they are, no traps. What the host
// has (a Fortran program that traps invalid operations, a plugin host that flushes to zero) comes back at the end, with
// the flags it had.
#pragma once

#include <cfenv>

namespace delam {

class DefaultFloats {
public:
    DefaultFloats() noexcept {
        std::fegetenv(&host_);
        std::fesetenv(FE_DFL_ENV);
    }
    ~DefaultFloats() { std::fesetenv(&host_); }
    DefaultFloats(const DefaultFloats&) = delete;
    DefaultFloats& operator=(const DefaultFloats&) = delete;

private:
    std::fenv_t host_;
};

}  // namespace delam
