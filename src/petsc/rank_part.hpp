// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "petsc/bodies/part_state.hpp"
#include "petsc/part/part.hpp"

namespace delam::petsc {

// The part of the bodies that this rank has: its stiffness, the cells from which it came, where rank 0's scene gave
// them, and the fields of the state that has been recovered last.
class RankPart {
public:
    void set(Part part, PartCells cells) {
        part_ = std::move(part);
        cells_ = std::move(cells);
        recovered_.clear();
        known_ = true;
    }
    // True if set() has been called.
    bool known() const { return known_; }
    const Part& part() const { return part_; }
    const PartCells& cells() const { return cells_; }
    PartState& recovered() { return recovered_; }
    // Throws unless a state has been recovered.
    const PartState& state() const {
        if (!recovered_.known())
            fail(DELAM_ERROR_STATE, "no state of these parts has been recovered: delam_petsc_recover comes first");
        return recovered_;
    }
    PartState::Field field(const std::string& key) { return recovered_.field(key, cells_); }

private:
    Part part_;
    PartCells cells_;
    PartState recovered_;
    bool known_ = false;
};

}  // namespace delam::petsc
