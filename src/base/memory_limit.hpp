// SPDX-License-Identifier: BSD-3-Clause
// The memory that this process can have at all, whoever uses it now.
#pragma once

#include <string>

namespace delam {

struct MemoryLimit {
    double bytes;      // infinite where the system tells none
    std::string what;  // sets it, for people
};

// The smallest of physical memory and the limits of the process' control groups, each with the swap space, and the
// limit of its address space.
MemoryLimit memory_limit();
// Returns the smaller of this and what an analysis may take by its option memory_limit, in GiB; 0: it says nothing.
MemoryLimit memory_limit(double option);

// Returns the smallest limit of the Linux control groups of this process, of versions 1 and 2, and of the groups around
// them; infinite if they set no limit. top: the folder that contains proc and sys.
double control_group_limit(const std::string& top);

}  // namespace delam
