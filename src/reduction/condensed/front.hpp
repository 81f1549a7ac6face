// SPDX-License-Identifier: BSD-3-Clause
// A front of the multifrontal method (I. Duff, J. Reid, ACM TOMS 9, 1983): the dense matrix of the variables that a
// node of the tree eliminates, and of those that it leaves to others.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "reduction/condensed/superelements.hpp"
#include "reduction/dense/dense_energy.hpp"

namespace delam {

//     F = [F_ee F_er; F_re F_rr],   L L^T = F_ee,   V = L^-1 F_er;     F_rr - V^T V is left.
// Until it is eliminated, `factor` and `coupling` hold F_ee and F_er.
struct TreeFront {
    std::vector<std::int64_t> out, left;  // places
    DenseMatrix factor;                   // L
    DenseMatrix coupling;                 // V
    DenseMatrix load;                     // L^-1 f_e
    DenseEnergy energy;                   // lower triangle
    std::int64_t made = -1;               // number of the update
    std::int64_t loaded = -1;             // number of the loads

    // Adds to an entry of F, i >= j: positions in `out`, then `left`.
    void put(std::int64_t i, std::int64_t j, double value);
    // False: F_ee is not positive definite; nothing is left that could be used.
    bool eliminate(const Poll& poll);
    // Does what eliminate() does with the loads.
    void eliminate_loads();
    // Sets x_e from x_r and the load parameters.
    void recover(std::span<const double> theta, std::span<double> skeleton) const;
};

// Sums up the entries of one front after another. open(), any number of additions, close().
class FrontBuilder {
public:
    // `bodies` must outlive it.
    explicit FrontBuilder(const Superelements& bodies) : bodies_(bodies), at_(bodies.variable().size(), -1) {}
    // Takes `out` and `left` of the front; its entries are zero. leaf: what is added next, -1: none.
    void open(TreeFront& front, std::int64_t leaf, std::int64_t patterns);
    // Opens a front that has been eliminated, for other loads alone.
    void open_loads(TreeFront& front, std::int64_t patterns);
    void add_leaf(TreeFront& front, std::int64_t leaf) const;
    void add_entries(TreeFront& front, std::span<const Triplet> entries) const;
    // Adds the energy that another front has left, of which the places that are not here are dropped.
    void add(TreeFront& front, const TreeFront& other) const;
    // Adds the loads that another front has left.
    void add_loads(TreeFront& front, const TreeFront& other) const;
    void close(const TreeFront& front);
    // Forgets a front that was opened and, because of an exception, never closed.
    void reset() { std::fill(at_.begin(), at_.end(), -1); }
    // Returns the position of a place in the open front: `out`, then `left`; -1: it is not there.
    std::int64_t at(std::int64_t place) const { return at_[index(place)]; }

private:
    // Variables of another front that are neighbours there and here; `to` is among those that are eliminated or left.
    struct Run {
        std::int64_t from, to, length;
    };
    struct Runs {
        std::vector<Run> out, left;
    };
    Runs runs(const TreeFront& front, const TreeFront& other) const;

    const Superelements& bodies_;
    std::vector<std::int64_t> at_;
};

}  // namespace delam
