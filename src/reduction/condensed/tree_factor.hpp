// SPDX-License-Identifier: BSD-3-Clause
// The Cholesky factor of the whole skeleton, with springs on its jumps, along the tree of superelements. A change of
// springs renews the fronts on the path from its node to the root; a solve renews the forward substitution of the nodes
// below which loads or springs have changed, and goes back down only where jumps are asked for. No digit depends on
// earlier factors.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/monitor.hpp"
#include "reduction/condensed/front.hpp"
#include "reduction/condensed/superelements.hpp"

namespace delam {

class TreeFactor {
public:
    // `bodies` must outlive it.
    explicit TreeFactor(const Superelements& bodies);

    // held: [places] 1: at rest. spring: [places] on the diagonal. cross: entries beside it, row > column, both of one
    // node (owner()), in an order that does not change. False: not positive definite; nothing is then left to solve
    // with.
    bool factor(std::span<const std::uint8_t> held, std::span<const double> spring, std::span<const Triplet> cross,
                const Poll& poll);
    // Sets x to A^-1 b on the wanted nodes, which must have their parents among them, and to zero elsewhere; [places].
    // Forces on held places do nothing. Returns b^T A^-1 b.
    double solve(std::span<const double> b, std::span<const std::uint8_t> wanted, std::span<double> x);
    // Returns F^T A^-1 F of forces in columns, each a list of places with values, which must not be held.
    DenseMatrix flexibility(std::span<const std::vector<std::pair<std::int64_t, double>>> forces) const;
    // Sets y to S x in the given places, which must not be cuts, where x is known on their nodes(); 0 elsewhere.
    void image(std::span<const double> x, std::span<const std::int64_t> places, std::span<double> y) const;

    // Returns the node that owns a place.
    std::int64_t owner(std::int64_t place) const { return owner_[index(place)]; }
    // [nodes] 1: the energy of one of these places is there, or below.
    std::vector<std::uint8_t> nodes(std::span<const std::int64_t> places) const;
    // Returns the operations of the fronts that a change at these places renews, twice their multiplications.
    double operations(std::span<const std::int64_t> places) const;
    // Returns how many fronts have been made so far.
    std::int64_t fronts_made() const { return fronts_made_; }

private:
    struct Node {
        TreeFront front;
        std::vector<std::vector<std::int64_t>> of_child;  // position here of what each child leaves
        std::vector<Triplet> cross;
        // Forward substitution: its load, L^-1 of what arrives, what goes on to the parent, and b^T A^-1 b below.
        std::vector<double> load, forward, up;
        double work = 0.0;
        std::int64_t made = -1;    // the front with which it was made
        std::int64_t solved = -1;  // number of the solve that has renewed it
    };
    bool make(std::int64_t number, const Poll& poll);
    void find_stale(std::span<const std::uint8_t> held, std::span<const double> spring, std::span<const Triplet> cross);
    void divide(Node& node, std::int64_t number) const;
    void substitute(std::int64_t number, std::span<const double> b);

    const Superelements& bodies_;
    std::vector<Node> nodes_;
    std::vector<std::int64_t> parent_, owner_;  // [nodes], [places]
    std::vector<std::uint8_t> held_;            // of the last factor(), as the next
    std::vector<double> spring_;
    FrontBuilder builder_;
    std::int64_t updates_ = 0, solves_ = 0, fronts_made_ = 0;
    bool interrupted_ = false;
};

}  // namespace delam
