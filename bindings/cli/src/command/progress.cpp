// SPDX-License-Identifier: BSD-3-Clause
#include "command/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "text/say.hpp"

namespace cli {

namespace {

std::string duration_text(double seconds) {
    const auto whole = static_cast<std::int64_t>(seconds + 0.5);
    if (whole >= 3600) return fmt::format("{}:{:02d}:{:02d}", whole / 3600, whole / 60 % 60, whole % 60);
    return fmt::format("{}:{:02d}", whole / 60, whole % 60);
}

// JSON has no NaN, which is the factor without a load.
std::string json_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

constexpr std::string_view erase_line = "\r\033[K";

// Returns the columns of the terminal behind standard output; 0: it is no terminal, or one of no width, as mpirun sets
// up for its own output.
std::size_t terminal_width() {
    winsize size{};
    return isatty(STDOUT_FILENO) == 1 && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace

Progress::Progress(std::int64_t total)
    : total_(total),
      first_(0),
      step_(0),
      terminal_(terminal_width() > 0 && !says_json_lines()),
      start_(Clock::now()),
      redraw_(start_) {}

void Progress::begin_after(std::int64_t first) {
    first_ = step_ = first;
    say_event("start", fmt::format("\"step\": {}, \"steps\": {}", first, total_));
    start_ = Clock::now();
    clear();
}

void Progress::clear() {
    if (terminal_ && drawn_) say_raw(erase_line);
    drawn_ = false;
}

std::string Progress::left() const { return step_ > first_ ? duration_text(seconds_left()) : "?"; }

double Progress::seconds_left() const {
    const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
    return elapsed / static_cast<double>(step_ - first_) * static_cast<double>(total_ - step_);
}

void Progress::step(std::int64_t step, double time, double load, std::int64_t iterations, bool converged) {
    step_ = step;
    if (says_json_lines()) {
        say_event("step", fmt::format("\"step\": {}, \"steps\": {}, \"time\": {}, \"load\": {}, \"iterations\": {}, "
                                      "\"converged\": {}, \"seconds_left\": {:.3g}",
                                      step, total_, json_number(time), json_number(load), iterations, converged,
                                      seconds_left()));
        return;
    }
    last_ = fmt::format("time {:.6g}  load {:.6g}  {} iterations{}", time, load, iterations,
                        converged ? "" : " NOT CONVERGED");
    if (terminal_) {
        draw("");
        return;
    }
    say("step {}/{}  {}  left {}\n", step, total_, last_, left());
    std::fflush(stdout);
}

void Progress::stage(const char* name, std::int64_t done, std::int64_t total) {
    if ((!terminal_ && !says_json_lines()) || Clock::now() - redraw_ < std::chrono::milliseconds(100)) return;
    if (says_json_lines()) {
        redraw_ = Clock::now();
        say_event("stage", fmt::format("\"name\": {}, \"done\": {}, \"total\": {}", json_text(name), done, total));
        return;
    }
    draw(total > 0 ? fmt::format("{} {}/{}", name, done, total) : std::string(name));
}

void Progress::draw(const std::string& stage) {
    redraw_ = Clock::now();
    constexpr std::int64_t width = 24;
    const auto full = static_cast<std::size_t>(total_ > 0 ? width * step_ / total_ : width);
    std::string line =
        fmt::format("[{}{}] {}/{}  {}  left {}  {}", std::string(full, '#'),
                    std::string(static_cast<std::size_t>(width) - full, '.'), step_, total_, last_, left(), stage);
    line.resize(std::min(line.size(), std::max<std::size_t>(terminal_width(), 2) - 1));
    say_raw(erase_line);
    say("{}", line);
    std::fflush(stdout);
    drawn_ = true;
}

void Progress::note(const std::string& text) {
    if (terminal_ && drawn_) say_raw(erase_line);
    say("{}\n", text);
    std::fflush(stdout);
    if (terminal_ && drawn_) draw("");
}

void Progress::finish() {
    if (terminal_ && drawn_) say("\n");
    std::fflush(stdout);
    drawn_ = false;
}

}  // namespace cli
