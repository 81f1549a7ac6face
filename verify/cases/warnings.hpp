// SPDX-License-Identifier: BSD-3-Clause
// Hears what the library tells a host.
#pragma once

#include <string>
#include <vector>

#include "api.hpp"

namespace cases {

// Warnings that an analysis has logged.
class Warnings {
public:
    explicit Warnings(const reference::Scene& scene) : scene_(scene) {
        REQUIRE(scene, delam_context_set_log, scene.context(), &Warnings::hear, this);
    }
    Warnings(const Warnings&) = delete;
    Warnings& operator=(const Warnings&) = delete;
    ~Warnings() { delam_context_set_log(scene_.context(), nullptr, nullptr); }
    std::vector<std::string> lines;

private:
    static void hear(std::int32_t level, const char* line, void* user) {
        if (level == 1) static_cast<Warnings*>(user)->lines.emplace_back(line);
    }
    const reference::Scene& scene_;
};

}  // namespace cases
