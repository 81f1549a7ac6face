// SPDX-License-Identifier: BSD-3-Clause
// The allocator of a test program, which can be told to fail: malloc and its relatives, operator new, and so everything
// that the library, CHOLMOD, METIS and LAPACK take. Link allocator.cpp into the program.
#pragma once

namespace faults {

// Without glibc, or under a sanitizer that brings an allocator of its own, there is nothing to tell.
bool can_fail();
// The k-th allocation from now on fails, and with `all` every later one too. k = 0: none.
void fail_at(long k, bool all = false);
// Ends it; has one failed?
bool stop_failing();
// The OpenMP runtime and OpenBLAS with several threads end the process when they get none (src/capi/CONTRACT.md,
// "Memory"): what they ask for themselves does not fail, and is not counted, unless it is spared no more.
void spare_others(bool yes);
// Blocks that are not yet freed.
long live_blocks();

}  // namespace faults
