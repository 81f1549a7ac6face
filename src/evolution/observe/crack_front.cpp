// SPDX-License-Identifier: BSD-3-Clause
#include "evolution/observe/crack_front.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/numbers.hpp"
#include "law/driving.hpp"
#include "mesh/box_tree.hpp"
#include "mesh/faces.hpp"
#include "mesh/points.hpp"

namespace delam {

namespace {

constexpr double zone_ends = 1e-3;

Mixity mixity_of(const CrackedInterface& interface, std::int64_t pair) {
    const SpaceVector jump = jump_of(interface, pair);
    double shear = 0.0;
    for (const double component : jump.tangential) shear += component * component;
    const double normal = 0.5 * interface.law.normal_stiffness * jump.normal * jump.normal;
    if (!has_axes(interface.law)) return mode_mixity(normal, 0.5 * interface.law.tangential_stiffness * shear);
    const std::size_t dim = index(interface.mesh.dimension());
    const std::span<const double> local = interface.jump.subspan(index(pair) * dim, dim);
    const Driving y = driving_energy(interface.law, local);
    return Driving{normal, y.tangential, y.second}.mixity();
}

}  // namespace

bool in_process_zone(const CrackedInterface& interface, std::int64_t pair) {
    return interface.adhesion[index(pair)] < (1.0 - zone_ends) * interface.initial[index(pair)] &&
           !exhausted(interface, pair);
}

bool exhausted(const CrackedInterface& interface, std::int64_t pair) {
    const double adhesion = interface.adhesion[index(pair)];
    if (!(adhesion > 0.0)) return true;
    if (!(adhesion < 1.0)) return false;
    const Toughness toughness = interface.law.toughness(mixity_of(interface, pair));
    return interface.law.dissipated(toughness, adhesion) >= (1.0 - zone_ends) * toughness.total;
}

double spent(const CrackedInterface& interface, std::int64_t pair) {
    const double initial = interface.initial[index(pair)], adhesion = interface.adhesion[index(pair)];
    if (!(initial > 0.0) || !(adhesion > 0.0)) return 1.0;
    if (!(adhesion < initial)) return 0.0;
    const Toughness toughness = interface.law.toughness(mixity_of(interface, pair));
    const double before = interface.law.dissipated(toughness, initial);
    const double left = toughness.total - before;
    if (!(left > 0.0)) return 1.0;
    return std::clamp((interface.law.dissipated(toughness, adhesion) - before) / left, 0.0, 1.0);
}

std::vector<double> spent(const CrackedInterface& interface) {
    std::vector<double> shares(interface.adhesion.size());
    for (std::size_t p = 0; p < shares.size(); ++p) shares[p] = spent(interface, static_cast<std::int64_t>(p));
    return shares;
}

double process_zone(const CrackedInterface& interface) {
    double zone = 0.0;
    for (std::size_t p = 0; p < interface.adhesion.size(); ++p)
        if (in_process_zone(interface, static_cast<std::int64_t>(p))) zone += interface.geometry.weight[p];
    return zone;
}

std::vector<PairPiece> pair_pieces(const InterfaceGeometry& geometry, int dimension) {
    const auto per_face = index(geometry.nodes_per_face);
    std::vector<PairPiece> pieces;
    if (geometry.face.empty()) return pieces;
    const auto of_a_face = face_pieces(dimension, per_face);
    pieces.reserve(geometry.face.size() / per_face * of_a_face.size());
    for (std::size_t f = 0; f + per_face <= geometry.face.size(); f += per_face)
        for (const FacePiece& piece : of_a_face) {
            PairPiece own{0, {}};
            for (int k = 0; k < piece.nodes; ++k) {
                const std::int64_t pair = geometry.face[f + index(piece.node[index(k)])];
                const auto end = own.pair.begin() + own.pairs;
                if (std::find(own.pair.begin(), end, pair) == end) own.pair[index(own.pairs++)] = pair;
            }
            if (own.pairs >= dimension) pieces.push_back(own);
        }
    return pieces;
}

Vector3 place_of(const CrackedInterface& interface, std::int64_t pair) {
    const auto node = interface.mesh.node(interface.geometry.node_b[index(pair)]);
    Vector3 place{};
    std::copy(node.begin(), node.end(), place.begin());
    return place;
}

namespace {

SpaceVector in_space(const CrackedInterface& interface, std::int64_t pair, std::span<const double> local,
                     double scale) {
    const std::size_t dim = index(interface.mesh.dimension());
    const double* frame = &interface.geometry.frame[index(pair) * dim * dim];
    SpaceVector made{scale * local[index(pair) * dim], {}};
    for (std::size_t t = 1; t < dim; ++t)
        for (std::size_t i = 0; i < dim; ++i)
            made.tangential[i] += frame[t * dim + i] * scale * local[index(pair) * dim + t];
    return made;
}

}  // namespace

SpaceVector jump_of(const CrackedInterface& interface, std::int64_t pair) {
    return in_space(interface, pair, interface.jump, 1.0);
}

SpaceVector traction_of(const CrackedInterface& interface, std::int64_t pair) {
    return in_space(interface, pair, interface.force, 1.0 / interface.geometry.weight[index(pair)]);
}

void add_closure(const CrackedInterface& interface, std::int64_t p, std::int64_t q, double factor, const Vector3& n,
                 Vector3& rate) {
    const SpaceVector u = jump_of(interface, p), v = jump_of(interface, q);
    const SpaceVector s = traction_of(interface, p), t = traction_of(interface, q);
    const double ahead = dot(t.tangential, n) * dot(u.tangential, n) - dot(s.tangential, n) * dot(v.tangential, n);
    const double sliding = dot(t.tangential, u.tangential) - dot(s.tangential, v.tangential);
    rate[0] += factor * (t.normal * u.normal - s.normal * v.normal);
    rate[1] += factor * ahead;
    rate[2] += factor * (sliding - ahead);
}

std::vector<CrackFront> crack_fronts(const CrackedInterface& interface) {
    return interface.mesh.dimension() == 2 ? crack_fronts_on_lines(interface) : crack_fronts_on_faces(interface);
}

namespace {

Box around(const Box& box, const Point& place) {
    Box wider = box;
    for (std::size_t i = 0; i < 3; ++i) {
        wider.low[i] = std::min(wider.low[i], place[i]);
        wider.high[i] = std::max(wider.high[i], place[i]);
    }
    return wider;
}

}  // namespace

void mark_cells_at_fronts(const CrackedInterface& interface, std::span<std::uint8_t> cells) {
    const Mesh& mesh = interface.mesh;
    std::vector<Box> fronts;
    for (const PairPiece& piece : pair_pieces(interface.geometry, mesh.dimension())) {
        const auto pairs = std::span(piece.pair).first(index(piece.pairs));
        const auto behind =
            std::count_if(pairs.begin(), pairs.end(), [&](std::int64_t p) { return exhausted(interface, p); });
        if (behind == 0 || behind == piece.pairs) continue;
        Box box{place_of(interface, pairs.front()), place_of(interface, pairs.front())};
        for (const std::int64_t p : pairs) box = around(box, place_of(interface, p));
        const double faces = 2.0 * length(box.high - box.low);
        for (std::size_t i = 0; i < 3; ++i) box.low[i] -= faces, box.high[i] += faces;
        fronts.push_back(box);
    }
    if (fronts.empty()) return;
    const BoxTree tree(std::move(fronts));
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        Box box{position(mesh, mesh.cell(c)[0]), position(mesh, mesh.cell(c)[0])};
        for (const std::int64_t n : mesh.cell(c)) box = around(box, position(mesh, n));
        tree.meeting(box, [&](std::int64_t) { cells[index(c)] = 1; });
    }
}

}  // namespace delam
