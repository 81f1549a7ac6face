// SPDX-License-Identifier: BSD-3-Clause
// The unit of cost, one linear-solve equivalent (LSE): CHOLMOD's analysis, numeric factorisation and one solve of the
// scene's undamaged monolithic matrix, already assembled.
#pragma once

#include "scenes.hpp"
#include "sparse_factor.hpp"
#include "stats.hpp"

namespace bench {

class Lse {
public:
    // Assembles the matrix; `stage` must be declared.
    explicit Lse(const Stage& stage);
    // Seconds of one linear solve, from scratch. The default is the faster index width (see choose()).
    double measure() const { return measure(wide_); }
    double measure(bool wide) const;
    // Measures both widths of CHOLMOD's indices three times each, keeps the faster one and prints both.
    Json choose();
    bool wide() const { return wide_; }
    std::size_t unknowns() const { return matrix_.size(); }
    Json facts() const;

private:
    UpperMatrix matrix_;
    std::vector<double> right_;
    bool wide_ = false;
};

}  // namespace bench
