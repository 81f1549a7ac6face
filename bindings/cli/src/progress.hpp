// SPDX-License-Identifier: BSD-3-Clause
// What a person sees while it runs: one line that is rewritten on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace cli {

class Progress {
public:
    // first: steps that are done already.
    Progress(std::int64_t total, std::int64_t first);

    void step(std::int64_t step, double time, double load, std::int64_t iterations, bool converged);
    // From inside the library; no more than ten times a second, on a terminal only.
    void stage(const char* name, std::int64_t done, std::int64_t total);
    // A line of its own, above the bar.
    void note(const std::string& text);
    void finish();

private:
    using Clock = std::chrono::steady_clock;
    [[nodiscard]] std::string left() const;
    void draw(const std::string& stage);

    std::int64_t total_;
    std::int64_t first_;
    std::int64_t step_;
    std::string last_;  // load and iterations of the last step
    bool terminal_;
    bool drawn_ = false;
    Clock::time_point start_;
    Clock::time_point redraw_;
};

}  // namespace cli
