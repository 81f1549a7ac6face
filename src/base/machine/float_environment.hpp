// SPDX-License-Identifier: BSD-3-Clause
// The floating-point environment during a call: rounding to nearest, denormals kept, no traps. The destructor restores
// the host's environment and exception flags: a Fortran program may trap invalid operations, a plugin host may flush
// denormals to zero.
#pragma once

#include <cfenv>
#include <cstdint>

#if defined(__x86_64__) && defined(__GLIBC__)
#include <xmmintrin.h>
#endif

namespace delam {

// Setting the environment takes 0.2 microseconds, longer than most calls. On x86-64 two control words show whether it
// is already the default, as it nearly always is. Then only the flags must be restored: those of SSE, which does nearly
// all arithmetic, and those of the x87 in the rare call that raises one.
class DefaultFloats {
public:
    DefaultFloats() noexcept {
#if defined(__x86_64__) && defined(__GLIBC__)
        constexpr std::uint32_t flags = 0x3f, masked_to_nearest = 0x1f80;
        constexpr std::uint16_t x87 = 0x37f;
        std::uint16_t control = 0;
        __asm__ volatile("fnstcw %0" : "=m"(control));
        __asm__ volatile("fnstsw %0" : "=m"(x87_flags_));
        sse_ = _mm_getcsr();
        default_already_ = (sse_ & ~flags) == masked_to_nearest && control == x87;
        if (default_already_) return;
#endif
        std::fegetenv(&host_);
        std::fesetenv(FE_DFL_ENV);
    }
    ~DefaultFloats() {
#if defined(__x86_64__) && defined(__GLIBC__)
        if (default_already_) {
            if (_mm_getcsr() != sse_) _mm_setcsr(sse_);
            std::uint16_t now = 0;
            __asm__ volatile("fnstsw %0" : "=m"(now));
            if (now == x87_flags_) return;
            std::fegetenv(&host_);
            host_.__status_word = x87_flags_;
            std::fesetenv(&host_);
            return;
        }
#endif
        std::fesetenv(&host_);
    }
    DefaultFloats(const DefaultFloats&) = delete;
    DefaultFloats& operator=(const DefaultFloats&) = delete;

private:
    std::fenv_t host_;
#if defined(__x86_64__) && defined(__GLIBC__)
    std::uint32_t sse_ = 0;
    std::uint16_t x87_flags_ = 0;
    bool default_already_ = false;
#endif
};

}  // namespace delam
