// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "petsc/bodies/visible.hpp"

namespace delam::petsc {

// Variables that are not free: some are zero, some are expressed by others (v = S y + r, where y are the free ones and
// r is what a request has for the expressed ones). Places without a variable count as zero. Rows and columns on rank 0
// only, as places in `visible`.
class Constraints {
public:
    Constraints(const Bodies& bodies, const Visible& visible);

    struct Expressed {
        std::vector<std::int64_t> pivots;
        std::vector<std::int64_t> rows;  // places in pivots
        std::vector<std::int64_t> columns;
        std::vector<double> values;
    };
    void set(const std::vector<std::int64_t>& fixed, const Expressed& expressed);

    void spread(Vec y, Vec v) const;  // v = S y
    void gather(Vec v, Vec y) const;  // y = S^T v
    void mask(Vec v) const;           // leaves the free variables
    void rest(const std::vector<double>& right, Vec r) const;
    bool has_pivots() const { return has_pivots_; }
    Vec free() const { return free_; }

private:
    const Bodies& bodies_;
    const Visible& visible_;
    OwnedVec used_;  // 1 where there is a variable that something acts on
    OwnedVec free_;
    OwnedVec work_;
    std::vector<std::int64_t> pivots_;
    bool has_pivots_ = false;
    SparseEntries masters_;
};

}  // namespace delam::petsc
