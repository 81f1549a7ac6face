// SPDX-License-Identifier: BSD-3-Clause
// Where the cracks of an interface end, what drives them there, and how well the pairs resolve it.
//
// A front separates pairs with adhesion below 1/2 from those above: in 2D a point, in 3D the contour zeta = 1/2 on the
// faces. Its energy release rate is Rice's J integral (J. Appl. Mech. 35, 1968) on a path that hugs the interface from
// the open crack through the process zone and crosses the interface ahead of it, where the layer holds 1/2 t.[u]:
//     J = - int t . d[u]/dx dx + (1/2 t.[u])_ahead = 1/2 int (dt/dx . [u] - t . d[u]/dx) dx = int Y dzeta/dx dx,   t_c
//     = zeta k_c [u]_c.
// The last form has nothing to add where zeta is constant: it does not depend on how far behind and ahead it goes, and
// a closed contact, [u]_n = 0, adds nothing either. Between neighbouring pairs it is
//     1/2 (t_1.[u]_0 - t_0.[u]_1) = 1/2 k (zeta_1 - zeta_0) [u]_0 [u]_1,
// at a sharp tip 1/2 t_tip.[u]_behind: the virtual crack closure of Rybicki and Kanninen (Eng. Fract. Mech. 9, 1977).
// Components are the modes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "law/law.hpp"
#include "mesh/mesh.hpp"

namespace delam {

using Vector3 = std::array<double, 3>;  // third component 0 in 2D

struct FrontPoint {
    Vector3 place{};
    Vector3 direction{};      // unit, along the interface into what adheres
    double length = 0.0;      // 2D: of the crack that ends here; 3D: of front that the point stands for
    Vector3 rate{};           // energy release rate in modes I, II, III, F/L
    double zone = 0.0;        // process zone along `direction`, L
    double zone_pairs = 0.0;  // how many pairs lie in it

    double total() const { return rate[0] + rate[1] + rate[2]; }
    // Share of the shearing modes; 0 where there is no rate.
    double mixity() const { return total() > 0.0 ? (rate[1] + rate[2]) / total() : 0.0; }
};

// In 2D one point.
struct CrackFront {
    bool closed = false;  // a loop: its last point is joined to the first
    std::vector<FrontPoint> points;
};

// An interface with its law and state, each [pairs]; jump: [pairs][dimension], local.
struct CrackedInterface {
    const Mesh& mesh;
    const InterfaceGeometry& geometry;
    const Law& law;
    std::span<const double> initial;
    std::span<const double> adhesion;
    std::span<const double> jump;
};

// Adhesion where a front lies.
inline constexpr double front_adhesion = 0.5;
// Does a pair lie in the process zone? It has lost a thousandth of its adhesion, and a thousandth of its toughness is
// left to spend. The adhesion alone does not tell where the zone ends: past the onset it is below (onset jump)/(jump),
// little throughout the zone of a stiff interface.
bool in_process_zone(const CrackedInterface& interface, std::int64_t pair);
// Behind it: all but a thousandth of the toughness is spent, or it never adhered.
bool spent(const CrackedInterface& interface, std::int64_t pair);
// Weight of these pairs, L or L2.
double process_zone(const CrackedInterface& interface);
// Neither damaged nor open from the start: where the adhesion of two such pairs differs, it is no work of a crack.
inline bool undamaged(double initial, double adhesion) { return initial > 0.0 && adhesion >= initial; }

std::vector<CrackFront> crack_fronts(const CrackedInterface& interface);
// The two dimensions of it.
std::vector<CrackFront> crack_fronts_on_lines(const CrackedInterface& interface);
std::vector<CrackFront> crack_fronts_on_faces(const CrackedInterface& interface);

// a = a_0 + sum w (1 - zeta) over the pairs that adhered at first, L or L2; a_0: the linear pieces of faces that touch
// a pair without initial adhesion, so in 2D up to the pair at the tip. No more than the interface has.
double crack_length(const CrackedInterface& interface);

// Straight pieces of the faces as pair indices, without entries that only fill the list up: 2 pairs (2D), 3 or 4.
struct PairPiece {
    int pairs;
    std::array<std::int64_t, 4> pair;
};
std::vector<PairPiece> pair_pieces(const InterfaceGeometry& geometry, int dimension);

Vector3 place_of(const CrackedInterface& interface, std::int64_t pair);
// The jump in space: its part along the pair's normal, and the rest.
struct SpaceJump {
    double normal;
    Vector3 tangential;
};
SpaceJump jump_of(const CrackedInterface& interface, std::int64_t pair);

}  // namespace delam
