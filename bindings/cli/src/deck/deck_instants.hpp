// SPDX-License-Identifier: BSD-3-Clause
// The instants of the scene that the increments of the deck's steps make.
#pragma once

#include <string>
#include <vector>

#include "deck/cards/deck.hpp"

namespace cli::abaqus {

class Instants {
public:
    // Adds those of a step that begins at a time.
    void add(const Step& step, double begin);
    // Returns [time], up to the end of the last step, and [solver] with these keys and what it says of substeps.
    [[nodiscard]] std::string text(double end, const std::string& solver_keys) const;

private:
    std::vector<double> instants_, sizes_;
    double substep_ = 1;  // the least increment of all steps, as a part of the load step
};

}  // namespace cli::abaqus
