// SPDX-License-Identifier: BSD-3-Clause
#include "machine.hpp"

#include <dlfcn.h>
#include <malloc.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <fstream>

#include "delam/delam.h"

namespace bench {
namespace {

// The text after the colon of the first line that starts with `key`.
std::string line_of(const char* file, const std::string& key) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        if (line.compare(0, key.size(), key) != 0) continue;
        const auto colon = line.find(':');
        const auto first = line.find_first_not_of(" \t", colon + 1);
        return first == std::string::npos ? "" : line.substr(first);
    }
    return "";
}

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
}

// Weak symbols: a BLAS other than OpenBLAS does not have these functions, and only the report needs them.
template <class Result>
Result ask_blas(const char* name, Result otherwise) {
    using Function = Result (*)();
    const auto function = reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
    return function == nullptr ? otherwise : function();
}

}  // namespace

Json machine() {
    Json m;
    m["processor"] = line_of("/proc/cpuinfo", "model name");
    m["mhz"] = line_of("/proc/cpuinfo", "cpu MHz");
    m["cores"] = sysconf(_SC_NPROCESSORS_ONLN);
    m["memory"] = line_of("/proc/meminfo", "MemTotal");
    utsname system{};
    uname(&system);
    m["kernel"] = std::string(system.sysname) + " " + system.release;
    m["compiler"] = __VERSION__;
    m["version"] = delam_version();
    m["commit"] = delam_commit();
    m["blas_core"] = ask_blas<char*>("openblas_get_corename", const_cast<char*>("unknown BLAS"));
    m["blas_config"] = ask_blas<char*>("openblas_get_config", const_cast<char*>("unknown BLAS"));
    m["blas_threads"] = ask_blas<int>("openblas_get_num_threads", 0);
    for (const char* name :
         {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "OMP_THREAD_LIMIT", "OPENBLAS_CORETYPE", "DELAM_BENCH_AS_SHIPPED"})
        m["environment"][name] = environment(name);
    double load[1] = {0.0};
    m["load_average"] = getloadavg(load, 1) == 1 ? load[0] : -1.0;
    char date[40];
    const std::time_t now = std::time(nullptr);
    std::strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
    m["date"] = date;
    return m;
}

double peak_memory() { return 1024.0 * std::strtod(line_of("/proc/self/status", "VmHWM").c_str(), nullptr); }

bool reset_peak_memory() {
    malloc_trim(0);
    std::ofstream out("/proc/self/clear_refs");
    out << "5" << std::flush;
    return static_cast<bool>(out);
}

}  // namespace bench
