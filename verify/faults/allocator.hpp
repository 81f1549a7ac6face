// SPDX-License-Identifier: BSD-3-Clause
// An allocator for test programs that can be made to fail: malloc and its relatives, operator new, and so every
// allocation of the library, CHOLMOD, METIS and LAPACK. Link allocator.cpp into the program.
#pragma once

namespace faults {

// False without glibc, or under a sanitizer that has its own allocator: nothing can be made to fail then.
bool can_fail();
// The k-th allocation from now on fails, and with `all` every later one too. k = 0: none.
void fail_at(long k, bool all = false);
// Ends this; returns whether an allocation has failed.
bool stop_failing();
// The OpenMP runtime and OpenBLAS with several threads end the process when an allocation fails (src/capi/CONTRACT.md,
// "Memory"). Their own allocations therefore do not fail and are not counted, unless this is switched off.
void spare_others(bool yes);
// Number of blocks that are not yet freed.
long live_blocks();

}  // namespace faults
