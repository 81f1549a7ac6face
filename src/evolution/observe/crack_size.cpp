// SPDX-License-Identifier: BSD-3-Clause
// Sizes of the cracks of an interface: lengths in 2D, areas in 3D.
#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "evolution/observe/crack_front.hpp"
#include "mesh/faces.hpp"

namespace delam {

namespace {

double measure(const CrackedInterface& interface, const PairPiece& piece) {
    std::array<std::int64_t, 4> node{};
    for (int k = 0; k < piece.pairs; ++k) node[index(k)] = interface.geometry.node_b[index(piece.pair[index(k)])];
    const auto area = area_vector(interface.mesh, std::span<const std::int64_t>(node).first(index(piece.pairs)));
    return std::hypot(area[0], area[1], area[2]);
}

// The spent share at the front: that in the middle of the zone, by the mean of where it is spent. Where a plate bends
// away, the opening and with it the spent share rise about as x^2 from the edge of the zone, whose middle is at x =
// 2/3. Measured on circular fronts with a zone of a third of the radius, d(dissipated)/d(area) over the toughness: .998
// to 1.001 (hex8, hex20, tet10; 6 to 10 pairs in the zone), with 1/2 1.010 to 1.012. Where shear opens a zone, it is x.
constexpr double front_spent = 4.0 / 9.0;

bool initially_open(const CrackedInterface& interface, const PairPiece& piece) {
    const auto pairs = std::span(piece.pair).first(index(piece.pairs));
    return std::any_of(pairs.begin(), pairs.end(),
                       [&](std::int64_t p) { return !(interface.initial[index(p)] > 0.0); });
}

// Part of a triangle, or of a segment, in which the linear interpolation of s is above front_spent.
double part_behind(const std::array<double, 3>& s, std::size_t corners) {
    std::size_t above = 0;
    for (std::size_t i = 0; i < corners; ++i) above += s[i] >= front_spent ? 1 : 0;
    if (above == 0 || above == corners) return above == 0 ? 0.0 : 1.0;
    // The corner that is alone on its side, cut off from each of the others.
    const bool alone = above == 1;
    double part = 1.0;
    for (std::size_t i = 0; i < corners; ++i) {
        if ((s[i] >= front_spent) != alone) continue;
        for (std::size_t j = 0; j < corners; ++j)
            if (j != i) part *= (s[i] - front_spent) / (s[i] - s[j]);
        return alone ? part : 1.0 - part;
    }
    return part;
}

// Size of the part of a piece that lies behind the front; quadrilaterals as two triangles, in both ways.
double behind(const CrackedInterface& interface, const PairPiece& piece, std::span<const double> shares) {
    const auto at = [&](int corner) { return shares[index(piece.pair[index(corner)])]; };
    if (piece.pairs < 4)
        return measure(interface, piece) *
               part_behind({at(0), at(1), piece.pairs == 3 ? at(2) : 0.0}, index(piece.pairs));
    double area = 0.0;
    for (const std::array<int, 3>& t : quad_halves)
        area += 0.5 * part_behind({at(t[0]), at(t[1]), at(t[2])}, 3) *
                measure(interface, {3, {piece.pair[index(t[0])], piece.pair[index(t[1])], piece.pair[index(t[2])], 0}});
    return area;
}

}  // namespace

double crack_length(const CrackedInterface& interface) {
    double length = 0.0, all = 0.0;
    for (std::size_t p = 0; p < interface.adhesion.size(); ++p) {
        const double weight = interface.geometry.weight[p];
        all += weight;
        if (interface.initial[p] > 0.0) length += weight * (1.0 - interface.adhesion[p]);
    }
    for (const PairPiece& piece : pair_pieces(interface.geometry, interface.mesh.dimension()))
        if (initially_open(interface, piece)) length += measure(interface, piece);
    return std::min(length, all);
}

double crack_area(const CrackedInterface& interface) {
    const std::vector<double> now = spent(interface);
    const std::vector<PairPiece> pieces = pair_pieces(interface.geometry, interface.mesh.dimension());
    double all = 0.0, weight_behind = 0.0;
    std::vector<double> first(now.size());
    for (std::size_t p = 0; p < now.size(); ++p) {
        first[p] = interface.initial[p] > 0.0 ? 0.0 : 1.0;
        all += interface.geometry.weight[p];
        if (now[p] >= front_spent) weight_behind += interface.geometry.weight[p];
    }
    if (pieces.empty()) return weight_behind;
    double area = 0.0;
    for (const PairPiece& piece : pieces) {
        if (initially_open(interface, piece)) area += measure(interface, piece);
        area += behind(interface, piece, now) - behind(interface, piece, first);
    }
    return std::clamp(area, 0.0, all);
}

}  // namespace delam
