// SPDX-License-Identifier: BSD-3-Clause
// Wall time and processor time.
#pragma once

#include <chrono>
#include <ctime>

namespace bench {

class Clock {
public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    // Seconds since the start or the last lap.
    double lap() {
        const double passed = seconds();
        start_ = std::chrono::steady_clock::now();
        return passed;
    }

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Processor time of this process, all threads: excludes other processes, includes threads that wait by spinning.
class ProcessorClock {
public:
    double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

private:
    std::clock_t start_ = std::clock();
};

}  // namespace bench
