// SPDX-License-Identifier: BSD-3-Clause
// Progress: one line that is rewritten on a terminal, plain lines elsewhere, or events for programs (text/say.hpp).
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace cli {

class Progress {
public:
    explicit Progress(std::int64_t total);
    ~Progress() { finish(); }  // so that the message of an error has a line of its own
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    // Ends what was done before the steps: the bar is gone until the next stage.
    void clear();
    // So many steps were done before; the time that is left is that of the others.
    void begin_after(std::int64_t first);

    void step(std::int64_t step, double time, double load, std::int64_t iterations, bool converged);
    // Called from inside the library; prints at most ten times a second, and only on a terminal.
    void stage(const char* name, std::int64_t done, std::int64_t total);
    // Prints a separate line above the bar.
    void note(const std::string& text);
    void finish();

private:
    using Clock = std::chrono::steady_clock;
    [[nodiscard]] std::string left() const;
    [[nodiscard]] double seconds_left() const;  // after one step at least
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
