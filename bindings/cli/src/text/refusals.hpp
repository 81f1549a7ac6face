// SPDX-License-Identifier: BSD-3-Clause
// Holds several things that a file asks for and does not get, which are said together.
#pragma once

#include <utility>
#include <vector>

#include "text/error.hpp"

namespace cli {

// Gives the first message where one is expected.
class Refusals : public SceneFailure {
public:
    // all: one at least, in the order of the file.
    explicit Refusals(std::vector<SceneFailure> all) : SceneFailure(all.front()), all_(std::move(all)) {}
    [[nodiscard]] const std::vector<SceneFailure>& all() const noexcept { return all_; }

private:
    std::vector<SceneFailure> all_;
};

}  // namespace cli
