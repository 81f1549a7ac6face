// SPDX-License-Identifier: BSD-3-Clause
// The ends of an interface's cracks, their energy release rate, and how well the pairs resolve them.
//
// A front separates pairs with adhesion below 1/2 from those above: in 2D a point, in 3D the contour zeta = 1/2 on the
// faces. Its energy release rate is Rice's J integral (J. Appl. Mech. 35, 1968) on a path that follows the interface
// from the open crack through the process zone and crosses the interface ahead of it, where the layer stores 1/2 t.[u]:
//     J = - int t . d[u]/dx dx + (1/2 t.[u])_ahead = 1/2 int (dt/dx . [u] - t . d[u]/dx) dx = int Y dzeta/dx dx,
//     t_c = zeta k_c [u]_c.
// The last form has no contribution where zeta is constant, so it does not depend on how far the path extends; a closed
// contact, [u]_n = 0, does not contribute either. Between neighbouring pairs it is
//     1/2 (t_1.[u]_0 - t_0.[u]_1) = 1/2 k (zeta_1 - zeta_0) [u]_0 [u]_1,
// at a sharp tip 1/2 t_tip.[u]_behind: the virtual crack closure of Rybicki and Kanninen (Eng. Fract. Mech. 9, 1977).
// The traction of a stiff interface is that of a contact where it presses, which closes behind an advancing tip as any
// other. Its components are the modes. On quadratic faces the pairs are the next ones of their kind (pair_links.hpp).
//
// In 3D, the rate of a point is that of a band about it. It is the integral of w Y grad zeta . n over the faces,
// divided by the length of front in the band, - int w grad s . n dA. The spent share s falls from 1 to 0 across the
// zone, so that where the front is curved this is the length in the middle of the zone.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/numbers.hpp"
#include "law/law.hpp"
#include "mesh/mesh.hpp"

namespace delam {

using Vector3 = std::array<double, 3>;  // third component 0 in 2D

inline double total_rate(const Vector3& rate) { return rate[0] + rate[1] + rate[2]; }
// Share of the shearing modes; 0 if the rate is 0, 1 where contact presses at the front.
inline double shear_share(const Vector3& rate) {
    const double total = total_rate(rate);
    return total > 0.0 ? std::min((rate[1] + rate[2]) / total, 1.0) : 0.0;
}

struct FrontPoint {
    Vector3 place{};
    Vector3 direction{};      // unit, along the interface into the adhering part
    double length = 0.0;      // 2D: of the crack that ends here; 3D: length of front that belongs to the point
    Vector3 rate{};           // energy release rate in modes I, II, III, F/L
    double zone = 0.0;        // process zone along `direction`, L
    double zone_pairs = 0.0;  // number of pairs in it

    double total() const { return total_rate(rate); }
    double mixity() const { return shear_share(rate); }
};

// A front; in 2D it has one point.
struct CrackFront {
    bool closed = false;  // a loop: its last point is connected to the first
    std::vector<FrontPoint> points;
};

// An interface with its law and state, each [pairs]; jump and force: [pairs][dimension], local.
struct CrackedInterface {
    const Mesh& mesh;
    const InterfaceGeometry& geometry;
    const Law& law;
    std::span<const double> initial;
    std::span<const double> adhesion;
    std::span<const double> jump;
    std::span<const double> force;  // F, contact included
};

// The adhesion at a front.
inline constexpr double front_adhesion = 0.5;
// Share of the toughness of a pair that is spent, at the mixity of its jump: 0 before damage, 1 where the crack is open
// and where nothing adhered at first. What an initial adhesion below 1 had spent before the start does not count.
double spent(const CrackedInterface& interface, std::int64_t pair);
// The same of all pairs, [pairs].
std::vector<double> spent(const CrackedInterface& interface);
// True if a pair lies in the process zone: it has lost a thousandth of its adhesion, and a thousandth of its toughness
// is left to dissipate. The adhesion alone does not show where the zone ends: beyond the onset it is below (onset
// jump)/(jump), which is small throughout the zone of a stiff interface.
bool in_process_zone(const CrackedInterface& interface, std::int64_t pair);
// True if the pair lies behind the zone: all but a thousandth of the toughness is dissipated, or it never adhered.
bool exhausted(const CrackedInterface& interface, std::int64_t pair);
// Weight of these pairs, L or L2.
double process_zone(const CrackedInterface& interface);
// True if the pair is neither damaged nor initially open: if the adhesion of two such pairs differs, no crack is the
// cause.
inline bool undamaged(double initial, double adhesion) { return initial > 0.0 && adhesion >= initial; }
// True if a crack has parted two pairs.
inline bool parted(const CrackedInterface& interface, std::int64_t p, std::int64_t q) {
    const double initial_p = interface.initial[index(p)], initial_q = interface.initial[index(q)];
    const double adhesion_p = interface.adhesion[index(p)], adhesion_q = interface.adhesion[index(q)];
    return adhesion_p != adhesion_q && !(undamaged(initial_p, adhesion_p) && undamaged(initial_q, adhesion_q));
}

std::vector<CrackFront> crack_fronts(const CrackedInterface& interface);
// Marks the cells of the mesh, [cells], within two faces of a place where exhausted pairs meet others.
void mark_cells_at_fronts(const CrackedInterface& interface, std::span<std::uint8_t> cells);
// Find the fronts of interfaces in 2D and in 3D.
std::vector<CrackFront> crack_fronts_on_lines(const CrackedInterface& interface);
std::vector<CrackFront> crack_fronts_on_faces(const CrackedInterface& interface);

// a = a_0 + sum w (1 - zeta) over the initially adhering pairs, L or L2; a_0 is the size of the linear pieces of faces
// that touch a pair without initial adhesion; in 2D it reaches to the pair at the tip. The length is at most the size
// of the interface.
double crack_length(const CrackedInterface& interface);
// A = a_0 + what the front has swept, L or L2. This front is the contour of the spent share, linear between pairs, in
// the middle of the zone (front_spent). At the start it lies about half a cell behind a_0, and that distance stays.
// Without faces A is the weight of the pairs behind the front. A zone that travels and keeps its shape dissipates Gc
// per area: the contour of zeta = 1/2, the outer rim of the zone of a stiff interface, sweeps more where it is curved.
// The area is at most the size of the interface.
double crack_area(const CrackedInterface& interface);

// Straight pieces of the faces as pair indices, without padding entries: 2 pairs (2D), 3 or 4.
struct PairPiece {
    int pairs;
    std::array<std::int64_t, 4> pair;
};
// A quadrilateral as two triangles, in both ways: each of the four counts half.
inline constexpr std::array<std::array<int, 3>, 4> quad_halves{{{0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {1, 2, 3}}};
std::vector<PairPiece> pair_pieces(const InterfaceGeometry& geometry, int dimension);

Vector3 place_of(const CrackedInterface& interface, std::int64_t pair);
// The jump of a pair in space, or its traction (force over weight): the component along the pair's normal, and the
// rest.
struct SpaceVector {
    double normal;
    Vector3 tangential;
};
SpaceVector jump_of(const CrackedInterface& interface, std::int64_t pair);
SpaceVector traction_of(const CrackedInterface& interface, std::int64_t pair);
// Adds factor (t_q.[u]_p - t_p.[u]_q), in the modes of a front that advances in direction n, to a rate.
void add_closure(const CrackedInterface& interface, std::int64_t p, std::int64_t q, double factor, const Vector3& n,
                 Vector3& rate);

}  // namespace delam
