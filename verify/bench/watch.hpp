// SPDX-License-Identifier: BSD-3-Clause
// Measures an analysis by the progress callback of a context: iterations of each linear solve, and how long the library
// does not poll, so that a cancellation has to wait.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "api.hpp"
#include "clock.hpp"

namespace bench {

class Watch {
public:
    explicit Watch(delam_context* context);
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

    // The caller has done something else since the last call of the library.
    void resume();

    double solves() const { return solves_; }  // those that iterate
    double iterations() const { return iterations_; }
    double most_iterations() const { return most_; }
    // Processor seconds between two calls of the callback, the longest after each stage.
    const std::map<std::string, double>& silence() const { return silence_; }

private:
    static std::int32_t hear(const char* stage, std::int64_t done, std::int64_t total, void* self) noexcept;

    delam_context* context_;
    ProcessorClock clock_;
    double before_ = 0.0;
    std::string stage_ = "begin";
    std::map<std::string, double> silence_;
    double solves_ = 0.0, iterations_ = 0.0, most_ = 0.0;
};

}  // namespace bench
