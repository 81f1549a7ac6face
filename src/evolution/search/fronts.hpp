// SPDX-License-Identifier: BSD-3-Clause
// Finds the places where cracks may grow: the fronts of debonded regions, and places in intact regions where a new
// crack may begin.
//
// Pairs are neighbours when they share a face of an interface. A front is a connected set of adhering pairs next to
// debonded ones; its n-th ring are the adhering pairs n - 1 faces away from it. In 2D rings are single pairs, and the
// rings up to n an advance by n pairs.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/numbers.hpp"
#include "evolution/increment/damage_step.hpp"
#include "mesh/interface_geometry.hpp"

namespace delam {

class PairGraph {
public:
    PairGraph() = default;
    explicit PairGraph(std::span<const InterfaceGeometry> interfaces);
    std::size_t size() const { return start_.size() - 1; }
    std::span<const std::int64_t> neighbours(std::size_t pair) const {
        return std::span<const std::int64_t>(neighbour_).subspan(start_[pair], start_[pair + 1] - start_[pair]);
    }
    std::int64_t interface_of(std::size_t pair) const { return interface_[pair]; }
    std::int64_t first_pair(std::int64_t interface) const { return first_[index(interface)]; }

private:
    std::vector<std::size_t> start_{0};
    std::vector<std::int64_t> neighbour_;
    std::vector<std::int64_t> interface_, first_;
};

struct Front {
    std::int64_t interface;
    bool nucleation;                  // a new crack, not the advance of one
    std::vector<std::int64_t> pairs;  // the first ring, where it starts
};

// Smaller adhesion counts as debonded in reports.
inline constexpr double debonded_below = 1e-3;

// Returns the connected parts of a set of pairs, [pairs] 1 for those in it; each ascending.
std::vector<std::vector<std::int64_t>> components(const PairGraph& graph, const std::vector<std::uint8_t>& set);
// [pairs] 1 if a significant amount is left to dissipate. The adhesion itself does not show this: at k = 1e17 N/m3 a
// thousandth of it still bridges a crack.
std::vector<std::uint8_t> adhering_pairs(const PairLaws& pairs, std::span<const double> adhesion,
                                         std::span<const Toughness> toughness);
// Fronts of the debonded regions; then, in adhering regions, the ends of lines and up to `seeds` pairs per interface
// whose driving energy is the largest fraction of their onset among their neighbours.
std::vector<Front> find_fronts(const PairGraph& graph, const PairLaws& pairs, std::span<const std::uint8_t> adhering,
                               std::span<const Toughness> toughness, std::span<const double> jump, std::size_t seeds);
// Rings of adhering pairs around a front, the front itself first.
std::vector<std::vector<std::int64_t>> rings(const PairGraph& graph, std::span<const std::uint8_t> adhering,
                                             const Front& front);

}  // namespace delam
