// SPDX-License-Identifier: BSD-3-Clause
#include "base/memory_limit.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <utility>

#if __has_include(<sys/sysinfo.h>)
#include <sys/sysinfo.h>
#endif

namespace delam {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

double swap_space() {
#if __has_include(<sys/sysinfo.h>)
    struct sysinfo info {};
    if (sysinfo(&info) == 0) return static_cast<double>(info.totalswap) * static_cast<double>(info.mem_unit);
#endif
    return 0.0;
}

// "max", or no such file: unlimited.
double number_in(const std::string& path) {
    std::ifstream file(path);
    double bytes = 0.0;
    return file >> bytes ? bytes : unlimited;
}

// Returns the lowest limit of a group and of the groups around it; a container may see its own group as the root.
double limit_of_group(const std::string& root, std::string group, const std::string& name) {
    double least = number_in(root + name);
    while (group.size() > 1 && group.front() == '/') {
        least = std::min(least, number_in(root + group + name));
        group.erase(group.rfind('/'));
    }
    return least;
}

}  // namespace

// Lines "0::PATH" (version 2) and "NUMBER:CONTROLLERS:PATH" (version 1).
double control_group_limit(const std::string& top) {
    const std::string tree = top + "/sys/fs/cgroup";
    std::ifstream groups(top + "/proc/self/cgroup");
    double least = unlimited;
    for (std::string line; std::getline(groups, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",",
                          group = line.substr(second + 1);
        if (controllers == ",,")
            least = std::min(least, limit_of_group(tree, group, "/memory.max"));
        else if (controllers.find(",memory,") != std::string::npos)
            least = std::min(least, limit_of_group(tree + "/memory", group, "/memory.limit_in_bytes"));
    }
    return least;
}

MemoryLimit memory_limit() {
    MemoryLimit limit{unlimited, "no limit"};
    const auto take = [&](double bytes, const char* what) {
        if (bytes < limit.bytes) limit = {bytes, what};
    };
    const double swap = swap_space();
    const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    if (pages > 0 && page > 0)
        take(static_cast<double>(pages) * static_cast<double>(page) + swap, "the memory of this machine");
    take(control_group_limit("") + swap, "the limit of the control group of this process");
    rlimit space{};
    if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
        take(static_cast<double>(space.rlim_cur), "the limit of the address space of this process");
    return limit;
}

MemoryLimit memory_limit(double option) {
    const MemoryLimit limit = memory_limit();
    const double own = option * 1024.0 * 1048576.0;
    return own > 0.0 && own < limit.bytes ? MemoryLimit{own, "option memory_limit"} : limit;
}

}  // namespace delam
